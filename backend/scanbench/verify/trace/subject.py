"""Verification against a controller log: the same questions and answers as for a recorded run."""

from collections.abc import Iterator, Mapping

from scanbench.debug.flow_shown import FlowAsked
from scanbench.program.program import Program
from scanbench.recording.reader import Unreadable
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.names import Names
from scanbench.verify.contract import DEFAULT_LIMIT, MAX_LIMIT, Begun, Range, Row, Use, VerifyCoverage, VerifyFlows
from scanbench.verify.edits import BadEdit, Edit
from scanbench.verify.places import Places
from scanbench.verify.ranges import Resolved, resolve_range
from scanbench.verify.rows import Columns, Reader
from scanbench.verify.trace.assume import Assumed, assume
from scanbench.verify.trace.bind import Trace, check
from scanbench.verify.trace.coverage import Tally
from scanbench.verify.trace.mapping import BadMapping, TraceMapping
from scanbench.verify.trace.monitor import Ran, Recorded, TraceMonitor
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.rows import TraceRows, leaves_read
from scanbench.verify.uses import Pass, Recorder
from scanbench.verify.verifier import Verifier


def open_trace(
    data: bytes, name: str, mapping: str, program: Program, sources: Mapping[str, str] | None = None
) -> Verifier:  # fmt: skip
    """Reads, maps and checks a file. Raises `BadTraceFile`, or `BadMapping` with the first of what does not fit."""
    table = read_trace(data, name)
    checked = check(table, TraceMapping.from_json(mapping), program)
    if checked.trace is None:
        told = [str(each) for each in checked.problems if not each.warning]
        more = f" And {len(told) - 3} more." if len(told) > 3 else ""
        raise BadMapping(f"The trace does not fit: {' '.join(told[:3])}{more}")
    return Verifier(TraceSubject(program, checked.trace, sources, table.note))


class TraceSubject:
    """See `Subject`: the monitor runs on the inputs of a controller log, and its results are compared with those of the log."""

    def __init__(
        self, program: Program, trace: Trace, sources: Mapping[str, str] | None = None, note: str = ""
    ) -> None:  # fmt: skip
        """`sources`: the project's files, for the lines that differences are told with."""
        self._program, self._trace, self._note = program, trace, note
        self._monitor = TraceMonitor(program, trace)
        self._texts = {file: text.splitlines() for file, text in (sources or {}).items()}
        self._sites = self._monitor.side.resource.loaded.debugged().sites
        self._reader = Reader(Names(program, self._sites), Places(program, self._sites, self._line), Columns())
        self._range = Resolved("the whole scan")
        self._limit = DEFAULT_LIMIT
        self._rows = TraceRows(self._reader, trace)
        self._tally = Tally(program, self._sites, trace)
        self._assumed: tuple[Assumed, ...] | None = None
        self._read: dict[str, Leaf] = {}
        """What the second scan reads before it writes it."""
        self._last: tuple[Recorder, Ran] | None = None
        """The scan that was run last. The monitor is in the seam before this or a different scan."""

    def close(self) -> None:
        """There is nothing to let go of."""

    @property
    def first(self) -> int:
        """The trace's first scan, ..."""
        return self._monitor.first

    @property
    def end(self) -> int:
        """... and the one after its last."""
        return self._monitor.end

    @property
    def columns(self) -> Columns:
        """See `Subject`."""
        return self._reader.columns

    @property
    def coverage(self) -> VerifyCoverage:
        """See `Subject`."""
        return self._tally.made(self._rows.unrecorded)

    def follow(self, until: int) -> None:
        """The trace of a controller that runs has more rows; any other one does not grow."""
        self._monitor.grow()

    def begin(self, range: Range, limit: int, scan: int | None) -> Begun:
        """See `Subject`."""
        self._range = resolve_range(self._program, self._sites, range, lambda file: len(self._texts.get(file, ())))
        self._limit = limit
        self._reader.columns = Columns()
        self._tally = Tally(self._program, self._sites, self._trace)
        self._rows.unrecorded.clear()
        self._last = None
        notes = [self._range.note, self._note, *self._beginning()]
        return Begun(
            self._range.title, self._range.instances, self.first, self.end, self._program.interval_ns, 1,
            " ".join(each for each in notes if each),
        )  # fmt: skip

    def _beginning(self) -> Iterator[str]:
        """What is to be said of where the trace begins. Afterwards the monitor has what it is to begin with."""
        if self._trace.scans.cold:
            return
        yield f"The trace begins in the middle of a run: the values of scan {self.first} are taken over, and compared after it."
        second = self.first + 1
        if second >= self.end or self._monitor.recorded(second).row is None:
            return
        if self._assumed is None:
            self._monitor.goto(second)
            recorder = Recorder(self._monitor.side.resource, self._reader.names, Resolved(""), MAX_LIMIT)
            ran = self._monitor.run(recorder)
            self._read = {
                name: leaf for made in recorder.passes for name, leaf in leaves_read(self._reader, made).items()
            }
            self._monitor.back(ran)
            self._assumed = assume(self._monitor, self._tally.remember(self._read).items())
            self._monitor.assume([each.patch for each in self._assumed])
        self._tally.remember(self._read)
        self._tally.assume(self._assumed)
        if self._assumed:
            yield f"The log does not have what the program remembers, but its first rows tell: {', '.join(map(str, self._assumed))}."
        left = len(self._tally.remembered)
        if left:
            yield (
                f"{left} variables that the program remembers are not in the log: they begin as after a cold start, so "
                "differences may come from that."
            )

    def run(self, scan: int) -> tuple[Row, ...]:
        """See `Subject`."""
        recorded = self._recorded(scan)
        if recorded.skipped:
            first = self._monitor.recorded(scan - 1).row is not None
            return (self._rows.skipped(scan),) if first else ()
        rows, recorder, ran = self._run(scan)
        self._last = recorder, ran
        self._tally.read(
            self._whole(leaf) for made in recorder.passes for leaf in leaves_read(self._reader, made).values()
        )
        self._tally.add(ran, self._rows.shown(recorder.passes, ran, self._range))
        return rows

    def step(self, scan: int, after: int, count: int) -> Row:
        """The monitor after a statement: the trace says nothing of what was inside of a scan."""
        if self._recorded(scan).skipped:
            return self._rows.skipped(scan)
        self._monitor.goto(scan)
        return self._rows.step(self._monitor, scan, (after, count), self._range)

    def uses(self, scan: int, call: int) -> tuple[Use, ...]:
        """What the trace has no value of is None on its side."""
        if self._recorded(scan).skipped:
            return ()
        _, recorder, ran = self._run(scan, detail=True)
        return self._rows.uses(self._pass(recorder, scan, call), ran, recorder.passes)

    def flows(self, scan: int, call: int, asked: FlowAsked) -> VerifyFlows:
        """A trace says nothing of what the elements of the controller saw."""
        raise BadEdit(f"a trace has no power of elements: of scan {scan} its outputs are compared")

    def inputs(self, scan: int, call: int) -> Mapping[str, Leaf]:
        """See `Subject`."""
        if not self.first <= scan < self.end or self._monitor.recorded(scan).skipped:
            raise BadEdit(f"scan {scan} is not in the trace: nothing runs there")
        return leaves_read(self._reader, self._pass(self._ran(scan)[0], scan, call))

    def edited(self, row: Row, edits: Mapping[str, Edit]) -> Row:
        """See `Subject`."""
        if row.kind not in ("pass", "scan"):
            return row
        _, ran = self._ran(row.scan)
        self._monitor.back(ran)
        recorder = self._recorder()
        again = self._monitor.run(recorder, {self._index(row.call): [each.patch for each in edits.values()]})
        made = self._rows.with_set(row, recorder.passes, again, {name: each.value for name, each in edits.items()})
        self._monitor.back(ran)
        return made

    def _recorded(self, scan: int) -> Recorded:
        if not self.first <= scan < self.end:
            raise Unreadable(f"scan {scan} is not in the trace: it has scans {self.first} to {self.end - 1}")
        return self._monitor.recorded(scan)

    def _ran(self, scan: int) -> tuple[Recorder, Ran]:
        """A scan that was run, the one that was run last if that is it."""
        if self._last is None or self._last[1].recorded.scan != scan:
            _, recorder, ran = self._run(scan)
            self._last = recorder, ran
        return self._last

    def _run(self, scan: int, detail: bool = False) -> tuple[tuple[Row, ...], Recorder, Ran]:
        """The rows of a scan. Afterwards the monitor is in the seam before it."""
        self._monitor.goto(scan)
        recorder = self._recorder(detail)
        ran = self._monitor.run(recorder)
        rows = self._rows.rows(recorder.passes, ran, self._range)
        self._monitor.back(ran)
        if not detail and any(row.differs for row in rows):  # who wrote it is asked for then only
            return self._run(scan, detail=True)
        return rows, recorder, ran

    def _whole(self, leaf: Leaf) -> Leaf:
        """With its name in the program, where it has another one inside of a range."""
        path = self._reader.names.at(leaf.offset, leaf.type.size, 0xFF if leaf.bit is None else 1 << leaf.bit)
        return next((each for each in path if each.bit == leaf.bit), leaf)

    def _recorder(self, detail: bool = False) -> Recorder:
        return Recorder(self._monitor.side.resource, self._reader.names, self._range, self._limit, detail)

    def _index(self, call: int) -> int:
        return 0 if self._range.whole else call - 1

    def _pass(self, recorder: Recorder, scan: int, call: int) -> Pass:
        if not 0 <= self._index(call) < len(recorder.passes):
            raise BadEdit(f"scan {scan} has no run {call} through the range: it has {len(recorder.passes)}")
        return recorder.passes[self._index(call)]

    def _line(self, file: str, line: int) -> str:
        lines = self._texts.get(file, [])
        return lines[line - 1].strip() if 0 < line <= len(lines) else ""
