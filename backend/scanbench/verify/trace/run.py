"""Verification against a trace of a real controller: the same questions and answers as `Verifier`, without a run file."""

from collections.abc import Mapping, Sequence
from difflib import get_close_matches

from scanbench.problems import perhaps
from scanbench.program.program import Program
from scanbench.program.types import StringType
from scanbench.recording.reader import Unreadable
from scanbench.symbols.names import Names
from scanbench.symbols.values import parse_value
from scanbench.verify.contract import DEFAULT_LIMIT, Column, Range, Row, ScanVerified, Use
from scanbench.verify.edits import BadEdit, Edit
from scanbench.verify.places import Places
from scanbench.verify.ranges import Resolved, resolve_range
from scanbench.verify.rows import Columns, Reader
from scanbench.verify.trace.bind import Trace, check
from scanbench.verify.trace.mapping import BadMapping, TraceMapping
from scanbench.verify.trace.monitor import Ran, TraceMonitor
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.rows import TraceRows, leaves_read
from scanbench.verify.uses import Pass, Recorder
from scanbench.verify.verifier import Begun


def open_trace(
    data: bytes, name: str, mapping: str, program: Program, sources: Mapping[str, str] | None = None
) -> "TraceVerifier":  # fmt: skip
    """Reads, maps and checks a file. Raises `BadTraceFile`, or `BadMapping` with the first of what does not fit."""
    table = read_trace(data, name)
    checked = check(table, TraceMapping.from_json(mapping), program)
    if checked.trace is None:
        told = [str(each) for each in checked.problems if not each.warning]
        more = f" And {len(told) - 3} more." if len(told) > 3 else ""
        raise BadMapping(f"The trace does not fit: {' '.join(told[:3])}{more}")
    return TraceVerifier(program, checked.trace, name, sources, table.note)


class TraceVerifier:
    """The monitor on the inputs of a trace, and what it comes to beside what the trace says. One thread."""

    def __init__(
        self, program: Program, trace: Trace, name: str = "", sources: Mapping[str, str] | None = None, note: str = ""
    ) -> None:  # fmt: skip
        """`sources`: the project's files, for the lines that differences are told with."""
        self.program, self.trace, self.name = program, trace, name or trace.name
        self._note = note
        self._monitor = TraceMonitor(program, trace)
        self._texts = {file: text.splitlines() for file, text in (sources or {}).items()}
        sites = self._monitor.side.resource.loaded.debugged().sites
        self._sites = sites
        self._reader = Reader(Names(program, sites), Places(program, sites, self._line), Columns())
        self._range = Resolved("the whole scan")
        self._limit = DEFAULT_LIMIT
        self._edits: dict[tuple[int, int], dict[str, Edit]] = {}
        self._rows = TraceRows(self._reader, trace)

    def __enter__(self) -> "TraceVerifier":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """There is nothing to let go of."""

    @property
    def first(self) -> int:
        """The trace's first scan, ..."""
        return self._monitor.first

    @property
    def end(self) -> int:
        """... and the one behind its last."""
        return self._monitor.end

    @property
    def columns(self) -> Mapping[str, Column]:
        """Those of all rows so far."""
        return self._reader.columns.all

    def follow(self, until: int) -> None:
        """A trace does not grow."""

    def begin(self, range: Range, limit: int = DEFAULT_LIMIT, scan: int | None = None) -> Begun:
        """From now on this range; `BadRange`."""
        self._range = resolve_range(self.program, self._sites, range, lambda file: len(self._texts.get(file, ())))
        self._limit = limit
        self._reader.columns = Columns()
        self._edits = {}
        notes = [self._range.note, self._note, self._beginning()]
        return Begun(
            self._range.title, self._range.instances, self.first, self.end, self.program.interval_ns, 1,
            " ".join(each for each in notes if each),
        )  # fmt: skip

    def _beginning(self) -> str:
        if self.trace.scans.cold:
            return ""
        return f"The trace begins in the middle of a run: the values of scan {self.first} are taken over, and compared behind it."

    # ---- scans --------------------------------------------------------------------------------------------------------

    def verify(self, scan: int) -> ScanVerified:
        """What came of a scan; any order, consecutive is fastest. `Unreadable`."""
        recorded = self._monitor.recorded(self._known(scan))
        if recorded.skipped:
            first = self._monitor.recorded(scan - 1).row is not None
            return self._told(scan, (self._rows.skipped(scan),) if first else ())
        rows, _, ran = self._run(scan)
        rows = tuple(self._with_edits(row, ran) for row in rows)
        self._monitor.back(ran)
        self._monitor.goto(scan + 1)
        return self._told(scan, rows)

    def step(self, scan: int, count: int) -> ScanVerified:
        """The monitor in front of a statement: the trace says nothing of what was inside of a scan."""
        recorded = self._monitor.recorded(self._known(scan))
        if recorded.skipped:
            return self._told(scan, (self._rows.skipped(scan),))
        monitor = self._monitor
        monitor.goto(scan)
        row = self._rows.step(monitor, scan, count, self._range)
        return self._told(scan, (row,))

    def uses(self, scan: int, call: int) -> tuple[Use, ...]:
        """The used-variable record of one pass. What the trace has no value of is None on its side."""
        if self._monitor.recorded(self._known(scan)).skipped:
            return ()
        _, recorder, ran = self._run(scan, detail=True)
        self._monitor.back(ran)
        made = self._pass(recorder, scan, call)
        return self._rows.uses(made, ran, recorder.passes)

    def _known(self, scan: int) -> int:
        if not self.first <= scan < self.end:
            raise Unreadable(f"scan {scan} is not in the trace: it has scans {self.first} to {self.end - 1}")
        return scan

    def _run(self, scan: int, detail: bool = False) -> tuple[tuple[Row, ...], Recorder, Ran]:
        """The rows of a scan; the monitor stands behind it, not settled."""
        self._monitor.goto(scan)
        recorder = self._recorder(detail)
        ran = self._monitor.run(recorder)
        rows = self._rows.rows(recorder.passes, ran, self._range)
        if not detail and any(row.differs for row in rows):  # who wrote it is asked for then only
            self._monitor.back(ran)
            return self._run(scan, detail=True)
        return rows, recorder, ran

    def _recorder(self, detail: bool = False) -> Recorder:
        return Recorder(self._monitor.side.resource, self._reader.names, self._range, self._limit, detail)

    def _told(self, scan: int, rows: tuple[Row, ...]) -> ScanVerified:
        columns, inputs, outputs = self._reader.columns.take()
        return ScanVerified(scan, rows, columns, inputs, outputs, max((row.used for row in rows), default=0))

    # ---- set data -----------------------------------------------------------------------------------------------------

    def set_inputs(self, edits: Sequence[tuple[int, int, str, str]]) -> tuple[Row, ...]:
        """(scan, call, column, value as typed; empty takes it back): the monitor runs these passes on edited inputs too, which
        changes nothing but A' on set data. `BadEdit`: then nothing is edited."""
        wanted: dict[tuple[int, int], dict[str, Edit]] = {}
        for scan, call, column, text in edits:
            key = scan, call
            if key not in wanted:
                wanted[key] = dict(self._edits.get(key, {}))
            if text.strip():
                wanted[key][column] = self._edit(scan, call, column, text)
            else:
                wanted[key].pop(column, None)
        self._edits.update(wanted)
        rows = []
        for scan, call in wanted:
            all, _, ran = self._run(scan)
            rows += [self._with_edits(row, ran) for row in all if row.call == call]
            self._monitor.back(ran)
        self._edits = {key: each for key, each in self._edits.items() if each}
        return tuple(rows)

    def _edit(self, scan: int, call: int, column: str, text: str) -> Edit:
        try:
            if self._monitor.recorded(self._known(scan)).skipped:
                raise BadEdit(f"scan {scan} is not in the trace: nothing runs there")
        except Unreadable as error:
            raise BadEdit(str(error)) from None
        _, recorder, ran = self._run(scan)
        self._monitor.back(ran)
        known = leaves_read(self._reader, self._pass(recorder, scan, call))
        leaf = known.get(column)
        if leaf is None:
            near = tuple(get_close_matches(column, known, 3, 0.5))
            raise BadEdit(f"`{column}` is no input of scan {scan}, call {call}.{perhaps(near)}", near)
        try:
            value = parse_value(leaf.type, text)
        except ValueError as error:
            raise BadEdit(f"{column}: {error}") from None
        return Edit(leaf, value.ljust(leaf.type.size, b"\0") if isinstance(leaf.type, StringType) else value)

    def _pass(self, recorder: Recorder, scan: int, call: int) -> Pass:
        index = 0 if self._range.whole else call - 1
        if not 0 <= index < len(recorder.passes):
            raise BadEdit(f"scan {scan} has no run {call} through the range: it has {len(recorder.passes)}")
        return recorder.passes[index]

    def _with_edits(self, row: Row, ran: Ran) -> Row:
        """With what the monitor comes to on set data, if there is any."""
        edits = self._edits.get((row.scan, row.call))
        if not edits or row.kind not in ("pass", "scan"):
            return row
        index = 0 if self._range.whole else row.call - 1
        self._monitor.back(ran)
        recorder = self._recorder()
        again = self._monitor.run(recorder, {index: [each.patch for each in edits.values()]})
        return self._rows.with_set(row, recorder.passes, again, {name: each.value for name, each in edits.items()})

    def _line(self, file: str, line: int) -> str:
        lines = self._texts.get(file, [])
        return lines[line - 1].strip() if 0 < line <= len(lines) else ""
