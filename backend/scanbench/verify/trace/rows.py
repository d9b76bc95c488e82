"""Rows of a verification against a trace: what the monitor used and came to, and what the trace says of it."""

import builtins
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from scanbench.engines.debug import Frame, Listen
from scanbench.runtime.trap import trap_info
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.names import ANYWHERE, NamesInside
from scanbench.symbols.values import format_value
from scanbench.verify.contract import ENDED, Input, Mismatch, Output, Place, Row, RowKind, Use
from scanbench.verify.ranges import Resolved
from scanbench.verify.rows import MAX_MISMATCHES, Reader, written_by
from scanbench.verify.trace.bind import Signal, Trace
from scanbench.verify.trace.monitor import Ran, Result, TraceMonitor
from scanbench.verify.trace.patches import put
from scanbench.verify.uses import Access, Pass

_HELD = "not in the trace: inputs held"
_TAKEN_OVER = "taken over from the trace, not compared"
_NOTHING = "the trace has no value to compare here"


class TraceRows:
    """Makes them."""

    def __init__(self, reader: Reader, trace: Trace) -> None:
        self._reader, self._trace = reader, trace
        self._given = {(each.symbol.offset, each.symbol.bit) for each in trace.inputs}
        self.unrecorded: dict[str, None] = {}
        """What rows have a result of and the trace has no column of."""

    def rows(self, passes: Sequence[Pass], ran: Ran, range: Resolved) -> tuple[Row, ...]:
        """Those of a scan."""
        note = _HELD if ran.recorded.row is None else _TAKEN_OVER if ran.recorded.taken_over else ""
        if range.whole:
            made = passes[0] if passes else Pass(None, 0, 0)
            self._first_of_the_log(made, ran.results)
            rows = [self._row("scan", made, 0, ran, ran.results)]
        else:
            last = [_last_used(passes, index, ran.results) for index in builtins.range(len(passes))]
            for made, results in zip(passes, last, strict=True):
                self._first_of_the_log(made, results)
            rows = [
                self._row("pass", made, call, ran, results)
                for call, (made, results) in enumerate(zip(passes, last, strict=True), 1)
            ]
        if ran.trap:
            rows = [*rows[:-1], self._trapped(rows[-1] if rows else Row("none", ran.recorded.scan), ran)]
        if not rows:
            rows = [Row("none", ran.recorded.scan, note="not run in this scan", compared=False)]
        return tuple(replace(each, note="; ".join(filter(None, (note, each.note)))) for each in rows)

    def _first_of_the_log(self, made: Pass, results: Sequence[Result]) -> None:
        """The columns that the log has come before those that only the monitor has."""
        names = self._reader.names.within(made.inside)
        for each in results:
            self._reader.used(_leaf(names, each.signal), True, each.found)
        for leaf, value in _read(self._reader, made).values():
            if (leaf.offset, leaf.bit) in self._given:
                self._reader.used(leaf, False, value)

    def shown(self, passes: Sequence[Pass], ran: Ran, range: Resolved) -> list[Signal]:
        """The outputs that the rows of a scan have."""
        if range.whole:
            return [each.signal for each in ran.results]
        return [each.signal for index in builtins.range(len(passes)) for each in _last_used(passes, index, ran.results)]

    def skipped(self, scan: int) -> Row:
        """Of a gap."""
        scans = self._trace.scans.of_rows
        last = next(each for each in scans if each > scan) - 1
        which = f"scan {scan} is" if last == scan else f"scans {scan} to {last} are"
        return Row("none", scan, note=f"{which} not in the trace: skipped", compared=False)

    def _row(self, kind: RowKind, made: Pass, call: int, ran: Ran, results: Sequence[Result]) -> Row:
        reader = self._reader
        names = reader.names.within(made.inside)
        known = {_leaf(names, each.signal).name: each for each in results}
        written = written_by(reader, made)
        outputs: dict[str, Output] = {}
        for name, result in known.items():
            if reader.used(_leaf(names, result.signal), True, result.found):
                outputs[name] = Output(_shown(result, ran), None if ran.recorded.taken_over else result.found)
        alone = {name: value for name, value in written.items() if name not in outputs}
        outputs |= {name: Output(None, value) for name, value in alone.items()}
        self.unrecorded |= dict.fromkeys(alone)
        differences = () if ran.recorded.taken_over else tuple(self._differences(names, made, known, ran.recorded.scan))
        place = reader.places.of(made.frames[0].site, made.frames) if made.frames else None
        note = f"record full: {len(made.log):,} of {made.used:,} uses kept" if made.full else ""
        path = reader.places.path(made.pou, made.instance)
        inputs = {
            name: Input(value) for name, (leaf, value) in _read(reader, made).items() if reader.used(leaf, False, value)
        }
        compared = any(None not in (each.control, each.monitor) for each in outputs.values())
        if kind == "pass" and made.full:  # which outputs are its own is not known
            compared = False
        elif not compared and ran.recorded.row is not None and not ran.recorded.taken_over:
            note = "; ".join(filter(None, (note, _NOTHING)))
        if not ran.recorded.taken_over:
            note = "; ".join(filter(None, (note, *_tolerated(known))))
        return Row(
            kind, ran.recorded.scan, call, 0, path, place, outputs, inputs, differences[:MAX_MISMATCHES], (), made.used, note,
            compared,
        )  # fmt: skip

    def _differences(
        self, names: NamesInside, made: Pass, results: Mapping[str, Result], scan: int
    ) -> Iterator[Mismatch]:  # fmt: skip
        """In the order in which the statements that wrote them ran; those that no statement wrote come last."""
        found = [
            (name, each, _last_use(made, each.signal, written=True)) for name, each in results.items() if not each.same
        ]
        found.sort(key=lambda each: len(made.log) if each[2] is None else each[2])
        for name, result, index in found:
            place = None if index is None else place_at(self._reader, made, index)
            yield _mismatch(name, result, place, scan)

    def _trapped(self, row: Row, ran: Ran) -> Row:
        """The monitor ended the scan by a run-time error, and the controller did not."""
        program, scan = self._reader.places.program, ran.recorded.scan
        info, place = trap_info(program, ran.trap, scan), self._reader.places.of_trap(ran.trap)
        message = f"the reference ended scan {scan} by a run-time error, at {info.file}:{info.line}: {info.message}"
        found = Mismatch("trap", "", b"", b"", place, message)
        note = "; ".join(filter(None, (row.note, f"{ENDED}: {info.message}")))
        return replace(row, differences=(found, *row.differences), note=note, compared=True)

    # ---- inside of a scan ---------------------------------------------------------------------------------------------

    def step(self, monitor: TraceMonitor, scan: int, span: tuple[int, int], range: Resolved) -> Row:
        """The row of one step of the monitor; `span` as in `verify.steps.step_row`. After the last one the results are compared.
        Before and after this call the monitor is in the seam before the scan."""
        hook = _Halt(span, range, monitor)
        ran = monitor.run_with(hook, Listen(count=1, every=True))
        place, following = (
            self._reader.places.of(each[0].site, each) if each else None for each in (hook.before, hook.frames)
        )
        over = not hook.frames
        results = ran.results if over else monitor.results(monitor.recorded(scan))
        names = self._reader.names.within(ANYWHERE)
        outputs, differences = {}, []
        for each in results:
            leaf = _leaf(names, each.signal)
            if self._reader.used(leaf, True, each.found):
                outputs[leaf.name] = Output(each.recorded if over else None, each.found)
            if over and not ran.recorded.taken_over and not each.same:
                differences.append(_mismatch(leaf.name, each, None, scan))
        monitor.back(ran)
        note = "end of the scan" if over else "a trace has values at the ends of scans only"
        if over and ran.recorded.taken_over:
            note = f"{note}; {_TAKEN_OVER}"
        told = over and not ran.recorded.taken_over
        compared = told and any(None not in (each.control, each.monitor) for each in outputs.values())
        row = Row(
            "step", scan, 0, hook.count, "" if place is None else place.instance, place, outputs, {}, tuple(differences),
            note=note, compared=compared, next=following,
        )  # fmt: skip
        return self._trapped(row, ran) if ran.trap else row

    def uses(self, made: Pass, ran: Ran, passes: Sequence[Pass]) -> tuple[Use, ...]:
        """Every use of a pass. The trace has values of inputs as they were read, and of outputs as they were written last."""
        names = self._reader.names.within(made.inside)
        inputs = {(each.symbol.offset, each.symbol.bit) for each in self._trace.inputs}
        written = {
            (result.signal.symbol.offset, result.signal.symbol.bit): (
                _last_use(made, result.signal, written=True),
                result,
            )
            for result in _last_used(passes, next(at for at, each in enumerate(passes) if each is made), ran.results)
        }
        found = []
        for index, access in enumerate(made.log):
            place = place_at(self._reader, made, index)
            for leaf in names.at(access.offset, access.size, access.bits):
                value = leaf.cut(access.value, access.offset)
                control: bytes | None = None
                last, result = written.get((leaf.offset, leaf.bit), (None, None))
                if access.written and result is not None and last == index:
                    control = result.recorded
                elif not access.written and (leaf.offset, leaf.bit) in inputs:
                    control = value
                found.append(Use(leaf.name, access.written, control, value, place))
        return tuple(found)

    # ---- set data -----------------------------------------------------------------------------------------------------

    def with_set(self, row: Row, passes: Sequence[Pass], again: Ran, edits: Mapping[str, bytes]) -> Row:
        """The row with what a run on edited inputs came to."""
        index = max(row.call - 1, 0)
        made = passes[index] if index < len(passes) else Pass(None, 0, 0)
        names = self._reader.names.within(made.inside)
        written = written_by(self._reader, made)
        values = _used_last(made, names) | written  # what was not written this time is what it was when it was read
        if row.kind == "scan":
            values |= {_leaf(names, each.signal).name: each.found for each in again.results}
        outputs = {name: replace(each, set=values.get(name)) for name, each in row.outputs.items()}
        outputs |= {name: Output(None, None, value) for name, value in written.items() if name not in outputs}
        inputs = {name: replace(each, set=edits.get(name)) for name, each in row.inputs.items()}
        note = "; ".join(filter(None, (row.note, f"set data: {ENDED}" if again.trap else "")))
        return replace(row, outputs=outputs, inputs=inputs, note=note)


class _Halt:
    """Halts at the end of a step."""

    def __init__(self, span: tuple[int, int], range: Resolved, monitor: TraceMonitor) -> None:
        self._after, self._until = span
        self._range, self._monitor = range, monitor
        self.before: tuple[Frame, ...] = ()
        """The open calls where it begins."""
        self.frames: tuple[Frame, ...] = ()
        """And where it ends; none at the end of the scan."""
        self.count = 0
        self._patches = monitor.inputs(monitor.scan)

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        if count == 1:
            put(self._monitor.side.memory, self._patches)
        if count < self._after:
            return False
        frames = self._monitor.side.resource.loaded.debugged().frames()
        if self._after and count == self._after:
            self.before = frames
            return False
        if count < self._until or not (self._until or self._range.holds(frames)):
            return False
        self.frames, self.count = frames, count
        return True

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""

    def entered(self) -> None:
        """See `Onlooker`."""


def leaves_read(reader: Reader, made: Pass) -> dict[str, Leaf]:
    """Where the inputs of a pass live."""
    return {name: leaf for name, (leaf, _) in _read(reader, made).items()}


def place_at(reader: Reader, made: Pass, index: int) -> Place:
    """Where a use happened; of a pass that was recorded in detail with its instance."""
    frames = made.frames_of[index] if index < len(made.frames_of) else ()
    return reader.places.of(made.log[index].site, frames)


def _read(reader: Reader, made: Pass) -> dict[str, tuple[Leaf, bytes]]:
    names = reader.names.within(made.inside)
    found: dict[str, tuple[Leaf, bytes]] = {}
    for access, mask in made.fresh():
        for leaf in names.at(access.offset, access.size, access.bits):
            at = leaf.offset - access.offset
            if leaf.passing or (mask is not None and not any(mask[at : at + leaf.type.size])):
                continue
            found.setdefault(leaf.name, (leaf, leaf.cut(access.value, access.offset)))
    return found


def _used_last(made: Pass, names: NamesInside) -> dict[str, bytes]:
    found: dict[str, bytes] = {}
    for access in made.log:
        for leaf in names.at(access.offset, access.size, access.bits):
            found[leaf.name] = leaf.cut(access.value, access.offset)
    return found


def _leaf(names: NamesInside, signal: Signal) -> Leaf:
    """The name that a pass has for a variable to which a column is mapped."""
    symbol, size = signal.symbol, signal.type.size
    for leaf in names.at(symbol.offset, size, 0xFF if symbol.bit is None else 1 << symbol.bit):
        if (leaf.offset, leaf.bit, leaf.type.size) == (symbol.offset, symbol.bit, size):
            return leaf
    return Leaf(signal.path, signal.type, symbol.offset, symbol.bit)


def _tolerated(results: Mapping[str, Result]) -> Iterator[str]:
    """Which results agree only because somebody allows it, or because rounded numbers leave it open."""
    allowed = [name for name, each in results.items() if each.agrees == "allowed"]
    left_open = [name for name, each in results.items() if each.agrees == "open"]
    if allowed:
        yield f"within the tolerance: {', '.join(allowed)}"
    if left_open:
        yield f"within what rounded numbers leave open: {', '.join(left_open)}"


def _shown(result: Result, ran: Ran) -> bytes | None:
    """A number that is written with fewer digits than it has is the one that was found."""
    if result.recorded is not None and result.exact and not ran.recorded.taken_over:
        return result.found
    return result.recorded


def _last_use(made: Pass, signal: Signal, written: bool) -> int | None:
    """The index of the last use of any of it; of the last that wrote any."""
    symbol = signal.symbol
    end, bits = symbol.offset + signal.type.size, 0xFF if symbol.bit is None else 1 << symbol.bit
    for index in range(len(made.log) - 1, -1, -1):
        access = made.log[index]
        there = access.offset < end and symbol.offset < access.offset + access.size and access.bits & bits
        if there and (access.written or not written):
            return index
    return None


def _last_used(passes: Sequence[Pass], index: int, results: Sequence[Result]) -> list[Result]:
    """The results that this pass wrote last; and those that differ, though it is the last that read them, and nobody wrote."""
    found = []
    for each in results:
        if all(_last_use(made, each.signal, written=True) is None for made in passes[index + 1 :]):
            read = _last_use(passes[index], each.signal, written=False)
            if _last_use(passes[index], each.signal, written=True) is not None or (
                read is not None and not each.same and _stays(passes[index].log[read], each)
            ):
                found.append(each)
    return found


def _stays(access: Access, result: Result) -> bool:
    """Whether it is at the end of the scan what it was when it was read."""
    symbol = result.signal.symbol
    at = symbol.offset - access.offset
    if symbol.bit is not None:
        return 0 <= at < access.size and bytes((access.value[at] >> symbol.bit & 1,)) == result.found
    return at >= 0 and access.value[at : at + result.signal.type.size] == result.found


def _mismatch(name: str, result: Result, place: Place | None, scan: int) -> Mismatch:
    signal, recorded = result.signal, result.recorded or b""
    was, right = format_value(signal.type, recorded), format_value(signal.type, result.found)
    where = "" if place is None else f", at {place.file}:{place.line}"
    text = f"{signal.path} is {was}, the reference gives {right}{where} in scan {scan}"
    return Mismatch(
        "logic", name, recorded, result.found, place, text, signal.type.name, signal.type.kind.value, signal.type.size
    )  # fmt: skip
