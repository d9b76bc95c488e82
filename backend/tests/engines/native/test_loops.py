"""FOR at the ends of ranges, EXIT, RETURN, and what the counter is afterwards. The reference engine agrees on all."""

import pytest

from scanbench.program.layout import Layout
from scanbench.program.sites import TrapKind
from tests.engines.native.plc import plc, ran

TYPES = {"SINT": (-128, 127), "USINT": (0, 255), "INT": (-32768, 32767), "UINT": (0, 65535)}


@pytest.mark.parametrize(
    ("header", "rounds", "after"),
    [
        ("1 TO 10", 10, 11),
        ("5 TO 5", 1, 6),
        ("6 TO 5", 0, 6),
        ("10 TO 1 BY -3", 4, -2),
        ("1 TO 10 BY 4", 3, 13),
        ("1 TO 10 BY z", 0, 1),
        ("1 TO 10 BY z + 4", 3, 13),
        ("z TO z + 2", 3, 3),
        ("32766 TO 32767", 2, -32768),
        ("-32767 TO -32768 BY -1", 2, 32767),
        ("32000 TO 32767 BY 500", 2, -32536),
        ("32000 TO 32767 BY 500 + z", 2, -32536),
    ],
)
def test_rounds_and_the_counter_afterwards(header: str, rounds: int, after: int) -> None:
    made = ran(f"PROGRAM Main VAR i, z : INT; n : DINT; END_VAR FOR i := {header} DO n := n + 1; END_FOR; END_PROGRAM")
    assert (made.value("Main.n"), made.value("Main.i")) == (rounds, after)


@pytest.mark.parametrize("type", TYPES)
@pytest.mark.parametrize("down", [False, True])
def test_the_whole_range_ends(type: str, down: bool) -> None:
    low, high = TYPES[type]
    if down and type.startswith("U"):
        return
    header = f"{high} TO {low} BY -1" if down else f"{low} TO {high}"
    made = ran(f"PROGRAM Main VAR i : {type}; n, sum : DINT; END_VAR FOR i := {header} DO n := n + 1; sum := sum + i; "
               "END_FOR; END_PROGRAM")  # fmt: skip
    assert made.value("Main.n") == high - low + 1
    assert made.value("Main.sum") == sum(range(low, high + 1))
    assert made.value("Main.i") == (high if down else low)


def test_64_bits_near_their_ends() -> None:
    made = ran("""
PROGRAM Main VAR i : LINT; u : ULINT; n, m : DINT; END_VAR
FOR i := 9223372036854775805 TO 9223372036854775807 DO n := n + 1; END_FOR;
FOR u := 18446744073709551610 TO 18446744073709551615 BY 2 DO m := m + 1; END_FOR;
END_PROGRAM""")
    assert (made.value("Main.n"), made.value("Main.m")) == (3, 3)
    assert (made.value("Main.i"), made.value("Main.u")) == (-(1 << 63), 0)


@pytest.mark.parametrize("type", ["LINT", "ULINT"])
def test_more_rounds_than_any_budget_trap_at_once(type: str) -> None:
    low, high = (-(1 << 63), (1 << 63) - 1) if type == "LINT" else (0, (1 << 64) - 1)
    start = "(-9223372036854775807 - 1)" if low else "0"
    made = plc(
        f"PROGRAM Main VAR i : {type}; n : INT; END_VAR FOR i := {start} TO {high} DO n := 1; END_FOR; END_PROGRAM"
    )
    made.set_field(Layout.BUDGET_LIMIT, 1000)
    assert made.trapped().kind is TrapKind.LOOP
    assert made.field(Layout.BUDGET) == -(1 << 63)
    assert made.value("Main.n") == 0


def test_exit_leaves_the_counter_and_return_leaves_the_block() -> None:
    made = ran("""
FUNCTION_BLOCK Find VAR_INPUT x : INT; END_VAR VAR_OUTPUT place : INT; ended : BOOL; END_VAR VAR i : INT; END_VAR
ended := FALSE;
FOR place := 1 TO 100 DO FOR i := 1 TO 10 DO IF place * i = x THEN RETURN; END_IF; IF i > 3 THEN EXIT; END_IF; END_FOR; END_FOR;
ended := TRUE;
END_FUNCTION_BLOCK
PROGRAM Main VAR f, g : Find; END_VAR f(x := 35); g(x := 997); END_PROGRAM""")
    assert (made.value("Main.f.place"), made.value("Main.f.ended")) == (35, False)
    assert (made.value("Main.g.place"), made.value("Main.g.ended")) == (101, True)


def test_bounds_are_evaluated_once() -> None:
    made = ran("""
PROGRAM Main VAR i, n, last : INT := 5; step : INT := 1; END_VAR
n := 0; FOR i := 1 TO last BY step DO last := 100; step := 7; n := n + 1; END_FOR; END_PROGRAM""")
    assert made.value("Main.n") == 5


def test_a_function_that_changes_the_counter_through_a_reference() -> None:
    made = ran("""
FUNCTION Jump : INT VAR_IN_OUT x : INT; END_VAR x := x + 100; Jump := x; END_FUNCTION
FUNCTION_BLOCK Hold VAR_IN_OUT x : INT; END_VAR x := x + 1; END_FUNCTION_BLOCK
PROGRAM Main VAR i, j, n, m, last : INT; a : ARRAY[0..3] OF INT; h : Hold; END_VAR
FOR i := 0 TO 3 DO h(x := j); a[i] := i + j; n := n + 1; END_FOR;
END_PROGRAM""")
    assert made.value("Main.n") == 4


def test_nested_loops_with_bounds_that_need_no_check() -> None:
    made = ran("""
PROGRAM Main VAR i, j, t : INT; a : ARRAY[0..15] OF INT; seed : DINT := 1; END_VAR
FOR i := 0 TO 15 DO seed := (seed * 75 + 74) MOD 65537; a[i] := DINT_TO_INT(seed MOD 1000); END_FOR;
FOR i := 0 TO 14 DO FOR j := 0 TO 14 - i DO
IF a[j] > a[j + 1] THEN t := a[j]; a[j] := a[j + 1]; a[j + 1] := t; END_IF; END_FOR; END_FOR;
END_PROGRAM""")
    found = [made.value(f"Main.a[{n}]") for n in range(16)]
    assert found == sorted(found, key=int)  # type: ignore[arg-type]


def test_a_counter_that_a_callee_writes() -> None:
    """A global counter is not what the loop made it, once something that may write it has run."""
    made = plc("""
VAR_GLOBAL g : INT; END_VAR
FUNCTION Spoil : INT VAR_INPUT x : INT; END_VAR g := x; Spoil := x; END_FUNCTION
PROGRAM Main VAR a : ARRAY[0..3] OF INT; n, seen : INT; END_VAR
FOR g := 0 TO 3 DO n := n + 1; seen := Spoil(1000 + n) + seen; a[g] := 1; END_FOR;
END_PROGRAM""")
    assert made.trapped().kind is TrapKind.BOUNDS
    assert (made.value("g"), made.value("Main.n"), made.value("Main.seen")) == (1001, 1, 1001)
