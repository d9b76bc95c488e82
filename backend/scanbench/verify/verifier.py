"""Verifies scans: the library that job processes and the command line use. No processes, no clock."""

from collections.abc import Mapping, Sequence
from types import TracebackType
from typing import Protocol, Self

from scanbench.debug.flow_shown import FlowAsked
from scanbench.symbols.leaves import Leaf
from scanbench.verify.contract import (
    DEFAULT_LIMIT,
    MAX_LIMIT,
    BadRange,
    Begun,
    Column,
    Range,
    Row,
    ScanVerified,
    Use,
    VerifyCoverage,
    VerifyFlows,
)
from scanbench.verify.edits import BadEdit, Edit, Edits
from scanbench.verify.rows import Columns

__all__ = ["BadEdit", "Begun", "Subject", "Verifier"]


class Subject(Protocol):
    """What is verified: a control device compared with the monitor, scan by scan. What it refuses is `Unreadable`."""

    @property
    def first(self) -> int:
        """The first scan that can be verified."""

    @property
    def end(self) -> int:
        """Scans before this one can be."""

    @property
    def columns(self) -> Columns:
        """Those of all rows so far, since it was begun."""

    def close(self) -> None:
        """Lets go of files."""

    def follow(self, until: int) -> None:
        """Scans before `until` are over."""

    def begin(self, range: Range, limit: int, scan: int | None) -> Begun:
        """From now on this range, with so many uses of a scan. `scan`: the program that runs there says what there is.
        `BadRange`."""

    def run(self, scan: int) -> tuple[Row, ...]:
        """The rows of a scan that is over; in any order, consecutive ones are fastest."""

    def step(self, scan: int, after: int, count: int) -> Row:
        """See `Verifier.step`."""

    def uses(self, scan: int, call: int) -> tuple[Use, ...]:
        """The used-variable record of one pass. `BadEdit` when there is none."""

    def flows(self, scan: int, call: int, asked: FlowAsked) -> VerifyFlows:
        """What the code of an instance saw in one pass, on both sides. `BadEdit` when there is none, or it is not known; `UnknownPath`."""

    def inputs(self, scan: int, call: int) -> Mapping[str, Leaf]:
        """What a pass reads from outside of it, by column. `BadEdit` when there is no such pass."""

    @property
    def coverage(self) -> VerifyCoverage | None:
        """What of a trace was compared so far; None: everything of a scan is."""

    def edited(self, row: Row, edits: Mapping[str, Edit]) -> Row:
        """A row of the scan that was run last, with what the monitor comes to on edited inputs."""


class Verifier:
    """Of one subject. In one thread."""

    def __init__(self, subject: Subject) -> None:
        self._subject = subject
        self._edits = Edits()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Lets go of files."""
        self._subject.close()

    @property
    def first(self) -> int:
        """The first scan that can be verified."""
        return self._subject.first

    @property
    def end(self) -> int:
        """Scans before this one can be."""
        return self._subject.end

    @property
    def columns(self) -> Mapping[str, Column]:
        """All columns so far, by name."""
        return self._subject.columns.all

    @property
    def coverage(self) -> VerifyCoverage | None:
        """What of a trace was compared so far; None: everything of a scan is."""
        return self._subject.coverage

    def follow(self, until: int) -> None:
        """Scans before `until` are over. `Unreadable`."""
        self._subject.follow(until)

    def begin(self, range: Range, limit: int = DEFAULT_LIMIT, scan: int | None = None) -> Begun:
        """From now on this range is verified, and so many uses of variables are kept of a scan. `scan`: the program that runs
        there says what there is. `BadRange`, `Unreadable`."""
        if not 1 <= limit <= MAX_LIMIT:
            raise BadRange(f"{limit:,} uses of variables cannot be kept of a scan: 1 to {MAX_LIMIT:,} can")
        begun = self._subject.begin(range, limit, scan)
        self._edits = Edits()
        return begun

    def verify(self, scan: int) -> ScanVerified:
        """The rows of one scan. `Unreadable` says why not."""
        return self._verified(scan, self._rows(scan))

    def step(self, scan: int, after: int, count: int = 0) -> ScanVerified:
        """Both sides run the statement of the count `after` (0: they run up to the first one of the range), and halt before that of
        `count` (0: the next one of the range), compared there. A row with the count 0 is at the end of the scan. `Unreadable`."""
        return self._verified(scan, (self._subject.step(scan, after, count),))

    def uses(self, scan: int, call: int) -> tuple[Use, ...]:
        """The used-variable record of one pass. `BadEdit` when there is none; `Unreadable`."""
        return self._subject.uses(scan, call)

    def flows(self, scan: int, call: int, asked: FlowAsked) -> VerifyFlows:
        """What the code of an instance saw in one pass, on both sides. `BadEdit`, `UnknownPath`, `Unreadable`."""
        return self._subject.flows(scan, call, asked)

    def set_inputs(self, edits: Sequence[tuple[int, int, str, str]]) -> tuple[Row, ...]:
        """The monitor runs these passes on edited inputs as well: (scan, call, column, value as typed); an empty value takes
        an edit back. The rows as they are now. `BadEdit`: then nothing is edited; `Unreadable`."""
        made = self._edits.copy()
        ordered = sorted(edits, key=lambda each: each[:2])
        for scan, call, column, text in ordered:
            made.set(self._subject.inputs(scan, call), scan, call, column, text)
        self._edits = made
        touched = dict.fromkeys((scan, call) for scan, call, _, _ in ordered)
        return tuple(row for scan, call in touched for row in self._rows(scan) if row.call == call)

    def _rows(self, scan: int) -> tuple[Row, ...]:
        rows = self._subject.run(scan)
        edited = {row.call: edits for row in rows if (edits := self._edits.of(scan, row.call))}
        if not edited:
            return rows
        return tuple(self._subject.edited(row, edited[row.call]) if row.call in edited else row for row in rows)

    def _verified(self, scan: int, rows: tuple[Row, ...]) -> ScanVerified:
        columns, inputs, outputs = self._subject.columns.take()
        return ScanVerified(scan, rows, columns, inputs, outputs, max((each.used for each in rows), default=0))
