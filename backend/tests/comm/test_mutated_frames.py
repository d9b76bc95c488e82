"""Broken requests by the thousand, over real sockets: nothing is raised, nothing is kept, and the next client is served."""

import asyncio
import logging
import tracemalloc
from collections.abc import Callable

import pytest

from bench.broken_frames import AT_ONCE, FINS, MODBUS, SLMP, fins_over_tcp, mutated, sent
from scanbench.comm.desk import FRAMES_KEPT, Desk
from scanbench.comm.fins.service import FinsServer
from scanbench.comm.modbus.mapping import default
from scanbench.comm.modbus.service import modbus_server
from scanbench.comm.slmp.service import slmp_server
from scanbench.server.communication import Server
from tests.amounts import amount, nightly
from tests.comm.bench import LocalDoor, machine

FRAMES = amount(100_000, 320)
MOST_BYTES = 4 << 20
"""More than this may not be left over."""

KINDS: dict[str, tuple[str, Callable[[Desk], Server], list[bytes], bytes]] = {
    "slmp": ("Q03UD", slmp_server, SLMP, bytes.fromhex("d00000")),
    "modbus": (
        "CJ1M-CPU13",
        lambda desk: modbus_server(desk, lambda: default(machine().program.layout.model)),
        MODBUS,
        bytes.fromhex("00010000"),
    ),
    "fins": ("CJ1M-CPU13", lambda desk: FinsServer(desk, 1, True), [fins_over_tcp(each) for each in FINS], b"FINS"),
}


@nightly
@pytest.mark.parametrize("kind", KINDS)
def test_broken_frames_harm_nobody(kind: str, caplog: pytest.LogCaptureFixture) -> None:
    model, make, whole, answer = KINDS[kind]
    resource = machine(model)
    desk = Desk(lambda _name: LocalDoor(resource), lambda: None, read_only=True)
    server = make(desk)

    async def story() -> int:
        await server.open("127.0.0.1", 0)
        batch: list[bytes] = []
        before = 0
        for number, frame in enumerate(mutated(whole, FRAMES, seed=7)):
            batch.append(frame)
            if len(batch) == AT_ONCE:
                await sent(server.port, batch)
                batch.clear()
            if number == FRAMES // 4:
                before = tracemalloc.get_traced_memory()[0]
        left = tracemalloc.get_traced_memory()[0] - before
        found = await sent(server.port, whole[:1])
        assert found.startswith(answer), found.hex()
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
