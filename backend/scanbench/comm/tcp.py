"""A listening socket, its connections, and that of a server whose connections are streams of requests."""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Iterable

from scanbench.comm.desk import Desk
from scanbench.comm.door import Door

log = logging.getLogger("scanbench")
CONNECTIONS = 16
"""At once, of each server; the devices have about as many."""
PIECE = 4096

Serve = Callable[[asyncio.StreamReader, asyncio.StreamWriter, bool], Awaitable[None]]
"""Serves one connection to its end; true: there are too many already."""
Answers = Callable[[bytes], Iterable[Awaitable[bytes]]]
"""Takes what came; answers that are still to be made, one for each request that is whole."""


class Listener:
    """One port. What `serve` raises ends its connection; what is no affair of the client's is logged under `name`."""

    def __init__(self, name: str, serve: Serve) -> None:
        self._name, self._serve = name, serve
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
        await end_all(self._tasks)

    async def _connected(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None
        full = len(self._tasks) >= CONNECTIONS
        self._tasks.add(task)
        try:
            await self._serve(reader, writer, full)
        except (OSError, EOFError, asyncio.CancelledError):
            pass
        except Exception:
            log.exception("%s: a request could not be answered", self._name)
        finally:
            self._tasks.discard(task)
            writer.close()


async def end_all(tasks: set[asyncio.Task[None]]) -> None:
    """Ends what serves clients."""
    for task in list(tasks):
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


def tcp_server(
    desk: Desk, protocol: str, begin: Callable[[str, Door], Answers], broken: type[Exception]
) -> Listener:  # fmt: skip
    """A server that answers each request before the next one of its connection. `begin` makes the answers of a connection; `broken` is
    what it raises at what is no request."""

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter, full: bool) -> None:
        host, port = writer.get_extra_info("peername")[:2]
        name = f"{protocol} {host}:{port}"
        if full or not desk.arrive(name):
            return
        try:
            answers = begin(name, desk.make_door(name))
            while data := await reader.read(PIECE):
                for each in answers(data):
                    writer.write(await desk.on_the_way(await each))
                await writer.drain()
        except broken:
            return
        finally:
            desk.leave(name)

    return Listener(protocol, serve)
