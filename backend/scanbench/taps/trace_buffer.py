"""Samples of a trace in memory: a ring of rows, read in full or as the least and greatest of each stretch.

The thread that runs the scans appends; any thread reads, as rows never change once they are there. Values are kept in the
size of their type, and given out as the u64 of `engines.sample`.
"""

import struct
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scanbench.engines.sample import HEAD_WORDS
from scanbench.program.types import Elementary, Kind

BLOCK = 4096
SAMPLES = 2
"""First byte of packed samples; 1 is a value frame."""
LARGEST = 16 << 20
"""Bytes of samples that are read at once."""
PAGE = 4 << 20
"""Bytes of samples that are taken at a time, where all are wanted."""
_HEAD = struct.Struct("<BBHIQQQ")
_RAW: "dict[int, np.dtype[Any]]" = {1: np.dtype("<u1"), 2: np.dtype("<u2"), 4: np.dtype("<u4"), 8: np.dtype("<u8")}
_CODES = {Kind.REAL: "f", Kind.INT: "i", Kind.TIME: "i", Kind.DATE: "i"}
Words = NDArray[np.uint64]


def number_type(type: Elementary) -> "np.dtype[Any]":
    """How numpy reads values of a type."""
    return np.dtype(f"<{_CODES.get(type.kind, 'u')}{type.size}")


@dataclass(frozen=True, slots=True)
class Samples:
    """Rows, oldest first. Decimated ones have two for each range of scans: the least values in its first scan, the
    greatest in its last."""

    scans: Words
    valid: Words
    values: tuple[Words, ...]
    decimated: bool = False

    def __len__(self) -> int:
        return len(self.scans)

    def pack(self, first: int, end: int, generation: int) -> bytes:
        """As bytes for browsers; `first` to `end` (exclusive) is all that the buffer has.

        u8 kind = 2 | u8 decimated | u16 signals | u32 rows | u64 first | u64 end | u64 generation
        u64 scan[rows] | u64 valid[rows], bit i: signal i | for each signal u64 value[rows]
        """
        head = _HEAD.pack(
            SAMPLES, self.decimated, len(self.values), len(self.scans), first, end, generation
        )  # fmt: skip
        return b"".join((head, self.scans.tobytes(), self.valid.tobytes(), *(each.tobytes() for each in self.values)))

    @staticmethod
    def unpack(data: bytes) -> "tuple[Samples, int, int]":
        """What `pack` made, with `first` and `end`; `ValueError` when it is nothing of that kind."""
        signals, rows, decimated = _head(data)
        if len(data) != _HEAD.size + _packed(signals, rows):
            raise ValueError(f"{len(data)} bytes are not the samples of {signals} signals in {rows} rows")
        columns = np.frombuffer(data, dtype=np.uint64, offset=_HEAD.size).reshape(2 + signals, rows)
        _, _, _, _, first, end, _ = _HEAD.unpack_from(data)
        return Samples(columns[0], columns[1], tuple(columns[2:]), decimated), first, end


def unpack_pages(read: Callable[[int], bytes]) -> Iterator[Samples]:
    """What `pack` made several times, one after the other; `read` gives so many bytes, fewer at the end. `ValueError`."""
    while head := read(_HEAD.size):
        signals, rows, _ = _head(head)
        yield Samples.unpack(head + read(_packed(signals, rows)))[0]


def _head(data: bytes) -> tuple[int, int, bool]:
    if len(data) < _HEAD.size:
        raise ValueError(f"{len(data)} bytes are no samples")
    kind, decimated, signals, rows, _, _, _ = _HEAD.unpack_from(data)
    if kind != SAMPLES:
        raise ValueError(f"{len(data)} bytes are no samples: they begin with {kind}")
    return signals, rows, bool(decimated)


def _packed(signals: int, rows: int) -> int:
    return 8 * rows * (2 + signals)


class TooMany(Exception):
    """More rows than can be read at once; the message says what to do."""


class _Block:
    """Rows side by side; those before `count` are final."""

    __slots__ = ("count", "scans", "valid", "values")

    def __init__(self, types: Sequence[Elementary]) -> None:
        self.count = 0
        self.scans = np.zeros(BLOCK, dtype=np.uint64)
        self.valid = np.zeros(BLOCK, dtype=np.uint64)
        self.values = [np.zeros(BLOCK, dtype=_RAW[type.size]) for type in types]

    def with_columns(self, types: Sequence[Elementary], of: Sequence[int | None]) -> "_Block":
        made = _Block(types)
        made.scans = self.scans
        for at, column in enumerate(of):
            if column is not None:
                made.values[at] = self.values[column]
                made.valid |= (self.valid >> np.uint64(column) & np.uint64(1)) << np.uint64(at)
        made.count = self.count
        return made

    def append(self, rows: Words) -> None:
        """Takes rows that there is room for."""
        begin, end = self.count, self.count + len(rows)
        self.scans[begin:end], self.valid[begin:end] = rows[:, 0], rows[:, 1]
        for index, column in enumerate(self.values):
            column[begin:end] = rows[:, HEAD_WORDS + index]
        self.count = end


class TraceBuffer:
    """The last `capacity` rows of signals of these types."""

    def __init__(self, types: Sequence[Elementary], capacity: int) -> None:
        self.types, self.capacity = tuple(types), capacity
        self._blocks: tuple[_Block, ...] = ()

    @property
    def rows(self) -> int:
        """Rows that are there."""
        return _count(self._parts())

    @property
    def bytes(self) -> int:
        """What these rows take."""
        return self.rows * row_bytes(self.types)

    @property
    def extent(self) -> tuple[int, int]:
        """The scan of the oldest row, and that after the newest one's; 0 and 0 where there is none."""
        parts = self._parts()
        if not parts:
            return 0, 0
        (first, begin, _), (last, _, end) = parts[0], parts[-1]
        return int(first.scans[begin]), int(last.scans[end - 1]) + 1

    def with_columns(self, types: Sequence[Elementary], of: Sequence[int | None]) -> "TraceBuffer":
        """The same rows with other columns, which take this buffer's place: `of` names the column that each was, None one that
        has no values in these rows."""
        made = TraceBuffer(types, self.capacity)
        made._blocks = tuple(block.with_columns(types, of) for block in self._blocks)
        return made

    def append(self, rows: Words) -> None:
        """Takes rows as a `Sampling` has them."""
        rows = rows[-self.capacity :]
        blocks = list(self._blocks)
        while len(rows):
            if not blocks or blocks[-1].count == BLOCK:
                blocks.append(_Block(self.types))
            some = rows[: BLOCK - blocks[-1].count]
            blocks[-1].append(some)
            rows = rows[len(some) :]
        spare = sum(block.count for block in blocks) - self.capacity
        self._blocks = tuple(blocks[max(0, spare) // BLOCK :])  # at once: somebody may be reading

    def read(self, first: int, last: int, points: int | None = None) -> Samples:
        """The rows of scans `first` to `last`, both included; any thread. With more than `points` of them, so many at most:
        the least and greatest values of stretches whose bounds do not depend on what is asked for. `TooMany`."""
        parts = self._within(first, last)
        count, most = _count(parts), self.rows_in(LARGEST)
        if points is None and count > most:
            raise TooMany(
                f"{count:,} samples of {len(self.types)} signals are too many at once, {most:,} can be read:"
                " ask for fewer scans (first, last), for an outline (points), or for the file (CSV)."
            )
        if points is None or count <= min(points, most):
            return self._rows(parts)
        return self._outline(parts, max(1, min(points, most) // 2))

    def newest(self, first: int, last: int, rows: int) -> Samples:
        """The last rows of scans `first` to `last`, so many at most; any thread."""
        parts: list[Part] = []
        for block, begin, end in reversed(self._within(first, last)):
            if rows <= 0:
                break
            parts.insert(0, (block, max(begin, end - rows), end))
            rows -= end - begin
        return self._rows(parts)

    def pieces(self, first: int, last: int) -> Iterator[Samples]:
        """The rows of scans `first` to `last`, those of a block at a time; any thread."""
        for part in self._within(first, last):
            yield self._rows([part])

    def rows_in(self, size: int) -> int:
        """How many rows take so many bytes when they are packed; one at least."""
        return max(1, size // _packed(len(self.types), 1))

    def _rows(self, parts: "Sequence[Part]") -> Samples:
        columns = (self._column(parts, index).astype(np.uint64) for index in range(len(self.types)))
        return Samples(*_heads(parts), tuple(columns))

    def _outline(self, parts: "Sequence[Part]", stretches: int) -> Samples:
        # Column by column: all of them together would take as much memory as the buffer.
        scans, valid = _heads(parts)
        outline = _Outline(scans, valid, stretches)
        values = (
            outline.extremes(index, self._column(parts, index), number_type(type)) for index, type in enumerate(self.types)
        )  # fmt: skip
        return Samples(outline.scans, outline.valid, tuple(values), decimated=True)

    def _column(self, parts: "Sequence[Part]", index: int) -> "NDArray[Any]":
        return _joined([block.values[index][begin:end] for block, begin, end in parts], _RAW[self.types[index].size])

    def _within(self, first: int, last: int) -> "list[Part]":
        parts: list[Part] = []
        for block, begin, end in self._parts():
            within = block.scans[begin:end]
            low, high = np.searchsorted(within, (first, last + 1) if last >= first else (0, 0))
            if low < high:
                parts.append((block, begin + int(low), begin + int(high)))
        return parts

    def _parts(self) -> "list[Part]":
        """The blocks, and which of their rows count: those of one moment, whoever appends."""
        parts: list[Part] = [(block, 0, block.count) for block in self._blocks]
        skip = max(0, _count(parts) - self.capacity)
        found: list[Part] = []
        for block, _, end in parts:
            if skip < end:
                found.append((block, skip, end))
            skip = max(0, skip - end)
        return found


Part = tuple[_Block, int, int]


def _count(parts: Sequence[Part]) -> int:
    return sum(end - begin for _, begin, end in parts)


def _heads(parts: Sequence[Part]) -> tuple[Words, Words]:
    """Scans, and what has a value."""
    return (
        _joined([block.scans[begin:end] for block, begin, end in parts], _RAW[8]),
        _joined([block.valid[begin:end] for block, begin, end in parts], _RAW[8]),
    )


def buffer_of(pages: Iterable[Samples], types: Sequence[tuple[str, int]], rows: int) -> TraceBuffer:
    """Samples to be read again; of each signal the kind of its type and its size, empty and 0 where it never had any."""
    made = [Elementary("", Kind(kind) if kind else Kind.BOOL, size or 1) for kind, size in types]
    buffer = TraceBuffer(made, max(1, rows))
    for page in pages:
        if len(page.values) != len(made):
            raise ValueError(f"{len(page.values)} columns are not those of {len(made)} signals")
        buffer.append(np.stack((page.scans, page.valid, *page.values), axis=1))
    return buffer


def row_bytes(types: Sequence[Elementary]) -> int:
    """What a row takes in a buffer."""
    return 16 + sum(type.size for type in types)


def _joined(parts: "Sequence[NDArray[np.unsignedinteger[Any]]]", type: "np.dtype[Any]") -> "NDArray[Any]":
    return np.concatenate(parts) if parts else np.zeros(0, dtype=type)


class _Outline:
    """Stretches of rows, two rows for each."""

    def __init__(self, scans: Words, valid: Words, stretches: int) -> None:
        # a power of two, and counted from scan 0, so that the same stretches come again when the end moves on
        width = 1
        while int(scans[-1]) // width - int(scans[0]) // width + 1 > stretches:
            width *= 2
        of = scans // np.uint64(width)
        self._starts = np.concatenate(([0], np.flatnonzero(of[1:] != of[:-1]) + 1))
        ends = np.concatenate((self._starts[1:], [len(scans)])) - 1
        self.scans = np.empty(2 * len(self._starts), dtype=np.uint64)
        self.scans[0::2], self.scans[1::2] = scans[self._starts], scans[ends]
        self.valid = np.repeat(np.bitwise_or.reduceat(valid, self._starts), 2)
        self._known, self._everywhere = valid, int(np.bitwise_and.reduce(valid))

    def extremes(self, index: int, column: "NDArray[Any]", number: "np.dtype[Any]") -> Words:
        """Least and greatest value of each stretch in turn, of those that signal `index` has."""
        values, starts = column.view(number), self._starts
        known = None
        if not self._everywhere >> index & 1:
            known = (self._known >> np.uint64(index) & np.uint64(1)).astype(np.bool_)
        found = np.empty(2 * len(starts), dtype=number)
        if number.kind == "f":  # a NaN is neither the least nor the greatest
            some = values if known is None else np.where(known, values, number.type(np.nan))
            found[0::2], found[1::2] = np.fmin.reduceat(some, starts), np.fmax.reduceat(some, starts)
        else:
            info = np.iinfo(number)
            least = values if known is None else np.where(known, values, number.type(info.max))
            most = values if known is None else np.where(known, values, number.type(info.min))
            found[0::2], found[1::2] = np.minimum.reduceat(least, starts), np.maximum.reduceat(most, starts)
        return found.view(column.dtype).astype(np.uint64)
