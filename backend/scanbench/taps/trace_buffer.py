"""Samples of a trace in memory: a ring of rows, read in full or as the least and greatest of each stretch.

The thread that runs the scans appends; any thread reads, as rows never change once they are there. Values are kept in the
size of their type, and given out as the u64 of `engines.sample`.
"""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scanbench.check.types import Elementary, Kind
from scanbench.engines.sample import HEAD_WORDS

BLOCK = 4096
SAMPLES = 2
"""First byte of packed samples; 1 is a value frame."""
_HEAD = struct.Struct("<BBHIQQQ")
_RAW: "dict[int, np.dtype[Any]]" = {1: np.dtype("<u1"), 2: np.dtype("<u2"), 4: np.dtype("<u4"), 8: np.dtype("<u8")}
_CODES = {Kind.REAL: "f", Kind.INT: "i", Kind.TIME: "i", Kind.DATE: "i"}
Words = NDArray[np.uint64]


def number_type(type: Elementary) -> "np.dtype[Any]":
    """How numpy reads values of a type."""
    return np.dtype(f"<{_CODES.get(type.kind, 'u')}{type.size}")


@dataclass(frozen=True, slots=True)
class Samples:
    """Rows, oldest first. Of decimated ones two stand for each stretch: the least values in its first scan, the
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
        if len(data) < _HEAD.size:
            raise ValueError(f"{len(data)} bytes are no samples")
        kind, decimated, signals, rows, first, end, _ = _HEAD.unpack_from(data)
        if kind != SAMPLES or len(data) != _HEAD.size + 8 * rows * (2 + signals):
            raise ValueError(f"{len(data)} bytes are not the samples of {signals} signals in {rows} rows")
        columns = np.frombuffer(data, dtype=np.uint64, offset=_HEAD.size).reshape(2 + signals, rows)
        return Samples(columns[0], columns[1], tuple(columns[2:]), bool(decimated)), first, end


class _Block:
    """Rows side by side; those before `count` are final."""

    __slots__ = ("count", "scans", "valid", "values")

    def __init__(self, types: Sequence[Elementary]) -> None:
        self.count = 0
        self.scans = np.zeros(BLOCK, dtype=np.uint64)
        self.valid = np.zeros(BLOCK, dtype=np.uint64)
        self.values = [np.zeros(BLOCK, dtype=_RAW[type.size]) for type in types]

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
        return sum(end - begin for _, begin, end in self._parts())

    @property
    def extent(self) -> tuple[int, int]:
        """The scan of the oldest row, and that behind the newest one's; 0 and 0 where there is none."""
        parts = self._parts()
        if not parts:
            return 0, 0
        (first, begin, _), (last, _, end) = parts[0], parts[-1]
        return int(first.scans[begin]), int(last.scans[end - 1]) + 1

    def append(self, rows: Words) -> None:
        """Takes rows as a `Sampling` has them."""
        rows = rows[-self.capacity :]
        while len(rows):
            if not self._blocks or self._blocks[-1].count == BLOCK:
                self._blocks = (*self._blocks, _Block(self.types))
            some = rows[: BLOCK - self._blocks[-1].count]
            self._blocks[-1].append(some)
            rows = rows[len(some) :]
        blocks = self._blocks
        spare = len(blocks) * BLOCK - BLOCK + (blocks[-1].count if blocks else 0) - self.capacity
        if spare >= BLOCK:
            self._blocks = blocks[spare // BLOCK :]

    def read(self, first: int, last: int, points: int | None = None) -> Samples:
        """The rows of scans `first` to `last`, both included; any thread. With more than `points` of them, so many at most:
        the least and greatest values of stretches whose bounds do not depend on what is asked for."""
        parts: list[Part] = []
        for block, begin, end in self._parts():
            within = block.scans[begin:end]
            low, high = np.searchsorted(within, (first, last + 1) if last >= first else (0, 0))
            if low < high:
                parts.append((block, begin + int(low), begin + int(high)))
        scans = _joined([block.scans[begin:end] for block, begin, end in parts], _RAW[8])
        valid = _joined([block.valid[begin:end] for block, begin, end in parts], _RAW[8])
        columns = [
            _joined([block.values[index][begin:end] for block, begin, end in parts], _RAW[type.size])
            for index, type in enumerate(self.types)
        ]
        if points is None or len(scans) <= points:
            return Samples(scans, valid, tuple(column.astype(np.uint64) for column in columns))
        return _decimated(scans, valid, columns, self.types, max(1, points // 2))

    def _parts(self) -> "list[Part]":
        """The blocks, and which of their rows count: those of one moment, whoever appends."""
        blocks = self._blocks
        ends = [block.count for block in blocks]
        skip = max(0, sum(ends) - self.capacity)
        return [
            (block, skip if number == 0 else 0, end) for number, (block, end) in enumerate(zip(blocks, ends, strict=True))
        ]  # fmt: skip


Part = tuple[_Block, int, int]


def buffer_of(samples: Samples, types: Sequence[tuple[str, int]]) -> TraceBuffer:
    """Samples to be read again; of each signal the kind of its type and its size, empty and 0 where it never had any."""
    made = [Elementary("", Kind(kind) if kind else Kind.BOOL, size or 1) for kind, size in types]
    buffer = TraceBuffer(made, max(1, len(samples)))
    buffer.append(np.stack((samples.scans, samples.valid, *samples.values), axis=1))
    return buffer


def row_bytes(types: Sequence[Elementary]) -> int:
    """What a row takes in a buffer."""
    return 16 + sum(type.size for type in types)


def _joined(parts: "Sequence[NDArray[np.unsignedinteger[Any]]]", type: "np.dtype[Any]") -> "NDArray[Any]":
    return np.concatenate(parts) if parts else np.zeros(0, dtype=type)


def _decimated(
    scans: Words, valid: Words, columns: "Sequence[NDArray[Any]]", types: Sequence[Elementary], stretches: int
) -> Samples:
    # a power of two, and counted from scan 0, so that the same stretches come again when the end moves on
    width = 1
    while int(scans[-1]) // width - int(scans[0]) // width + 1 > stretches:
        width *= 2
    of = scans // np.uint64(width)
    starts = np.concatenate(([0], np.flatnonzero(of[1:] != of[:-1]) + 1))
    ends = np.concatenate((starts[1:], [len(scans)])) - 1
    both = np.empty(2 * len(starts), dtype=np.uint64)
    both[0::2], both[1::2] = scans[starts], scans[ends]
    has = np.repeat(np.bitwise_or.reduceat(valid, starts), 2)
    everywhere = int(np.bitwise_and.reduce(valid))
    values = []
    for index, (column, type) in enumerate(zip(columns, types, strict=True)):
        known = None if everywhere >> index & 1 else (valid >> np.uint64(index) & np.uint64(1)).astype(np.bool_)
        values.append(_extremes(column, number_type(type), starts, known))
    return Samples(both, has, tuple(values), decimated=True)


def _extremes(
    column: "NDArray[Any]", number: "np.dtype[Any]", starts: NDArray[np.int64], known: NDArray[np.bool_] | None
) -> Words:
    """Least and greatest value of each stretch in turn, of those that are `known`."""
    values = column.view(number)
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
