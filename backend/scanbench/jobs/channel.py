"""Questions to a process, each with a typed answer, and messages to it without an answer: one way for all processes.

A question is a message with a `ref`, which the channel gives it; whatever comes back with that `ref` belongs to it.
"""

import asyncio
import logging
import socket
from collections.abc import AsyncIterator, Awaitable, Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from scanbench.host.zygote import NoProcess, Process, zygote
from scanbench.wire.codec import LENGTH, body_length, pack, unpack
from scanbench.wire.host import Ack
from scanbench.wire.jobs import JobRefused
from scanbench.wire.refused import Refused

log = logging.getLogger("scanbench")
UNREAD_BYTES = 64 << 20
"""More than this not read by a process: it is ended."""
A = TypeVar("A")
OnPart = Callable[[object], Awaitable[None]]


@dataclass(frozen=True, slots=True)
class _Question:
    """One that is open."""

    hear: OnPart
    fail: Callable[[Exception], None]


class Channel:
    """To one process after the other; while there is none, nothing can be asked. Everything in the event loop."""

    def __init__(
        self, name: str, kill: Callable[[], None], gone: Callable[[str], Exception], in_turn: bool = False
    ) -> None:  # fmt: skip
        """`kill` ends a process that does not read; `gone` makes what questions raise when they are given up. `in_turn`: it
        answers one question after the other, so each deadline begins again whenever anything is heard."""
        self._name, self._kill, self._gone, self._in_turn = name, kill, gone, in_turn
        self._writer: asyncio.StreamWriter | None = None
        self._questions: dict[int, _Question] = {}
        self._next_ref = 1
        self._heard = 0

    @property
    def there(self) -> bool:
        """Whether there is a process, or was until a moment ago."""
        return self._writer is not None

    @property
    def open(self) -> bool:
        """Whether there is a process that listens."""
        return self._writer is not None and not self._writer.is_closing()

    def begin(self, writer: asyncio.StreamWriter) -> None:
        """A process is there."""
        self._writer = writer

    def end(self, why: str) -> None:
        """It is gone: nobody gets an answer."""
        self._writer = None
        self.give_up(why)

    def tell(self, message: object) -> bool:
        """Something whose answer, if any, comes as a message; false when the process is away."""
        if self._writer is None or self._writer.is_closing():
            return False
        self._write(self._writer, pack(message))
        return True

    async def ask(
        self, make: Callable[[int], object], answer: type[A], seconds: float | None, on_part: OnPart | None = None
    ) -> A:  # fmt: skip
        """Asks a process that is there; `make` makes the question with the ref that it is given. What comes before the answer of
        this class is given to `on_part`, and no more is read meanwhile. `Refused`; `TimeoutError` after so many seconds."""
        assert self._writer is not None
        ref, self._next_ref = self._next_ref, self._next_ref + 1
        packed = pack(make(ref))
        future: asyncio.Future[A] = asyncio.get_running_loop().create_future()

        def fail(error: Exception) -> None:
            if not future.done():
                future.set_exception(error)

        async def hear(message: object) -> None:
            if future.done():
                return
            if isinstance(message, answer):
                future.set_result(message)
            elif isinstance(message, Ack | JobRefused):
                fail(Refused(message.message, message.near))
            elif on_part is None:
                fail(TypeError(f"{answer.__name__} was asked for, {type(message).__name__} came"))
            else:
                try:
                    await on_part(message)
                except Exception as error:  # whoever asked has to know
                    fail(error)

        self._questions[ref] = _Question(hear, fail)
        self._write(self._writer, packed)
        try:
            return await self._within(future, seconds)
        finally:
            self._questions.pop(ref, None)

    async def take(self, message: object) -> bool:
        """Gives a message to the question that it belongs to, if anybody still waits; false where it belongs to none."""
        self._heard += 1
        ref = getattr(message, "ref", None)
        if not isinstance(ref, int):
            return False
        question = self._questions.get(ref)
        if question is not None:
            await question.hear(message)
        return True

    def give_up(self, why: str) -> None:
        """Whoever waits for an answer is told why there is none."""
        for question in self._questions.values():
            question.fail(self._gone(why))

    async def _within(self, future: asyncio.Future[A], seconds: float | None) -> A:
        while not future.done():
            heard = self._heard
            await asyncio.wait((future,), timeout=seconds)
            if not future.done() and not (self._in_turn and self._heard > heard):
                raise TimeoutError
        return future.result()

    def _write(self, writer: asyncio.StreamWriter, packed: bytes) -> None:
        """Sends it some time; a process that has not read for long is not written to for ever."""
        writer.write(packed)
        if writer.transport.get_write_buffer_size() > UNREAD_BYTES:
            log.error("the process of %s does not read: it is ended", self._name)
            self._kill()


async def connect(cache: Path | None, entry: str) -> tuple[Process, asyncio.StreamReader, asyncio.StreamWriter]:
    """A process of its own that serves this entry point, and both ends of what is said; `NoProcess`."""
    try:
        ours, theirs = socket.socketpair()
    except OSError as error:  # no file descriptors are left, say
        raise NoProcess(f"no process could be started: {error.strerror}") from error
    try:
        with theirs:
            process = await asyncio.to_thread(zygote().spawn, theirs, cache, entry)
        reader, writer = await asyncio.open_unix_connection(sock=ours, limit=1 << 20)
    except BaseException as error:
        ours.close()  # a process that is there ends with it
        if isinstance(error, OSError):
            raise NoProcess(f"no process could be started: {error.strerror}") from error
        raise
    return process, reader, writer


async def messages(reader: asyncio.StreamReader) -> AsyncIterator[object]:
    """What a process says, until it is gone; `BadMessage` where that is none."""
    try:
        while True:
            length = body_length(await reader.readexactly(LENGTH.size))
            yield unpack(await reader.readexactly(length))
    except (asyncio.IncompleteReadError, ConnectionError):
        return
