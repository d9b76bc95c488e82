"""The servers of FINS: UDP, where a datagram is a frame, and TCP, where a client gets a node first."""

import asyncio
import logging
from contextlib import suppress
from typing import cast

from scanbench.comm.desk import ELSEWHERE, Desk, LineCut
from scanbench.comm.door import Door
from scanbench.comm.fins import tcp_frame as tcp
from scanbench.comm.fins.codes import End
from scanbench.comm.fins.commands import respond
from scanbench.comm.fins.describe import described, outcome
from scanbench.comm.fins.frame import Request, answer, parse
from scanbench.comm.tcp import PIECE, Listener, end_all

log = logging.getLogger("scanbench")
_FIRST_NODE, _NODES = 239, 16
"""Nodes that TCP clients get which ask for none."""
_WAITING = 64
"""Datagrams of a client that wait for their turn; more are lost, as on a network."""
_IDLE_S = 60.0


class Answering:
    """Answers frames of one server, each client's in their order."""

    def __init__(self, desk: Desk, error_bits: bool) -> None:
        self.desk, self._error_bits = desk, error_bits

    async def answer(self, name: str, door: Door, request: Request, frame: bytes) -> bytes:
        """The answer to a frame, which is noted; empty where none is wanted, or none comes. `LineCut`."""
        self.desk.before_request()
        if self.desk.elsewhere:
            answered, told = answer(request, End.NO_NODE), f"{End.NO_NODE:04X} {ELSEWHERE}"
        else:
            answered, end = await respond(request, door, self.desk.read_only, self._error_bits)
            told = outcome(end)
        self.desk.note(name, described(request, door.model), told, frame, answered)
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
        await end_all(self._tasks)


class Nodes:
    """The nodes of TCP clients, and that of the PLC."""

    def __init__(self, node: int) -> None:
        self.node = node
        """Of the PLC itself."""
        self._taken: set[int] = set()

    def give(self, wanted: int) -> int:
        """A node for a client: the one that it asks for, or a free one. `Broken`."""
        free = (each for each in (wanted, *range(_FIRST_NODE, _FIRST_NODE + _NODES)) if each)
        node = next((each for each in free if each not in self._taken and each != self.node), 0)
        if not node:
            raise tcp.Broken(tcp.Error.NO_NODE)
        self._taken.add(node)
        return node

    def take_back(self, node: int) -> None:
        """The client with this node is gone."""
        self._taken.discard(node)


class _Connection:
    """FINS over TCP, of one client."""

    def __init__(self, answering: Answering, nodes: Nodes, host: str) -> None:
        self._answering, self._nodes, self._host = answering, nodes, host
        self._client_node = 0
        self._name = ""
        self._door: Door | None = None

    async def serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, full: bool) -> None:
        """Answers one message after the other; at what is no FINS says what is wrong."""
        try:
            if full:
                raise tcp.Broken(tcp.Error.ALL_IN_USE)
            stream = tcp.Stream()
            while data := await reader.read(PIECE):
                for message in stream.feed(data):
                    writer.write(await self._answer(message))
                await writer.drain()
        except tcp.Broken as broken:
            writer.write(tcp.message(tcp.Kind.ERROR, error=broken.error))
            await writer.drain()
        finally:
            self._end()

    async def _answer(self, message: tcp.Message) -> bytes:
        if message.kind == tcp.Kind.ASK_NODE:
            if not self._client_node:
                self._client_node = self._nodes.give(tcp.asked_node(message.content) & 0xFF)
                self._arrived()
            return tcp.given_nodes(self._client_node, self._nodes.node)
        if message.kind == tcp.Kind.CONFIRM:
            return b""
        if message.kind != tcp.Kind.FRAME:
            raise tcp.Broken(tcp.Error.UNKNOWN)
        request = parse(message.content)
        if request is None:
            return b""
        answered = await self._answering.answer(self._name, self._arrived(), request, message.content)
        return tcp.message(tcp.Kind.FRAME, answered) if answered else b""

    def _arrived(self) -> Door:
        """The door of the client, who is there from the handshake on, or from the first frame where there was none."""
        if self._door is None:
            name = f"FINS {self._host}, node {self._client_node}"
            if not self._answering.desk.arrive(name):
                raise tcp.Broken(tcp.Error.ALL_IN_USE)
            self._name, self._door = name, self._answering.desk.make_door(name)
        return self._door

    def _end(self) -> None:
        if self._client_node:
            self._nodes.take_back(self._client_node)
        if self._door is not None:
            self._answering.desk.leave(self._name)


class FinsServer:
    """Both on the same port number."""

    def __init__(self, desk: Desk, node: int, error_bits: bool) -> None:
        self._answering, self._nodes = Answering(desk, error_bits), Nodes(node)
        self._udp, self._tcp = Udp(self._answering), Listener("FINS", self._connected)

    @property
    def port(self) -> int:
        """0 while it is closed."""
        return self._tcp.port

    async def open(self, host: str, port: int) -> None:
        """Listens; with port 0 on one that is free. `OSError`."""
        await self._tcp.open(host, port)
        try:
            await asyncio.get_running_loop().create_datagram_endpoint(
                lambda: self._udp, local_addr=(host, self._tcp.port)
            )
        except OSError:
            await self._tcp.close()
            raise

    async def close(self) -> None:
        """Nobody is served any more."""
        await self._tcp.close()
        await self._udp.close()

    async def _connected(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, full: bool) -> None:
        host = writer.get_extra_info("peername")[0]
        await _Connection(self._answering, self._nodes, host).serve(reader, writer, full)
