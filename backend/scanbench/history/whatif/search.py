"""The smallest change of a few variables with which something holds: one of them first, then two that are BOOL.

It tries, and does not prove: a number is looked for in both directions at distances that double, then between the last one that
did not do and the first one that did. Where what holds does not depend on it in one direction, a nearer one may be there.
"""

import struct
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from scanbench.program.types import Elementary, Enumeration, Kind, Subrange, Type
from scanbench.program.untyped import bounds
from scanbench.symbols.values import format_value

_MS = 1_000_000
"""In ns: the least change of a TIME."""
_REAL_ROUNDS = 12
_FARTHEST = 40
"""Distances of a REAL: each is twice the one before."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A variable, and what it is worth without a change."""

    path: str
    type: Type
    data: bytes

    @property
    def counts(self) -> bool:
        """Whether it is a number, of which not every value is tried."""
        return _number(self) is not None


Change = tuple[tuple[str, str], ...]
"""Paths, and values as typed."""
Ask = Callable[[Change], bool]
"""Whether it holds with these values."""


class Enough(Exception):
    """No more tries."""


@dataclass(slots=True)
class Search:
    """`found`: the smallest changes that were found, those of BOOLs first, then by how far they are from what was."""

    candidates: Sequence[Candidate]
    ask: Ask
    most: int
    asked: int = 0

    def run(self) -> tuple[list[Change], bool]:
        """The changes, best first; and whether all was tried that it tries."""
        found: list[tuple[float, Change]] = []
        try:
            for each in sorted(self.candidates, key=_order):
                found += self._single(each)
            if not found:
                found += self._pairs()
        except Enough:
            return [change for _, change in sorted(found, key=lambda each: each[0])], False
        return [change for _, change in sorted(found, key=lambda each: each[0])], True

    def _holds(self, change: Change) -> bool:
        if self.asked >= self.most:
            raise Enough
        self.asked += 1
        return self.ask(change)

    def _single(self, candidate: Candidate) -> Iterator[tuple[float, Change]]:
        number = _number(candidate)
        if number is not None:
            yield from self._nearest(candidate, number)
            return
        for text in _others(candidate):
            change = ((candidate.path, text),)
            if self._holds(change):
                yield 0.0, change

    def _nearest(self, candidate: Candidate, number: "Number") -> Iterator[tuple[float, Change]]:
        distance, below = number.least, {1: number.least * 0, -1: number.least * 0}  # of each direction what did not do
        for _ in range(_FARTHEST if number.real else 65):
            for sign in tuple(below):
                room = number.high - number.now if sign > 0 else number.now - number.low
                step = min(distance, room)
                if step > below[sign] and self._holds(number.change(candidate, number.now + sign * step)):
                    best = self._between(candidate, number, below[sign], sign * step)
                    yield abs(best) / max(abs(number.now), 1), number.change(candidate, number.now + best)
                    return
                below[sign] = step
                if step == room:  # its bound was tried
                    del below[sign]
            if not below:
                return
            distance = distance * 2

    def _between(self, candidate: Candidate, number: "Number", fails: float, does: float) -> float:
        """Between a distance that does not do and one that does."""
        sign = 1 if does > 0 else -1
        near, far = fails, abs(does)
        for _ in range(_REAL_ROUNDS if number.real else 64):
            middle = (near + far) / 2 if number.real else near + (far - near) // (2 * number.least) * number.least
            if not number.real and middle <= near:
                break
            if self._holds(number.change(candidate, number.now + sign * middle)):
                far = middle
            else:
                near = middle
        return sign * far

    def _pairs(self) -> Iterator[tuple[float, Change]]:
        bools = [each for each in self.candidates if isinstance(each.type, Elementary) and each.type.kind is Kind.BOOL]
        for pair in combinations(bools, 2):
            change = tuple((each.path, text) for each in pair for text in _others(each))
            if self._holds(change):
                yield 1.0, change


@dataclass(frozen=True, slots=True)
class Number:
    """A value that has neighbours."""

    now: float
    low: float
    high: float
    least: float
    """The smallest step."""
    real: bool

    def change(self, candidate: Candidate, value: float) -> Change:
        """That value, as typed."""
        assert isinstance(candidate.type, Elementary)
        size = candidate.type.size
        if self.real:
            data = struct.pack("<f" if size == 4 else "<d", value)
        else:
            data = (int(value) & (1 << 8 * size) - 1).to_bytes(size, "little")
        return ((candidate.path, format_value(candidate.type, data)),)


def _number(candidate: Candidate) -> Number | None:
    type, data = candidate.type, candidate.data
    if not isinstance(type, Elementary) or isinstance(type, Enumeration):
        return None
    if type.kind is Kind.REAL:
        (now,) = struct.unpack("<f" if type.size == 4 else "<d", data)
        most = 3.4e38 if type.size == 4 else 1.7e308
        return Number(now, -most, most, max(abs(now), 1.0) / 1000, True) if abs(now) <= most else None
    if type.kind in (Kind.INT, Kind.UINT, Kind.TIME):
        low, high = bounds(type)
        now = int.from_bytes(data, "little", signed=low < 0)
        if isinstance(type, Subrange):
            low, high = min(type.low, now), max(type.high, now)
        return Number(now, low, high, _MS if type.kind is Kind.TIME else 1, False)
    return None


def _others(candidate: Candidate) -> Iterator[str]:
    """Other values of what has few, or of a bit string with one bit turned over."""
    type, data = candidate.type, candidate.data
    if isinstance(type, Enumeration):
        shown = format_value(type, data)
        yield from (name for name, _ in type.values if name != shown)
    elif isinstance(type, Elementary) and type.kind is Kind.BOOL:
        yield "FALSE" if any(data) else "TRUE"
    elif isinstance(type, Elementary) and type.kind is Kind.BITS:
        now = int.from_bytes(data, "little")
        for bit in range(8 * type.size):
            yield format_value(type, (now ^ 1 << bit).to_bytes(type.size, "little"))


def searchable(type: Type) -> bool:
    """Whether values of the type are tried."""
    kinds = (Kind.BOOL, Kind.BITS, Kind.INT, Kind.UINT, Kind.TIME, Kind.REAL)
    return isinstance(type, Enumeration) or (isinstance(type, Elementary) and type.kind in kinds)


def _order(candidate: Candidate) -> int:
    """Those with few values first."""
    if _number(candidate) is not None:
        return 2
    return 0 if isinstance(candidate.type, Elementary) and candidate.type.kind is Kind.BOOL else 1
