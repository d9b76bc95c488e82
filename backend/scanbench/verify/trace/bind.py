"""A table and its mapping, checked against a program: what the monitor is to be given in each scan, and what is compared."""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches

from scanbench.problems import perhaps
from scanbench.program.program import Program
from scanbench.program.types import Elementary, StringType
from scanbench.symbols.sites import sites_of
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.verify.trace.axis import axis_of, bare_name, plain_name
from scanbench.verify.trace.mapping import ColumnMap, Gaps, TraceMapping, bits_of, written
from scanbench.verify.trace.scans import Scans, place
from scanbench.verify.trace.table import Problems, Table, TraceProblem
from scanbench.verify.trace.values import Exactness, Leaf, Tolerance, cell_value, exactness


@dataclass(frozen=True, slots=True)
class Signal:
    """A column that is a variable."""

    column: str
    path: str
    """As the program calls it."""
    symbol: Symbol
    type: Leaf
    values: Sequence[bytes | None]
    """Of each row; None: it has no value there."""
    exactness: Exactness = field(default_factory=Exactness)
    tolerance: Tolerance = field(default_factory=Tolerance)


class Breaks:
    """Stretches in which nobody looked at the controller: nothing is run there, and the row after one is taken over."""

    def __init__(self) -> None:
        self._firsts: list[int] = []
        self._afters: list[int] = []

    def add(self, first: int, after: int) -> None:
        """One more, later than all others: its first scan, and that of the row after it."""
        self._firsts.append(first)
        self._afters.append(after)

    def after(self, scan: int) -> int | None:
        """The scan of the row after the stretch that has this one; None: it is in none."""
        at = bisect_right(self._firsts, scan) - 1
        return self._afters[at] if at >= 0 and scan < self._afters[at] else None


@dataclass(frozen=True, slots=True)
class Trace:
    """A controller log whose columns are mapped to variables: each row is a scan."""

    name: str
    scans: Scans
    gaps: Gaps
    inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]
    ignored: tuple[str, ...] = ()
    """Columns that are mapped to nothing: they were not compared."""
    breaks: Breaks = field(default_factory=Breaks)

    def unseen(self, scan: int) -> bool:
        """Whether it lies in such a stretch."""
        return self.breaks.after(scan) is not None


@dataclass(frozen=True, slots=True)
class Checked:
    """What came of it. `trace` is there if it is `ok`."""

    problems: tuple[TraceProblem, ...]
    first: int | None
    last: int | None
    missing: int
    trace: Trace | None

    @property
    def ok(self) -> bool:
        """Whether the trace can be run: warnings do not hinder it."""
        return self.trace is not None


def check(table: Table, mapping: TraceMapping, program: Program) -> Checked:
    """All that is wrong with it, and the trace if nothing is."""
    problems = Problems()
    _check_columns(table, mapping, problems)
    known = _resolved(table, mapping, program, problems)
    _check_overlaps(table, known, problems)
    placed = None
    if not mapping.axis or mapping.axis in table.columns:
        placed = place(table, mapping.axis, mapping.unit, program.interval_ns, mapping.gaps, problems)
    rows = table if placed is None else placed.table
    signals = {each.column: _signal(rows, each, symbol, problems) for each, symbol in known}
    hindered = problems.any
    _warn(table, known, program, problems)
    trace = None
    if placed is not None and not hindered:
        inputs = tuple(signals[each.column] for each, _ in known if each.role == "input")
        outputs = tuple(
            _within(signals[each.column], each, mapping, placed.scans, program.interval_ns)
            for each, _ in known
            if each.role == "output"
        )
        ignored = tuple(
            each.column for each in mapping.columns if each.role == "ignore" and each.column != mapping.axis
        )
        trace = Trace(table.name, placed.scans, mapping.gaps, inputs, outputs, ignored)
    if placed is None:
        return Checked(tuple(problems.found), None, None, 0, trace)
    scans = placed.scans
    return Checked(tuple(problems.found), scans.first, scans.last, scans.missing, trace)


def _within(signal: Signal, column: ColumnMap, mapping: TraceMapping, scans: Scans, interval_ns: int) -> Signal:
    """An output with what it may differ by, and with its values in the scans that gave them."""
    values = signal.values
    if mapping.sampled == "begin":  # what is there before a scan is what the scan before has left
        follows = [after == scan + 1 for scan, after in zip(scans.of_rows, scans.of_rows[1:], strict=False)]
        values = [value if one else None for value, one in zip(signal.values[1:], follows, strict=True)] + [None]
    tolerance = Tolerance(column.absolute, column.relative, round(column.late_ms * 1e6 / interval_ns))
    return replace(signal, values=values, tolerance=tolerance)


def _check_columns(table: Table, mapping: TraceMapping, problems: Problems) -> None:
    """The names in the mapping, and those in the table that it says nothing of."""
    if mapping.axis and mapping.axis not in table.columns:
        problems.add(
            table.header,
            mapping.axis,
            f"The file has no such column for scan or time.{_meant(mapping.axis, table.columns)}",
        )
    named: set[str] = set()
    for each in mapping.columns:
        if each.column in named:
            problems.add(table.header, each.column, "The mapping has this column twice.")
        named.add(each.column)
        if each.column not in table.columns and each.role != "ignore":
            problems.add(table.header, each.column, f"The file has no such column.{_meant(each.column, table.columns)}")
        if each.column == mapping.axis and each.role != "ignore":
            problems.add(table.header, each.column, "The column is the scan or time of its row, so it is no variable.")
    for column in table.columns:
        if column not in named and column != mapping.axis and axis_of(column) is None:
            problems.add(
                table.header, column, "The mapping says nothing of this column: map it to a variable, or ignore it."
            )
    if not any(each.role == "output" for each in mapping.columns):
        problems.add(None, "", "No column is an output of the program, so there is nothing to compare.")


def _resolved(
    table: Table, mapping: TraceMapping, program: Program, problems: Problems
) -> list[tuple[ColumnMap, Symbol]]:
    """The columns that are variables, with these."""
    found = []
    for each in mapping.columns:
        if each.role == "ignore" or each.column not in table.columns or each.column == mapping.axis:
            continue
        try:
            symbol = resolve(program, each.path or bare_name(each.column))
        except UnknownPath as error:
            why = error.message if each.path else f"Nothing in the program is called `{each.column}`."
            problems.add(
                table.header, each.column, f"{why}{_near(error.near)} Map it to a variable, or ignore the column.",
                near=error.near[:3],
            )  # fmt: skip
            continue
        if not each.path:
            message = f"The column is mapped to nothing. Did you mean `{symbol.path}`?"
            problems.add(table.header, each.column, message, near=(symbol.path,))
            continue
        why = _unfit(symbol, each)
        if why:
            problems.add(table.header, each.column, why)
        else:
            found.append((each, symbol))
    return found


def _unfit(symbol: Symbol, column: ColumnMap) -> str:
    if not isinstance(symbol.type, Elementary | StringType):
        return f"`{symbol.path}` is {symbol.type}, which has no single value: map the column to one of its members."
    if symbol.slots:
        return f"`{symbol.path}` leads through an in-out or a reference: map the column to the variable that is passed there."
    if symbol.constant and column.role == "input":
        return f"`{symbol.path}` is a constant: it cannot be an input."
    return ""


def _check_overlaps(table: Table, known: Sequence[tuple[ColumnMap, Symbol]], problems: Problems) -> None:
    """Two columns must not say what one variable is."""
    taken: dict[int, ColumnMap] = {}
    for each, symbol in known:
        other = next((taken[bit] for bit in bits_of(symbol) if bit in taken), None)
        taken.update(dict.fromkeys(bits_of(symbol), each))
        if other is not None:
            message = (
                f"`{symbol.path}` is what column `{other.column}` is mapped to (`{other.path}`): keep one of them."
            )
            problems.add(table.header, each.column, message)


def _signal(table: Table, column: ColumnMap, symbol: Symbol, problems: Problems) -> Signal:
    index, unit = table.columns.index(column.column), plain_name(column.column)[1] or table.durations
    type = symbol.type
    assert isinstance(type, Elementary | StringType)
    known: dict[str, bytes | None] = {"": None}
    wrong: dict[str, str] = {}
    values: list[bytes | None] = []
    for row, at in zip(table.rows, table.numbers, strict=True):
        text = row[index]
        if text not in known:
            try:
                known[text] = cell_value(type, text, unit, table.comma)
            except ValueError as error:
                known[text], wrong[text] = None, f"{symbol.path}: {error}."
        if text in wrong:
            problems.add(at, column.column, wrong[text], cause="cell")
        values.append(known[text])
    return Signal(column.column, symbol.path, symbol, type, values, exactness(type, [*known], unit))


def _warn(table: Table, known: Sequence[tuple[ColumnMap, Symbol]], program: Program, problems: Problems) -> None:
    """What is allowed, but perhaps not meant."""
    if not known or problems.full:
        return
    sites = sites_of(program)
    for each, symbol in known:
        writes = written(program, sites, symbol)
        if each.role == "output" and not writes:
            problems.add(
                table.header, each.column, f"The program never writes `{symbol.path}`. Is it an input?", warning=True
            )
        if each.role == "input" and writes and symbol.bit is None:
            problems.add(
                table.header, each.column, f"The program itself writes `{symbol.path}`. Is it an output?", warning=True
            )


def _meant(name: str, known: Sequence[str]) -> str:
    return _near(get_close_matches(name, known, 2, 0.6))


def _near(names: Sequence[str]) -> str:
    return perhaps(names[:3])
