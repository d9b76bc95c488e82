"""What is written while a debugger has halted inside of a block: on the variable at once, and for the next statement."""

from dataclasses import replace

import pytest

from scanbench.check.build import check_sources
from scanbench.debug.assign import Assign
from scanbench.engines.debug import Listen
from scanbench.engines.engine import Reason
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.forces import Force
from scanbench.runtime.inside import HaltAt
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import resolve
from tests.runtime.bench import ENGINES, model, value

SOURCE = """
FUNCTION_BLOCK Valve
VAR_IN_OUT level : INT; on : BOOL; END_VAR
VAR first, second : INT; END_VAR
first := level;
second := level;
level := level + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Pump
VAR_IN_OUT l : INT; on : BOOL; END_VAR
VAR valve : Valve; seen : INT; END_VAR
l := l + 10;
valve(level := l, on := on);
seen := l;
END_FUNCTION_BLOCK
PROGRAM Main
VAR pump : Pump; tank : ARRAY[1..2] OF INT; word : WORD; END_VAR
pump(l := tank[2], on := word.%X3);
END_PROGRAM
"""
AFTER_FIRST = 5
"""The count of the statement `second := level`, before which it halts."""


def halted(engine: EngineFactory, convention: str) -> Resource:
    checked = check_sources({"main.st": SOURCE}, replace(model(), in_out=convention))  # type: ignore[arg-type]
    assert checked.program is not None, checked.problems
    resource = Resource(Loaded.make(checked.program, engine))
    resource.run(1)
    resource.listening.attach(HaltAt(AFTER_FIRST), Listen(count=AFTER_FIRST))
    assert resource.run(1).reason is Reason.HALTED
    assert value(resource, "Main.pump.valve.first") == 21
    return resource


def went_on(resource: Resource) -> None:
    resource.listening.attach(None, Listen())
    resource.run(1)


@pytest.mark.parametrize("path", ["Main.pump.valve.level", "Main.pump.l", "Main.tank[2]"])
@pytest.mark.parametrize("convention", ["reference", "value"])
@pytest.mark.parametrize("engine", ENGINES)
def test_the_next_statement_sees_it(engine: EngineFactory, convention: str, path: str) -> None:
    resource = halted(engine, convention)
    entry = resource.submit(Write("Ada", path, "500"))
    assert isinstance(entry, Entry), entry
    assert entry.step == AFTER_FIRST
    assert value(resource, "Main.tank[2]") == 500
    assert value(resource, "Main.pump.valve.second") == 10
    went_on(resource)
    assert value(resource, "Main.pump.valve.second") == 500
    assert value(resource, "Main.pump.seen") == 501
    assert value(resource, "Main.tank[2]") == 501


@pytest.mark.parametrize("convention", ["reference", "value"])
def test_bits_and_forces(convention: str) -> None:
    resource = halted(ENGINES[0], convention)
    assert isinstance(resource.submit(Write("Ada", "Main.pump.valve.on", "TRUE")), Entry)
    assert value(resource, "Main.word") == 8
    forced = resource.submit(Force("Ada", "Main.pump.valve.level", "70"))
    assert isinstance(forced, Entry)
    assert forced.step == AFTER_FIRST
    went_on(resource)
    assert value(resource, "Main.word.3") is True
    assert value(resource, "Main.tank[2]") == 70  # held at the end of the scan
    assert value(resource, "Main.pump.valve.second") == 70
    went_on(resource)
    assert value(resource, "Main.pump.valve.first") == 80
    assert resolve(resource.program, "Main.pump.valve.level").locate(resource.memory) is not None


OVERLAPS = """
TYPE Both : UNION word : WORD; bytes : ARRAY[0..1] OF BYTE; END_UNION; Part : STRUCT a, b : INT; END_STRUCT; END_TYPE
FUNCTION_BLOCK Look
VAR_IN_OUT on : BOOL; low : BYTE; part : Part; x : INT; END_VAR
VAR saw_on : BOOL; saw_low : BYTE; saw_b, saw_x : INT; END_VAR
saw_x := 0;
saw_on := on; saw_low := low; saw_b := part.b; saw_x := x;
END_FUNCTION_BLOCK
PROGRAM Main
VAR look : Look; word AT D100 : WORD; bit AT D100.3 : BOOL; both : Both; parts : ARRAY[0..1] OF Part; x AT D200 : INT;
  wide AT D200 : DINT; END_VAR
look(on := bit, low := both.bytes[1], part := parts[1], x := x);
END_PROGRAM
"""


def looking(engine: EngineFactory, convention: str) -> Resource:
    """Halted before the statements of Look that copy what they see."""
    checked = check_sources({"main.st": OVERLAPS}, replace(model(), in_out=convention))  # type: ignore[arg-type]
    assert checked.program is not None, checked.problems
    resource = Resource(Loaded.make(checked.program, engine))
    assert isinstance(resource.submit(Write("Ada", "D100", "16#FFF7")), Entry)
    resource.listening.attach(HaltAt(3), Listen(count=3))
    assert resource.run(1).reason is Reason.HALTED
    return resource


def assigned(resource: Resource, text: str) -> Entry | Refusal:
    """As an execution point in Look does."""
    return resource.submit(Assign("Ada", "Look", resolve(resource.program, "Main.look").offset, text))


@pytest.mark.parametrize("convention", ["reference", "value"])
@pytest.mark.parametrize("engine", ENGINES)
def test_what_overlaps_the_variable_is_seen_too(engine: EngineFactory, convention: str) -> None:
    resource = looking(engine, convention)
    for path, text in (
        ("D100", "16#1008"),
        ("Main.both.word", "16#4321"),
        ("Main.wide", "9"),
        ("Main.parts[1].b", "5"),
    ):
        assert isinstance(resource.submit(Write("Ada", path, text)), Entry)
    went_on(resource)
    assert value(resource, "Main.look.saw_on") is True
    assert (value(resource, "D100"), value(resource, "Main.both.word")) == (0x1008, 0x4321)
    assert (value(resource, "Main.look.saw_low"), value(resource, "Main.look.saw_b")) == (0x43, 5)
    assert (value(resource, "Main.look.saw_x"), value(resource, "Main.wide")) == (9, 9)


@pytest.mark.parametrize("convention", ["reference", "value"])
@pytest.mark.parametrize("engine", ENGINES)
def test_an_assignment_to_an_in_out_that_is_a_bit_leaves_the_other_bits(engine: EngineFactory, convention: str) -> None:
    resource = looking(engine, convention)
    entry = assigned(resource, "on := TRUE; part.b := part.b + 7")
    assert isinstance(entry, Entry), entry
    assert entry.plan.message == "Main.word.3 (D100.03) := TRUE; Main.parts[1].b := 7"
    assert value(resource, "D100") == 0xFFFF
    went_on(resource)
    assert (value(resource, "D100"), value(resource, "Main.look.saw_on")) == (0xFFFF, True)
    assert (value(resource, "Main.parts[1].b"), value(resource, "Main.look.saw_b")) == (7, 7)


@pytest.mark.parametrize("convention", ["reference", "value"])
def test_an_assignment_is_refused_where_a_write_is(convention: str) -> None:
    resource = looking(ENGINES[0], convention)
    assert isinstance(resource.submit(Force("Ada", "Main.bit", "TRUE")), Entry)
    said = assigned(resource, "on := FALSE")
    assert isinstance(said, Refusal)
    assert "forced" in said.message
