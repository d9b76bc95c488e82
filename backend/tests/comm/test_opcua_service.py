"""The server's end of OPC UA: what happens when its process ends."""

import asyncio
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from scanbench.comm.desk import Desk
from scanbench.comm.door import Door, Plc
from scanbench.comm.opcua import service
from scanbench.comm.opcua.service import OpcUaServer, Place
from scanbench.host.zygote import NoProcess
from scanbench.wire.codec import pack
from scanbench.wire.opcua import OpcUaFailed, OpcUaReady


class NoPlc:
    """`Plc`, of which nothing is asked."""

    name, errors, sources = "PLC", None, None
    model = SimpleNamespace(name="CJ1M-CPU13")

    def listen(self, _changed: Callable[[], None]) -> Callable[[], None]:
        return lambda: None


class Processes:
    """What each process says before it ends; None: it cannot be started."""

    def __init__(self, *said: object) -> None:
        self.said = list(said)

    async def connect(self, _cache: Path, _entry: str) -> Any:
        message = self.said.pop(0) if self.said else None
        if message is None:
            raise NoProcess("no process could be started")
        reader = asyncio.StreamReader()
        reader.feed_data(pack(message))
        reader.feed_eof()
        process = SimpleNamespace(kill=lambda: None, wait=lambda: 0)
        transport = SimpleNamespace(get_write_buffer_size=lambda: 0)
        writer = SimpleNamespace(
            is_closing=lambda: False, write=lambda _data: None, close=lambda: None, transport=transport
        )
        return process, reader, writer


def no_door(_name: str) -> Door:
    raise AssertionError("there is no client")


def made(tmp_path: Path) -> OpcUaServer:
    desk = Desk(no_door, lambda: None, read_only=True)
    return OpcUaServer(desk, cast(Plc, NoPlc()), Place(tmp_path, tmp_path, ""), False)


def test_a_process_that_ends_again_and_again_is_started_less_and_less_often(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    processes = Processes(OpcUaReady(4840), OpcUaFailed("Address already in use"), None, OpcUaFailed("x"))
    rests: list[tuple[float, str]] = []
    enough = asyncio.Event()
    server = made(tmp_path)

    async def rest(seconds: float) -> None:
        rests.append((seconds, server.trouble))
        if len(rests) == 8:
            enough.set()
            await asyncio.Event().wait()

    monkeypatch.setattr(service, "connect", processes.connect)
    monkeypatch.setattr(service, "_rest", rest)

    async def story() -> None:
        await server.open("127.0.0.1", 0)
        await enough.wait()
        await server.close()

    asyncio.run(story())
    assert [seconds for seconds, _ in rests] == [1, 2, 4, 8, 16, 30, 30, 30]
    assert [trouble for _, trouble in rests][1:4] == ["Address already in use", "no process could be started", "x"]


def test_the_first_process_says_why_nobody_can_listen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service, "connect", Processes(OpcUaFailed("Address already in use")).connect)
    with pytest.raises(OSError, match="Address already in use"):
        asyncio.run(made(tmp_path).open("127.0.0.1", 4840))


def test_nothing_is_left_of_a_server_whose_opening_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    begun = asyncio.Event()

    async def connect(_cache: Path, _entry: str) -> Any:
        begun.set()
        await asyncio.Event().wait()

    monkeypatch.setattr(service, "connect", connect)

    async def story() -> None:
        opening = asyncio.create_task(made(tmp_path).open("127.0.0.1", 4840))
        await begun.wait()
        opening.cancel()
        with pytest.raises(asyncio.CancelledError):
            await opening
        assert asyncio.all_tasks() == {asyncio.current_task()}

    asyncio.run(story())
