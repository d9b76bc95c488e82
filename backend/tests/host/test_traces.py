"""Samples between a host, the server and files: whole, or refused; never something of another record."""

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from queue import SimpleQueue
from typing import cast

import numpy as np
import pytest

from scanbench.host.link import Link
from scanbench.host.traces import Traces
from scanbench.recording.timeline import Timeline
from scanbench.session.tracing import A, Tracing
from scanbench.store.records import Json
from scanbench.taps.spool import Spool, read_pages, write_pages
from scanbench.taps.trace import Trace, TraceDefinition
from scanbench.taps.trace_buffer import Samples, TraceBuffer
from scanbench.wire.refused import Refused
from scanbench.wire.traces import ReadTrace, TraceRead, TraceStatus
from tests.runtime.bench import plc

DEFINITION = TraceDefinition("T", ("Main.n",), scans=1000)
KEPT: Mapping[int, Json] = {
    1: {
        "definition": {
            "name": "T", "signals": ["Main.n"], "every": 1, "scans": 1000, "trigger": None, "repeat": False
        }, "by": "Ada", "on": True,
    }
}  # fmt: skip


def page(first: int, count: int) -> Samples:
    scans = np.arange(first, first + count, dtype=np.uint64)
    return Samples(scans, np.ones(count, dtype=np.uint64), (scans * np.uint64(2),))


def status(generation: int) -> TraceStatus:
    return TraceStatus(1, DEFINITION, "Ada", "recording", (), generation, None, 0, 0, 0, 0, 0, 0, "")


def tracing(answer: Callable[[ReadTrace], TraceRead]) -> Tracing:
    async def ask(make: Callable[[int], object], kind: type[A]) -> A:
        asked = make(7)
        assert isinstance(asked, ReadTrace)
        answered = answer(asked)
        assert isinstance(answered, kind)
        return answered

    return Tracing(ask, lambda event: None, lambda kept: None, KEPT)


async def gathered(of: Tracing, first: int = 0) -> list[Samples]:
    return [samples async for _, samples in of.pages(1, first, None)]


def test_all_pages_are_taken_from_the_newest_on() -> None:
    asked: list[tuple[int | None, bool]] = []

    def answer(ask: ReadTrace) -> TraceRead:
        asked.append((ask.last, ask.page))
        end = 100 if ask.last is None else ask.last + 1
        first = max(10, end - 40)
        return TraceRead(ask.ref, page(first, end - first).pack(10, 100, 5), status=status(5))

    pages = asyncio.run(gathered(tracing(answer)))
    assert [each.scans.tolist() for each in pages] == [
        list(range(60, 100)), list(range(20, 60)), list(range(10, 20)), []
    ]  # fmt: skip
    assert asked == [(None, True), (59, True), (19, True), (9, True)]


def test_what_fits_on_one_page_is_asked_for_once() -> None:
    """A trace that is armed again and again would be a different one by the second time."""
    generations = iter((3, 4))

    def answer(ask: ReadTrace) -> TraceRead:
        whole = replace(status(next(generations)), first=500, end=800)
        return TraceRead(ask.ref, page(500, 300).pack(500, 800, 3), status=whole)

    assert [len(each) for each in asyncio.run(gathered(tracing(answer)))] == [300]


def test_pages_of_two_records_are_refused() -> None:
    generations = iter((1, 1, 2))
    answer = lambda ask: TraceRead(ask.ref, page(500, 10).pack(10, 900, 1), status=status(next(generations)))  # noqa: E731
    with pytest.raises(Refused, match="begun again"):
        asyncio.run(gathered(tracing(answer)))


def test_what_is_spooled_backwards_is_kept_in_order(tmp_path: Path) -> None:
    spool = Spool(tmp_path)
    for first in (700, 300, 100):
        spool.add(page(first, {700: 300, 300: 400, 100: 200}[first]))
    spool.add(page(0, 0))
    assert (spool.rows, spool.first, spool.end) == (900, 100, 1000)
    assert [each.scans[0] for each in spool.pages()] == [100, 300, 700]
    spool.save(tmp_path / "1.trace")
    spool.close()
    assert [path.name for path in tmp_path.iterdir()] == ["1.trace"]
    found = list(read_pages(tmp_path / "1.trace", 900))
    assert [scan for each in found for scan in each.scans.tolist()] == list(range(100, 1000))
    write_pages(tmp_path / "2.trace", found)
    assert [each.values[0].tolist() for each in read_pages(tmp_path / "2.trace", 900)] == [
        each.values[0].tolist() for each in found
    ]


@pytest.mark.parametrize(
    "spoil",
    [
        lambda data: data[:-5],
        lambda data: data[: len(data) // 2],
        lambda data: b"what" + data[4:],
        lambda data: data + b"abc",
    ],
)
def test_a_damaged_file_is_no_record(tmp_path: Path, spoil: Callable[[bytes], bytes]) -> None:
    path = tmp_path / "1.trace"
    write_pages(path, [page(0, 1000), page(1000, 1000)])
    path.write_bytes(spoil(path.read_bytes()))
    with pytest.raises(ValueError, match=r"damaged|bytes"):
        list(read_pages(path, 2000))


class _Posted:
    """A link that keeps what is posted."""

    def __init__(self) -> None:
        self.queue: SimpleQueue[object] = SimpleQueue()

    def post(self, message: object) -> None:
        self.queue.put(message)


class _Timeline:
    """A timeline with one PLC."""

    def __init__(self) -> None:
        self.live = plc("PROGRAM Main VAR n : DINT; END_VAR n := n + 1; END_PROGRAM")
        self.live_scan = 0


def test_no_look_ends_the_plc(monkeypatch: pytest.MonkeyPatch) -> None:
    link, timeline = _Posted(), _Timeline()
    traces = Traces(cast(Timeline, timeline), cast(Link, link))
    trace = Trace(1, DEFINITION, "Ada")
    trace.define(DEFINITION, timeline.live.program, "Ada")
    traces._traces[1] = trace

    def answer(asked: ReadTrace) -> TraceRead:
        traces.read(asked)
        found = link.queue.get(timeout=60)
        assert isinstance(found, TraceRead)
        assert found.ref == asked.ref
        return found

    assert "no trace 2" in answer(ReadTrace(1, 2, 0, None, None)).message
    errors = iter((IndexError("index 4424"), MemoryError(), ValueError("odd")))

    def fail(*args: object) -> Samples:
        raise next(errors)

    with monkeypatch.context() as patch:
        patch.setattr(TraceBuffer, "read", fail)
        assert "index 4424" in answer(ReadTrace(2, 1, 0, None, None)).message
        assert "memory" in answer(ReadTrace(3, 1, 0, None, 100)).message
        assert "odd" in answer(ReadTrace(4, 1, 5, 3, 0)).message
    trace.buffer.append(np.array([[3, 1, 4], [4, 1, 5]], dtype=np.uint64))
    found = answer(ReadTrace(5, 1, 0, None, None, page=True))
    assert found.status is not None
    assert found.status.generation == trace.generation
    assert Samples.unpack(found.data)[0].values[0].tolist() == [4, 5]
