"""The trace of a controller that runs: samples are rows that come one after the other."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import Decimal

from scanbench.program.program import Program
from scanbench.program.types import Elementary, Kind
from scanbench.syntax.literals import UNITS_NS
from scanbench.verify.trace.axis import plain_name
from scanbench.verify.trace.bind import Breaks, Signal, Trace, check
from scanbench.verify.trace.clock import number
from scanbench.verify.trace.mapping import BadMapping, TraceMapping
from scanbench.verify.trace.scans import MAX_SCAN, Scans
from scanbench.verify.trace.table import Table, bad
from scanbench.verify.trace.values import REAL_DIGITS, Exactness, cell_value

MOST_CELLS = 2_000_000
MOST_SAMPLES = 100_000
TIME = "time [ms]"
"""The column with the time of each sample since the first one."""
LONGEST = 10_000
"""Scans from one sample to the next that the monitor runs. Beyond that it is as after a break, once; it cannot be so again and again."""


@dataclass(frozen=True, slots=True)
class Sample:
    """What a controller had at some time, as the cells of a row; those that are mapped to nothing may be empty."""

    cells: tuple[str, ...]
    after_break: bool = False
    """Nobody looked at the controller before it: the connection was lost, or samples were left out."""


def controller_table(address: str, columns: Sequence[str], cells: Sequence[str]) -> Table:
    """The first sample of a controller as a table, as if it came from a log: columns are those of the samples, with the time."""
    return Table(
        address, tuple(columns), (tuple(cells),), range(1), layout=address, from_start=False, durations="ms"
    )  # fmt: skip


def most_samples(columns: int) -> int:
    """Samples of one verification."""
    return min(MOST_SAMPLES, MOST_CELLS // max(columns, 1))


class GrowingTrace:
    """Its `trace` begins with the only row of a table; `add` appends to it, in place."""

    def __init__(self, table: Table, mapping: TraceMapping, program: Program) -> None:
        """Raises `BadMapping`: what does not fit."""
        if mapping.sampled == "begin":
            raise BadMapping(
                "A controller that runs is read between two scans: samples at the beginning of a scan are for files."
            )
        if not mapping.axis:
            raise BadMapping("Say which column is the scan or the time of a sample.")
        checked = check(table, replace(mapping, gaps="hold" if mapping.gaps == "refuse" else mapping.gaps), program)
        if checked.trace is None:
            told = [str(each) for each in checked.problems if not each.warning]
            more = f" And {len(told) - 3} more." if len(told) > 3 else ""
            raise BadMapping(f"The controller does not fit the program: {' '.join(told[:3])}{more}")
        self._table, self._mapping, self._program = table, mapping, program
        self._signals: list[tuple[Signal, int, list[bytes | None]]] = []
        """Each with the place of its column, and its values."""
        self._scans = list(checked.trace.scans.of_rows)
        self._breaks = Breaks()
        self._far = False
        """The last sample was too far from the one before it."""
        self.trace: Trace = replace(
            checked.trace, inputs=tuple(map(self._growing, checked.trace.inputs)),
            outputs=tuple(map(self._growing, checked.trace.outputs)), breaks=self._breaks,
            scans=Scans(self._scans, checked.trace.scans.cold, 0),
        )  # fmt: skip
        self._axis = table.columns.index(mapping.axis)
        self._first = self._moment(table.rows[0])
        self._late = max((each.tolerance.scans for each in self.trace.outputs), default=0)

    def _growing(self, signal: Signal) -> Signal:
        """With values that more can be added to, and that are exact: the protocol writes no digits."""
        values = list(signal.values)
        real = isinstance(signal.type, Elementary) and signal.type.kind is Kind.REAL
        single = real and signal.type.size == 4
        made = replace(signal, values=values, exactness=Exactness(REAL_DIGITS) if single else Exactness())
        self._signals.append((made, self._table.columns.index(signal.column), values))
        return made

    def until(self, last: bool = False) -> int:
        """Scans before this one can be compared: of later ones a value may still come in time, unless this is the last sample."""
        return self._scans[-1] + 1 if last else max(self._scans[-1] + 1 - self._late, self._scans[0] + 1)

    def after_break(self, scan: int) -> int | None:
        """The scan of the sample after the break that has this scan; None: it is in none."""
        return self._breaks.after(scan)

    def add(self, samples: Sequence[Sample]) -> None:
        """More rows; a further one of the same scan is left out. Raises `BadTraceFile`."""
        for each in samples:
            self._add(each)

    def _add(self, sample: Sample) -> None:
        scan, last = self._scan(sample.cells), self._scans[-1]
        if scan < last:
            raise bad(
                f"The controller was at scan {last:,}, and is at scan {scan:,} now: it was started again. Begin a new verification."
            )
        if scan == last:
            return
        far = scan - last > LONGEST and not sample.after_break
        if far and self._far:
            raise bad(
                f"The controller goes on by {scan - last:,} scans from one sample to the next, and at most {LONGEST:,} are run: "
                f"choose a shorter interval."
            )
        read = [
            self._cell(signal, sample.cells[at]) for signal, at, _ in self._signals
        ]  # all of them are right, or none is added
        for (_, _, values), value in zip(self._signals, read, strict=True):
            values.append(value)
        if scan > last + 1 and (sample.after_break or far):
            self._breaks.add(last + 1, scan)
        self._far = far
        self._scans.append(scan)

    def _cell(self, signal: Signal, text: str) -> bytes | None:
        if not text:
            return None
        try:
            return cell_value(signal.type, text, plain_name(signal.column)[1] or self._table.durations, comma=False)
        except ValueError as error:
            raise bad(
                f"{signal.path}: {error}. The controller has a different type there now.", None, signal.column
            ) from None

    def _scan(self, cells: Sequence[str]) -> int:
        if self._mapping.unit == "scan":
            return int(self._moment(cells))
        passed = (self._moment(cells) - self._first) * UNITS_NS[self._mapping.unit]
        return self._scans[0] + round(passed / self._program.interval_ns)

    def _moment(self, cells: Sequence[str]) -> Decimal:
        try:
            found = number(cells[self._axis], comma=False)
        except ValueError as error:
            raise bad(
                f"A sample needs its {'scan' if self._mapping.unit == 'scan' else 'time'}: {error}.",
                None,
                self._mapping.axis,
            ) from None
        if abs(found) > MAX_SCAN:
            raise bad(f"{found} is too large for the number of a scan, or for a time.", None, self._mapping.axis)
        return found
