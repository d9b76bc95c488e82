"""The monitor of a trace: the reference interpreter on the inputs that a real controller wrote down, scan by scan."""

import zlib
from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from scanbench.engines.debug import Listen
from scanbench.engines.engine import Reason, Stop
from scanbench.program.program import Program
from scanbench.recording.programs import reference
from scanbench.runtime.command import Patch
from scanbench.runtime.header import pass_time
from scanbench.runtime.inside import Onlooker
from scanbench.runtime.resource import Resource
from scanbench.verify.sides import Begin, Side
from scanbench.verify.trace.bind import Signal, Trace
from scanbench.verify.trace.lateness import Lateness
from scanbench.verify.trace.patches import Agrees, patch_of, put, value_of
from scanbench.verify.trace.rounding import NO_SPREAD, Rounding, Shift, Spread, narrowed
from scanbench.verify.uses import Recorder

EVERY = 200
"""Scans from one kept state to the next; more when there are many of them."""
MOST = 100


@dataclass(frozen=True, slots=True)
class Recorded:
    """What the trace says of a scan."""

    scan: int
    row: int | None
    """None: it has no row."""
    taken_over: bool = False
    """The trace begins here, or goes on after a gap: what it says is believed."""
    skipped: bool = False
    """It is in a gap in which nothing runs."""


@dataclass(frozen=True, slots=True)
class Result:
    """A mapped output at the end of a scan."""

    signal: Signal
    recorded: bytes | None
    """None: the trace has no value of it."""
    found: bytes
    agrees: Agrees = "same"
    """How: as it is written; within what somebody allows; within what rounded numbers leave open; or not."""

    @property
    def same(self) -> bool:
        """Whether there is nothing to say against it."""
        return self.agrees != "no"

    @property
    def exact(self) -> bool:
        """Whether the cell can mean the very value that the reference has."""
        return self.agrees == "same"


@dataclass(frozen=True, slots=True)
class Ran:
    """A scan of the monitor."""

    recorded: Recorded
    begin: Begin
    """Before it, inputs included."""
    trap: int
    """Number of the run-time error that ended it, or 0."""
    results: tuple[Result, ...]
    spread: Spread = NO_SPREAD


class TraceMonitor:
    """The monitor in the seam before a scan, with the state that it computed from a cold start and from recorded values."""

    def __init__(self, program: Program, trace: Trace) -> None:
        self.trace = trace
        self.side = Side(Resource(reference(1, program)))
        scans = trace.scans
        self.first, self.end = scans.first, scans.last + 1
        self._rows = {scan: row for row, scan in enumerate(scans.of_rows)}
        self._inputs = [(each, _filled(each.values)) for each in trace.inputs]
        if self.first:
            pass_time(self.side.memory, self.first, program.interval_ns)
        self._program = program
        self._kept: dict[int, bytes] = {}
        self._every = EVERY
        self._open = Rounding(self.side, trace)
        self._assumed: tuple[Patch, ...] = ()
        """What is put into memory after the first scan."""
        self._late = Lateness(trace)

    @property
    def scan(self) -> int:
        """The scan that is next."""
        return self.side.resource.header.scan

    def recorded(self, scan: int) -> Recorded:
        """What the trace says of a scan."""
        skips = self.trace.gaps == "skip"
        row = self._rows.get(scan)
        if row is None:
            return Recorded(scan, None, skipped=skips or self.trace.unseen(scan))
        begins = (scan == self.first and not self.trace.scans.cold) or (
            scan > self.first and scan - 1 not in self._rows and (skips or self.trace.unseen(scan - 1))
        )
        return Recorded(scan, row, taken_over=begins)

    def goto(self, scan: int) -> None:
        """To the seam before a scan of the trace."""
        if scan < self.scan or (scan == self.first and self._kept):
            kept = max((each for each in self._kept if each <= scan), default=None)
            assert kept is not None, "the first scan is always kept"
            state, *others = self._open.parts(zlib.decompress(self._kept[kept]), len(self.side.state))
            self.side.memory[: len(state)] = state
            self._open.take_up(others)
        while self.scan < scan:
            self.pass_scan()

    def grow(self) -> None:
        """The trace has more rows at its end."""
        rows = self.trace.scans.of_rows
        for row in range(len(self._rows), len(rows)):
            self._rows[rows[row]] = row
            for signal, filled in self._inputs:
                value = signal.values[row]
                filled.append(filled[-1] if value is None else value)
        self.end = self.trace.scans.last + 1
        self._skip()

    def assume(self, patches: Sequence[Patch]) -> None:
        """From now on these values are there after the first scan, beside those that are taken over."""
        self._assumed = tuple(patches)
        self._kept = {self.first: self._kept[self.first]}  # what comes after it is not the same any more
        self.goto(self.first)

    def pass_scan(self) -> None:
        """Runs the scan that is next, and nobody looks."""
        self.settle(self.run(None))

    def run(self, recorder: Recorder | None, edits: Mapping[int, Sequence[Patch]] | None = None) -> Ran:
        """Runs the next scan on recorded inputs; applies `edits` (pass -> patches) as each pass begins. Afterwards the monitor
        is at the end of this scan, until `settle` or `back` is called."""
        memory, recorded = self.side.memory, self.recorded(self.scan)
        self._keep()
        patches = self.inputs(recorded.scan)
        put(memory, patches)  # for the system program and the plant
        begin = self.side.begin()
        hook = recorder if recorder is not None else _Nobody()
        if isinstance(hook, Recorder) and edits:
            hook.on_begin = lambda number, made: put(memory, edits.get(number, ()))
        hook.on_first = lambda: put(memory, patches)  # a plant may have said something else
        spread = NO_SPREAD if edits else self._open.run(begin, lambda shift: self.inputs(recorded.scan, shift))
        return self._ran(recorded, begin, self.side.run(hook, hook.listen), spread)

    def run_with(self, hook: Onlooker, listen: Listen) -> Ran:
        """The same with a hook that gives the inputs itself, and may halt."""
        recorded = self.recorded(self.scan)
        self._keep()
        put(self.side.memory, self.inputs(recorded.scan))
        begin = self.side.begin()
        spread = self._open.run(begin, lambda shift: self.inputs(recorded.scan, shift))
        return self._ran(recorded, begin, self.side.run(hook, listen), spread)

    def _ran(self, recorded: Recorded, begin: Begin, stop: Stop, spread: Spread = NO_SPREAD) -> Ran:
        trap = stop.trap if stop.reason is Reason.TRAP else 0
        return Ran(recorded, begin, trap, self.results(recorded, spread), spread)

    def results(self, recorded: Recorded, spread: Spread = NO_SPREAD) -> tuple[Result, ...]:
        """The mapped outputs as they are now."""
        row = recorded.row
        found = []
        for at, each in enumerate(self.trace.outputs):
            was, now = None if row is None else each.values[row], value_of(each, self.side.memory)
            agrees: Agrees = "same"
            if was is not None and not recorded.taken_over and not each.exactness.same(each.type, was, now):
                agrees = self._judge(at, each, was, now, recorded.scan, spread)
            found.append(Result(each, was, now, agrees))
        return tuple(found)

    def _judge(self, at: int, signal: Signal, was: bytes, now: bytes, scan: int, spread: Spread) -> Agrees:
        """How a value that differs agrees, if it does."""
        if signal.tolerance.allows(signal.type, was, now):
            return "allowed"
        if spread.leaves_open(signal, was, now):
            return "open"
        if signal.tolerance.scans and self._late.allows(
            at, was, now, scan, lambda: self._ahead(at, signal.tolerance.scans)
        ):
            return "allowed"
        return "no"

    def _ahead(self, at: int, scans: int) -> list[bytes]:
        """What an output is in the scans after this one, if nobody corrects the monitor. Afterwards it is where it was."""
        side, signal = self.side, self.trace.outputs[at]
        here = side.begin()
        found: list[bytes] = []
        try:
            while len(found) < scans and self.scan < self.end and not self.recorded(self.scan).skipped:
                patches = self.inputs(self.scan)
                put(side.memory, patches)
                nobody = _Nobody()
                nobody.on_first = lambda patches=patches: put(side.memory, patches)  # type: ignore[misc]
                if side.run(nobody, nobody.listen).reason is Reason.TRAP:
                    break
                found.append(value_of(signal, side.memory))
        finally:
            side.restore(here)
        return found

    def back(self, ran: Ran) -> None:
        """Restores the beginning of a scan."""
        self.side.restore(ran.begin)

    def settle(self, ran: Ran) -> None:
        """Completes the scan: takes over the recorded values of the controller where they differ."""
        memory = self.side.memory
        if ran.trap:
            pass_time(memory, 1, self._program.interval_ns)
        self._late.note(ran.recorded.scan, [each.found for each in ran.results])
        self._open.settle(ran.spread, ran.results, ran.recorded.taken_over)
        for each in ran.results:
            if each.recorded is not None and (ran.recorded.taken_over or not each.same):
                put(memory, [patch_of(each.signal, each.recorded)])
            elif each.recorded is not None and each.agrees == "open":
                put(memory, [patch_of(each.signal, narrowed(each.signal, each.recorded, each.found))])
        if ran.recorded.scan == self.first and self._assumed:
            put(memory, self._assumed)
            self._open.put(self._assumed)
        self._skip()

    def _skip(self) -> None:
        """Over a gap in which nothing runs."""
        if self.scan >= self.end or not self.recorded(self.scan).skipped:
            return
        rows = self.trace.scans.of_rows
        pass_time(self.side.memory, rows[bisect_right(rows, self.scan)] - self.scan, self._program.interval_ns)

    def _keep(self) -> None:
        """This state, where it is time."""
        scan = self.scan
        if self._kept and scan < max(self._kept) + self._every:
            return
        self._kept[scan] = zlib.compress(b"".join((self.side.state, *self._open.memories)), 1)
        if len(self._kept) > MOST:
            self._every *= 2
            self._kept = {each: self._kept[each] for each in sorted(self._kept)[::2]}

    def inputs(self, scan: int, shift: Shift | None = None) -> list[Patch]:
        """What the monitor gets in a scan: what the trace says last, or what a run makes of it."""
        row = bisect_right(self.trace.scans.of_rows, scan) - 1
        values = ((signal, filled[row]) for signal, filled in self._inputs)
        return [
            patch_of(signal, value if shift is None else shift(signal, value))
            for signal, value in values
            if value is not None
        ]


class _Nobody:
    """Waits for the first statement of the scan."""

    listen = Listen(count=1)

    def __init__(self) -> None:
        self.on_first: Callable[[], None] = _nothing

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        self.on_first()
        return False

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""

    def entered(self) -> None:
        """See `Onlooker`."""


def _nothing() -> None:
    pass


def _filled(values: Sequence[bytes | None]) -> list[bytes | None]:
    """An input without a value stays as it was."""
    found: list[bytes | None] = []
    last: bytes | None = None
    for value in values:
        last = last if value is None else value
        found.append(last)
    return found
