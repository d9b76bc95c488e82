"""What the code saw, element by element: power, values, calls, in scans that are run again."""

import re
from pathlib import Path

import pytest
from hypothesis import given, settings

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.flow import FlowHook
from scanbench.debug.flow_shown import Flow, FlowAsked, FlowElement
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.program.program import Program
from scanbench.recording.again import kept_moment, listen_again
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.symbols.symbols import UnknownPath
from tests.amounts import amount
from tests.caseformat import read_cases, write
from tests.debug.scenes import checked
from tests.debug.test_walks import BUILDS, ENGINES
from tests.debug.walking import MakeDebug, Walker
from tests.drawings.draws import of
from tests.drawings.ladder import VARIABLES, Run, State, diagram

MAIN = FlowAsked("Main", "Main")
CONTACT = re.compile(r"\[/?[\w.]+\]")
CASES = Path(__file__).parents[1] / "cases"


def resource_of(program: Program, make: MakeDebug) -> Resource:
    """A PLC whose debug flavour is this one."""
    loaded = Loaded.make(program, ReferenceEngine)
    resource = Resource(loaded)
    loaded.debug = make(program, loaded.memory)
    return resource


def ran(resource: Resource, asked: FlowAsked = MAIN) -> Flow:
    """The flow of one scan that is run."""
    hook = FlowHook(resource, asked)
    with resource.listening.instead(hook, hook.listen):
        resource.run(1)
    hook.over()
    return hook.flow


def flow_of(walker: Walker, asked: FlowAsked, scan: int, upto: int = 0) -> Flow:
    """Of a scan that is run again."""
    hooks: list[FlowHook] = []

    def make(resource: Resource) -> FlowHook:
        hooks.append(FlowHook(resource, asked, upto))
        return hooks[0]

    before = walker.seen
    assert listen_again(walker.timeline, scan, make) is None
    assert walker.seen == before
    return hooks[0].flow


def at(flow: Flow, line: int, number: int = 0) -> FlowElement:
    return [each for each in flow.elements if each.line == line][number]


def said(flow: Flow, line: int, number: int = 0) -> dict[str, str]:
    return {each.name: each.text for each in at(flow, line, number).values}


@ENGINES
@settings(max_examples=amount(150, 10), deadline=None)
@given(of(diagram))
def test_power_and_values_are_those_of_a_straightforward_evaluation(
    make: MakeDebug, made: tuple[str, list[Run], list[dict[str, bool]]]
) -> None:
    source, runs, sets = made
    resource = resource_of(checked(source), make)
    state = State(dict.fromkeys(VARIABLES, False))
    for values in sets:
        for name, value in values.items():
            state.values[name] = value
            write(resource.program, f"Main.{name}", str(value).upper(), resource.memory)
        state.noted.clear()
        for run in runs:
            run(state, True)
        flow = ran(resource)
        found = [
            (each.values[-1].text == "TRUE", None if each.values[-1].written else each.power)
            for each in flow.elements
            if each.values
        ]
        assert found == state.noted, source
        assert (flow.calls, flow.call, flow.whole) == (1, 1, True) or not any(run for run in runs)


@ENGINES
def test_the_vectors_flow_as_their_values_say(make: MakeDebug) -> None:
    """Of every case of ladders: a contact that is not an edge has power just where what it saw lets it through, and a coil has the value that is there
    after the scan unless something else writes it, too."""
    looked = 0
    for case in read_cases(CASES / "ladder.case"):
        if case.trap or case.model != "GENERIC-IEC" or "Main" not in case.source or case.libraries or case.dialect:
            continue
        program = checked(case.source)
        resource = resource_of(program, make)
        texts = case.source.splitlines()
        for step in range(max((each.scan for each in case.steps), default=0) + 1):
            for each in case.steps:
                for path, value in each.sets if each.scan == step else ():
                    write(
                        program, f"Main.{path}" if not path.startswith(("Main", "%")) else path, value, resource.memory
                    )
            for element in ran(resource).elements:
                text = texts[element.line - 1][element.column - 1 :]
                if not CONTACT.match(text):
                    continue
                lets = (element.values[0].text == "TRUE") != text.startswith("[/")
                looked += 1
                assert lets or not element.power, f"{case.name}, scan {step}, {text}"
    assert looked > 100


BELT = """\
FUNCTION_BLOCK Belt
VAR_INPUT go : BOOL; END_VAR
VAR_OUTPUT n : INT; END_VAR
VAR on, off, done, skip : BOOL; jam : TON; END_VAR
RUNG
    [go] (on)
END_RUNG
RUNG
    [on] (off)
    (R on)
END_RUNG
RUNG
    [on] jam(IN := ~, PT := T#1s).Q (done)
END_RUNG
RUNG
    [skip] JMP last
END_RUNG
RUNG
    [off] n := ADD(EN := ~, IN1 := n, IN2 := 1).ENO (done)
END_RUNG
RUNG last:
    [/off] (skip)
END_RUNG
END_FUNCTION_BLOCK
PROGRAM Main
VAR a, b, c : Belt; twice : INT; END_VAR
a(go := TRUE);
b(go := FALSE);
IF twice > 0 THEN c(); END_IF;
c(go := TRUE);
c(go := FALSE);
twice := 1;
END_PROGRAM
"""


@ENGINES
def test_what_was_seen_is_not_what_is_there_after_the_scan(make: MakeDebug) -> None:
    resource = resource_of(checked(BELT), make)
    flow = ran(resource, FlowAsked("Belt", "Main.a"))
    assert (at(flow, 9, 0).power, said(flow, 9)) == (True, {"on": "TRUE"})
    assert said(flow, 10) == {"on": "FALSE"}
    assert (at(flow, 13).power, said(flow, 13)) == (False, {"on": "FALSE"})
    assert said(flow, 13, 1)["jam.IN"] == "FALSE"
    assert at(flow, 19, 1).power is True
    assert said(flow, 19, 1)["n"] == "1"


@ENGINES
def test_each_instance_is_told_alone_and_each_call_has_its_number(make: MakeDebug) -> None:
    resource = resource_of(checked(BELT), make)
    assert at(ran(resource, FlowAsked("Belt", "Main.b")), 6).power is False
    last = ran(resource, FlowAsked("Belt", "Main.c"))
    assert (last.calls, last.call, said(last, 6)) == (3, 3, {"go": "FALSE"})
    first = ran(resource, FlowAsked("Belt", "Main.c", call=2))
    assert (first.calls, first.call, said(first, 6)) == (3, 2, {"go": "TRUE"})
    none = ran(resource, FlowAsked("Belt", "Main.c", call=9))
    assert (none.calls, none.call, none.elements) == (3, 0, ())


@ENGINES
def test_what_is_jumped_over_is_not_there(make: MakeDebug) -> None:
    resource = resource_of(checked(BELT), make)
    write(resource.program, "Main.b.skip", "TRUE", resource.memory)
    flow = ran(resource, FlowAsked("Belt", "Main.b"))
    assert {each.line for each in flow.elements} == {6, 9, 10, 13, 16, 22}
    assert at(flow, 16).power is True


@ENGINES
def test_an_instance_that_is_not_called_has_no_elements(make: MakeDebug) -> None:
    source = BELT.replace("a(go := TRUE);", "IF twice > 5 THEN a(); END_IF;")
    flow = ran(resource_of(checked(source), make), FlowAsked("Belt", "Main.a"))
    assert (flow.calls, flow.call, flow.whole, flow.elements) == (0, 0, True, ())


@ENGINES
def test_of_lines_out_of_sight_nothing_is_told(make: MakeDebug) -> None:
    flow = ran(resource_of(checked(BELT), make), FlowAsked("Belt", "Main.a", first=9, last=10))
    assert said(flow, 9) == {"on": "TRUE"}
    assert {each.line for each in flow.elements} <= {9, 10}


DIAGRAM = """\
FUNCTION_BLOCK Ramp
VAR_INPUT auto : BOOL; x : INT; END_VAR
VAR_OUTPUT y : INT; END_VAR
NETWORK
    #low = SUB(x, 1);
    #high = ADD(#low, #loop);
    y := MOVE(EN := auto, IN := #high);
    #loop : INT = ADD(#loop, 1);
    RETURN IF NOT auto;
END_NETWORK
NETWORK
    #low = GT(x, 5);
    y S= #low;
END_NETWORK
END_FUNCTION_BLOCK
PROGRAM Main
VAR a, b : Ramp; END_VAR
a(auto := TRUE, x := 7);
b(auto := FALSE, x := 3);
END_PROGRAM
""".replace("    y S= #low;\n", "    auto S= #low;\n")


@ENGINES
def test_wires_have_what_they_had(make: MakeDebug) -> None:
    resource = resource_of(checked(DIAGRAM), make)
    ran(resource)
    flow = ran(resource, FlowAsked("Ramp", "Main.a"))
    wires = {(each.name, each.line): each.text for each in flow.wires}
    assert wires == {("#LOW", 5): "6", ("#HIGH", 6): "7", ("#LOW", 12): "TRUE", ("#LOOP", 8): "2"}
    assert (at(flow, 7).power, said(flow, 7)["y"]) == (True, "7")
    flow = ran(resource, FlowAsked("Ramp", "Main.b"))
    assert at(flow, 7).power is False
    assert {each.line for each in flow.elements} == {5, 6, 7, 8, 9}


CHART = """\
PROGRAM Main
VAR go, lamp : BOOL; n : INT; END_VAR
INITIAL_STEP Wait: END_STEP
STEP Work: lamp(N); Count(N); END_STEP
TRANSITION FROM Wait TO Work := go; END_TRANSITION
TRANSITION FROM Work TO Wait :
RUNG
    [/go]
END_RUNG
END_TRANSITION
ACTION Count:
RUNG
    [lamp] n := ADD(EN := ~, IN1 := n, IN2 := 1).ENO
END_RUNG
END_ACTION
END_PROGRAM
"""


@ENGINES
def test_a_chart_tells_its_steps_transitions_and_actions(make: MakeDebug) -> None:
    resource = resource_of(checked(CHART), make)
    flow = ran(resource)
    assert (at(flow, 3).runs, at(flow, 5).power) == (1, False)
    write(resource.program, "Main.go", "TRUE", resource.memory)
    flow = ran(resource)
    assert at(flow, 5).power is True
    flow = ran(resource)
    assert {each.line for each in flow.elements} >= {4, 8, 13}
    assert at(flow, 8).power is False
    assert not [each for each in flow.elements if each.line in (3, 5)]
    assert at(flow, 13).power is True
    assert said(flow, 13, 1)["n"] == "1"


def test_a_halted_scan_is_told_as_far_as_it_has_come(tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", BELT, BUILDS.engine)
    walker.run(20)
    walker.set(Breakpoint(1, "line", "Ann", file="main.st", line=13, column=10, instance="Main.b"))
    halt = walker.run()
    assert halt is not None
    flow = flow_of(walker, FlowAsked("Belt", "Main.b"), halt.scan, halt.count)
    assert (flow.whole, {each.line for each in flow.elements}) == (False, {6, 9, 10, 13})
    assert len([each for each in flow.elements if each.line == 13]) == 1
    assert at(flow, 13).power is False
    before = flow_of(walker, FlowAsked("Belt", "Main.b"), halt.scan - 1)
    assert before.whole
    assert {each.line for each in before.elements} == {6, 9, 10, 13, 16, 22}
    whole = flow_of(walker, FlowAsked("Belt", "Main.a"), halt.scan, halt.count)
    assert (whole.whole, whole.calls) == (False, 1)
    assert at(whole, 22).runs == 1
    later = flow_of(walker, FlowAsked("Belt", "Main.c"), halt.scan, halt.count)
    assert (later.calls, later.elements) == (0, ())
    main = flow_of(walker, MAIN, halt.scan, halt.count)
    assert [each.line for each in main.elements] == [27]


def test_the_past_is_told_by_the_same_words(tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", BELT, BUILDS.engine)
    walker.run(1)
    first = flow_of(walker, FlowAsked("Belt", "Main.a"), 0)
    walker.run(30)
    assert flow_of(walker, FlowAsked("Belt", "Main.a"), 0) == first
    begin = kept_moment(walker.timeline)
    walker.run(1)
    made: list[FlowHook] = []

    def make(resource: Resource) -> FlowHook:
        made.append(FlowHook(resource, FlowAsked("Belt", "Main.a")))
        return made[0]

    here = walker.timeline.resource.state
    assert listen_again(walker.timeline, begin.scan, make, begin) is None
    assert walker.timeline.resource.state == here
    assert made[0].flow == flow_of(walker, FlowAsked("Belt", "Main.a"), begin.scan)


def test_what_has_no_statements_is_refused() -> None:
    resource = resource_of(checked(BELT), BUILDS.engine)
    with pytest.raises(UnknownPath, match="no program that runs has statements of `Bolt`"):
        FlowHook(resource, FlowAsked("Bolt", "Main.a"))
    with pytest.raises(UnknownPath):
        FlowHook(resource, FlowAsked("Belt", "Main.nobody"))
