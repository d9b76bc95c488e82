"""Processes of PLCs: who dies with whom, what they share, and what they may take."""

import asyncio
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic, sleep

import pytest

from scanbench.host.zygote import HostProcess, NoProcess, Zygote
from scanbench.session.instance import Instance, Remembered
from scanbench.store.records import Limits
from scanbench.wire import host as protocol
from scanbench.wire.codec import Splitter, pack
from scanbench.wire.host import PlcState
from tests.amounts import slow

COUNTING = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
LARGE = "PROGRAM Main\nVAR n : ARRAY[1..{0}] OF DINT; END_VAR\n  n[1] := n[1] + 1;\nEND_PROGRAM\n"
PATIENCE_S = 60


def sources(text: str = COUNTING) -> protocol.Sources:
    return protocol.Sources("GENERIC-IEC", {"main.st": text}, 1_000_000, 1)


class Talk:
    """The parent's end of a host."""

    def __init__(self, zygote: Zygote, directory: Path, number: int = 0) -> None:
        ours, theirs = socket.socketpair()
        with theirs:
            self.process = zygote.spawn(theirs, directory / "cache")
        self.sock, self._splitter = ours, Splitter()
        self._run = directory / f"{number}.run"
        self._read: list[object] = []
        ours.settimeout(PATIENCE_S)

    def start(self, text: str = COUNTING, memory_mib: int | None = None) -> None:
        self.sock.sendall(pack(protocol.Start("line", sources(text), str(self._run), None, memory_mib, None, 0, None)))

    def say(self, message: object) -> None:
        self.sock.sendall(pack(message))

    def hear(self, kind: type) -> object:
        """The next message of this kind; None at the end."""
        while True:
            while self._read:
                message = self._read.pop(0)
                if isinstance(message, kind):
                    return message
            data = self.sock.recv(1 << 16)
            if not data:
                return None
            self._read += self._splitter.feed(data)

    def answers(self) -> bool:
        self.say(protocol.Lookup(7, "members", ""))
        return isinstance(self.hear(protocol.Found), protocol.Found)


@contextmanager
def hosts(directory: Path, count: int) -> Iterator[tuple[Zygote, list[Talk]]]:
    """So many PLCs that run."""
    zygote = Zygote()
    talks: list[Talk] = []
    try:
        for number in range(count):
            talks.append(Talk(zygote, directory, number))
            talks[-1].start()
        assert all(isinstance(talk.hear(protocol.Ready), protocol.Ready) for talk in talks)
        yield zygote, talks
    finally:
        for talk in talks:
            talk.sock.close()
            talk.process.kill()
            talk.process.wait()
        zygote.close()


def runs(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


def until(holds: Callable[[], bool]) -> None:
    end = monotonic() + PATIENCE_S
    while not holds():
        assert monotonic() < end, "it never came"
        sleep(0.01)


def test_a_host_ends_when_it_is_told_to(tmp_path: Path) -> None:
    with hosts(tmp_path, 1) as (_, (talk,)):
        assert talk.answers()
        talk.say(protocol.Quit())
        assert talk.process.wait(PATIENCE_S) == 0
        assert talk.hear(protocol.StartFailed) is None


def test_a_host_says_that_it_is_there_also_before_its_plc_runs(tmp_path: Path) -> None:
    zygote = Zygote()
    talk = Talk(zygote, tmp_path)
    talk.say(protocol.Ping())
    assert isinstance(talk.hear(protocol.Pong), protocol.Pong)
    talk.sock.close()
    talk.process.wait(PATIENCE_S)
    zygote.close()


def test_a_host_ends_when_nobody_speaks_to_it_any_more(tmp_path: Path) -> None:
    with hosts(tmp_path, 1) as (_, (talk,)):
        talk.sock.close()
        assert talk.process.wait(PATIENCE_S) == 0


def test_a_killed_host_is_noticed_and_the_only_one(tmp_path: Path) -> None:
    with hosts(tmp_path, 3) as (zygote, (first, second, third)):
        os.kill(second.process.pid, signal.SIGKILL)
        assert second.hear(protocol.StartFailed) is None  # the end: nobody else has its socket
        assert second.process.wait(PATIENCE_S) == -signal.SIGKILL
        assert first.answers()
        assert third.answers()
        again = Talk(zygote, tmp_path, 4)
        again.start()
        assert again.answers()
        again.sock.close()
        assert again.process.wait(PATIENCE_S) == 0


def test_hosts_survive_their_zygote(tmp_path: Path) -> None:
    with hosts(tmp_path, 2) as (zygote, talks):
        killed = zygote.pid
        assert killed is not None
        os.kill(killed, signal.SIGKILL)
        until(lambda: not runs(killed))
        assert all(talk.answers() for talk in talks)
        born_later = Talk(zygote, tmp_path, 7)
        born_later.start()
        assert born_later.answers()
        assert zygote.pid != killed
        born_later.process.kill()
        assert born_later.process.wait() == -signal.SIGKILL
        born_later.sock.close()


@slow
def test_a_frozen_zygote_is_given_up(tmp_path: Path) -> None:
    zygote = Zygote(grace_s=0.1)
    zygote.start()
    Talk(zygote, tmp_path).sock.close()
    frozen = zygote.pid
    assert frozen is not None
    os.kill(frozen, signal.SIGSTOP)
    patience, zygote.reply_s = zygote.reply_s, 0.01
    ours, theirs = socket.socketpair()
    with ours, theirs, pytest.raises(NoProcess):
        zygote.spawn(theirs, None)
    zygote.reply_s = patience
    talk = Talk(zygote, tmp_path, 1)
    talk.start()
    assert talk.answers()
    talk.sock.close()
    assert not runs(frozen)
    assert zygote.pid is not None
    os.kill(zygote.pid, signal.SIGSTOP)
    zygote.close()


_PARENT = """
import socket, sys, time
from pathlib import Path
from scanbench.host.zygote import zygote
from tests.host.test_zygote import Talk
from scanbench.wire import host as protocol
talks = [Talk(zygote(), Path(sys.argv[1]), number) for number in range(2)]
for talk in talks:
    talk.start()
    talk.hear(protocol.Ready)
print(zygote().pid, *(talk.process.pid for talk in talks), flush=True)
time.sleep(600)
"""


def test_nothing_survives_the_server(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", _PARENT, str(tmp_path)], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        pids = [int(word) for word in parent.stdout.readline().split()]
        assert len(pids) == 3
        assert all(runs(pid) for pid in pids)
        parent.kill()
    for pid in pids:
        until(lambda pid=pid: not runs(pid))  # type: ignore[misc]


def sockets(pid: int) -> set[str]:
    links = (os.readlink(path) for path in Path(f"/proc/{pid}/fd").iterdir())
    return {link for link in links if link.startswith("socket:")}


def test_siblings_share_no_socket(tmp_path: Path) -> None:
    with hosts(tmp_path, 3) as (zygote, talks):
        assert zygote.pid is not None
        of_zygote = sockets(zygote.pid)
        assert len(of_zygote) == 1
        of_hosts = [sockets(talk.process.pid) for talk in talks]
        assert [len(each) for each in of_hosts] == [1, 1, 1]
        assert len(set().union(of_zygote, *of_hosts)) == 4


def test_a_zygote_that_cannot_start_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    zygote = Zygote()
    monkeypatch.setattr(sys, "executable", str(tmp_path / "no python"))
    ours, theirs = socket.socketpair()
    with ours, theirs, pytest.raises(NoProcess, match="no process could be started"):
        zygote.spawn(theirs, None)
    monkeypatch.undo()
    zygote.start()
    assert zygote.pid is not None
    zygote.close()
    assert zygote.pid is None


def test_waiting_for_a_process_has_an_end(tmp_path: Path) -> None:
    with hosts(tmp_path, 1) as (_, (talk,)):
        assert talk.process.wait(0.01) is None
        talk.process.kill()
        assert talk.process.wait() == -signal.SIGKILL
        talk.process.kill()  # its number may be another's by now
        assert talk.process.wait() == -signal.SIGKILL


def test_somebody_elses_child_is_gone() -> None:
    with subprocess.Popen([sys.executable, "-c", ""]) as child:
        child.wait()
        assert HostProcess(child.pid).wait(PATIENCE_S) == 0


# ---- limits -------------------------------------------------------------------------------------------------------


def test_out_of_memory_is_said(tmp_path: Path) -> None:
    zygote = Zygote()
    talk = Talk(zygote, tmp_path)
    talk.start(LARGE.format(8_000_000), memory_mib=64)
    failed = talk.hear(protocol.StartFailed)
    assert isinstance(failed, protocol.StartFailed)
    assert failed.message.startswith("out of memory: limit 64 MiB")
    assert talk.process.wait(PATIENCE_S) == 1
    talk.sock.close()
    zygote.close()


def test_a_small_program_needs_little_memory(tmp_path: Path) -> None:
    zygote = Zygote()
    talk = Talk(zygote, tmp_path)
    talk.start(memory_mib=64)
    assert isinstance(talk.hear(protocol.Ready), protocol.Ready)
    assert talk.answers()
    talk.say(protocol.Quit())
    assert talk.process.wait(PATIENCE_S) == 0
    talk.sock.close()
    zygote.close()


def test_a_plc_that_is_out_of_memory_is_not_started_again_before_somebody_switches_it_on(tmp_path: Path) -> None:
    async def fails() -> PlcState:
        failed, running = asyncio.Event(), asyncio.Event()

        def on_state(state: PlcState) -> None:
            if state.state in ("failed", "running"):
                (failed if state.state == "failed" else running).set()

        memory = Remembered("line", sources(LARGE.format(8_000_000)), tmp_path / "line.run", Limits(memory_mib=64))
        instance = Instance(memory, on_state, lambda _: None, tmp_path / "cache")
        instance.start()
        await asyncio.wait_for(failed.wait(), PATIENCE_S)
        state = instance.state
        instance.limit(Limits())
        await instance.switch(on=True)
        await asyncio.wait_for(running.wait(), PATIENCE_S)
        await instance.stop()
        return state

    state = asyncio.run(fails())
    assert state.message.startswith("out of memory: limit 64 MiB")
    assert state.restarts == 0
    assert state.pid is None
    assert state.startable
