"""The server of Modbus TCP. Requests of a connection are answered one after the other, each with its own transaction."""

import asyncio
import logging

from scanbench.comm.desk import Desk
from scanbench.comm.modbus.frame import Broken, Stream
from scanbench.comm.modbus.functions import Target, described, outcome, respond
from scanbench.comm.modbus.mapping import Mapped, default

log = logging.getLogger("scanbench")
CONNECTIONS = 16
_PIECE = 4096


class ModbusServer:
    """On one port."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
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
        name = f"Modbus {host}:{port}"
        if len(self._tasks) >= CONNECTIONS or not self._desk.arrive(name):
            writer.close()
            return
        self._tasks.add(task)
        try:
            await self._serve(name, reader, writer)
        except (Broken, OSError, EOFError, asyncio.CancelledError):
            pass
        except Exception:
            log.exception("%s: a request could not be answered", name)
        finally:
            self._tasks.discard(task)
            self._desk.leave(name)
            writer.close()

    async def _serve(self, name: str, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        stream, door = Stream(), self._desk.make_door(name)
        table: tuple[Mapped, ...] = default(door.model)
        target = Target(door, table)
        while data := await reader.read(_PIECE):
            for request, frame in stream.feed(data):
                answered, code = await respond(request, target, self._desk.read_only)
                self._desk.note(name, described(request), outcome(code), frame, answered)
                writer.write(answered)
            await writer.drain()
