"""Job processes, from the parent: what takes a processor for a while must not be in the way of the server or of a PLC."""

import asyncio
import logging
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from scanbench.host.zygote import JOB, NoProcess, Process
from scanbench.jobs.channel import Channel, OnPart, connect, messages
from scanbench.wire.codec import BadMessage
from scanbench.wire.refused import Refused

log = logging.getLogger("scanbench")
ANSWER_S = 120.0
"""So long a question of people is waited for; then the process is ended that computes it."""
WORK_S = 600.0
"""So long a process that does one thing, and tells how far it is, may say nothing; then it is ended."""
IDLE_S = 60.0
"""So long without a question, and a process that is there for all ends."""
DIED = "the process that computes it died: try again"
FAULT = "a fault of Scanbench: see the log of the server"
SLOW = f"it took longer than {ANSWER_S:g} s, and was given up: ask for fewer scans, or try again"
A = TypeVar("A")
Make = Callable[[int], object]
"""Makes a question of the ref that it is given."""


class Gone(Refused):
    """There is no answer: the process died, or was ended."""


class Slow(Gone):
    """It was ended, as it said nothing for too long."""


class Job:
    """One job process, which answers one question after the other. To be made in the event loop."""

    def __init__(self, cache: Path | None, on_end: Callable[[], None] = lambda: None, entry: str = JOB) -> None:
        """`cache` is the directory where programs and their code are kept; `on_end` is called once, when the process is gone."""
        self._channel = Channel("a job", self.kill, Gone, in_turn=True)
        self._process: Process | None = None
        self._begun = asyncio.Event()
        self._why = DIED
        self.gone = False
        """It is ended, or will be in a moment."""
        self._task = asyncio.get_running_loop().create_task(self._live(cache, on_end, entry))

    @property
    def pids(self) -> tuple[int, ...]:
        """Of the process; none before it is there."""
        return () if self._process is None else (self._process.pid,)

    async def ask(
        self, make: Make, answer: type[A], seconds: float | None = ANSWER_S, on_part: OnPart | None = None
    ) -> A:  # fmt: skip
        """The answer; see `Channel.ask`. `Gone` when the process died, or said nothing for so many seconds: then it is ended."""
        await self._begun.wait()
        if not self._channel.open:
            raise Gone(self._why)
        try:
            return await self._channel.ask(make, answer, seconds, on_part)
        except TimeoutError:
            log.error("a job process has said nothing for %g s: it is ended", seconds)
            self.kill()
            raise Slow(SLOW if on_part is None else DIED) from None

    def tell(self, message: object) -> None:
        """Something that has no answer; lost where the process is away."""
        self._channel.tell(message)

    def kill(self) -> None:
        """Ends the process, whatever it does."""
        self.gone = True
        if self._process is not None:
            self._process.kill()

    async def end(self, why: str = DIED) -> None:
        """Ends the process, and waits for that; who waits for an answer is told why there is none."""
        self._why = why
        self.kill()
        await asyncio.wait((self._task,))

    async def _live(self, cache: Path | None, on_end: Callable[[], None], entry: str) -> None:
        try:
            self._process, reader, writer = await connect(cache, entry)
        except NoProcess:
            log.exception("a job process could not be started")
            self.gone = True
            self._begun.set()
            on_end()
            return
        self._channel.begin(writer)
        self._begun.set()
        try:
            if not self.gone:
                async for message in messages(reader):
                    await self._channel.take(message)
        except BadMessage:
            log.exception("a job process does not speak the protocol")
        finally:
            self.kill()
            self._channel.end(self._why)
            writer.close()
            await asyncio.to_thread(self._process.wait)
            on_end()


class SharedJob:
    """One job process for the questions of all: the first one starts it, and it ends when nothing was asked for a while.
    One that is gone is replaced by the next question."""

    def __init__(self, cache: Path | None, idle_s: float | None = IDLE_S, entry: str = JOB) -> None:
        """Without `idle_s` it stays."""
        self._cache, self._idle_s, self._entry = cache, idle_s, entry
        self._job: Job | None = None
        self.closed = False
        self._open = 0
        self._idle: asyncio.TimerHandle | None = None

    @property
    def pids(self) -> tuple[int, ...]:
        """See `Job`."""
        return () if self._job is None else self._job.pids

    async def ask(self, make: Make, answer: type[A], seconds: float = ANSWER_S) -> A:
        """See `Job.ask`."""
        self._open += 1
        if self._idle is not None:
            self._idle.cancel()
        try:
            job = await self._ready()
            return await job.ask(make, answer, seconds)
        finally:
            self._open -= 1
            if not self._open and self._job is not None and self._idle_s is not None:
                self._idle = asyncio.get_running_loop().call_later(self._idle_s, self._job.kill)

    def tell(self, message: object) -> None:
        """See `Job.tell`."""
        if self._job is not None:
            self._job.tell(message)

    async def close(self) -> None:
        """Ends the process; what is still asked, or is asked later, is not answered any more."""
        self.closed = True
        if self._idle is not None:
            self._idle.cancel()
        if self._job is not None:
            await self._job.end()

    async def _ready(self) -> Job:
        if self.closed:
            raise Gone(DIED)
        before = self._job
        if before is not None and not before.gone:
            return before
        job = self._job = Job(self._cache, entry=self._entry)
        if before is not None:
            await before.end()
        return job


async def alone(cache: Path, make: Make, answer: type[A], on_part: OnPart, silent_s: float = WORK_S) -> A:
    """The answer of a process that does nothing else, and tells how far it is; cancelled, it ends the process."""
    job = Job(cache)
    try:
        return await job.ask(make, answer, silent_s, on_part)
    finally:
        await job.end()
