"""A full disk: nothing is acknowledged that is not in the run file, the PLC waits and says so, and goes on when there is room."""

import asyncio
import os
import resource
import signal
from pathlib import Path

import pytest

from scanbench.host.zygote import zygote
from scanbench.runtime.forces import Force
from scanbench.runtime.write import Write
from scanbench.session.instance import Instance, Remembered
from scanbench.store.records import Limits
from scanbench.wire import host as protocol
from scanbench.wire.host import Driven, PlcState
from tests.host.child import Child

COUNTING = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
NO_LIMIT = resource.RLIM_INFINITY


def room(pid: int, bytes: int) -> None:
    """No file that this process writes may be larger."""
    resource.prlimit(pid, resource.RLIMIT_FSIZE, (bytes, NO_LIMIT))


def submit(child: Child, command: object) -> protocol.Ack:
    return child.ask(lambda ref: protocol.Submit(ref, command), protocol.Ack)  # type: ignore[arg-type]


def test_it_waits_and_refuses_until_there_is_room(tmp_path: Path) -> None:
    run = tmp_path / "a.run"
    with Child(run, COUNTING, tmp_path / "cache") as child:
        kept = submit(child, Write("Ann", "D100", "11"))
        assert kept.ok
        room(child.process.pid, run.stat().st_size + 10)
        for command in (Write("Ann", "D100", "12"), Force("Ann", "D101", "5")):
            refused = submit(child, command)
            assert not refused.ok
            assert "no space" in refused.message
        waiting = child.until(lambda state: state.state == "no_space")
        assert "is room" in waiting.message
        for action in ("continue", "scan", "pause", "speed"):
            driven = child.ask(lambda ref: protocol.Drive(ref, action, 10, "Ann"), protocol.Ack)  # noqa: B023
            assert (driven.ok, driven.scan) == (False, waiting.scan), "no scan runs"
            assert "no space" in driven.message
        assert not child.step("pause").ok
        assert (child.value("D100"), child.value("D101")) == ("16#000B", "16#0000")

        room(child.process.pid, NO_LIMIT)
        running = child.until(lambda state: state.state == "running" and state.scan > waiting.scan)
        assert running.speed == 1.0
        assert submit(child, Force("Ann", "D101", "5")).ok
        room(child.process.pid, run.stat().st_size + 10)
        assert not submit(child, Write("Ann", "D100", "13")).ok
        os.kill(child.process.pid, signal.SIGKILL)
    with Child(run, COUNTING, tmp_path / "cache") as child:
        assert child.wait(PlcState).state == "running"
        assert (child.value("D100"), child.value("D101")) == ("16#000B", "16#0005")


def test_paused_it_stays_paused_when_there_is_room(tmp_path: Path) -> None:
    run = tmp_path / "a.run"
    with Child(run, COUNTING, tmp_path / "cache", Driven(paused=True)) as child:
        room(child.process.pid, run.stat().st_size)
        assert not submit(child, Write("Ann", "D100", "12")).ok
        refused = child.ask(lambda ref: protocol.Drive(ref, "scan", None, "Ann"), protocol.Ack)
        assert not refused.ok
        room(child.process.pid, NO_LIMIT)
        done = child.ask(lambda ref: protocol.Drive(ref, "scan", None, "Ann"), protocol.Ack)
        assert (done.ok, done.scan) == (True, 1)
        assert child.until(lambda state: state.scan == 1).state == "paused"


def test_a_plc_begins_when_there_is_room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scanbench.session.instance._ROOM_S", 0.05)

    async def story() -> None:
        waits, runs = asyncio.Event(), asyncio.Event()

        def on_state(state: object) -> None:
            if instance.state.state == "no_space":
                waits.set()
            if instance.state.state == "running" and instance.state.scan > 0:
                runs.set()

        sources = protocol.Sources("GENERIC-IEC", {"main.st": COUNTING}, 1_000_000, 1)
        run = tmp_path / "line.run"
        instance = Instance(Remembered("line", sources, run, Limits()), on_state, lambda _: None, tmp_path / "cache")
        await asyncio.to_thread(zygote().start)
        pid = zygote().pid
        assert pid is not None
        room(pid, 100)
        try:
            instance.start()
            await asyncio.wait_for(waits.wait(), 60)
            assert "there is room" in instance.state.message
            assert not run.exists(), "a run that has not begun leaves no file"
            room(pid, NO_LIMIT)
            await asyncio.wait_for(runs.wait(), 60)
            assert instance.state.restarts == 0
        finally:
            room(pid, NO_LIMIT)
            await instance.stop()

    asyncio.run(story())
