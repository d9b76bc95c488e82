"""A recorded run to be verified: its run file is run again with the code that ran live, and compared with the monitor."""

from collections.abc import Callable, Mapping
from typing import TypeVar

from scanbench.debug.flow_shown import FlowAsked
from scanbench.recording.gaps import gap_of
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.names import Names
from scanbench.verify.both import Both, View
from scanbench.verify.contract import DEFAULT_LIMIT, BadRange, Begun, Range, Row, Use, VerifyFlows
from scanbench.verify.control import Control
from scanbench.verify.edits import Edit
from scanbench.verify.flow_record import flows_of
from scanbench.verify.monitor import Monitor
from scanbench.verify.passes import edited_row, inputs_of
from scanbench.verify.places import Places
from scanbench.verify.ranges import Resolved, resolve_range
from scanbench.verify.rows import Columns, Reader
from scanbench.verify.sides import Side
from scanbench.verify.steps import step_row
from scanbench.verify.used_record import uses_of

T = TypeVar("T")


class RunSubject:
    """See `Subject`. The run file may go on growing."""

    def __init__(self, reader: RunReader) -> None:
        """`Unreadable` when it is none. The reader's texts are the lines that differences name."""
        self._reader = reader
        reader.follow()
        self._both: Both | None = None
        self._range, self._limit = Range(), DEFAULT_LIMIT
        self._views: dict[int, View] = {}
        self.columns = Columns()

    def close(self) -> None:
        """Lets go of the file."""
        self._reader.close()

    @property
    def first(self) -> int:
        """See `Subject`."""
        return self._reader.first

    @property
    def end(self) -> int:
        """See `Subject`."""
        return self._reader.over

    @property
    def coverage(self) -> None:
        """Everything of a scan is compared."""
        return None

    def follow(self, until: int) -> None:
        """See `Subject`."""
        try:
            same = self._reader.follow(until)
        except Unreadable:
            self._both = None
            raise
        if not same:
            self._both = None
            self._views = {}

    def begin(self, range: Range, limit: int, scan: int | None) -> Begun:
        """See `Subject`."""
        version = self._reader.version(self.first if scan is None else max(scan, self.first))
        with self._reader.reading():
            both = self._sides()
            loaded = both.control.loaded(version)
        program = loaded.program
        resolved = resolve_range(
            program, loaded.debugged().sites, range, lambda file: len(self._reader.lines(version, file))
        )
        self._range, self._limit = range, limit
        self._views, self.columns = {}, Columns()
        both.ran = []
        return Begun(
            resolved.title, resolved.instances, self.first, self.end, program.interval_ns, version, resolved.note
        )  # fmt: skip

    def run(self, scan: int) -> tuple[Row, ...]:
        """See `Subject`."""
        if not self.first <= scan < self.end:
            raise Unreadable(f"scans {self.first} to {self.end - 1} can be verified: {scan} is none of them")

        gaps = self._reader.recording.gaps
        gap = gap_of(gaps, scan)
        if gap is not None:
            return (Row("none", scan, note=str(gap), compared=False),)

        def run() -> tuple[Row, ...]:
            both = self._sides()
            again = any(each.until == scan for each in gaps)
            if again or not (both.ran_last == scan - 1 and both.control.scan == scan):
                both.goto(scan)
            return both.run(scan, self._view)

        return self._guarded(scan, run)

    def step(self, scan: int, after: int, count: int) -> Row:
        """See `Subject`."""

        def step() -> Row:
            both = self._sides()
            both.goto(scan)
            return step_row(both, scan, (after, count), self._view)

        return self._guarded(scan, step)

    def uses(self, scan: int, call: int) -> tuple[Use, ...]:
        """See `Subject`."""
        self._again(scan)
        return self._guarded(scan, lambda: uses_of(self._sides(), call))

    def flows(self, scan: int, call: int, asked: FlowAsked) -> VerifyFlows:
        """See `Subject`."""
        self._again(scan)
        return self._guarded(scan, lambda: flows_of(self._sides(), call, asked))

    def inputs(self, scan: int, call: int) -> Mapping[str, Leaf]:
        """See `Subject`."""
        self._again(scan)
        return inputs_of(self._sides(), call)

    def edited(self, row: Row, edits: Mapping[str, Edit]) -> Row:
        """See `Subject`."""
        return edited_row(self._sides(), row, edits)

    def _sides(self) -> Both:
        if self._both is None:
            control = Control(self._reader)
            monitor = Monitor(self._reader.programs, control.side.resource.version)
            self._both = Both(self._reader, control, monitor)
        return self._both

    def _again(self, scan: int) -> None:
        """The scan ran last."""
        if self._sides().ran_last != scan or not self._sides().ran:
            self.run(scan)

    def _guarded(self, scan: int, run: Callable[[], T]) -> T:
        """What goes wrong with the file or the replay, as words. Whoever comes next begins again."""
        try:
            with self._reader.replaying(scan):
                return run()
        except Unreadable:
            self._both = None
            raise

    def _view(self, side: Side) -> View:
        """How the program that runs now is looked at."""
        version = side.resource.version
        if version not in self._views:
            program, sites = side.resource.program, side.resource.loaded.debugged().sites
            places = Places(program, sites, lambda file, line: self._reader.text(version, file, line))
            try:
                resolved = resolve_range(program, sites, self._range)
            except BadRange:  # a different program runs by now, which does not have the range
                resolved = Resolved("nothing", pous=frozenset(list(sites.bodies)[:1]))
            self._views[version] = View(Reader(Names(program, sites), places, self.columns), resolved, self._limit)
        return self._views[version]
