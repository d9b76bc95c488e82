"""What the elements of a drawing saw on both sides of a verification."""

from pathlib import Path

import pytest

from scanbench.debug.flow import FlowHook
from scanbench.debug.flow_shown import Flow, FlowAsked
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.symbols.symbols import UnknownPath
from scanbench.verify.contract import VerifyFlows
from scanbench.verify.edits import BadEdit
from tests.runtime.bench import program
from tests.verify.verified_runs import record, verifier

GATE = """FUNCTION_BLOCK Gate
VAR_INPUT go, stop : BOOL; x : INT; END_VAR VAR run, late : BOOL; jam : TON; y : INT; END_VAR
RUNG "Hold"
    < [go] | [run] > [/stop] (run)
END_RUNG
RUNG "Jam"
    [run] jam(IN := ~, PT := T#0s).Q (late)
END_RUNG
NETWORK "Ramp"
    #low = ADD(x, 3);
    #high = AND(run, GT(#low, 3));
    y := SEL(#high, #low, 7);
END_NETWORK
END_FUNCTION_BLOCK
PROGRAM Main
VAR first, second : Gate; END_VAR
    first(go := FALSE, x := 1);
    second(go := TRUE, x := 1);
    second(stop := TRUE);
END_PROGRAM
"""
LINES = {text.strip(): number for number, text in enumerate(GATE.splitlines(), 1)}
HOLD, JAM, HIGH = (
    LINES["< [go] | [run] > [/stop] (run)"],
    LINES["[run] jam(IN := ~, PT := T#0s).Q (late)"],
    LINES["#high = AND(run, GT(#low, 3));"],
)
FIRST = FlowAsked("Gate", "Main.first")


def seen(
    path: Path,
    engine: EngineFactory = ReferenceEngine,
    range: str = "Gate",
    asked: FlowAsked = FIRST,
    limit: int = 4096,
) -> VerifyFlows:
    """In scan 3, in which the coil of the first rung wrote a wrong value."""
    wrong = Disturbance("result", site=f"main.st:{HOLD}", bit=0, path="Main.first.run", scan=3)
    record(path, program(GATE), 6, [(1, Disturb("Ada", wrong))], engine=engine, agenda=DisturbanceSchedule())
    made = verifier(path, program(GATE), range, limit=limit)
    made.verify(3)
    return made.flows(3, 1, asked)


def said(flow: Flow, line: int) -> list[tuple[int, bool | None, dict[str, str]]]:
    """The elements of a line: column, power, and what they read or wrote."""
    return [
        (each.column, each.power, {value.name: value.text for value in each.values})
        for each in flow.elements
        if each.line == line
    ]


@pytest.mark.parametrize("engine", [ReferenceEngine, NativeEngine])
def test_both_sides_are_told_element_by_element_and_the_coil_differed_first(
    tmp_path: Path, engine: EngineFactory
) -> None:
    found = seen(tmp_path / "run", engine)
    (control,), (monitor,) = found.control.flows, found.monitor.flows
    assert (found.line, found.column) == (HOLD, GATE.splitlines()[HOLD - 1].index("(run)") + 1)
    assert said(control, HOLD)[:-1] == said(monitor, HOLD)[:-1]  # the contacts before it are the same
    assert said(control, HOLD)[-1][2] == {"run": "TRUE"}
    assert said(monitor, HOLD)[-1][2] == {"run": "FALSE"}
    contact, box = said(control, JAM)[:2]
    assert (contact[1], contact[2], box[1], box[2]["jam.IN"]) == (True, {"run": "TRUE"}, True, "TRUE")
    contact, box = said(monitor, JAM)[:2]
    assert (contact[1], contact[2], box[1], box[2]["jam.IN"]) == (False, {"run": "FALSE"}, False, "FALSE")
    assert {each.name: each.text for each in control.wires} == {"#LOW": "4", "#HIGH": "TRUE"}
    assert {each.name: each.text for each in monitor.wires} == {"#LOW": "4", "#HIGH": "FALSE"}


def test_of_the_whole_scan_it_is_the_last_call_of_the_instance(tmp_path: Path) -> None:
    second = FlowAsked("Gate", "Main.second")
    found = seen(tmp_path / "run", range="", asked=second)
    (control,), (monitor,) = found.control.flows, found.monitor.flows
    assert (control.calls, monitor.calls, found.line) == (2, 2, 0)
    assert control.elements == monitor.elements
    assert [values["run"] for _, _, values in said(control, HOLD) if "run" in values][-1] == "FALSE"
    first = seen(tmp_path / "again", range="")
    assert (first.line, first.control.flows[0].calls) == (HOLD, 1)


def test_it_is_what_the_debug_flavour_notes(tmp_path: Path) -> None:
    monitor = seen(tmp_path / "run").monitor.flows[0]
    loaded = Loaded.make(program(GATE), ReferenceEngine)
    resource = Resource(loaded)
    resource.run(3)
    hook = FlowHook(resource, FIRST)
    with resource.listening.instead(hook, hook.listen):
        resource.run(1)
    hook.over()
    noted = {(each.line, each.column): each.power for each in hook.flow.elements}
    assert {(each.line, each.column): each.power for each in monitor.elements} == noted


def test_a_record_that_is_full_and_an_unknown_block_are_refused(tmp_path: Path) -> None:
    with pytest.raises(BadEdit, match="is full"):
        seen(tmp_path / "full", limit=5)
    with pytest.raises(UnknownPath):
        seen(tmp_path / "unknown", asked=FlowAsked("Nope"))
