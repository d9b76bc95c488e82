"""Questions to the process of one PLC, each with a deadline, and what is told it without an answer."""

import asyncio
import logging
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from scanbench.wire import host as protocol
from scanbench.wire.codec import pack
from scanbench.wire.debugging import DebugRequest
from scanbench.wire.refused import Unavailable

log = logging.getLogger("scanbench")

A = TypeVar("A")
_WORK = protocol.Build | protocol.RollBack | protocol.Preview | protocol.Copy | protocol.Travel | DebugRequest
_UNREAD_BYTES = 64 << 20
"""More than this not read by a process: it is ended, and the next one is told everything again."""


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


class Conversation:
    """With one process after the other; while there is none, nothing can be asked."""

    def __init__(self, name: str, patience: Patience, kill: Callable[[], None]) -> None:
        """`kill` ends a process that does not read."""
        self._name, self._patience, self._kill = name, patience, kill
        self._writer: asyncio.StreamWriter | None = None
        self._connected = asyncio.Event()
        self._answers: dict[int, asyncio.Future[object]] = {}
        self._next_ref = 1

    @property
    def open(self) -> bool:
        """Whether there is a process that listens."""
        return self._writer is not None and not self._writer.is_closing()

    @property
    def there(self) -> bool:
        """Whether there is a process, or was until a moment ago."""
        return self._writer is not None

    def begin(self, writer: asyncio.StreamWriter) -> None:
        """A process is there."""
        self._writer = writer
        self._connected.set()

    def end(self) -> None:
        """It is gone: nobody gets an answer."""
        self._writer = None
        self._connected.clear()
        self.give_up("the PLC's process died before it answered. See the log, and repeat")

    async def reached(self, seconds: float) -> None:
        """Waits so long, at most, for a process that is on its way."""
        try:
            async with asyncio.timeout(seconds):
                await self._connected.wait()
        except TimeoutError:
            pass

    def tell(self, message: object) -> bool:
        """Something whose answer, if any, comes as a message; false when the process is away."""
        if self._writer is None or self._writer.is_closing():
            return False
        self._write(self._writer, pack(message))
        return True

    async def ask(self, make: Callable[[int], object], answer: type[A]) -> A:
        """Asks something of a process that is there; `make` makes the question with the ref that it is given."""
        assert self._writer is not None
        ref, self._next_ref = self._next_ref, self._next_ref + 1
        question = make(ref)
        packed = pack(question)
        future: asyncio.Future[object] = asyncio.get_running_loop().create_future()
        self._answers[ref] = future
        self._write(self._writer, packed)
        seconds = self._patience.work_s if isinstance(question, _WORK) else self._patience.answer_s
        try:
            found = await asyncio.wait_for(future, seconds)
        except TimeoutError:
            raise Unavailable(
                f"the PLC has not answered this within {seconds:g} s. It may still be done: look before you repeat it"
            ) from None
        finally:
            self._answers.pop(ref, None)
        assert isinstance(found, answer)
        return found

    def answer(self, ref: int, message: object) -> None:
        """The answer to a question; nobody may wait for it any more."""
        future = self._answers.pop(ref, None)
        if future is not None and not future.done():
            future.set_result(message)

    def give_up(self, why: str) -> None:
        """Whoever waits for an answer is told why there is none."""
        for future in self._answers.values():
            if not future.done():
                future.set_exception(Unavailable(why))
        self._answers.clear()

    def _write(self, writer: asyncio.StreamWriter, packed: bytes) -> None:
        """Sends it some time; a process that has not read for long is not written to for ever."""
        writer.write(packed)
        if writer.transport.get_write_buffer_size() > _UNREAD_BYTES:
            log.error("the process of %s does not read: it is ended, and started again", self._name)
            self._kill()
