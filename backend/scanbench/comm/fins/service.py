"""The servers of FINS: UDP, where a datagram is a frame, and TCP, where a client gets a node first."""

import asyncio
import logging
from contextlib import suppress
from typing import cast

from scanbench.comm.desk import Desk, LineCut
from scanbench.comm.door import Door
from scanbench.comm.fins import tcp_frame as tcp
from scanbench.comm.fins.commands import respond
from scanbench.comm.fins.describe import described, outcome
from scanbench.comm.fins.frame import Request, parse

log = logging.getLogger("scanbench")
CONNECTIONS = 16
"""TCP clients at once; the device has as many."""
_FIRST_NODE, _NODES = 239, 16
"""Nodes that TCP clients get which ask for none."""
_WAITING = 64
"""Datagrams of a client that wait for their turn; more are lost, as on a network."""
_IDLE_S = 60.0
_PIECE = 4096


class Answering:
    """Answers frames of one server, each client's in their order."""

    def __init__(self, desk: Desk, error_bits: bool) -> None:
        self.desk, self._error_bits = desk, error_bits

    async def answer(self, name: str, door: Door, request: Request, frame: bytes) -> bytes:
        """The answer to a frame, which is noted; empty where none is wanted, or none comes. `LineCut`."""
        self.desk.before_request()
        answered, end = await respond(request, door, self.desk.read_only, self._error_bits)
        self.desk.note(name, described(request, door.model), outcome(end), frame, answered)
        return await self.desk.on_the_way(answered) if request.wants_answer else b""


class Udp(asyncio.DatagramProtocol):
    """FINS over UDP. A client is a host and its node; it is gone when it asked nothing for a minute."""

    def __init__(self, answering: Answering) -> None:
        self._answering = answering
        self._transport: asyncio.DatagramTransport | None = None
        self._queues: dict[str, asyncio.Queue[tuple[Request, bytes, tuple[str, int]]]] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """The socket is there."""
        self._transport = cast(asyncio.DatagramTransport, transport)  # that of uvloop does not say that it is one

    def datagram_received(self, data: bytes, addr: tuple[str, int]) -> None:
        """A frame; what is none is dropped."""
        request = parse(data)
        if request is None:
            return
        name = f"FINS {addr[0]}, node {request.node}"
        queue = self._queues.get(name)
        if queue is None:
            if not self._answering.desk.arrive(name):
                return
            queue = self._queues[name] = asyncio.Queue(_WAITING)
            task = asyncio.get_running_loop().create_task(self._serve(name, queue))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)
        with suppress(asyncio.QueueFull):
            queue.put_nowait((request, data, addr))

    async def _serve(self, name: str, queue: asyncio.Queue[tuple[Request, bytes, tuple[str, int]]]) -> None:
        door = self._answering.desk.make_door(name)
        try:
            while True:
                async with asyncio.timeout(_IDLE_S):
                    request, frame, address = await queue.get()
                try:
                    answered = await self._answering.answer(name, door, request, frame)
                except LineCut:  # a datagram is lost: there is no connection that could end
                    continue
                if answered and self._transport is not None:
                    self._transport.sendto(answered, address)
        except TimeoutError:
            pass
        except Exception:
            log.exception("%s: a request could not be answered", name)
        finally:
            self._queues.pop(name, None)
            self._answering.desk.leave(name)

    async def close(self) -> None:
        """Nobody is served any more."""
        if self._transport is not None:
            self._transport.close()
        await _end(self._tasks)


class Tcp:
    """FINS over TCP."""

    def __init__(self, answering: Answering, node: int) -> None:
        self._answering, self._node = answering, node
        self._taken: set[int] = set()
        self._tasks: set[asyncio.Task[None]] = set()

    async def connected(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """One connection until its end."""
        task = asyncio.current_task()
        assert task is not None
        self._tasks.add(task)
        host = writer.get_extra_info("peername")[0]
        connection = _Connection(self, host)
        try:
            await connection.serve(reader, writer)
        except tcp.Broken as broken:
            with suppress(OSError):
                writer.write(tcp.message(tcp.Kind.ERROR, error=broken.error))
                await writer.drain()
        except (OSError, EOFError, asyncio.CancelledError):
            pass
        except Exception:
            log.exception("FINS %s: a request could not be answered", host)
        finally:
            self._tasks.discard(task)
            connection.end()
            writer.close()

    def give(self, wanted: int) -> int:
        """A node for a client: the one that it asks for, or a free one."""
        if len(self._tasks) > CONNECTIONS:
            raise tcp.Broken(tcp.Error.ALL_IN_USE)
        if wanted and wanted not in self._taken and wanted != self._node:
            self._taken.add(wanted)
            return wanted
        free = (each for each in range(_FIRST_NODE, _FIRST_NODE + _NODES) if each not in self._taken | {self._node})
        node = next(free, 0)
        if not node:
            raise tcp.Broken(tcp.Error.NO_NODE)
        self._taken.add(node)
        return node

    def take_back(self, node: int) -> None:
        """The client with this node is gone."""
        self._taken.discard(node)

    @property
    def node(self) -> int:
        """Of the PLC itself."""
        return self._node

    @property
    def answering(self) -> Answering:
        """What answers its frames."""
        return self._answering

    async def close(self) -> None:
        """Every connection ends."""
        await _end(self._tasks)


class _Connection:
    """Of one client."""

    def __init__(self, server: Tcp, host: str) -> None:
        self._server, self._host = server, host
        self._client_node = 0
        self._name = ""
        self._door: Door | None = None

    async def serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Answers one message after the other."""
        stream = tcp.Stream()
        while data := await reader.read(_PIECE):
            for message in stream.feed(data):
                answer = await self._answer(message)
                if answer:
                    writer.write(answer)
                    await writer.drain()

    async def _answer(self, message: tcp.Message) -> bytes:
        if message.kind == tcp.Kind.ASK_NODE:
            if not self._client_node:
                self._client_node = self._server.give(tcp.asked_node(message.content) & 0xFF)
                self._arrive()
            return tcp.given_nodes(self._client_node, self._server.node)
        if message.kind == tcp.Kind.CONFIRM:
            return b""
        if message.kind != tcp.Kind.FRAME:
            raise tcp.Broken(tcp.Error.UNKNOWN)
        request = parse(message.content)
        if request is None:
            return b""
        if self._door is None:
            self._arrive()
        assert self._door is not None
        answered = await self._server.answering.answer(self._name, self._door, request, message.content)
        return tcp.message(tcp.Kind.FRAME, answered) if answered else b""

    def _arrive(self) -> None:
        self._name = f"FINS {self._host}, node {self._client_node}"
        desk = self._server.answering.desk
        if not desk.arrive(self._name):
            raise tcp.Broken(tcp.Error.ALL_IN_USE)
        self._door = desk.make_door(self._name)

    def end(self) -> None:
        """It is closed."""
        if self._client_node:
            self._server.take_back(self._client_node)
        if self._name:
            self._server.answering.desk.leave(self._name)


async def _end(tasks: set[asyncio.Task[None]]) -> None:
    for task in list(tasks):
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


class FinsServer:
    """Both on the same port number."""

    def __init__(self, desk: Desk, node: int, error_bits: bool) -> None:
        answering = Answering(desk, error_bits)
        self._udp, self._tcp = Udp(answering), Tcp(answering, node)
        self._listening: asyncio.Server | None = None
        self.port = 0
        """0 while it is closed."""

    async def open(self, host: str, port: int) -> None:
        """Listens; with port 0 on one that is free. `OSError`."""
        loop = asyncio.get_running_loop()
        self._listening = await asyncio.start_server(self._tcp.connected, host, port)
        chosen: int = self._listening.sockets[0].getsockname()[1]
        try:
            await loop.create_datagram_endpoint(lambda: self._udp, local_addr=(host, chosen))
        except OSError:
            await self.close()
            raise
        self.port = chosen

    async def close(self) -> None:
        """Nobody is served any more."""
        self.port = 0
        if self._listening is not None:
            self._listening.close()
            self._listening = None
        await self._tcp.close()
        await self._udp.close()
