"""How frames get to a controller that is read, and what it answers back: a datagram for each, or one connection that gives nodes first."""

import asyncio
import socket
from typing import Protocol

from scanbench.comm.fins.ask import Address, BadAnswer, hello, nodes_of
from scanbench.comm.fins.tcp_frame import Broken, Kind, Stream, message


class Line(Protocol):
    """An open line. `answers` has the frames that come, and what went wrong with it."""

    name: str
    """UDP or TCP."""
    client: Address
    server: Address
    tries: int
    """So often a question is sent that has no answer: a datagram may be lost."""
    answers: asyncio.Queue[bytes | Exception]

    def send(self, frame: bytes) -> None:
        """Raises nothing."""

    def close(self) -> None:
        """Raises nothing."""


class UdpLine(asyncio.DatagramProtocol):
    """Nodes are the last numbers of the IP addresses, which is so unless somebody sets a unit otherwise."""

    name, tries = "UDP", 3

    def __init__(self) -> None:
        self.answers: asyncio.Queue[bytes | Exception] = asyncio.Queue()
        self.client = self.server = Address()
        self._transport: asyncio.DatagramTransport | None = None

    def begin(self, transport: asyncio.DatagramTransport) -> None:
        """The socket is there."""
        self._transport = transport
        self.client, self.server = (_node(transport.get_extra_info(each)[0]) for each in ("sockname", "peername"))

    def send(self, frame: bytes) -> None:
        """See `Line`. What came to an earlier question is of no interest any more."""
        self.answers = asyncio.Queue()
        if self._transport is not None:
            self._transport.sendto(frame)

    def close(self) -> None:
        """See `Line`."""
        if self._transport is not None:
            self._transport.close()

    def datagram_received(self, data: bytes, addr: tuple[str, int]) -> None:
        """An answer."""
        self.answers.put_nowait(data)

    def error_received(self, exc: Exception) -> None:
        """Nothing listens there, say."""
        self.answers.put_nowait(exc)


class TcpLine(asyncio.Protocol):
    """The server gives both nodes."""

    name, tries = "TCP", 1

    def __init__(self) -> None:
        self.answers: asyncio.Queue[bytes | Exception] = asyncio.Queue()
        self.client = self.server = Address()
        self.greeted: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        """Done when the nodes are known; `OSError`, or `BadAnswer`."""
        self._transport: asyncio.Transport | None = None
        self._stream = Stream()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Asks for a node."""
        assert isinstance(transport, asyncio.Transport)
        self._transport = transport
        transport.write(hello())

    def data_received(self, data: bytes) -> None:
        """Whole messages are taken; what is none ends the line."""
        try:
            for each in self._stream.feed(data):
                if each.kind == Kind.FRAME:
                    self.answers.put_nowait(each.content)
                elif not self.greeted.done():
                    client, server = nodes_of(each)
                    self.client, self.server = Address(node=client), Address(node=server)
                    self.greeted.set_result(None)
        except (Broken, BadAnswer) as error:
            self._end(BadAnswer(str(error)))

    def connection_lost(self, exc: Exception | None) -> None:
        """Whoever waits is told."""
        self._end(exc or ConnectionResetError("the controller closed the connection"))

    def send(self, frame: bytes) -> None:
        """See `Line`."""
        if self._transport is not None:
            self._transport.write(message(Kind.FRAME, frame))

    def close(self) -> None:
        """See `Line`."""
        if self._transport is not None:
            self._transport.close()

    def _end(self, why: Exception) -> None:
        self.close()
        self.answers.put_nowait(why)
        if not self.greeted.done():
            self.greeted.set_exception(why)


async def open_line(host: str, port: int, tcp: bool) -> Line:
    """`OSError`, `TimeoutError`, `BadAnswer`. Over TCP it is open when the nodes are known; who calls says how long that may take."""
    loop = asyncio.get_running_loop()
    if not tcp:
        transport, line = await loop.create_datagram_endpoint(UdpLine, remote_addr=(host, port), family=socket.AF_INET)
        line.begin(transport)
        return line
    _, connected = await loop.create_connection(TcpLine, host, port, family=socket.AF_INET)
    try:
        await connected.greeted
    except BaseException:
        connected.close()
        raise
    return connected


def _node(host: str) -> Address:
    return Address(node=int(host.rpartition(".")[2]))
