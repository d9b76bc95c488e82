"""The ring of samples: what is kept, read in full, and in outline; exact in every type, whoever reads meanwhile."""

import io
import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from scanbench.program.types import ELEMENTARY
from scanbench.taps import trace_buffer
from scanbench.taps.trace_buffer import BLOCK, Samples, TooMany, TraceBuffer, buffer_of, row_bytes, unpack_pages

INT, BOOL, REAL, LINT, UINT = (ELEMENTARY[name] for name in ("INT", "BOOL", "REAL", "LINT", "UINT"))
TYPES = (INT, BOOL, REAL, LINT, UINT)


def rows(first: int, count: int) -> NDArray[np.uint64]:
    """n, whether it is even, n / 2, -n, n as u16; nothing for the REAL where n is a multiple of 7."""
    made = []
    for n in range(first, first + count):
        real = int.from_bytes(struct.pack("<f", n / 2), "little")
        valid = 0b11011 if n % 7 == 0 else 0b11111
        made.append([n, valid, n & 0xFFFF, int(n % 2 == 0), real, -n & (1 << 64) - 1, n & 0xFFFF])
    return np.array(made, dtype=np.uint64)


def test_the_last_rows_are_kept_and_no_more() -> None:
    buffer = TraceBuffer(TYPES, 5000)
    assert (buffer.rows, buffer.extent) == (0, (0, 0))
    for start in range(0, 20_000, 777):
        buffer.append(rows(start, 777))
    end = 777 * len(range(0, 20_000, 777))
    assert buffer.extent == (end - 5000, end)
    assert buffer.rows == 5000
    found = buffer.read(0, end)
    assert found.scans.tolist() == list(range(end - 5000, end))
    assert [int(value) for value in found.values[3][-3:]] == [-n & (1 << 64) - 1 for n in range(end - 3, end)]
    assert len(buffer._blocks) <= 5000 // BLOCK + 2


def test_whoever_reads_while_it_grows_finds_rows_that_are_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    """As another thread sees it: between any two steps of an append."""
    buffer, seen = TraceBuffer((INT,), 1000), []

    class Looked(trace_buffer._Block):
        def append(self, rows: NDArray[np.uint64]) -> None:
            super().append(rows)
            look()

    def look() -> None:
        first, end = buffer.extent
        found = buffer.read(0, 1 << 40).scans.tolist()
        assert found == list(range(first, end))
        assert buffer.rows <= 1000
        seen.append(len(found))

    monkeypatch.setattr(trace_buffer, "_Block", Looked)
    for start in range(0, 40_000, 700):
        buffer.append(rows(start, 700)[:, :3])
        look()
    assert max(seen) == 1000


def test_more_than_it_holds_at_once() -> None:
    buffer = TraceBuffer(TYPES, 100)
    buffer.append(rows(0, 10_000))
    assert buffer.extent == (9900, 10_000)
    assert buffer.read(0, 99_999).scans.tolist() == list(range(9900, 10_000))


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(1, 6000), min_size=1, max_size=8), st.integers(1, 12_000), st.data())
def test_any_part_is_what_was_appended(pieces: list[int], capacity: int, data: st.DataObject) -> None:
    buffer, n = TraceBuffer(TYPES, capacity), 0
    for piece in pieces:
        buffer.append(rows(n, piece))
        n += piece
    low = data.draw(st.integers(0, n + 5))
    high = data.draw(st.integers(0, n + 5))
    kept = [scan for scan in range(n) if scan >= n - capacity and low <= scan <= high]
    found = buffer.read(low, high)
    assert found.scans.tolist() == kept
    assert found.values[0].tolist() == [scan & 0xFFFF for scan in kept]


@settings(max_examples=40, deadline=None)
@given(st.integers(200, 30_000), st.integers(4, 400), st.integers(0, 5000))
def test_an_outline_has_every_extreme_and_only_so_many_points(count: int, points: int, first: int) -> None:
    buffer = TraceBuffer(TYPES, count)
    given_rows = rows(first, count)
    buffer.append(given_rows)
    found = buffer.read(0, first + count, points)
    assert found.decimated == (count > points)
    assert len(found) <= max(points, 2)
    assert (found.scans[0], found.scans[-1]) == (first, first + count - 1)
    ints = given_rows[:, 2].astype("<u2").view("<i2")
    shown = found.values[0].astype("<u2").view("<i2")
    assert (shown.min(), shown.max()) == (ints.min(), ints.max())
    has = given_rows[:, 1] >> np.uint64(2) & np.uint64(1) == 1
    reals = given_rows[:, 4].astype("<u4").view("<f4")[has]
    seen = found.values[2].astype("<u4").view("<f4")[found.valid >> np.uint64(2) & np.uint64(1) == 1]
    assert (np.nanmin(seen), np.nanmax(seen)) == (reals.min(), reals.max())


def test_the_stretches_of_an_outline_stay_where_they_are_when_it_goes_on() -> None:
    buffer = TraceBuffer((INT,), 100_000)
    buffer.append(rows(0, 20_000)[:, :3])
    before = buffer.read(0, 19_999, 200).scans.tolist()
    buffer.append(rows(20_000, 50)[:, :3])
    after = buffer.read(0, 20_049, 200).scans.tolist()
    assert after[: len(before) - 1] == before[:-1]


def test_what_is_packed_is_read_again() -> None:
    buffer = TraceBuffer(TYPES, 500)
    buffer.append(rows(1000, 700))
    samples = buffer.read(0, 5000)
    again, first, end = Samples.unpack(samples.pack(1200, 1700, 3))
    assert (first, end) == (1200, 1700)
    other = buffer_of([again], [(type.kind.value, type.size) for type in TYPES], 500)
    assert [column.tolist() for column in other.read(0, 5000).values] == [column.tolist() for column in samples.values]
    assert other.extent == (1200, 1700)
    for bad in (b"", samples.pack(0, 1, 1)[:-1], bytes([1]) + samples.pack(0, 1, 1)[1:]):
        with pytest.raises(ValueError, match="bytes are"):
            Samples.unpack(bad)
    with pytest.raises(ValueError, match="columns"):
        buffer_of([again], [("bool", 1)], 500)


def test_pages_are_taken_from_the_end_and_read_again() -> None:
    buffer = TraceBuffer(TYPES, 20_000)
    buffer.append(rows(0, 15_000))
    pages: list[Samples] = []
    last = 1 << 40
    while len(page := buffer.newest(100, last, 4000)):
        pages.insert(0, page)
        last = int(page.scans[0]) - 1
    assert [len(page) for page in pages] == [2900, 4000, 4000, 4000]
    stream = io.BytesIO(b"".join(page.pack(0, 1, 1) for page in pages))
    again = buffer_of(unpack_pages(stream.read), [(type.kind.value, type.size) for type in TYPES], 20_000)
    wanted, found = buffer.read(100, 20_000), again.read(0, 20_000)
    assert found.scans.tolist() == list(range(100, 15_000))
    assert [column.tolist() for column in found.values] == [column.tolist() for column in wanted.values]
    assert [len(piece) for piece in buffer.pieces(100, 5000)] == [BLOCK - 100, 5001 - BLOCK]
    with pytest.raises(ValueError, match="bytes are"):
        list(unpack_pages(io.BytesIO(stream.getvalue()[:-1]).read))


def test_what_is_read_at_once_has_a_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trace_buffer, "LARGEST", 1000 * 8 * 7)
    buffer = TraceBuffer(TYPES, 20_000)
    buffer.append(rows(0, 15_000))
    assert len(buffer.read(0, 999)) == 1000
    with pytest.raises(TooMany, match="1,001 samples of 5 signals"):
        buffer.read(0, 1000)
    outline = buffer.read(0, 15_000, 1_000_000)
    assert outline.decimated
    assert 200 < len(outline) <= 1000


def test_what_a_row_takes() -> None:
    assert row_bytes(TYPES) == 16 + 2 + 1 + 4 + 8 + 2
