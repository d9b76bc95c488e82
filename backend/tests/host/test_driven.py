"""However its process ends, a PLC is driven again as it was: with nothing but its run file to know it by."""

import os
import signal
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from scanbench.runtime.forces import Force
from scanbench.wire import host as protocol
from scanbench.wire.debugging import Places, WantPlaces
from scanbench.wire.host import Driven, PlcState
from tests.host.child import Child

COUNTING = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
Ended = Callable[[Child], None]


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


def killed(child: Child) -> None:
    os.kill(child.process.pid, signal.SIGKILL)
    child.process.wait()


def ended(child: Child) -> None:
    child.send(protocol.Quit())
    child.process.wait()


def drive(child: Child, action: str, speed: float | None = None, **more: object) -> int:
    ack = child.ask(lambda ref: protocol.Drive(ref, action, speed, "Ann", **more), protocol.Ack)  # type: ignore[arg-type]
    assert ack.ok, ack.message
    return ack.scan


def test_how_it_is_driven_is_told_before_the_answer(tmp_path: Path, cache: Path) -> None:
    """A parent that begins a new run at the answer to *pause* must not begin one that runs."""
    with Child(tmp_path / "a.run", COUNTING, cache) as child:
        for action, speed in (("pause", None), ("continue", None), ("speed", 0), ("pause", 2)):
            child.send(protocol.Drive(77, action, speed, "Ann"))
            told: list[object] = []
            while not any(isinstance(each, protocol.Ack) and each.ref == 77 for each in told):
                told += child.take()
            answer = next(at for at, each in enumerate(told) if isinstance(each, protocol.Ack) and each.ref == 77)
            state = [each for each in told[:answer] if isinstance(each, PlcState)][-1]
            assert state.paused == (action == "pause")
            assert speed is None or state.speed == speed


@pytest.mark.parametrize("end", [killed, ended])
def test_paused_at_this_scan_at_this_speed(tmp_path: Path, cache: Path, end: Ended) -> None:
    run = tmp_path / "a.run"
    with Child(run, COUNTING, cache) as child:
        drive(child, "pause", 0)
        scan = max(drive(child, "scan") for _ in range(3))
        end(child)
    for end_again in (killed, ended):
        with Child(run, COUNTING, cache) as child:
            state = child.wait(PlcState)
            assert (state.state, state.scan, state.speed) == ("paused", scan, 0)
            end_again(child)


@pytest.mark.parametrize("end", [killed, ended])
def test_on_its_way_to_where_it_was_asked_to_end(tmp_path: Path, cache: Path, end: Ended) -> None:
    run = tmp_path / "a.run"
    with Child(run, COUNTING, cache, Driven(paused=True)) as child:
        drive(child, "continue", 0.01, scans=10_000)
        end(child)
    with Child(run, COUNTING, cache) as child:
        state = child.wait(PlcState)
        assert (state.state, state.speed, state.target) == ("running", 0.01, "scan 10000")
        drive(child, "continue", 0, until="Main.n >= 10000")
        paused = child.wait(PlcState, lambda state: state.state == "paused")
        assert paused.scan == 10_000
        end(child)
    with Child(run, COUNTING, cache) as child:
        state = child.wait(PlcState)
        assert (state.state, state.scan, state.speed) == ("paused", 10_000, 0)


@pytest.mark.parametrize("end", [killed, ended])
def test_at_max_it_runs_on_at_max(tmp_path: Path, cache: Path, end: Ended) -> None:
    run = tmp_path / "a.run"
    with Child(run, COUNTING, cache) as child:
        drive(child, "speed", 0)
        end(child)
    with Child(run, COUNTING, cache) as child:
        state = child.wait(PlcState)
        assert (state.state, state.speed) == ("running", 0)


def test_what_the_server_asks_for_is_kept_before_it_is_told(tmp_path: Path, cache: Path) -> None:
    run = tmp_path / "a.run"
    with Child(run, COUNTING, cache, Driven(speed=0.5, paused=True)) as child:
        killed(child)
    with Child(run, COUNTING, cache) as child:
        state = child.wait(PlcState)
        assert (state.state, state.scan, state.speed) == ("paused", 0, 0.5)


@pytest.mark.parametrize("end", [killed, ended])
def test_a_halted_plc_is_halted_there_again_also_after_a_step(tmp_path: Path, cache: Path, end: Ended) -> None:
    run = tmp_path / "a.run"
    with Child(run, COUNTING, cache) as child:
        assert child.step("pause").ok
        scan = child.halted().scan
        child.step("scan")
        end(child)
    with Child(run, COUNTING, cache) as child:
        state = child.wait(PlcState)
        assert state.state == "halted"
        assert state.scan in (scan, scan + 1)
        assert child.step("continue").ok
        end(child)
    with Child(run, COUNTING, cache) as child:
        assert child.wait(PlcState).state == "running"


def test_what_was_acknowledged_is_told_before_it_is_said_to_run(tmp_path: Path, cache: Path) -> None:
    """Who looks at the forces as soon as it runs again must not miss the one that was made last."""
    run = tmp_path / "a.run"
    with Child(run, COUNTING, cache) as child:
        force = protocol.Submit(1, Force("Ann", "D1", "5"))
        assert child.ask(lambda ref: replace(force, ref=ref), protocol.Ack).ok
        killed(child)
    with Child(run, COUNTING, cache) as child:
        while not any(isinstance(each, protocol.InEffect) for each in child.messages):
            child.take()
        kinds = [type(each) for each in child.messages]
        told = [each for each in child.messages if isinstance(each, protocol.ForcesAre)]
        assert [[force.path for force in each.forces] for each in told[:1]] == [["D1"]]
        assert kinds.index(protocol.ForcesAre) < kinds.index(PlcState) < kinds.index(protocol.InEffect)


CALLING = """\
FUNCTION_BLOCK Inner
VAR n : DINT; END_VAR
  n := n + 1;
  n := n + 2;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n : DINT; inner : Inner; END_VAR
  n := n + 1;
  inner();
END_PROGRAM
"""


@pytest.mark.parametrize("end", [killed, ended])
def test_a_plc_halted_inside_of_a_scan_is_halted_before_the_same_statement(
    tmp_path: Path, cache: Path, end: Ended
) -> None:
    run = tmp_path / "a.run"
    with Child(run, CALLING, cache) as child:
        assert child.step("pause").ok
        last = child.halted()
        for _ in range(3):
            assert child.step("in").ok
            last = child.halted(last.number)
        assert last.count
        value = child.value("Main.inner.n")
        end(child)
    for _ in range(2):  # as often as it ends
        with Child(run, CALLING, cache) as child:
            state = child.until(lambda state: state.halt is not None and state.halt.count > 0)
            assert state.halt is not None
            assert (state.state, state.halt.scan, state.halt.count) == ("halted", last.scan, last.count)
            assert (state.halt.span, state.halt.instance, child.value("Main.inner.n")) == (
                last.span,
                last.instance,
                value,
            )
            end(child)
    with Child(run, CALLING, cache) as child:
        number = child.until(lambda state: state.halt is not None and state.halt.count > 0).halt
        assert number is not None
        assert child.step("scan").ok
        assert child.halted(number.number).scan == last.scan + 1


@pytest.mark.parametrize("count", [0, 2])
@pytest.mark.parametrize("end", [killed, ended])
def test_what_is_shown_of_the_past_is_shown_again(tmp_path: Path, cache: Path, end: Ended, count: int) -> None:
    run = tmp_path / "a.run"
    with Child(run, CALLING, cache) as child:
        drive(child, "pause", 0)
        live = max(drive(child, "scan") for _ in range(5))
        drive(child, "speed", 2)
        assert child.ask(lambda ref: protocol.Travel(ref, live - 3, "Ann", count), protocol.Ack).ok
        value = child.value("Main.n")
        end(child)
    for _ in range(2):
        with Child(run, CALLING, cache) as child:
            state = child.until(lambda state: state.state == "past")
            assert (state.scan, state.live_scan, state.past_by, state.speed, state.paused) == (
                live - 3,
                live,
                "Ann",
                2,
                True,
            )
            child.ask(
                lambda ref: WantPlaces(ref, "main.st", 1, 9), Places
            )  # it takes debugged code too, and comes after it
            assert child.value("Main.n") == value
            end(child)
    with Child(run, CALLING, cache) as child:
        child.until(lambda state: state.state == "past")
        assert child.ask(lambda ref: protocol.Travel(ref, None, "Ann"), protocol.Ack).ok
        assert child.until(lambda state: state.state == "paused").scan == live
        end(child)
    with Child(run, CALLING, cache) as child:
        assert child.wait(PlcState).state == "paused"
