"""Clients of FINS and Modbus for `bench comm`: in a process of their own, so that what they cost is not counted as the server's."""

import asyncio
import time
from collections.abc import Callable
from dataclasses import dataclass

PER_SECOND, WORDS = 20, 100
"""So often each of them asks, for so many words."""


class Udp(asyncio.DatagramProtocol):
    """One FINS client: a question, then its answer."""

    def __init__(self, node: int) -> None:
        self.node = node
        self.answered: asyncio.Future[bytes] | None = None

    def datagram_received(self, data: bytes, addr: tuple[str, int]) -> None:
        if self.answered is not None and not self.answered.done():
            self.answered.set_result(data)


async def fins(port: int, clients: int, seconds: float) -> list[float]:
    """Latencies of reads of 100 words, each client 20 times a second."""
    loop, took = asyncio.get_running_loop(), list[float]()

    async def one(node: int) -> None:
        transport, client = await loop.create_datagram_endpoint(lambda: Udp(node), remote_addr=("127.0.0.1", port))
        frame = (
            bytes.fromhex("800002000100") + bytes((0, node, 0, 1)) + bytes.fromhex("0101820064") + bytes((0, 0, WORDS))
        )
        begin = loop.time() + node / clients / PER_SECOND
        for at in range(int(seconds * PER_SECOND)):
            await asyncio.sleep(begin + at / PER_SECOND - loop.time())
            client.answered = loop.create_future()
            asked = loop.time()
            transport.sendto(frame)
            async with asyncio.timeout(10):
                answer = await client.answered
            took.append(loop.time() - asked)
            assert answer[12:14] == b"\0\0", answer[:14].hex()
        transport.close()

    await asyncio.gather(*(one(node) for node in range(1, clients + 1)))
    return took


async def modbus(port: int, clients: int, seconds: float) -> list[float]:
    """The same by Modbus."""
    loop, took = asyncio.get_running_loop(), list[float]()

    async def one(number: int) -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        begin = loop.time() + number / clients / PER_SECOND
        for at in range(int(seconds * PER_SECOND)):
            await asyncio.sleep(begin + at / PER_SECOND - loop.time())
            asked = loop.time()
            writer.write(bytes((0, at % 256, 0, 0, 0, 6, 1, 3, 0, 100, 0, WORDS)))
            await reader.readexactly(9 + 2 * WORDS)
            took.append(loop.time() - asked)
        writer.close()

    await asyncio.gather(*(one(number) for number in range(clients)))
    return took


def fins_from(port: int, clients: int, begin: float, seconds: float) -> list[float]:
    """Clients of FINS, from the moment `begin` (of the clock of the epoch) on; latencies in seconds."""
    time.sleep(max(0.0, begin - time.time()))
    return asyncio.run(fins(port, clients, seconds))


def modbus_from(port: int, clients: int, begin: float, seconds: float) -> list[float]:
    """Clients of Modbus."""
    time.sleep(max(0.0, begin - time.time()))
    return asyncio.run(modbus(port, clients, seconds))


@dataclass(frozen=True, slots=True)
class Asks:
    """Clients of FINS or Modbus."""

    ask: Callable[[int, int, float, float], list[float]]
    port: int
    clients: int
    seconds: float

    def __call__(self, begin: float) -> list[float]:
        return self.ask(self.port, self.clients, begin, self.seconds)


@dataclass(frozen=True, slots=True)
class Ua:
    """A client of OPC UA, which begins a little after the one before it."""

    ask: Callable[[int, int, float, float, float], list[float]]
    port: int
    nodes: int
    interval_ms: int
    after_s: float
    seconds: float

    def __call__(self, begin: float) -> list[float]:
        return self.ask(self.port, self.nodes, self.interval_ms, begin + self.after_s, self.seconds)
