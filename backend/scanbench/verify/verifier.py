"""Verifies the scans of a run: the library that job processes and the command line use. No processes, no clock."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Self, TypeVar

from scanbench.recording.reader import RunReader, Unreadable
from scanbench.symbols.names import Names
from scanbench.verify.both import Both, View
from scanbench.verify.contract import DEFAULT_LIMIT, MAX_LIMIT, BadRange, Column, Range, Row, ScanVerified, Use
from scanbench.verify.control import Control
from scanbench.verify.edits import BadEdit, Edits
from scanbench.verify.monitor import Monitor
from scanbench.verify.places import Places
from scanbench.verify.ranges import Resolved, resolve_range
from scanbench.verify.rows import Columns, Reader
from scanbench.verify.sides import Side
from scanbench.verify.steps import step_row
from scanbench.verify.used_record import uses_of

T = TypeVar("T")
__all__ = ["BadEdit", "Begun", "Verifier"]


@dataclass(frozen=True, slots=True)
class Begun:
    """A range that was understood."""

    title: str
    instances: tuple[str, ...]
    first: int
    end: int
    interval_ns: int
    version: int
    """Of the program."""
    note: str = ""
    """What is not quite as it was asked for."""


class Verifier:
    """Of one run file, which may go on growing. In one thread."""

    def __init__(self, reader: RunReader) -> None:
        """`Unreadable` when it is none. The reader's texts are the lines that differences name."""
        self._reader = reader
        reader.follow()
        self._both: Both | None = None
        self._range, self._limit = Range(), DEFAULT_LIMIT
        self._views: dict[int, View] = {}
        self._columns = Columns()
        self._edits = Edits()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Lets go of the file."""
        self._reader.close()

    @property
    def first(self) -> int:
        """The first scan that can be verified."""
        return self._reader.first

    @property
    def end(self) -> int:
        """Scans in front of this one can be."""
        return self._reader.over

    @property
    def columns(self) -> dict[str, Column]:
        """All columns so far, by name."""
        return self._columns.all

    def follow(self, until: int) -> None:
        """Reads the file on; scans in front of `until` are over. `Unreadable`."""
        if not self._reader.follow(until):
            self._both = None
            self._views = {}

    def begin(self, range: Range, limit: int = DEFAULT_LIMIT, scan: int | None = None) -> Begun:
        """From now on this range is verified, and so many uses of variables are kept of a scan. `scan`: the program that runs
        there says what there is. `BadRange`, `Unreadable`."""
        if not 1 <= limit <= MAX_LIMIT:
            raise BadRange(f"{limit:,} uses of variables cannot be kept of a scan: 1 to {MAX_LIMIT:,} can")
        version = self._reader.version(self.first if scan is None else max(scan, self.first))
        with self._reader.reading():
            both = self._standing()
            loaded = both.control.loaded(version)
        program = loaded.program
        resolved = resolve_range(
            program, loaded.debugged().sites, range, lambda file: len(self._reader.lines(version, file))
        )
        self._range, self._limit = range, limit
        self._views, self._columns, self._edits = {}, Columns(), Edits()
        both.ran = []
        return Begun(
            resolved.title, resolved.instances, self.first, self.end, program.interval_ns, version, resolved.note
        )  # fmt: skip

    def verify(self, scan: int) -> ScanVerified:
        """The rows of one scan. `Unreadable` says why not."""
        rows = list(self._rows(scan))
        for index, row in enumerate(rows):
            edited = self._edits.of(scan, row.call)
            if edited:
                rows[index] = self._edits.run(self._standing(), row, edited)
        return self._verified(scan, tuple(rows))

    def step(self, scan: int, count: int) -> ScanVerified:
        """Both sides in front of the statement of this count, compared there; 0: in front of the scan. `Unreadable`."""
        both = self._guarded(scan, lambda: self._before(scan))
        row = self._guarded(scan, lambda: step_row(both, scan, count, self._view))
        return self._verified(scan, (row,))

    def uses(self, scan: int, call: int) -> tuple[Use, ...]:
        """The used-variable record of one pass. `Unreadable`."""
        self._again(scan)
        return self._guarded(scan, lambda: uses_of(self._standing(), call))

    def set_inputs(self, edits: Sequence[tuple[int, int, str, str]]) -> tuple[Row, ...]:
        """The monitor runs these passes on edited inputs as well: (scan, call, column, value as typed); an empty value takes
        an edit back. The rows as they are now. `BadEdit`: then nothing is edited; `Unreadable`."""
        made = self._edits.copy()
        touched: dict[tuple[int, int], None] = {}
        for scan, call, column, text in sorted(edits, key=lambda each: each[:2]):
            self._again(scan)
            made.set(self._standing(), scan, call, column, text)
            touched[scan, call] = None
        self._edits = made
        found = []
        for scan, call in touched:
            rows = self.verify(scan).rows
            found += [row for row in rows if row.call == call]
        return tuple(found)

    # ---- standing -------------------------------------------------------------------------------------------------

    def _standing(self) -> Both:
        if self._both is None:
            control = Control(self._reader)
            monitor = Monitor(self._reader.programs, control.side.resource.version)
            self._both = Both(self._reader, control, monitor)
        return self._both

    def _before(self, scan: int) -> Both:
        """In front of what was entered in a scan."""
        if not self.first <= scan:
            raise Unreadable(f"scan {scan} is not kept any more: the run begins with scan {self.first}")
        both = self._standing()
        both.goto(scan)
        return both

    def _rows(self, scan: int) -> tuple[Row, ...]:
        if not self.first <= scan < self.end:
            raise Unreadable(f"scans {self.first} to {self.end - 1} can be verified: {scan} is none of them")

        def run() -> tuple[Row, ...]:
            both = self._standing()
            if not (both.ran_last == scan - 1 and both.control.scan == scan):
                self._before(scan)
            return both.run(scan, self._view)

        return self._guarded(scan, run)

    def _again(self, scan: int) -> None:
        """The scan ran last."""
        if self._standing().ran_last != scan or not self._standing().ran:
            self._rows(scan)

    def _guarded(self, scan: int, run: Callable[[], T]) -> T:
        """What goes wrong with the file or the replay, as words. Whoever comes next begins anew."""
        try:
            with self._reader.replaying(scan):
                return run()
        except Unreadable:
            self._both = None
            raise

    def _verified(self, scan: int, rows: tuple[Row, ...]) -> ScanVerified:
        columns, inputs, outputs = self._columns.take()
        return ScanVerified(scan, rows, columns, inputs, outputs, max((each.used for each in rows), default=0))

    # ---- programs -------------------------------------------------------------------------------------------------

    def _view(self, side: Side) -> View:
        """How the program that runs now is looked at."""
        version = side.resource.version
        if version not in self._views:
            program, sites = side.resource.program, side.resource.loaded.debugged().sites
            places = Places(program, sites, lambda file, line: self._reader.text(version, file, line))
            try:
                resolved = resolve_range(program, sites, self._range)
            except BadRange:  # another program runs meanwhile: nothing of it is in the range
                resolved = Resolved("nothing", pous=frozenset(list(sites.bodies)[:1]))
            self._views[version] = View(Reader(Names(program, sites), places, self._columns), resolved, self._limit)
        return self._views[version]
