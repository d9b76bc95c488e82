"""The line from OPC UA to one client: what comes late keeps its order, and nobody leaves everything unread."""

import asyncio
from typing import cast

import pytest

from scanbench.comm.opcua import connection
from scanbench.comm.opcua.connection import Line, _OnTheWay
from scanbench.wire.opcua import OpcUaFault


class Wire:
    """A transport whose client reads what `sent` has, and nothing of what is in its buffer."""

    def __init__(self, until: bytes = b"") -> None:
        self.sent: list[bytes] = []
        self.unread, self.aborted = 0, False
        self.until, self.done = until, asyncio.Event()

    def write(self, data: bytes) -> None:
        self.sent.append(data)
        if data == self.until:
            self.done.set()

    def get_write_buffer_size(self) -> int:
        return self.unread

    def is_closing(self) -> bool:
        return self.aborted

    def abort(self) -> None:
        self.aborted = True


def over(wire: Wire) -> tuple[_OnTheWay, Line]:
    line = Line()
    return _OnTheWay(cast(asyncio.Transport, wire), line), line


def test_what_comes_late_keeps_its_order() -> None:
    async def story() -> list[bytes]:
        wire = Wire(until=b"last")
        way, line = over(wire)
        way.write(b"at once")
        for kind, late_ms, data in (
            ("late", 60, b"slow"),
            ("late", 1, b"soon"),
            ("silent", 0, b"lost"),
            ("none", 0, b"last"),
        ):
            line.fault = OpcUaFault(kind, late_ms)
            way.write(data)
        assert wire.sent == [b"at once"]
        await wire.done.wait()
        way.write(b"after")
        return wire.sent

    assert asyncio.run(story()) == [b"at once", b"slow", b"soon", b"last", b"after"]


def test_who_leaves_its_answers_unread_is_cut_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "_UNREAD_BYTES", 100)

    async def story() -> None:
        wire = Wire()
        way, line = over(wire)
        wire.unread = 100
        way.write(b"one more")
        assert not wire.is_closing()
        wire.unread = 101
        way.write(b"too much")
        assert wire.is_closing()

        wire = Wire()
        way, line = over(wire)
        line.fault = OpcUaFault("late", 60_000)
        way.write(bytes(100))
        assert not wire.is_closing()
        way.write(b"1")
        assert wire.is_closing()
        assert wire.sent == []

    asyncio.run(story())
