"""IFs that become selects must still be IFs."""

import re

import pytest

from scanbench.engines.native import jit
from scanbench.engines.native.emit_program import emit_program
from scanbench.program.sites import TrapKind
from tests.engines.native.plc import check, plc, ran


def main_branches(source: str) -> int:
    """Conditional jumps in the text emitted for Main."""
    text = emit_program(check(source))
    body = re.search(r'define internal i32 @"p\.Main.*?\n}', text, re.DOTALL)
    assert body
    return body.group().count("br i1")


def test_a_swap_has_no_jumps() -> None:
    source = """PROGRAM Main VAR a, b, t : INT; END_VAR IF a > b THEN t := a; a := b; b := t; END_IF; END_PROGRAM"""
    assert main_branches(source) == 0


def test_what_may_trap_stays_under_the_condition() -> None:
    source = """PROGRAM Main VAR i, n, z : INT; a : ARRAY[0..3] OF INT; END_VAR
i := 9; IF i < 4 THEN a[i] := 1; END_IF; IF z <> 0 THEN n := 10 / z; END_IF; n := n + 1; END_PROGRAM"""
    assert ran(source).value("Main.n") == 1


def test_an_index_that_the_body_changes_is_checked_again() -> None:
    made = plc("""PROGRAM Main VAR i : INT := 1; a : ARRAY[0..3] OF INT := [5, 5, 5, 5]; END_VAR
IF a[i] > 0 THEN i := 77; a[i] := 1; END_IF; END_PROGRAM""")
    assert made.trapped().kind is TrapKind.BOUNDS
    assert made.value("Main.i") == 77


@pytest.mark.parametrize("x", [-5, 0, 5])
def test_all_branches_of_an_if(x: int) -> None:
    made = ran(f"""PROGRAM Main VAR x : INT := {x}; a, b : INT; r : REAL := 1.0; f AT %MX1.3 : BOOL; END_VAR
IF x > 0 THEN a := 1; x := 0; ELSIF x < 0 THEN a := 2; f := TRUE; ELSE a := 3; r := 0.5; END_IF;
IF a = 2 THEN b := a; a := 7; END_IF; END_PROGRAM""")
    assert made.value("Main.a") == {5: 1, -5: 7, 0: 3}[x]
    assert made.value("%MX1.3") is (x < 0)


def test_a_value_that_overlaps_stays_as_it_was() -> None:
    """A REAL that is not stored keeps its bits, even those of a NaN that is not canonical."""
    made = plc("""PROGRAM Main VAR r AT %MD2 : REAL; bits AT %MD2 : DWORD; go : BOOL; END_VAR
bits := 16#FFC0_1234; IF go THEN r := 1.0; END_IF; END_PROGRAM""")
    made.engine.run(1)
    assert made.raw("%MD2") == bytes.fromhex("3412c0ff")


def test_the_optimised_sort_is_free_of_bounds_checks() -> None:
    source = """PROGRAM Main VAR i, j, t : INT; a : ARRAY[0..255] OF INT; END_VAR
FOR i := 0 TO 254 DO FOR j := 0 TO 254 - i DO
IF a[j] > a[j + 1] THEN t := a[j]; a[j] := a[j + 1]; a[j + 1] := t; END_IF; END_FOR; END_FOR; END_PROGRAM"""
    program = check(source)
    bounds = [n for n, site in enumerate(program.traps, 1) if site.kind is TrapKind.BOUNDS]
    assert bounds
    emitted = emit_program(program)
    assert not any(f"ret i32 {number}\n" in emitted for number in bounds)
    assert "@scan" in jit.optimised_text(emitted)
