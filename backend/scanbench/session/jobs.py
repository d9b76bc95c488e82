"""Job processes, from the parent: what takes a processor for a while must not be in the way of the server or of a PLC."""

import asyncio
import logging
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from scanbench.session.codec import LARGEST, LENGTH, BadMessage, pack, unpack

log = logging.getLogger("scanbench")
DIED = "the process that computes it died: try again"


class Job:
    """One job process. `on_message` gets its answers in order; `on_end` is called once with it, when it is gone."""

    def __init__(self, cache: Path, on_message: Callable[[object], None], on_end: "Callable[[Job], None]") -> None:
        """`cache` is the directory where programs and their code are kept. To be made in the event loop."""
        self._waiting: list[bytes] = []
        self._process: asyncio.subprocess.Process | None = None
        self._ended = False
        self._task = asyncio.get_running_loop().create_task(self._live(cache, on_message, on_end))

    def ask(self, message: object) -> None:
        """A request; answers come as messages."""
        packed = pack(message)
        if self._process is None or self._process.stdin is None:
            self._waiting.append(packed)
        else:
            self._process.stdin.write(packed)

    async def end(self) -> None:
        """Ends the process, whatever it does."""
        self._ended = True
        self._kill()
        await asyncio.gather(self._task, return_exceptions=True)

    def _kill(self) -> None:
        if self._process is not None:
            with suppress(ProcessLookupError):
                self._process.kill()

    async def _live(
        self, cache: Path, on_message: Callable[[object], None], on_end: "Callable[[Job], None]"
    ) -> None:  # fmt: skip
        try:
            process = await asyncio.create_subprocess_exec(
                sys.executable, "-m", "scanbench.session.job", str(cache),
                stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE,
            )  # fmt: skip
        except OSError:
            log.exception("a job process could not be started")
            on_end(self)
            return
        self._process = process
        assert process.stdin is not None
        assert process.stdout is not None
        if self._ended:
            self._kill()
        for packed in self._waiting:
            process.stdin.write(packed)
        self._waiting.clear()
        try:
            while True:
                (length,) = LENGTH.unpack(await process.stdout.readexactly(LENGTH.size))
                if length > LARGEST:
                    raise BadMessage(f"a message of {length} bytes")
                on_message(unpack(await process.stdout.readexactly(length)))
        except (asyncio.IncompleteReadError, ConnectionError):
            pass
        except BadMessage:
            log.exception("a job process does not speak the protocol")
        finally:
            self._kill()
            await process.wait()
            on_end(self)
