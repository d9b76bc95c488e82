"""A new program on a running PLC."""

import pytest

from scanbench.recording.replay import replay
from scanbench.runtime.command import Refusal
from scanbench.runtime.forces import Force
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import EngineFactory, Loaded, LoadedPrograms
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, change, plc, program, value

OLD = """
TYPE Point : STRUCT x : INT; y : REAL; END_STRUCT; END_TYPE
VAR_GLOBAL g : DINT := 3; END_VAR
VAR_GLOBAL CONSTANT LIMIT : INT := 5; END_VAR
PROGRAM Main
VAR n : INT; gone : INT; list : ARRAY[0..3] OF INT; p : ARRAY[0..1] OF Point; text : STRING[9]; b : Block; r : REAL; END_VAR
  n := n + 1; list[1] := n; p[1].x := n; text := 'old'; b(v := n);
END_PROGRAM
FUNCTION_BLOCK Block
VAR_IN_OUT v : INT; END_VAR
VAR calls : DINT; END_VAR
  calls := calls + 1;
END_FUNCTION_BLOCK
"""
NEW = (
    OLD.replace("VAR n : INT; gone : INT;", "VAR first : LINT := 8; n : INT; r2 : INT;")
    .replace("LIMIT : INT := 5", "LIMIT : INT := 6")
    .replace("text : STRING[9]", "text : STRING[12]")
    .replace("text := 'old';", "")
    .replace("n := n + 1", "n := n + 10")
    .replace("y : REAL", "y : REAL; z : INT")
)


@pytest.mark.parametrize("engine", ENGINES)
def test_values_of_the_same_path_and_type_are_kept(engine: EngineFactory) -> None:
    resource = plc(OLD, engine)
    resource.submit(Write("Ada", "g", "44"))
    resource.submit(Write("Ada", "D100", "9"))
    resource.submit(Force("Ada", "Main.r", "1.5"))
    resource.submit(Force("Ada", "Main.gone", "1"))
    resource.run(7)
    new = program(NEW)
    report = change(resource, new, engine)
    assert "Main.gone" in report  # its force has nowhere to go
    for path, expected in (
        ("Main.n", 7), ("Main.first", 8), ("Main.list[1]", 7), ("Main.p[1].x", 7), ("Main.p[1].z", 0), ("g", 44),
        ("Main.text", ""), ("Main.b.calls", 7), ("LIMIT", 6), ("D100", 9), ("Main.r", 1.5),
    ):  # fmt: skip
        assert value(resource, path) == expected, path
    assert resource.header.scan == 7
    assert resource.header.force_count == 4
    resource.submit(Write("Ada", "Main.r", "2.5"))
    resource.run(1)
    assert (value(resource, "Main.n"), value(resource, "Main.r"), value(resource, "Main.b.v")) == (17, 1.5, 17)


def test_in_run_mode_the_program_stays() -> None:
    resource = plc(OLD)
    resource.submit(SetMode("Ada", "RUN"))
    resource.programs = LoadedPrograms(Loaded.make(program(NEW), ENGINES[0], 2))
    refusal = resource.submit(ProgramChange("Ada", 2))
    assert isinstance(refusal, Refusal)
    assert "MONITOR" in refusal.message
    assert resource.version == 1


TRAPPING = """
VAR_GLOBAL RETAIN total : DINT; END_VAR
VAR_GLOBAL other : INT; END_VAR
FUNCTION_BLOCK Count
VAR RETAIN calls : DINT; END_VAR
VAR inner : DINT; END_VAR
  calls := calls + 1; inner := inner + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n : INT := 5; q : INT; d : INT := 1; c : Count; END_VAR
VAR RETAIN list : ARRAY[0..1] OF INT; text : STRING[9]; p : REF_TO DINT; END_VAR
  n := n + 1; total := total + 2; list[1] := n; text := 'kept'; p := REF(total); q := 1 / d; c();
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_after_a_trap_the_new_program_starts_warm(engine: EngineFactory) -> None:
    resource = plc(TRAPPING, engine)
    for path, text in (("D7", "7"), ("H3", "3"), ("W3", "3"), ("other", "4")):
        resource.submit(Write("Ada", path, text))
    resource.run(3)
    resource.submit(Write("Ada", "Main.d", "0"))
    resource.run(3)
    assert resource.header.halted_by_trap
    scan = resource.header.scan
    corrected = TRAPPING.replace("VAR n : INT := 5;", "VAR first : LINT; n : INT := 6;").replace(
        "STRING[9]", "STRING[8]"
    )
    message = change(resource, program(corrected.replace("text := 'kept'; p := REF(total); q := 1 / d;", "")), engine)
    assert "version 2: warm start" in message
    assert "what is retained is kept" in message
    for path, expected in (
        ("D7", 7), ("H3", 3), ("W3", 0), ("total", 8), ("other", 0), ("Main.n", 6), ("Main.d", 1), ("Main.c.calls", 3),
        ("Main.c.inner", 0), ("Main.list[1]", 9), ("Main.text", ""), ("Main.p^", 8),
    ):  # fmt: skip
        assert value(resource, path) == expected, path
    assert resource.trap is None
    assert (int(resource.header.halt), resource.header.scan, resource.header.started) == (0, scan, scan)
    resource.run(2)
    assert [value(resource, path) for path in ("Main.n", "total", "Main.c.calls")] == [8, 12, 5]
    again = plc(TRAPPING, engine)
    again.programs = resource.programs
    replay(again, resource.journal, resource.header.scan)
    assert again.state == resource.state


EVENT = """
VAR_GLOBAL go : BOOL; END_VAR
FUNCTION_BLOCK Lamp
VAR coil AT %Q* : BOOL; END_VAR
coil := TRUE;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n : INT; lamp : Lamp; END_VAR
n := n + 1; lamp();
END_PROGRAM
CONFIGURATION C
RESOURCE R ON P
TASK once (SINGLE := go);
PROGRAM Main WITH once : Main;
END_RESOURCE
VAR_CONFIG R.Main.lamp.coil AT %QX0.0 : BOOL; END_VAR
END_CONFIGURATION
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_an_event_that_holds_on_is_no_new_one_after_the_swap(engine: EngineFactory) -> None:
    resource = plc(EVENT, engine)
    resource.submit(Write("Ada", "go", "TRUE"))
    resource.run(3)
    new = program(EVENT.replace("n := n + 1", "n := n + 10").replace("%QX0.0", "%QX0.1"))
    change(resource, new, engine)
    resource.run(2)
    assert value(resource, "Main.n") == 1
    resource.submit(Write("Ada", "go", "FALSE"))
    resource.run(1)
    resource.submit(Write("Ada", "go", "TRUE"))
    resource.run(1)
    assert value(resource, "Main.n") == 11
    assert value(resource, "%QX0.1") is True


REFERENCES = """
INTERFACE IPump
METHOD Run
END_METHOD
END_INTERFACE
FUNCTION_BLOCK Pump IMPLEMENTS IPump
VAR runs : INT; END_VAR
METHOD PUBLIC Run
  runs := runs + 1;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main
VAR a, b : Pump; p : IPump; n : INT; list : ARRAY[0..3] OF INT; r : REF_TO INT; many : ARRAY[0..1] OF REF_TO INT; END_VAR
  IF p = NULL THEN p := b; r := REF(list[2]); many[1] := REF(n); END_IF;
  p.Run();
  r^ := r^ + 1;
  many[1]^ := many[1]^ + 1;
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_references_are_led_to_the_same_variables(engine: EngineFactory) -> None:
    resource = plc(REFERENCES, engine)
    resource.run(3)
    new = program(REFERENCES.replace("VAR a, b", "VAR first : LINT; more : Pump; a, b"))
    change(resource, new, engine)
    assert resource.run(2).reason == "done"
    found = [value(resource, path) for path in ("Main.a.runs", "Main.b.runs", "Main.list[2]", "Main.n")]
    assert found == [0, 5, 5, 5]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_reference_to_what_is_gone_is_null(engine: EngineFactory) -> None:
    resource = plc(REFERENCES, engine)
    resource.run(3)
    new = program(
        REFERENCES.replace("list : ARRAY[0..3] OF INT", "list : ARRAY[0..2] OF DINT").replace("REF(list[2])", "REF(n)")
    )
    change(resource, new, engine)
    resource.run(1)
    assert resource.trap is not None
    assert resource.trap.kind == "null"


EDGES = """
INTERFACE IShow
METHOD Shown : INT END_METHOD
END_INTERFACE
FUNCTION_BLOCK Count IMPLEMENTS IShow
VAR_INPUT up : BOOL R_EDGE; END_VAR
VAR n : INT; END_VAR
METHOD PUBLIC Shown : INT Shown := 2; END_METHOD
IF up THEN n := n + 1; END_IF;
END_FUNCTION_BLOCK
PROGRAM Main
VAR c : Count; clock : BOOL := TRUE; shown : INT; any : IShow; END_VAR
c(up := clock);
any := c;
shown := any.Shown();
END_PROGRAM
"""
FIRST = """
FUNCTION_BLOCK Another IMPLEMENTS IShow
METHOD PUBLIC Shown : INT Shown := 1; END_METHOD
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_an_edge_that_was_seen_is_not_seen_again_and_classes_take_their_new_numbers(engine: EngineFactory) -> None:
    resource = plc(EDGES, engine)
    resource.run(2)
    new = program(FIRST + EDGES.replace("VAR c : Count", "VAR a : Another; c : Count"))
    change(resource, new, engine)
    resource.run(2)
    assert (value(resource, "Main.c.n"), value(resource, "Main.shown")) == (1, 2)


def test_bits_of_a_structure_are_kept_wherever_they_lie_now() -> None:
    old = "TYPE T : STRUCT a AT %X0.0 : BOOL; b AT %X0.1 : BOOL; c : BOOL; END_STRUCT; END_TYPE\nPROGRAM Main VAR v : T; END_VAR v.a := TRUE; v.c := TRUE; END_PROGRAM"
    resource = plc(old)
    resource.run(1)
    moved = old.replace("a AT %X0.0 : BOOL; b AT %X0.1", "b AT %X0.0 : BOOL; a AT %X0.5").replace(
        "c : BOOL", "c AT %X2.7 : BOOL"
    )
    new = program(moved.replace("v.a := TRUE; v.c := TRUE;", ";"))
    change(resource, new)
    assert [value(resource, f"Main.v.{name}") for name in "abc"] == [True, False, True]
