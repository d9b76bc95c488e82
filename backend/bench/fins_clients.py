"""Clients of FINS for `bench comm`."""

import asyncio
import time

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
            answer = await asyncio.wait_for(client.answered, 10)
            took.append(loop.time() - asked)
            assert answer[12:14] == b"\0\0", answer[:14].hex()
        transport.close()

    await asyncio.gather(*(one(node) for node in range(1, clients + 1)))
    return took


def fins_from(port: int, clients: int, begin: float, seconds: float) -> list[float]:
    """The same in a process of their own, from the moment `begin` (of the clock of the epoch) on."""
    time.sleep(begin - time.time())
    return asyncio.run(fins(port, clients, seconds))
