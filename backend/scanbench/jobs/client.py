"""Job processes, from the parent: what takes a processor for a while must not be in the way of the server or of a PLC."""

import asyncio
import logging
import socket
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from scanbench.host.zygote import JOB, NoProcess, Process, zygote
from scanbench.wire.codec import LENGTH, BadMessage, body_length, pack, unpack

log = logging.getLogger("scanbench")
DIED = "the process that computes it died: try again"
ANSWER_S = 120.0
"""So long a question of people is waited for; then the process is ended that computes it."""
WORK_S = 600.0
"""So long a process that does one thing, and tells how far it is, may say nothing; then it is ended."""
SLOW = f"it took longer than {ANSWER_S:g} s, and was given up: ask for fewer scans, or try again"
_UNREAD_BYTES = 64 << 20
"""More than this not read by a process: it is ended."""
_T = TypeVar("_T")


async def answered(future: asyncio.Future[_T], seconds: float, count: Callable[[], int]) -> _T:
    """The answer of a process that answers one question after the other. `TimeoutError` when none at all, of which `count`
    gives the number, has come for so many seconds: those before it have their own time."""
    while not future.done():
        before = count()
        await asyncio.wait((future,), timeout=seconds)
        if not future.done() and count() == before:
            raise TimeoutError
    return future.result()


class Job:
    """One job process. `on_message` gets its answers in order; `on_end` is called once with it, when it is gone."""

    def __init__(
        self, cache: Path, on_message: Callable[[object], None], on_end: "Callable[[Job], None]",
        silent_s: float | None = None,
    ) -> None:  # fmt: skip
        """`cache` is the directory where programs and their code are kept; a process that says nothing for `silent_s` is
        ended. To be made in the event loop."""
        self._silent_s = silent_s
        self._waiting: list[bytes] = []
        self._process: Process | None = None
        self._writer: asyncio.StreamWriter | None = None
        self._ended = False
        self._task = asyncio.get_running_loop().create_task(self._live(cache, on_message, on_end))

    def ask(self, message: object) -> None:
        """A request; answers come as messages."""
        packed = pack(message)
        if self._writer is None:
            self._waiting.append(packed)
        else:
            self._writer.write(packed)
            if self._writer.transport.get_write_buffer_size() > _UNREAD_BYTES:
                log.error("a job process does not read what it is asked: it is ended")
                self._kill()

    async def end(self) -> None:
        """Ends the process, whatever it does."""
        self._ended = True
        self._kill()
        await asyncio.gather(self._task, return_exceptions=True)

    def _kill(self) -> None:
        if self._process is not None:
            self._process.kill()

    async def _live(
        self, cache: Path, on_message: Callable[[object], None], on_end: "Callable[[Job], None]"
    ) -> None:  # fmt: skip
        ours, theirs = socket.socketpair()
        try:
            with theirs:
                self._process = process = await asyncio.to_thread(zygote().spawn, theirs, cache, JOB)
        except NoProcess:
            ours.close()
            log.exception("a job process could not be started")
            on_end(self)
            return
        reader, self._writer = await asyncio.open_unix_connection(sock=ours, limit=1 << 20)
        if self._ended:
            self._kill()
        for packed in self._waiting:
            self._writer.write(packed)
        self._waiting.clear()
        try:
            while True:
                async with asyncio.timeout(self._silent_s):
                    body = await reader.readexactly(body_length(await reader.readexactly(LENGTH.size)))
                on_message(unpack(body))
        except (asyncio.IncompleteReadError, ConnectionError):
            pass
        except TimeoutError:
            log.error("a job process has said nothing for %g s: it is ended", self._silent_s)
        except BadMessage:
            log.exception("a job process does not speak the protocol")
        finally:
            self._kill()
            self._writer.close()
            await asyncio.to_thread(process.wait)
            on_end(self)
