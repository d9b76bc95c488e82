"""Broken requests by the thousand, over real sockets: nothing is raised, nothing is kept, and the next client is served."""

import asyncio
import logging
import random
import tracemalloc
from collections.abc import Callable, Iterator
from contextlib import suppress

import pytest

from scanbench.comm.desk import FRAMES_KEPT, Desk
from scanbench.comm.fins.service import FinsServer
from scanbench.comm.modbus.mapping import default
from scanbench.comm.modbus.service import modbus_server
from scanbench.comm.slmp.service import slmp_server
from scanbench.server.communication import Server
from tests.amounts import amount
from tests.comm.bench import LocalDoor, machine

FRAMES = amount(100_000, 320)
AT_ONCE = 16
"""On one connection: a length that is wrong swallows what comes after it."""
MOST_BYTES = 4 << 20
"""More than this may not be left over."""

SLMP = [
    "500000ffff03000c00100001040000640000a80300",  # D100 to D102, in words
    "500000ffff03000d001000010401000000009c0100" + "00",
    "500000ffff03000e001000011400006400 00a80100 2a00".replace(" ", ""),
    "500000ffff03000600100001010000",
    "500000ffff030014001000030400000201640000a8650000a8c80000a8".replace(" ", ""),
    "353030303030464630334646303030303138303031303034303130303030442a3030303130303030303031"[:84],
]
MODBUS = [
    "000100000006010300640003", "00020000000601060064002a", "000300000006010100000010", "00040000000601050000ff00",
    "00050000000b0110006400020400010002", "000600000008010f0000000a02cd01", "00070000000801160004 00f20025".replace(" ", ""),
    "00080000000f011700030006000e00030600ff00ff00ff", "000900000005012b0e0100",
]  # fmt: skip
FINS = [
    "80000200010000190001" + each
    for each in ("0101820064000003", "010282006400 0001002a".replace(" ", ""), "0501", "21020000000a")
]
KINDS: dict[str, tuple[str, Callable[[Desk], Server], list[str], str, bytes]] = {
    "slmp": ("Q03UD", slmp_server, SLMP, SLMP[0], bytes.fromhex("d00000")),
    "modbus": (
        "CJ1M-CPU13",
        lambda desk: modbus_server(desk, lambda: default(machine().program.layout.model)),
        MODBUS,
        MODBUS[0],
        bytes.fromhex("00010000"),
    ),
    "fins": ("CJ1M-CPU13", lambda desk: FinsServer(desk, 1, True), FINS, "", b""),
}


def mutated(whole: list[bytes], seed: int) -> Iterator[bytes]:
    """Requests with bytes changed, taken out or added."""
    chance = random.Random(seed)
    for _ in range(FRAMES):
        frame = bytearray(chance.choice(whole))
        for _ in range(chance.randrange(1, 5)):
            at = chance.randrange(len(frame) + 1)
            frame[at : at + chance.randrange(3)] = chance.randbytes(chance.randrange(3))
        yield bytes(frame)


async def wired(port: int, frames: list[bytes]) -> bytes:
    """What comes back on a connection of its own, until the server has answered or closed."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    answered = b""
    with suppress(OSError):
        writer.write(b"".join(frames))
        writer.write_eof()
        while piece := await reader.read(1 << 16):
            answered += piece
    writer.close()
    return answered


def over_tcp(kind: str, frame: bytes) -> bytes:
    if kind != "fins":
        return frame
    return b"FINS" + (len(frame) + 8).to_bytes(4, "big") + bytes.fromhex("0000000200000000") + frame


@pytest.mark.parametrize("kind", KINDS)
def test_broken_frames_harm_nobody(kind: str, caplog: pytest.LogCaptureFixture) -> None:
    model, make, texts, question, answer = KINDS[kind]
    resource = machine(model)
    desk = Desk(lambda _name: LocalDoor(resource), lambda: None, read_only=True)
    server = make(desk)
    whole = [over_tcp(kind, bytes.fromhex(each)) for each in texts]

    async def story() -> int:
        await server.open("127.0.0.1", 0)
        batch: list[bytes] = []
        before = 0
        for number, frame in enumerate(mutated(whole, seed=7)):
            batch.append(frame)
            if len(batch) == AT_ONCE:
                await wired(server.port, batch)
                batch.clear()
            if number == FRAMES // 4:
                before = tracemalloc.get_traced_memory()[0]
        left = tracemalloc.get_traced_memory()[0] - before
        asked = bytes.fromhex(question) if question else whole[0]
        found = await wired(server.port, [asked])
        assert found.startswith(answer or b"FINS"), found.hex()
        await server.close()
        return left

    caplog.set_level(logging.WARNING)
    tracemalloc.start()
    try:
        left = asyncio.run(story())
    finally:
        tracemalloc.stop()
    assert left < MOST_BYTES
    assert not caplog.records
    assert desk.clients == ()
    assert 0 < len(desk.frames) <= FRAMES_KEPT, "some of them were still requests"
    assert not resource.journal, "a client that may only read has changed nothing"
