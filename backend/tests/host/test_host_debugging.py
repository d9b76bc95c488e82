"""Debugging through the process of a PLC: what its parent asks and hears, on native code."""

import os
import signal
from pathlib import Path

import pytest

from scanbench.debug.breakpoint import Breakpoint, Verdict
from scanbench.runtime.write import Write
from scanbench.taps.covered import CoveredOutcome
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import host as protocol
from scanbench.wire.host import Driven
from tests.amounts import slow
from tests.host.child import Child

STATIONS = """FUNCTION_BLOCK Station
VAR_INPUT up : DINT; END_VAR
VAR_OUTPUT total : DINT; END_VAR
VAR last : DINT; END_VAR
  last := total;
  total := total + up;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n : DINT; a, b, c : Station; END_VAR
  n := n + 1;
  a(up := 1);
  b(up := 2);
  c(up := 3);
END_PROGRAM
"""


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


def at_line(line: int, **more: object) -> tuple[Breakpoint, ...]:
    return (Breakpoint(1, "line", "Ann", file="main.st", line=line, **more),)  # type: ignore[arg-type]


def set_breakpoints(child: Child, breakpoints: tuple[Breakpoint, ...]) -> tuple[Verdict, ...]:
    return child.ask(
        lambda ref: debug_protocol.SetBreakpoints(ref, "", None, None, breakpoints), debug_protocol.BreakpointsAre
    ).verdicts


def test_a_breakpoint_halts_one_of_three_instances_and_a_step_goes_on(tmp_path: Path, cache: Path) -> None:
    with Child(tmp_path / "a.run", STATIONS, cache) as child:
        (verdict,) = set_breakpoints(child, at_line(6, instance="Main.b", condition="up = 2 AND total >= 20"))
        assert verdict.verified, verdict.message
        halt = child.halted()
        assert (halt.reason, halt.pou, halt.instance, halt.past) == ("breakpoint", "Station", "Main.b", False)
        assert halt.span is not None
        assert (halt.span.line, halt.breakpoints) == (6, (1,))
        total = int(child.value("total", 0))
        assert total >= 20
        assert child.value("up + 1", 0) == "3"
        stack = child.ask(debug_protocol.WantStack, debug_protocol.Stack)
        assert [each.name for each in stack.frames] == ["Main.b (Station)", "Main"]
        assert child.step("over").ok
        halt = child.halted(halt.number)
        assert (halt.reason, halt.instance, halt.span and halt.span.line) == ("step", "Main", 13)
        assert int(child.value("Main.b.total")) == total + 2
        assert child.step("continue").ok
        halt = child.halted(halt.number)
        assert int(child.value("total", 0)) == total + 2


def test_what_is_changed_while_halted_is_seen_by_the_next_statement(tmp_path: Path, cache: Path) -> None:
    with Child(tmp_path / "a.run", STATIONS, cache) as child:
        set_breakpoints(child, at_line(6, instance="Main.c"))
        halt = child.halted()
        before = int(child.value("total", 0))
        answer = child.ask(
            lambda ref: debug_protocol.SetExpression(ref, 0, "up", "1000", "Ann"), debug_protocol.Evaluated
        )
        assert answer.ok, answer.message
        assert answer.variable is not None
        assert answer.variable.value == "1000"
        child.step("in")
        halt = child.halted(halt.number)
        assert int(child.value("Main.c.total")) == before + 1000
        set_breakpoints(child, ())
        child.step("continue")
        child.until(lambda state: state.state == "running" and not state.flavour)


def test_back_into_an_earlier_scan_and_forward_to_the_live_position(tmp_path: Path, cache: Path) -> None:
    with Child(tmp_path / "a.run", STATIONS, cache) as child:
        set_breakpoints(child, at_line(10, condition="n > 30"))
        live = child.halted()
        number, n = live.number, int(child.value("n", 0))
        assert child.step("back").ok
        halt = child.halted(number)
        assert (halt.past, halt.scan, halt.span and halt.span.line) == (True, live.scan - 1, 6)
        assert child.value("Main.n") == str(n)
        refused = child.ask(lambda ref: protocol.Submit(ref, Write("Ann", "Main.n", "7")), protocol.Ack)
        assert not refused.ok
        assert child.step("continue").ok
        again = child.until(lambda state: state.halt is not None and not state.halt.past).halt
        assert again == live


def test_a_plc_that_is_killed_while_halted_comes_back_before_that_scan(tmp_path: Path, cache: Path) -> None:
    run = tmp_path / "a.run"
    with Child(run, STATIONS, cache) as child:
        set_breakpoints(child, at_line(5, instance="Main.c", condition="total > 30"))
        halt = child.halted()
        total, n = int(child.value("total", 0)), int(child.value("Main.n"))
        answer = child.ask(lambda ref: protocol.Submit(ref, Write("Ann", "Main.c.up", "500")), protocol.Ack)
        assert answer.ok
        child.step("in")
        halt = child.halted(halt.number)
        assert (halt.span and halt.span.line, child.value("up", 0)) == (6, "500")
        os.kill(child.process.pid, signal.SIGKILL)
    with Child(run, STATIONS, cache, Driven(paused=True), until=halt.scan) as child:
        state = child.wait(protocol.PlcState)
        assert (state.scan, state.halt) == (halt.scan, None)
        assert (int(child.value("Main.n")), int(child.value("Main.c.total"))) == (n - 1, total)
        done = child.ask(lambda ref: protocol.Drive(ref, "scan", None, "Ann"), protocol.Ack)
        assert done.ok
        assert int(child.value("Main.c.total")) == total + 500, "what was written inside of the scan is in the journal"


def test_a_plc_that_was_halted_comes_back_halted(tmp_path: Path, cache: Path) -> None:
    run = tmp_path / "a.run"
    with Child(run, STATIONS, cache) as child:
        child.until(lambda state: state.scan > 0)  # so that there is a statement to go back to
        assert child.step("pause").ok
        halt = child.halted()
        assert child.step("back").ok
        state = child.until(lambda state: state.halt is not None and state.halt.past)
        assert state.live_scan == halt.scan
        os.kill(child.process.pid, signal.SIGKILL)
    with Child(run, STATIONS, cache) as child:
        state = child.until(lambda state: state.state == "past")  # what was shown; that takes debugged code first
        assert state.live_scan == halt.scan
        child.ask(lambda ref: protocol.Travel(ref, None, "Ann"), protocol.Ack)
        # Perhaps before there was debugged code; it is halted there all the same.
        state = child.until(lambda state: state.halt is not None and state.halt.span == halt.span)
        assert state.message == "halted before main.st:10:3: it was halted in this scan when its process ended"
        assert state.halt is not None
        assert (state.halt.scan, state.halt.count) == (halt.scan, halt.count)
        child.step("in")
        assert child.halted(state.halt.number).count == halt.count + 1
        set_breakpoints(child, at_line(12))
        child.step("continue")
        assert child.halted(state.halt.number + 1).scan == halt.scan


def test_a_scan_on_in_the_past_leaves_the_statement_that_was_shown(tmp_path: Path, cache: Path) -> None:
    with Child(tmp_path / "a.run", STATIONS, cache) as child:
        set_breakpoints(child, at_line(11, condition="n > 20"))
        live = child.halted()
        for action in ("back", "back"):
            assert child.step(action).ok
        child.ask(lambda ref: protocol.Travel(ref, 9, "Ann"), protocol.Ack)
        assert child.step("in").ok
        halt = child.until(lambda state: state.halt is not None and state.halt.scan == 9).halt
        assert halt is not None
        assert (halt.past, halt.count) == (True, 1)
        assert child.ask(lambda ref: protocol.Drive(ref, "scan", None, "Ann"), protocol.Ack).ok
        state = child.until(lambda state: state.scan == 10)
        assert (state.state, state.halt) == ("past", None)
        refused = child.ask(debug_protocol.WantStack, protocol.Ack)
        assert "not halted" in refused.message
        assert child.step("continue").ok
        again = child.until(lambda state: state.halt is not None and not state.halt.past).halt
        assert again == live


def test_the_program_can_be_halted_where_it_traps(tmp_path: Path, cache: Path) -> None:
    source = "PROGRAM Main\nVAR n : DINT := 50; d : DINT; END_VAR\n  n := n - 1;\n  d := 100 / n;\nEND_PROGRAM\n"
    with Child(tmp_path / "a.run", source, cache) as child:
        set_breakpoints(child, (Breakpoint(1, "trap", "Ann"),))
        halt = child.halted()
        assert (halt.reason, halt.scan, halt.span and halt.span.line) == ("trap", 49, 4)
        assert child.value("n", 0) == "0"
        child.step("continue")
        state = child.until(lambda state: state.state in ("trapped", "fatal"))
        assert state.trap is not None
        assert (state.trap.line, state.halt) == (4, None)


def test_a_logpoint_that_speaks_all_the_time_does_not_flood(tmp_path: Path, cache: Path) -> None:
    with Child(tmp_path / "a.run", STATIONS, cache, Driven(speed=0)) as child:
        set_breakpoints(child, at_line(10, log="n is {n}"))
        first = child.wait(debug_protocol.LogpointSaid)
        assert first.text.startswith("n is ")
        assert (first.file, first.line) == ("main.st", 10)
        child.wait(debug_protocol.LogpointSaid, lambda said: "more were left out" in said.text)
        counted = child.wait(debug_protocol.BreakpointsAre, lambda told: told.ref is None)
        assert counted.verdicts[0].hits > 0


def test_coverage_says_what_was_reached(tmp_path: Path, cache: Path) -> None:
    source = (
        "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\n  IF n < 0 THEN\n    n := 0;\n  END_IF;\nEND_PROGRAM\n"
    )
    with Child(tmp_path / "a.run", source, cache) as child:
        child.ask(lambda ref: debug_protocol.SetCoverage(ref, True, False, "Ann"), protocol.Ack)
        found = child.wait(
            debug_protocol.CoverageIs, lambda told: any(each.reached for each in told.coverage.files[0].sites)
        )
        assert [(each.line, each.reached) for each in found.coverage.files[0].sites] == [
            (3, True),
            (4, True),
            (5, False),
        ]
        assert found.coverage.files[0].sites[1].outcomes == (
            CoveredOutcome("THEN", False),
            CoveredOutcome("ELSE", True),
        )


@slow
def test_a_plain_breakpoint_runs_on_fast_code_once_that_is_built(tmp_path: Path, cache: Path) -> None:
    with Child(tmp_path / "a.run", STATIONS, cache, Driven(speed=0)) as child:
        set_breakpoints(child, at_line(6, instance="", condition="total > 4000000 AND total < 0"))
        child.wait(protocol.PlcState, lambda state: state.flavour == "probed")
        child.send(protocol.Drive(0, "speed", 1.0, "Ann"))
        n = int(child.value("Main.n"))
        set_breakpoints(child, at_line(11, condition=f"n = {n + 500}"))
        child.wait(protocol.PlcState, lambda state: state.flavour == "probed")
        halt = child.halted()
        assert (halt.reason, halt.instance, child.value("n", 0)) == ("breakpoint", "Main", str(n + 500))


def test_back_to_the_last_write(tmp_path: Path, cache: Path) -> None:
    source = STATIONS.replace("VAR n :", "VAR mark, n :").replace(
        "  a(up := 1);", "  IF n = 1000 THEN\n    mark := 7;\n  END_IF;\n  a(up := 1);"
    )
    with Child(tmp_path / "a.run", source, cache, Driven(speed=0)) as child:
        child.wait(protocol.PlcState, lambda state: state.scan > 100_000)
        assert child.step("reverse", path="Main.mark").ok
        halt = child.halted()
        assert (halt.past, halt.scan, halt.span and halt.span.line) == (True, 999, 12)
        assert child.value("n", 0) == "1000"
