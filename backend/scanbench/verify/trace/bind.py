"""A table and its mapping, checked against a program: what the monitor is to be given in each scan, and what is compared."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches

from scanbench.problems import perhaps
from scanbench.program.program import Program
from scanbench.program.types import Elementary, StringType
from scanbench.symbols.sites import sites_of
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.verify.trace.axis import Scans, axis_of, plain_name, scans_of
from scanbench.verify.trace.mapping import ColumnMap, Gaps, TraceMapping, bits_of, written
from scanbench.verify.trace.table import Problems, Table, TraceProblem
from scanbench.verify.trace.values import Exactness, Leaf, cell_value, exactness


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


@dataclass(frozen=True, slots=True)
class Trace:
    """A controller log whose columns are mapped to variables: each row is a scan."""

    name: str
    scans: Scans
    gaps: Gaps
    inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]


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
    scans = None
    if not mapping.axis or mapping.axis in table.columns:
        scans = scans_of(table, mapping.axis, mapping.unit, program.interval_ns, mapping.gaps, problems)
    signals = {each.column: _signal(table, each, symbol, problems) for each, symbol in known}
    hindered = bool(problems.found)
    _warn(table, known, program, problems)
    trace = None
    if scans is not None and not hindered:
        by_role = {
            role: tuple(signals[each.column] for each, _ in known if each.role == role) for role in ("input", "output")
        }
        trace = Trace(table.name, scans, mapping.gaps, by_role["input"], by_role["output"])
    first, last, missing = (None, None, 0) if scans is None else (scans.first, scans.last, scans.missing)
    return Checked(tuple(problems.found), first, last, missing, trace)


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
            symbol = resolve(program, each.path or plain_name(each.column)[0])
        except UnknownPath as error:
            why = error.message if each.path else f"Nothing in the program is called `{each.column}`."
            problems.add(
                table.header, each.column, f"{why}{_near(error.near)} Map it to a variable, or ignore the column."
            )
            continue
        if not each.path:
            problems.add(table.header, each.column, f"The column is mapped to nothing. Did you mean `{symbol.path}`?")
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
    index, unit = table.columns.index(column.column), plain_name(column.column)[1]
    type = symbol.type
    assert isinstance(type, Elementary | StringType)
    known: dict[str, bytes | None] = {"": None}
    values: list[bytes | None] = []
    for row, at in zip(table.rows, table.numbers, strict=True):
        text = row[index]
        if text not in known:
            try:
                known[text] = cell_value(type, text, unit, table.comma)
            except ValueError as error:
                problems.add(at, column.column, f"{symbol.path}: {error}.")
                if problems.full:
                    break
                continue
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
