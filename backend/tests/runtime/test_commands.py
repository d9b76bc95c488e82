"""Writes, forces, modes: what the seam takes, what it refuses, and why."""

import pytest

from scanbench.program.layout import Layout
from scanbench.runtime.command import Command, Entry, Plan, Refusal
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, plc, value

SOURCE = """
VAR_GLOBAL
  start AT CIO 0.00 : BOOL; motor AT CIO 100.00 : BOOL; lamp AT CIO 100.01 : BOOL; total AT D100 : INT;
END_VAR
VAR_GLOBAL CONSTANT LIMIT : INT := 5; END_VAR
PROGRAM Main
VAR n : INT; text : STRING[8] := 'idle'; real : REAL; wait : TIME; user : User; pair : ARRAY[0..1] OF DINT; d : INT := 1; END_VAR
  n := n + 1; total := n; motor := start; lamp := FALSE;
  user(level := n);
  pair[0] := pair[0] + 1;
  n := n / d;
END_PROGRAM
FUNCTION_BLOCK User
VAR_IN_OUT level : INT; END_VAR
VAR seen : INT; END_VAR
  seen := level;
END_FUNCTION_BLOCK
"""


def refused(resource: Resource, command: Command) -> Refusal:
    before = bytes(resource.memory)
    outcome = resource.submit(command)
    assert isinstance(outcome, Refusal), outcome
    assert bytes(resource.memory) == before
    assert not any(entry.command is command for entry in resource.journal)
    return outcome


def done(resource: Resource, command: Command) -> Entry:
    outcome = resource.submit(command)
    assert isinstance(outcome, Entry), outcome
    return outcome


REFERENCES = """
INTERFACE Runs METHOD Run END_METHOD END_INTERFACE
PROGRAM Main
VAR n : INT; one : REF_TO INT; ptr : POINTER TO INT; same : REFERENCE TO INT; many : ARRAY[0..1] OF REF_TO INT; runs : Runs; user : User; END_VAR
  one := REF(n); user(level := n);
END_PROGRAM
FUNCTION_BLOCK User
VAR_IN_OUT level : INT; END_VAR
  level := level + 1;
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize("command", [Write, Force])
@pytest.mark.parametrize("path", ["one", "ptr", "same", "many[1]", "runs"])
def test_a_reference_is_no_number(command: type[Write | Force], path: str) -> None:
    resource = plc(REFERENCES)
    for text in ("1234", "16#1234"):
        message = refused(resource, command("Ada", f"Main.{path}", text)).message
        assert f"`{text}` is not" in message
        assert "would be any place in memory: write NULL, or the variable" in message
    done(resource, command("Ada", f"Main.{path}", "NULL"))


def test_an_in_out_is_the_variable_that_was_passed() -> None:
    resource = plc(REFERENCES)
    assert "not called yet" in refused(resource, Write("Ada", "Main.user.level", "7")).message
    resource.run(1)
    done(resource, Write("Ada", "Main.user.level", "7"))
    assert value(resource, "Main.n") == 7


@pytest.mark.parametrize("engine", ENGINES)
def test_writes_of_every_kind(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    for path, text, expected in (
        ("start", "TRUE", True), ("CIO 0.00", "0", False), ("Main.n", "16#7f", 127), ("main.N", "-5", -5),
        ("Main.text", "'hello'", "hello"), ("Main.real", "1.5", 1.5), ("Main.wait", "T#2s", 2_000_000_000),
        ("D200", "16#FFFF", 0xFFFF), ("W10.03", "TRUE", True), ("Main.pair[1]", "70000", 70000),
    ):  # fmt: skip
        done(resource, Write("Ada", path, text))
        assert value(resource, path) == expected
    resource.run(1)
    assert value(resource, "total") == -4
    assert [entry.scan for entry in resource.journal] == [0] * 10


def test_refusals_say_why_and_change_nothing() -> None:
    resource = plc(SOURCE)
    for command, words in (
        (Write("Ada", "A402.12", "TRUE"), ["A402.12", "read-only", "CJ1M-CPU63", "error simulator"]),
        (Force("Ada", "A402.12", "TRUE"), ["read-only"]),
        (Write("Ada", "LIMIT", "6"), ["constant"]),
        (Write("Ada", "Main.n", "40000"), ["Main.n", "INT", "32767"]),
        (Write("Ada", "Main.text", "'far too long'"), ["STRING[8]"]),
        (Write("Ada", "Main.pair", "1"), ["Main.pair", "members"]),
        (Write("Ada", "Main.user.level", "1"), ["Main.user.level", "not called yet"]),
        (Write("Ada", "D99999", "1"), ["D99999"]),
        (Force("Ada", "Main.text", "'x'"), ["8 bytes"]),
        (SetMode("Ada", "STOP"), ["STOP"]),
        (Release("Ada", "Main.n"), ["not forced"]),
    ):  # fmt: skip
        message = refused(resource, command).message
        assert all(word in message for word in words), message
    assert refused(resource, Write("Ada", "Main.txt", "1")).near == ("Main.text",)


@pytest.mark.parametrize("engine", ENGINES)
def test_an_in_out_leads_to_its_variable(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    resource.run(1)
    done(resource, Write("Ada", "Main.user.level", "41"))
    assert value(resource, "Main.n") == 41


@pytest.mark.parametrize("engine", ENGINES)
def test_forces_hold_against_the_program_and_share_bytes(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    done(resource, Force("Ada", "motor", "TRUE"))
    done(resource, Force("Ada", "lamp", "TRUE"))  # the same byte of the image
    done(resource, Force("Ada", "Main.n", "100"))
    assert resource.header.force_count == 3
    assert value(resource, "motor") is True  # at once, even in a pause
    resource.run(5)
    assert (value(resource, "motor"), value(resource, "lamp")) == (True, True)
    assert value(resource, "Main.n") == 100
    assert value(resource, "total") == 101  # the program saw the forced input
    done(resource, Release("Ada", "motor"))
    resource.run(1)
    assert (value(resource, "motor"), value(resource, "lamp")) == (False, True)
    done(resource, Release("Ada", None))
    resource.run(2)
    assert (value(resource, "lamp"), value(resource, "Main.n")) == (False, 102)
    table = resource.memory[Layout.FORCE_COUNT : Layout.FORCES + 8 * Layout.FORCE_LIMIT]
    assert not any(table)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_write_that_a_subrange_does_not_have_is_done_and_said(engine: EngineFactory) -> None:
    """So one can try out what the program does with it."""
    source = "PROGRAM Main VAR x : INT (0..10); y : INT; END_VAR y := x; END_PROGRAM"
    resource = plc(source, engine)
    inside, outside = (Write("Ada", "Main.x", value).plan(resource.view) for value in ("10", "11"))
    assert isinstance(inside, Plan)
    assert inside.message == "Main.x := 10"
    assert isinstance(outside, Plan)
    assert outside.message.startswith(
        "Main.x := 11, outside of 0 to 10: where the program reads the variable before it writes it, it finds that"
    )
    done(resource, Write("Ada", "Main.x", "11"))
    resource.run(1)
    assert value(resource, "Main.y") == 10


def test_a_write_that_a_force_would_swallow_is_refused() -> None:
    resource = plc(SOURCE)
    assert isinstance(resource.submit(Force("Ada", "motor", "TRUE")), Entry)
    assert "forced" in refused(resource, Write("Ada", "motor", "FALSE")).message
    assert isinstance(resource.submit(Write("Ada", "lamp", "TRUE")), Entry)  # another bit of the same byte


def test_the_force_table_has_an_end() -> None:
    source = "PROGRAM Main\nVAR a : ARRAY[0..70] OF LINT; END_VAR\na[0] := 0;\nEND_PROGRAM\n"
    resource = plc(source)
    for index in range(Layout.FORCE_LIMIT // 8):
        done(resource, Force("Ada", f"Main.a[{index}]", "-1"))
    assert str(Layout.FORCE_LIMIT) in refused(resource, Force("Ada", "Main.a[70]", "-1")).message
    resource.run(1)
    assert value(resource, "Main.a[0]") == -1


def test_modes() -> None:
    resource = plc(SOURCE)
    done(resource, Write("Ada", "start", "TRUE"))
    resource.run(3)
    done(resource, SetMode("Ada", "PROGRAM"))
    assert not resource.runnable
    assert value(resource, "motor") is False  # outputs go off
    done(resource, Write("Ada", "Main.n", "9"))
    with pytest.raises(RuntimeError):
        resource.run(1)
    done(resource, SetMode("Ada", "RUN"))
    for command in (Write("Ada", "Main.n", "1"), Force("Ada", "Main.n", "1"), Release("Ada", None)):
        assert "MONITOR" in refused(resource, command).message
    resource.run(1)
    assert value(resource, "Main.n") == 10


@pytest.mark.parametrize("engine", ENGINES)
def test_a_trap_stops_names_its_place_and_program_mode_ends_it(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    resource.run(4)
    done(resource, Write("Ada", "start", "TRUE"))
    resource.run(1)
    done(resource, Write("Ada", "Main.d", "0"))
    resource.run(10)
    assert resource.trap is not None
    line = next(number for number, text in enumerate(SOURCE.splitlines(), 1) if "n / d" in text)
    assert (resource.trap.kind, resource.trap.file, resource.trap.line) == ("division", "main.st", line)
    assert resource.header.scan == 5 == resource.trap.scan
    assert value(resource, "motor") is False  # outputs off
    assert "PROGRAM" in refused(resource, SetMode("Ada", "RUN")).message
    done(resource, Write("Ada", "Main.d", "1"))
    done(resource, SetMode("Ada", "PROGRAM"))
    done(resource, SetMode("Ada", "MONITOR"))
    assert resource.runnable
    resource.run(1)
    assert resource.header.scan == 6
