"""The rows of a verification, in the parent: as bytes, and not more than find room."""

from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import ClassVar

from scanbench.public import Public
from scanbench.verify.contract import Column, Row
from scanbench.wire.codec import unpack_kept
from scanbench.wire.verification import KeptRows, PackedRow, ScansVerified

MOST_ROWS = 20_000
MOST_BYTES = 48 << 20
"""Of one verification."""
MOST_OLD = 5000
"""Rows that differ which outlive the equal ones around them."""
MOST_DIFFERING = 10_000
"""Indices of rows that differ, which are told."""


@dataclass(frozen=True, slots=True)
class RowsPage(Public):
    """As many rows as were asked for, with all columns."""

    PUBLIC: ClassVar = "VerifyRows"

    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    first: int
    """Index of the first row that is kept."""
    count: int
    """Rows that there were; the last has index `count` - 1."""
    differing: tuple[int, ...]
    """Indices of rows that differ, at most 10,000."""


@dataclass
class Rows:
    """Rows in the order in which they came; the oldest are forgotten when there is no room."""

    columns: list[Column] = field(default_factory=list)
    inputs: dict[str, None] = field(default_factory=dict)
    outputs: dict[str, None] = field(default_factory=dict)
    kept: list[PackedRow] = field(default_factory=list)
    first: int = 0
    """Index of the first that is kept."""
    differing: list[int] = field(default_factory=list)
    """Indices, those of `old` included."""
    bytes: int = 0
    """Of `kept`."""
    old: dict[int, PackedRow] = field(default_factory=dict)
    """By index: rows before `first` that differ."""

    @property
    def count(self) -> int:
        """Rows that there were."""
        return self.first + len(self.kept)

    def add(self, came: ScansVerified) -> None:
        """After all others."""
        self._learn(came)
        for row in came.rows:
            if row.first is not None:
                self.differing.append(self.count)
            self.kept.append(row)
            self.bytes += len(row.data)
        self._forget()

    def replace(self, came: ScansVerified) -> None:
        """Rows that are others now: of the same scan, call and count."""
        self._learn(came)
        places = {(row.scan, row.call, row.count): at for at, row in enumerate(self.kept)}
        old = {(row.scan, row.call, row.count): index for index, row in self.old.items()}
        for row in came.rows:
            at = places.get((row.scan, row.call, row.count))
            index = old.get((row.scan, row.call, row.count))
            if index is not None:
                self.old[index] = row
            if at is not None:
                self.bytes += len(row.data) - len(self.kept[at].data)
                self.kept[at] = row

    def page(self, first: int, count: int, differing: bool) -> RowsPage:
        """Rows from index `first` on; with `differing` only those that differ."""
        if differing:
            at = bisect_left(self.differing, first)
            indices: Iterable[int] = self.differing[at : at + count]
        else:
            indices = range(max(first, self.first), min(self.count, max(first, self.first) + count))
        rows = tuple(replace(row_of(self._row(index)), index=index) for index in indices)
        told = tuple(self.differing[-MOST_DIFFERING:])
        columns = (
            replace(each, output=each.name in self.outputs, input=each.name in self.inputs) for each in self.columns
        )
        return RowsPage(tuple(columns), rows, self.first, self.count, told)

    def all(self) -> Iterator[Row]:
        """Every row that is kept."""
        return map(row_of, (*self.old.values(), *self.kept))

    def as_now(self) -> "Rows":
        """A copy for a different thread, which unpacks it while rows come in here."""
        return replace(
            self, columns=[*self.columns], inputs={**self.inputs}, outputs={**self.outputs}, kept=[*self.kept],
            differing=[*self.differing], old={**self.old},
        )  # fmt: skip

    def packed(self) -> KeptRows:
        """To be kept."""
        return KeptRows(
            self.first, tuple(self.kept), tuple(self.columns), tuple(self.inputs), tuple(self.outputs), dict(self.old)
        )

    @staticmethod
    def of(kept: KeptRows) -> "Rows":
        """As they were kept."""
        differing = [*kept.old, *(kept.first + at for at, row in enumerate(kept.rows) if row.first is not None)]
        return Rows(
            list(kept.columns), dict.fromkeys(kept.inputs), dict.fromkeys(kept.outputs), list(kept.rows), kept.first,
            differing, sum(len(row.data) for row in kept.rows), dict(kept.old),
        )  # fmt: skip

    def _row(self, index: int) -> PackedRow:
        return self.old[index] if index < self.first else self.kept[index - self.first]

    def _learn(self, came: ScansVerified) -> None:
        self.columns = [*{each.name: each for each in (*self.columns, *came.columns)}.values()]
        self.inputs.update(dict.fromkeys(came.inputs))
        self.outputs.update(dict.fromkeys(came.outputs))

    def _forget(self) -> None:
        gone, freed = 0, 0
        while len(self.kept) - gone > MOST_ROWS or self.bytes - freed > MOST_BYTES:
            row = self.kept[gone]
            if row.first is not None and len(self.old) < MOST_OLD:  # the first ones: what came of them is of less use
                self.old[self.first + gone] = row
            freed += len(row.data)
            gone += 1
        if gone:
            del self.kept[:gone]
            self.first += gone
            self.bytes -= freed
            at = bisect_left(self.differing, self.first)
            self.differing[:at] = self.old


def row_of(packed: PackedRow) -> Row:
    """The row in these bytes."""
    row = unpack_kept(packed.data)
    assert isinstance(row, Row)
    return row
