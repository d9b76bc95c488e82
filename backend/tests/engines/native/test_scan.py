"""The scan: clock, budget, forces, tasks; what a trap leaves."""

import gc

import pytest

from scanbench.engines.engine import Reason, Stop
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.layout import Layout
from scanbench.program.sites import TrapKind
from tests.engines.native.plc import check, plc

COUNT = "PROGRAM Main VAR n : DINT; a AT %MB4 : BYTE; seen : BYTE; END_VAR n := n + 1; seen := a; a := 5; END_PROGRAM"


def test_counts_scans_and_sets_the_clock() -> None:
    made = plc(COUNT)
    assert made.engine.run(1000) == Stop(Reason.DONE)
    assert made.value("Main.n") == 1000
    assert made.field(Layout.SCAN) == 1000
    assert made.field(Layout.CLOCK) == 999_000_000


def test_no_scans_change_nothing() -> None:
    made = plc(COUNT)
    assert made.engine.run(0) == Stop(Reason.DONE)
    assert made.memory == made.program.initial_image


def test_the_budget_is_new_in_every_scan() -> None:
    made = plc("PROGRAM Main VAR i : INT; END_VAR FOR i := 1 TO 10 DO ; END_FOR; END_PROGRAM")
    made.set_field(Layout.BUDGET_LIMIT, 10)
    assert made.engine.run(3) == Stop(Reason.DONE)
    assert made.field(Layout.BUDGET) == 0
    made.set_field(Layout.BUDGET_LIMIT, 9)
    assert made.trapped().kind is TrapKind.LOOP
    assert made.field(Layout.BUDGET) == -1


def test_forces_hold_before_and_after_the_program() -> None:
    made = plc(COUNT)
    made.force((made.offset("%MB4"), 0x0F, 0x0A))
    made.engine.run(1)
    assert made.value("Main.seen") == 0x0A
    assert made.value("%MB4") == 0x0A
    made.memory[made.offset("%MB4")] = 0x70
    made.engine.run(1)
    assert made.value("Main.seen") == 0x7A
    assert made.value("%MB4") == 0x0A, "the program wrote 16#05, of which the low nibble is forced"
    made.force()
    made.engine.run(1)
    assert made.value("%MB4") == 5


def test_a_trap_ends_the_scan_and_is_not_counted() -> None:
    made = plc("PROGRAM Main VAR n, a, b : INT; END_VAR n := n + 1; a := 100 / (3 - n); b := b + 1; END_PROGRAM")
    made.force((made.offset("Main.a"), 0xFF, 9))
    assert made.engine.run(10).reason is Reason.TRAP
    assert (made.value("Main.n"), made.value("Main.b")) == (3, 2)
    assert made.field(Layout.SCAN) == 2
    assert made.field(Layout.CLOCK) == 2_000_000


@pytest.mark.parametrize(
    ("body", "kind"),
    [
        ("i := 9; a[i] := 1;", TrapKind.BOUNDS),
        ("i := a[i - 1];", TrapKind.BOUNDS),
        ("i := 1 / i;", TrapKind.DIVISION),
        ("WHILE TRUE DO i := i + 1; END_WHILE;", TrapKind.LOOP),
        ("REPEAT i := i + 1; UNTIL FALSE END_REPEAT;", TrapKind.LOOP),
        ("FOR n := 0 TO 2000000000 DO i := i + 1; END_FOR;", TrapKind.LOOP),
    ],
)
def test_a_trap_names_its_line(body: str, kind: TrapKind) -> None:
    made = plc(f"PROGRAM Main\nVAR i : INT; n : DINT; a : ARRAY[0..8] OF INT; END_VAR\n{body}\nEND_PROGRAM")
    site = made.trapped()
    assert (site.kind, site.span.file, site.span.line) == (kind, "test.st", 3)


def test_a_trap_comes_through_calls() -> None:
    made = plc("""
FUNCTION Deep : INT VAR_INPUT x : INT; END_VAR Deep := 10 / x; END_FUNCTION
FUNCTION_BLOCK Block VAR_INPUT x : INT; END_VAR VAR y : INT; END_VAR y := Deep(x) + 1; END_FUNCTION_BLOCK
PROGRAM Main VAR b : Block; after : BOOL; END_VAR b(x := 0); after := TRUE; END_PROGRAM""")
    assert made.trapped().pou == "Deep"
    assert made.value("Main.after") is False


def test_tasks_run_when_they_are_due() -> None:
    made = plc("""
PROGRAM Fast VAR n : INT; END_VAR n := n + 1; END_PROGRAM
PROGRAM Slow VAR n : INT; END_VAR n := n + 1; END_PROGRAM
CONFIGURATION c RESOURCE r ON cpu
TASK quick(INTERVAL := T#1ms, PRIORITY := 1); TASK lazy(INTERVAL := T#3ms, PRIORITY := 2);
PROGRAM f WITH quick : Fast; PROGRAM s WITH lazy : Slow;
END_RESOURCE END_CONFIGURATION""")
    made.engine.run(7)
    assert (made.value("f.n"), made.value("s.n")) == (7, 3)


def test_engines_beside_each_other_and_after_each_other() -> None:
    made = [plc(COUNT) for _ in range(5)]
    for number, each in enumerate(made):
        each.engine.run(number)
    assert [each.value("Main.n") for each in made] == [0, 1, 2, 3, 4]
    del made, each
    gc.collect()
    again = plc(COUNT)
    again.engine.run(7)
    assert again.value("Main.n") == 7


def test_two_engines_share_an_image() -> None:
    made = plc(COUNT)
    quick = NativeEngine(made.program, made.memory, 0)
    made.engine.run(2)
    quick.run(3)
    assert made.value("Main.n") == 5


def test_a_wrong_image_is_refused() -> None:
    program = check(COUNT)
    with pytest.raises(ValueError, match="the program needs"):
        NativeEngine(program, bytearray(10))


def test_names_in_any_script() -> None:
    made = plc("""
FUNCTION 合計 : INT VAR_INPUT 値, größe : INT; 文 : STRING[10]; END_VAR 合計 := 値 + größe + LEN(文); END_FUNCTION
PROGRAM Main VAR 数 : INT := 3; x : INT; END_VAR x := 合計(数, 4, 'abc'); END_PROGRAM""")
    made.engine.run(1)
    assert made.value("Main.x") == 3 + 4 + 3


def test_long_and_deep_expressions() -> None:
    long = " + ".join(["n"] * 400)
    deep = "(" * 100 + "n" + " + 1)" * 100
    made = plc(f"PROGRAM Main VAR n : DINT := 2; a, b : DINT; END_VAR a := {long}; b := {deep}; END_PROGRAM")
    made.engine.run(1)
    assert (made.value("Main.a"), made.value("Main.b")) == (800, 102)
