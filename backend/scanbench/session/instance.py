"""One virtual PLC, seen from the parent: starts its process, speaks to it, notices its death and starts it again.

The host may die at any moment (a fault in generated code, `kill -9`): the parent keeps the last checkpoint, the journal
and the last known scan, and a new host goes on from there.
"""

import asyncio
import logging
import socket
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Command, Entry
from scanbench.session import protocol
from scanbench.session.codec import LENGTH, BadMessage, pack, unpack
from scanbench.session.events import PlcState

log = logging.getLogger("scanbench")

QUICK_DEATH_NS = 10_000_000_000
QUICK_DEATHS = 4
"""So many deaths, each within `QUICK_DEATH_NS` of its start, and it is not started again."""


class Unavailable(Exception):
    """The PLC cannot answer now; the message says why."""


@dataclass(slots=True)
class Memory:
    """What a new host needs to go on where the last one stopped."""

    sources: protocol.Sources
    speed: float = 1.0
    paused: bool = False
    checkpoint: protocol.Checkpoint | None = None
    journal: list[Entry] = field(default_factory=list)
    scan: int = 0

    def start(self) -> protocol.Start:
        """The first message to a new host."""
        journal = tuple(self.journal) if self.checkpoint is not None else ()
        return protocol.Start(self.sources, self.speed, self.paused, self.checkpoint, journal, self.scan)

    def forget_run(self) -> None:
        """A cold start: nothing of what was has any meaning."""
        self.journal.clear()
        self.checkpoint, self.scan = None, 0

    def keep(self, checkpoint: protocol.Checkpoint, offered: protocol.Sources | None) -> None:
        """Takes a checkpoint; the first one of a new program takes over its sources too."""
        if offered is not None and offered.version == checkpoint.version:
            self.sources = offered
        self.checkpoint = checkpoint
        self.scan = max(self.scan, checkpoint.scan)


class Instance:
    """Supervises the process of one PLC. `on_message` gets what the host says, in order."""

    def __init__(
        self, sources: protocol.Sources, on_state: Callable[[PlcState], None], on_message: Callable[[object], None],
        cache: Path | None = None,
    ) -> None:  # fmt: skip
        """`cache` is a directory where hosts keep what they built."""
        self._cache = cache
        self.state = PlcState(
            "starting", "MONITOR", "starting", 0, 0, sources.interval_ns, 0.0, 1.0, None, 0, None, 0, sources.version
        )
        self._memory = Memory(sources)
        self._on_state, self._on_message = on_state, on_message
        self._offered: protocol.Sources | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._writer: asyncio.StreamWriter | None = None
        self._task: asyncio.Task[None] | None = None
        self._answers: dict[int, asyncio.Future[object]] = {}
        self._next_ref = 1
        self._deaths = 0
        self._stopping = False

    @property
    def entries(self) -> Sequence[Entry]:
        """The journal of this run, as far as it is acknowledged."""
        return self._memory.journal

    # ---- life -----------------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Starts the process, and keeps it alive until `stop`."""
        self._task = asyncio.get_running_loop().create_task(self._supervise())

    async def stop(self) -> None:
        """Ends the process, and waits for it."""
        self._stopping = True
        if self._writer is not None:
            self._writer.write(pack(protocol.Quit()))
        if self._task is not None:
            try:
                await asyncio.wait_for(asyncio.shield(self._task), 3)
            except TimeoutError:
                if self._process is not None:
                    self._process.kill()
                await self._task

    async def _supervise(self) -> None:
        while True:
            born = monotonic_ns()
            failure = await self._live()
            if self._stopping:
                return
            if failure is not None:
                self._set_state(state="failed", message=failure, pid=None)
                return
            self._deaths = self._deaths + 1 if monotonic_ns() - born < QUICK_DEATH_NS else 1
            if self._deaths > QUICK_DEATHS:
                self._set_state(
                    state="failed",
                    message=f"the PLC's process died {self._deaths} times in a row: it is not started again. "
                    "Correct the program and build, or restart",
                    pid=None,
                )
                return
            self._set_state(
                state="restarting", message="the PLC's process died; it goes on from its journal",
                pid=None, restarts=self.state.restarts + 1,
            )  # fmt: skip

    async def _live(self) -> str | None:
        """One life of the process; returns why it must not be started again, or None."""
        ours, theirs = socket.socketpair()
        self._process = process = _spawn(theirs, self._cache)
        theirs.close()
        reader, writer = await asyncio.open_unix_connection(sock=ours, limit=1 << 20)
        self._writer = writer
        writer.write(pack(self._memory.start()))
        if self.state.state != "restarting":
            self._set_state(state="starting", message="starting", pid=process.pid)
        failure: str | None = None
        try:
            while True:
                (length,) = LENGTH.unpack(await reader.readexactly(LENGTH.size))
                message = unpack(await reader.readexactly(length))
                if isinstance(message, protocol.StartFailed):
                    failure = message.message
                else:
                    self._take(message)
        except (asyncio.IncompleteReadError, ConnectionError):
            pass
        except BadMessage:
            log.exception("the host of this PLC does not speak the protocol: it is restarted")
            process.kill()
        finally:
            self._writer = None
            self._fail_answers()
            writer.close()
            await asyncio.to_thread(_reap, process)
        return failure

    def _take(self, message: object) -> None:
        match message:
            case protocol.HostState():
                self._see(message)
            case protocol.Entered():
                self._memory.journal.append(message.entry)
                self._memory.scan = max(self._memory.scan, message.entry.scan)
                self._on_message(message)
            case protocol.ColdStart():
                self._memory.forget_run()
                self._on_message(message)
            case protocol.Checkpoint():
                self._memory.keep(message, self._offered)
            case protocol.Ack() | protocol.Found():
                self._answer(message.ref, message)
            case _:
                self._on_message(message)

    def _see(self, state: protocol.HostState) -> None:
        self._memory.speed, self._memory.paused = state.speed, state.paused
        self._memory.scan = max(self._memory.scan, state.scan)
        pid = self._process.pid if self._process is not None else None
        self._set_state(
            state=state.state, mode=state.mode, message=state.message, scan=state.scan, time_ns=state.time_ns,
            interval_ns=state.interval_ns, cycle_us=state.cycle_us, speed=state.speed, pid=pid, trap=state.trap,
            forces=state.forces, version=state.version,
        )  # fmt: skip

    def _set_state(self, **changes: object) -> None:
        self.state = replace(self.state, **changes)  # type: ignore[arg-type]  # names and types are PlcState's own
        self._on_state(self.state)

    # ---- speaking to it -------------------------------------------------------------------------------------------

    async def submit(self, command: Command) -> protocol.Ack:
        """Enters a command in the seam."""
        return self._ack(await self._ask(lambda ref: protocol.Submit(ref, command)))

    async def drive(self, action: str, speed: float | None, author: str) -> protocol.Ack:
        """Changes pace, pauses, restarts. A PLC that failed is started again by `restart`."""
        if action == "restart" and self.state.state == "failed":
            return await self.revive(None)
        return self._ack(await self._ask(lambda ref: protocol.Drive(ref, action, speed, author)))

    async def build(self, sources: protocol.Sources, author: str) -> protocol.Ack:
        """Swaps the program; a PLC that failed is started again with it."""
        if self.state.state == "failed":
            return await self.revive(sources)
        self._offered = sources
        return self._ack(await self._ask(lambda ref: protocol.Build(ref, sources, author)))

    async def revive(self, sources: protocol.Sources | None) -> protocol.Ack:
        """A cold start after the process was given up."""
        self._memory = Memory(sources or self._memory.sources)
        self._on_message(protocol.ColdStart())
        self._deaths = 0
        self._set_state(state="starting", message="starting", trap=None, version=self._memory.sources.version)
        self.start()
        return protocol.Ack(0, True, "started again, cold", 0)

    async def look_up(self, kind: str, text: str) -> protocol.Found:
        """Members of a path, completions of a text."""
        answer = await self._ask(lambda ref: protocol.Lookup(ref, kind, text))
        assert isinstance(answer, protocol.Found)
        return answer

    def tell(self, message: protocol.WatchPaths | protocol.UnwatchIds | protocol.WantSnapshot) -> bool:
        """Something whose answer, if any, comes as a message; false when the process is away."""
        if self._writer is None:
            return False
        self._writer.write(pack(message))
        return True

    async def _ask(self, make: Callable[[int], object]) -> object:
        if self._writer is None:
            raise Unavailable(f"the PLC is {self.state.state}: {self.state.message}. Try again in a moment")
        ref, self._next_ref = self._next_ref, self._next_ref + 1
        future: asyncio.Future[object] = asyncio.get_running_loop().create_future()
        self._answers[ref] = future
        self._writer.write(pack(make(ref)))
        return await future

    @staticmethod
    def _ack(answer: object) -> protocol.Ack:
        assert isinstance(answer, protocol.Ack)
        return answer

    def _answer(self, ref: int, message: object) -> None:
        future = self._answers.pop(ref, None)
        if future is not None and not future.done():
            future.set_result(message)

    def _fail_answers(self) -> None:
        for future in self._answers.values():
            if not future.done():
                future.set_exception(Unavailable("the PLC's process died before it answered. See the log, and repeat"))
        self._answers.clear()


def _spawn(sock: socket.socket, cache: Path | None) -> "subprocess.Popen[bytes]":
    fd = sock.fileno()
    command = [sys.executable, "-m", "scanbench.session.host", str(fd), *([str(cache)] if cache is not None else [])]
    return subprocess.Popen(command, pass_fds=(fd,), stdin=subprocess.DEVNULL)


def _reap(process: "subprocess.Popen[bytes]") -> None:
    """Collects a process whose socket is closed: it ends by itself, or is ended."""
    try:
        process.wait(3)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
