"""What a report of a verification is made of: its head, the columns, and rows. Who made them does not matter."""

from collections import deque
from dataclasses import dataclass, field
from typing import Literal

from scanbench.verify.contract import DEFAULT_LIMIT, Column, Mismatch, Row, ScanVerified, VerifyCoverage
from scanbench.verify.verdict import Verdict, partly, verdict

Source = Literal["live", "past", "trace"]
CONTEXT = 2
"""Rows around one that differs which a report keeps."""
MAX_ROWS = 10_000


@dataclass(frozen=True, slots=True)
class ReportHead:
    """Who verified what, and what came of it."""

    project: str
    instance: str
    """Name of the virtual PLC, or of the run file."""
    model: str
    by: str
    when: str
    """ISO 8601."""
    version: int
    """Of the program."""
    title: str
    """The range, for people: `FB_Belt, lines 33 to 42`."""
    source: Source
    first: int
    """Scans, both ends included."""
    last: int
    compared: int
    """Scans."""
    skipped: int
    """Scans of which nothing was compared."""
    differing: int
    """Rows; with what is not in the report any more."""
    tool: str
    """`Scanbench 0.1.0`."""
    trace: str = ""
    """Name of the file of a real controller's trace."""
    interval_ns: int = 0
    forgotten: int = 0
    """Rows that are not in the report."""
    limit: int = DEFAULT_LIMIT
    stretches: tuple[tuple[int, int], ...] = ()
    """The skipped scans, both ends included; perhaps only the last of them."""
    coverage: VerifyCoverage | None = None
    """Of a trace: what was compared, and what was not."""
    note: str = ""
    """What else a reader should know: how the trace was mapped, why it ended early."""
    full: int = 0
    """Scans of those skipped in which uses of variables found no room in the record."""
    not_reached: int = 0
    """Scans that were asked for and did not run, as a run-time error had ended the program."""
    sampled: bool = False
    """Of a log or a controller of which only some scans are known, so that those in between were not asked for."""

    unfinished: bool = False
    """It was ended before all that was asked for."""

    @property
    def partly(self) -> bool:
        """See `verdict.partly`."""
        return partly(self)


@dataclass(frozen=True, slots=True)
class Report:
    """A verification, ready to be written down."""

    head: ReportHead
    columns: tuple[Column, ...]
    """In the order of the table."""
    rows: tuple[Row, ...]
    inputs: tuple[str, ...] = ()
    """Names of columns that were read before they were written, in some row."""
    outputs: tuple[str, ...] = ()

    @property
    def idle(self) -> bool:
        """Whether the range did not run in any of the scans, so that nothing of it was compared."""
        return not self.columns and all(row.kind == "none" for row in self.rows)

    @property
    def verdict(self) -> Verdict:
        """What it came to."""
        return verdict(self.head, self.idle)

    def ordered(self) -> tuple[Column, ...]:
        """Outputs, then inputs, as in the table of the panel; each column once."""
        written = [each for each in self.columns if each.name in self.outputs]
        return (*written, *(each for each in self.columns if each.name not in self.outputs))

    def differences(self) -> list[tuple[Row, Mismatch]]:
        """All of them, in the order of the scans."""
        return [(row, each) for row in self.rows for each in row.differences]


def stretched(stretches: list[tuple[int, int]], first: int, last: int) -> None:
    """Adds scans to stretches of them, both ends included."""
    if stretches and stretches[-1][1] == first - 1:
        first = stretches.pop()[0]
    stretches.append((first, last))


@dataclass(slots=True)
class Collected:
    """Takes scans as they are verified, and keeps what a report shows: rows that differ, and a few around them."""

    compared: int = 0
    skipped: int = 0
    """Scans of which nothing was compared, and the stretches of them."""
    stretches: list[tuple[int, int]] = field(default_factory=list)
    full: int = 0
    """Scans of those in which uses found no room in the record."""
    differing: int = 0
    """Rows."""
    first_difference: tuple[Row, Mismatch] | None = None
    most_used: int = 0
    last_scan: int | None = None
    seen: int = 0
    """Rows, the ones included that were not kept."""
    columns: list[Column] = field(default_factory=list)
    inputs: dict[str, None] = field(default_factory=dict)
    outputs: dict[str, None] = field(default_factory=dict)
    _rows: list[Row] = field(default_factory=list)
    _before: deque[Row] = field(default_factory=lambda: deque(maxlen=CONTEXT))
    _rows_left: int = 0

    def add(self, verified: ScanVerified) -> None:
        """One more scan."""
        if verified.compared:
            self.compared += 1
        else:
            self.skipped += 1
            self.full += verified.cut
            stretched(self.stretches, verified.scan, verified.scan)
        self.last_scan = verified.scan
        self.most_used = max(self.most_used, verified.used)
        self.columns = [*{each.name: each for each in (*self.columns, *verified.columns)}.values()]
        self.inputs |= dict.fromkeys(verified.inputs)
        self.outputs |= dict.fromkeys(verified.outputs)
        for row in verified.rows:
            self._add(row)

    def _add(self, row: Row) -> None:
        self.seen += 1
        if row.differs:
            self.differing += 1
            if self.first_difference is None:
                self.first_difference = row, row.differences[0]
            if len(self._rows) + len(self._before) < MAX_ROWS:
                self._rows += self._before
            self._before.clear()
            self._rows_left = CONTEXT + 1
        if not self._rows_left or len(self._rows) >= MAX_ROWS:
            self._before.append(row)
            return
        self._rows_left -= 1
        self._rows.append(row)

    def rows(self) -> tuple[Row, ...]:
        """Those that are kept: where nothing differs, the last ones."""
        return tuple(self._rows or self._before)

    def report(self, head: ReportHead) -> Report:
        """With what came so far."""
        return Report(head, tuple(self.columns), self.rows(), tuple(self.inputs), tuple(self.outputs))
