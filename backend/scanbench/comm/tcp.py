"""A server of a protocol whose connections are streams of requests: each is answered before the next one of its connection."""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Iterable

from scanbench.comm.desk import Desk
from scanbench.comm.door import Door

log = logging.getLogger("scanbench")
CONNECTIONS = 16
_PIECE = 4096

Answers = Callable[[bytes], Iterable[Awaitable[bytes]]]
"""Takes what came; answers that are still to be made, one for each request that is whole."""


class TcpServer:
    """On one port. `begin` makes the answers of a connection; `broken` is what it raises at what is no request."""

    def __init__(
        self, desk: Desk, protocol: str, begin: Callable[[str, Door], Answers], broken: type[Exception]
    ) -> None:
        self._desk, self._protocol, self._begin, self._broken = desk, protocol, begin, broken
        self._listening: asyncio.Server | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self.port = 0
        """0 while it is closed."""

    async def open(self, host: str, port: int) -> None:
        """Listens; with port 0 on one that is free. `OSError`."""
        self._listening = await asyncio.start_server(self._connected, host, port)
        self.port = self._listening.sockets[0].getsockname()[1]

    async def close(self) -> None:
        """Nobody is served any more."""
        self.port = 0
        if self._listening is not None:
            self._listening.close()
            self._listening = None
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def _connected(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None
        host, port = writer.get_extra_info("peername")[:2]
        name = f"{self._protocol} {host}:{port}"
        if len(self._tasks) >= CONNECTIONS or not self._desk.arrive(name):
            writer.close()
            return
        self._tasks.add(task)
        try:
            answers = self._begin(name, self._desk.make_door(name))
            while data := await reader.read(_PIECE):
                for each in answers(data):
                    writer.write(await self._desk.on_the_way(await each))
                await writer.drain()
        except (self._broken, OSError, EOFError, asyncio.CancelledError):
            pass
        except Exception:
            log.exception("%s: a request could not be answered", name)
        finally:
            self._tasks.discard(task)
            self._desk.leave(name)
            writer.close()
