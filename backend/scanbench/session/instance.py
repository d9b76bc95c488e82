"""One virtual PLC, seen from the parent: starts its process, speaks to it, notices its death and starts it again.

The host may die at any moment (a fault in generated code, `kill -9`): everything is in the run file, and a new host goes
on from there, up to the last scan that was heard of. It may also fall silent (SIGSTOP, a machine that swaps): then people
are told so, nothing waits for it, and it goes on by itself when it can.
"""

import asyncio
import logging
import signal
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from scanbench.host.run_files import bring_back, set_aside
from scanbench.host.zygote import HOST, NoProcess, Process
from scanbench.jobs.channel import Channel, connect, messages
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Command
from scanbench.store.records import Limits, NotFound
from scanbench.wire import host as protocol
from scanbench.wire.codec import BadMessage
from scanbench.wire.host import PlcState
from scanbench.wire.refused import Unavailable

log = logging.getLogger("scanbench")

QUICK_DEATH_NS = 10_000_000_000
_REACHED_S = 10
_ROOM_S = 1
"""How often it is tried to go on where there was no room."""
QUICK_DEATHS = 4
"""So many deaths, each within `QUICK_DEATH_NS` of its start, and it is not started again."""


A = TypeVar("A")
OFF = "switched off; its run is kept"
Telling = protocol.WatchPaths | protocol.UnwatchIds | protocol.WantSnapshot | protocol.Attend | protocol.SetLimits


@dataclass(frozen=True, slots=True)
class Patience:
    """How long a process is waited for."""

    look_s: float = 1.0
    """From one look whether something was heard to the next. Looks are counted, so that a server that was held up itself
    does not take that for silence."""
    looks: int = 5
    """So many looks in a row with nothing heard, and it does not answer."""
    answer_s: float = 120.0
    """For an answer of a process that does answer others."""
    work_s: float = 600.0
    """For what takes a while: builds, copies, the past, debugging."""
    grace_s: float = 3.0
    """For the end of a process that was told to end; then it is killed."""


PATIENCE = Patience()


@dataclass(slots=True)
class Remembered:
    """What a new host is told, so that it goes on where the last one stopped."""

    name: str
    sources: protocol.Sources
    run: Path
    limits: Limits
    driven: protocol.Driven | None = None
    """How the next host is to drive it; None is as the run file says."""
    scan: int = 0

    def start(self) -> protocol.Start:
        """The first message to a new host."""
        limits = self.limits
        return protocol.Start(
            self.name, self.sources, str(self.run), limits.run_mib, limits.memory_mib, limits.cpu_percent,
            self.scan, self.driven,
        )  # fmt: skip


class Instance:
    """Supervises the process of one PLC. `on_message` gets what the host says, in order."""

    def __init__(
        self, memory: Remembered, on_state: Callable[[PlcState], None], on_message: Callable[[object], None],
        cache: Path | None = None, patience: Patience = PATIENCE, why_not: str = "",
    ) -> None:  # fmt: skip
        """`cache` is a directory where hosts keep what they built; `why_not` is why it can never be started."""
        self._cache, self._patience, self.why_not = cache, patience, why_not
        self.state = PlcState(
            "failed" if why_not else "off", "MONITOR", why_not or OFF, interval_ns=memory.sources.interval_ns,
            version=memory.sources.version, startable=not why_not,
        )  # fmt: skip
        self._memory = memory
        self._on_state, self._on_message = on_state, on_message
        self._process: Process | None = None
        self._channel = Channel(memory.name, self._kill, Unavailable)
        self._connected = asyncio.Event()
        self._task: asyncio.Task[None] | None = None
        self._turning = asyncio.Lock()  # one at a time is switched on, off, or to a new run
        self._deaths = 0
        self.runs = 0
        """New runs that began since the server started."""
        self._stopping = self._paused = self._no_space = False
        self._heard = False
        self._before_silence: PlcState | None = None

    @property
    def sources(self) -> protocol.Sources:
        """What the program that runs is made of."""
        return self._memory.sources

    @property
    def run_file(self) -> Path:
        """Where the run is recorded."""
        return self._memory.run

    @property
    def on(self) -> bool:
        """Whether it has a process, or will have one again in a moment."""
        return self._task is not None and not self._task.done()

    # ---- life -----------------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Starts the process, and keeps it alive until `stop`."""
        if self.on or self.why_not:
            return
        self._stopping = False
        self._deaths = 0  # somebody wants it, whatever was before
        self._set_state(state="starting", message="starting")
        self._task = asyncio.get_running_loop().create_task(self._supervise())

    async def stop(self) -> None:
        """Ends the process, and waits for it."""
        await self.switch(on=False)

    async def switch(self, on: bool) -> bool:
        """Starts the process, or ends it and waits for that; whoever wants it otherwise waits. Whether it was otherwise: that is
        known only here, as a PLC has no process for a moment while it begins a new run."""
        async with self._turning:
            if on == self.on:
                return False
            if on:
                self.start()
            else:
                await self._stop()
            return True

    async def _stop(self) -> None:
        self._stopping = True
        self._channel.tell(protocol.Quit())
        if self._task is not None:
            try:
                async with asyncio.timeout(self._patience.grace_s):
                    await asyncio.shield(self._task)
            except TimeoutError:
                self._kill()
                await self._task
        self._set_state(state="off", message=OFF, pid=None)

    def _kill(self) -> None:
        if self._process is not None:
            self._process.kill()

    async def _supervise(self) -> None:
        while True:
            born = monotonic_ns()
            failure = await self._live()
            waits = failure is not None and self._no_space
            if waits and not self._stopping:
                self._set_state(state="no_space", message=failure, pid=None)
                await asyncio.sleep(_ROOM_S)
            if self._stopping:
                return
            if waits:
                continue
            if failure is not None:
                await asyncio.to_thread(bring_back, self._memory.run)
                self._set_state(state="failed", message=failure, pid=None)
                return
            self._deaths = self._deaths + 1 if monotonic_ns() - born < QUICK_DEATH_NS else 1
            if self._deaths > QUICK_DEATHS:
                self._set_state(
                    state="failed",
                    message=f"the PLC's process died {self._deaths} times in a row: it is not started again. "
                    "Correct the program and build, or begin a new run",
                    pid=None,
                )
                return
            self._set_state(
                state="restarting", message="the PLC's process died; it goes on from its run file",
                pid=None, restarts=self.state.restarts + 1,
            )  # fmt: skip

    async def _live(self) -> str | None:
        """One life of the process; returns why it must not be started again, or None."""
        self._no_space = False
        try:
            self._process, reader, writer = await connect(self._cache, HOST)
        except NoProcess as error:
            return str(error)
        process = self._process
        self._channel.begin(writer)
        self._channel.tell(self._memory.start())
        self._connected.set()
        if self._stopping:  # while the process was on its way
            self._channel.tell(protocol.Quit())
        if self.state.state not in ("restarting", "no_space"):
            self._set_state(state="starting", message="starting", pid=process.pid)
        failure: str | None = None
        looking = asyncio.get_running_loop().create_task(self._look())
        try:
            async for message in messages(reader):
                self._hear()
                if isinstance(message, protocol.StartFailed):
                    failure, self._no_space = message.message, message.no_space
                else:
                    await self._take(message)
        except BadMessage:
            log.exception("the host of this PLC does not speak the protocol: it is restarted")
            process.kill()
        finally:
            looking.cancel()
            self._before_silence = None
            self._connected.clear()
            self._channel.end("the PLC's process died before it answered. See the log, and repeat")
            writer.close()
            code = await asyncio.to_thread(_reap, process, self._patience.grace_s)
        return failure or _failure_of(code, self._memory.limits.memory_mib)

    async def _look(self) -> None:
        """Notices when the process falls silent: one that has nothing to tell is asked whether it is there."""
        missed = 0
        while True:
            await asyncio.sleep(self._patience.look_s)
            missed = 0 if self._heard else missed + 1
            self._heard = False
            if missed == 1:
                self._channel.tell(protocol.Ping())
            if missed > self._patience.looks and self._before_silence is None:
                self._fall_silent()

    def _fall_silent(self) -> None:
        self._before_silence = self.state
        self._set_state(
            state="silent", message="the PLC's process does not answer; it goes on when it can, or switch it off and on"
        )
        self._channel.give_up(
            "the PLC does not answer. What you asked for has not been confirmed: it may be done when the PLC goes on"
        )

    def _hear(self) -> None:
        self._heard = True
        if self._before_silence is not None:
            before, self._before_silence = self._before_silence, None
            self._set_state(state=before.state, message=before.message)

    async def _take(self, message: object) -> None:
        match message:
            case protocol.Pong():
                pass
            case protocol.PlcState():
                self._see(message)
            case protocol.Entered():
                self._memory.scan = max(self._memory.scan, message.entries[-1].scan)
                self._on_message(message)
            case protocol.Frame():
                self._memory.scan = max(self._memory.scan, message.live_scan)
                self._on_message(message)
            case protocol.Ready():
                self._memory.sources, self._memory.driven = message.sources, None  # its file says it from now on
                if message.fresh:
                    self._memory.scan = 0
                self._on_message(message)
            case protocol.NowRuns():
                self._memory.sources = message.sources
                self._on_message(message)
            case protocol.Watching():  # who watches has given it its ref
                self._on_message(message)
            case _:
                if not await self._channel.take(message):
                    self._on_message(message)

    def _see(self, state: protocol.PlcState) -> None:
        self._paused = state.paused
        self._memory.scan = state.live_scan
        pid = self._process.pid if self._process is not None else None
        halt = state.halt if pid is not None else None
        self.state = replace(
            state, pid=pid, halt=halt, restarts=self.state.restarts, startable=self.state.startable
        )  # fmt: skip
        self._on_state(self.state)

    def _set_state(self, **changes: object) -> None:
        if changes.get("pid", self) is None:  # where there is no process, nothing is halted
            changes["halt"] = None
        self.state = replace(self.state, **changes)  # type: ignore[arg-type]  # names and types are PlcState's own
        self._on_state(self.state)

    # ---- speaking to it -------------------------------------------------------------------------------------------

    async def ask(self, make: Callable[[int], object], answer: type[A], takes_long: bool = False) -> A:
        """Asks something; `make` makes the question with the ref that it is given, `answer` is what comes back. `Refused`, or
        `Unavailable` when the PLC is away, or does not answer in time."""
        if self.why_not:
            raise Unavailable(self.why_not)
        if not self._channel.there and self.state.state == "starting":
            with suppress(TimeoutError):
                async with asyncio.timeout(_REACHED_S):
                    await self._connected.wait()
        if not self._channel.open:
            hint = "Switch it on first" if self.state.state == "off" else "Try again in a moment"
            raise Unavailable(f"the PLC is {self.state.state.replace('_', ' ')}: {self.state.message}. {hint}")
        if self._before_silence is not None:
            raise Unavailable(f"nothing was changed: {self.state.message}")
        seconds = self._patience.work_s if takes_long else self._patience.answer_s
        try:
            return await self._channel.ask(make, answer, seconds)
        except TimeoutError:
            raise Unavailable(
                f"the PLC has not answered this within {seconds:g} s. It may still be done: look before you repeat it"
            ) from None

    async def submit(self, command: Command) -> protocol.Ack:
        """Enters a command in the seam."""
        return await self.ask(lambda ref: protocol.Submit(ref, command), protocol.Ack)

    async def sources_of(self, version: int) -> protocol.Sources:
        """What a version of the program was made of when it ran here; `NotFound` when it never did."""
        found = await self.ask(lambda ref: protocol.WantSources(ref, version), protocol.SourcesOf)
        if found.sources is None:
            raise NotFound(found.message)
        return found.sources

    async def look_up(self, kind: str, text: str) -> protocol.Found:
        """`members` of a path, what `complete`s a text, the `instances` of a POU, or the `terminals` of the PLC."""
        return await self.ask(lambda ref: protocol.Lookup(ref, kind, text), protocol.Found)

    def tell(self, message: Telling) -> bool:
        """Something whose answer, if any, comes as a message; false when the process is away."""
        return self._channel.tell(message)

    async def build(self, sources: protocol.Sources, author: str) -> protocol.Ack:
        """Swaps the program; a PLC that failed begins a new run with it."""
        if self.state.state == "failed":
            return await self.new_run(sources)
        return await self.ask(lambda ref: protocol.Build(ref, sources, author), protocol.Ack, takes_long=True)

    async def new_run(self, sources: protocol.Sources | None = None) -> protocol.Ack:
        """Begins a new run at scan 0; the old run file is kept aside."""
        async with self._turning:
            if self.why_not:  # its run must not be put aside for one that cannot begin
                raise Unavailable(self.why_not)
            if not self.on and self.state.state != "failed":
                raise Unavailable(f"the PLC is {self.state.state}: {self.state.message}. Switch it on first")
            await self._stop()
            await asyncio.to_thread(set_aside, self._memory.run)
            self._begin(sources)
        return protocol.Ack(0, True, "a new run begins at scan 0", 0)

    def _begin(self, sources: protocol.Sources | None) -> None:
        memory = self._memory
        self.runs += 1
        memory.sources = sources or memory.sources
        memory.scan = 0
        memory.driven = protocol.Driven(self.state.speed, self._paused)
        self._set_state(
            scan=0, live_scan=0, time_ns=0, trap=None, past_by="", target="", version=memory.sources.version
        )
        self.start()

    def limit(self, limits: Limits) -> None:
        """New limits; that of memory holds from the next start of the process."""
        self._memory.limits = limits
        self.tell(protocol.SetLimits(limits.run_mib, limits.cpu_percent))


def _reap(process: Process, grace_s: float) -> int | None:
    """Collects a process whose socket is closed: it ends by itself, or is ended. Returns how it ended."""
    code = process.wait(grace_s)
    if code is None:
        process.kill()
        code = process.wait()
    return code


def _failure_of(code: int | None, memory_mib: int | None) -> str | None:
    """Why a process that ended so must not be started again: LLVM aborts where it gets no memory."""
    if code == -signal.SIGABRT and memory_mib is not None:
        return (
            f"out of memory: limit {memory_mib} MiB; the compiler got no more. "
            "Raise the limit of the instance, or use a smaller program"
        )
    return None
