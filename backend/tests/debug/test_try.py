"""The debugger, coverage and the verification where errors are caught."""

from pathlib import Path

import pytest

from scanbench.debug.breakpoint import Breakpoint
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.engines.native.engine import NativeEngine
from scanbench.runtime.write import Write
from tests.debug.walking import MakeDebug, Walker
from tests.runtime.bench import CODESYS, program
from tests.verify.verified_runs import differences, record, rows, verifier

SOURCE = (
    CODESYS
    + """FUNCTION Part : DINT
VAR_INPUT d : DINT; END_VAR
  Part := 1;
  Part := 100 / d;
END_FUNCTION
PROGRAM Main
VAR n, d, r, caught, ended : DINT; END_VAR
  n := n + 1;
  __TRY
    r := Part(d);
    n := n + 100;
  __CATCH()
    caught := caught + 1;
  __FINALLY
    ended := ended + 1;
  __ENDTRY
  d := n MOD 2;
END_PROGRAM
"""
)
FAILS, CALL, CAUGHT, ENDED, AFTER = 5, 11, 14, 16, 18
ENGINES = pytest.mark.parametrize("make", [debug_engine, DebugBuilds().engine], ids=["reference", "native"])


def depth(walker: Walker) -> int:
    inside = walker.timeline.resource.listening.inside
    assert inside is not None
    return len(inside.frames)


@ENGINES
def test_a_step_from_the_statement_that_fails_leads_into_the_catch(make: MakeDebug, tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", SOURCE, make)
    walker.set(Breakpoint(1, "line", "Ann", file="main.st", line=FAILS))
    walker.run()
    assert (walker.line, depth(walker)) == (FAILS, 2)
    for line in (CAUGHT, ENDED, AFTER):
        walker.step("over")
        assert (walker.line, depth(walker)) == (line, 1), "the frame of Part is left"
    walker.step("back")
    assert walker.line == ENDED
    for _ in range(2):
        walker.step("back")
    assert (walker.line, depth(walker)) == (FAILS, 2), "back in the call that failed"
    walker.close()


@ENGINES
def test_a_step_over_and_a_step_out_of_a_call_that_fails_halt_in_the_catch(make: MakeDebug, tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", SOURCE, make)
    walker.set(Breakpoint(1, "line", "Ann", file="main.st", line=CALL))
    walker.run()
    walker.step("over")
    assert walker.line == CAUGHT
    walker.step("continue")
    assert (walker.line, walker.here[0]) == (CALL, 1)
    walker.step("in")
    walker.step("out")
    assert walker.line == CAUGHT if walker.here[0] % 2 == 0 else CALL + 1
    walker.close()


@ENGINES
def test_breakpoints_halt_in_the_catch_and_not_at_an_error_that_is_caught(make: MakeDebug, tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", SOURCE, make)
    walker.set(
        Breakpoint(1, "line", "Ann", file="main.st", line=CAUGHT),
        Breakpoint(2, "line", "Ann", file="main.st", line=ENDED, condition="n > 100"),
        Breakpoint(3, "trap", "Ann"),
    )
    walker.run()
    assert (walker.line, walker.here[0]) == (CAUGHT, 0)
    walker.step("continue")
    assert (walker.line, walker.here[0]) == (ENDED, 1)
    walker.close()


def test_coverage_has_the_statements_of_the_catch_that_ran() -> None:
    checked = program(SOURCE)
    for make in (debug_engine, DebugBuilds().engine):
        memory = bytearray(checked.initial_image)
        engine = make(checked, memory)
        reached = []
        for _ in range(2):
            engine.run(1)
            sites = engine.sites.statements
            reached.append({sites[each].span.line for each in engine.observer.take().reached})
        first, second = reached
        assert CAUGHT in first
        assert CALL + 1 not in first
        assert CAUGHT not in second
        assert CALL + 1 in second
        assert ENDED in first & second


def test_a_run_with_caught_errors_is_verified_without_a_difference(tmp_path: Path) -> None:
    checked = program(SOURCE)
    path = record(tmp_path / "run", checked, 12, [(5, Write("Ann", "Main.d", "0"))], engine=NativeEngine)
    with verifier(path, checked, "Main:10-17") as made:
        found = rows(made)
    assert not differences(found)
    assert len(found) == 12
