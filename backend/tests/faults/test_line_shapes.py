"""Faults of lines that come and go: when, what clients meet meanwhile, and that a replay needs nobody who knows of it."""

import pytest

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.faults.line_faults import BROKEN_LINES, NO_FAULT, BreakLine, LineFault, Lines, MendLine
from scanbench.recording.headless import HeadlessRun, run_headless
from scanbench.recording.replay import replay
from scanbench.runtime.command import Command, Refusal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from tests.runtime.bench import plc, program

SOURCE = "PROGRAM Main VAR n : DINT; END_VAR n := n + 1; END_PROGRAM"


def steps(scans: int, *commands: tuple[int, Command]) -> tuple[list[tuple[int, str]], Resource]:
    """What was entered of lines, by scan, and the PLC; again from the journal alone, which must come to the same."""
    run: HeadlessRun[None] = run_headless(program(SOURCE), scans, ReferenceEngine, commands, agenda=Lines())
    again = Resource(Loaded.make(program(SOURCE), ReferenceEngine))
    replay(again, run.entries, run.resource.header.scan)
    assert again.state == run.resource.state
    assert again.journal.derived(BROKEN_LINES) == run.resource.journal.derived(BROKEN_LINES)
    return [(each.scan, each.plan.message) for each in run.entries], run.resource


def test_a_fault_for_some_scans_goes_by_itself() -> None:
    found, resource = steps(100, (10, BreakLine("Ada", "fins", LineFault("cut", scans=5))))
    assert found == [(10, "line of FINS: connections end, for 5 scans"), (15, "line of FINS: the fault is gone")]
    assert resource.journal.derived(BROKEN_LINES) == {}


def test_a_fault_comes_again_until_the_line_is_mended() -> None:
    broken = (10, BreakLine("Ada", "modbus", LineFault("late", 500, scans=2, period=10)))
    found, resource = steps(35, broken)
    assert found[0] == (10, "line of Modbus TCP: answers come 500 ms late, 2 of every 10 scans")
    assert [scan for scan, _ in found] == [10, 12, 20, 22, 30, 32]
    line = resource.journal.derived(BROKEN_LINES)["modbus"]
    assert (line.present, line.now, line.due, line.by) == (False, NO_FAULT, 40, "Ada")
    found, resource = steps(100, broken, (25, MendLine("Jo", "modbus")))
    assert [scan for scan, _ in found] == [10, 12, 20, 22, 25]
    assert resource.journal.derived(BROKEN_LINES) == {}


def test_another_fault_of_the_line_takes_the_place_of_one_that_comes_and_goes() -> None:
    first, other = LineFault("cut", scans=2, period=10), LineFault("silent")
    found, resource = steps(50, (10, BreakLine("Ada", "fins", first)), (15, BreakLine("Jo", "fins", other)))
    assert [scan for scan, _ in found] == [10, 12, 15]
    assert resource.journal.derived(BROKEN_LINES)["fins"].now == other


@pytest.mark.parametrize(
    ("fault", "why"),
    [
        (LineFault("cut", scans=0), "scans is 0: it must be 1 to"),
        (LineFault("cut", scans=10, period=10), "it would never go"),
        (LineFault("cut", period=10), "say for how many scans"),
    ],
)
def test_what_no_scan_can_be_made_of_is_refused(fault: LineFault, why: str) -> None:
    refused = plc(SOURCE).submit(BreakLine("Ada", "fins", fault))
    assert isinstance(refused, Refusal)
    assert why in refused.message
