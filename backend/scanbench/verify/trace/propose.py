"""What the columns of a trace probably mean: a variable for each, with how sure that is."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from scanbench.check.typed.condition import BadCondition, compile_signal
from scanbench.program.program import Program
from scanbench.program.types import Elementary, StringType
from scanbench.public import Public
from scanbench.symbols.sites import sites_of
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.verify.trace.axis import axis_of, bare_name, only_counts, plain_name
from scanbench.verify.trace.likeness import Variables
from scanbench.verify.trace.mapping import MAX_LATE_MS, ColumnMap, Gaps, TraceMapping, bits_of, role_of
from scanbench.verify.trace.scans import place
from scanbench.verify.trace.table import Problems, Table, Unit
from scanbench.verify.trace.values import cell_value

SURE = 0.7
"""A variable that is less likely than this is only offered."""
_LOOKED_AT = 50
"""Different cells of a column that have to be values of its variable."""


@dataclass(frozen=True, slots=True)
class Guess(Public):
    """Why a column has its variable in a proposal."""

    PUBLIC: ClassVar = "TraceGuess"

    column: str
    score: float
    """How sure it is, up to 1: its name is that of the variable."""
    near: tuple[str, ...] = ()
    """What else it may be, or, below the score that is used, what it may be at all."""


@dataclass(frozen=True, slots=True)
class Proposal:
    """A mapping of all columns, and how sure each of its variables is."""

    mapping: TraceMapping
    guesses: tuple[Guess, ...]


def propose(table: Table, program: Program, learned: Mapping[str, str] | None = None) -> Proposal:
    """By names: what is called the same, then what ends the same (`Application.PLC_PRG.belt.run` is `Main.belt.run`), then what is
    alike. `learned`: variables of columns that somebody has mapped before. What the program writes comes out, all else goes in.
    Of a column that means nothing the path stays empty, and `bind.check` says so, until somebody ignores it."""
    axes = {} if table.axis else {each: unit for each in table.columns if (unit := _axis(program, each)) is not None}
    axis, unit = _best_axis(table, axes)
    columns = [each for each in table.columns if each != axis and each not in axes]
    found = _found(table, program, columns, learned or {})
    sites = sites_of(program)
    maps = []
    for column in table.columns:
        if column == axis:
            continue
        symbol = found[column].symbol if column in found else None
        if symbol is not None:
            maps.append(ColumnMap(column, symbol.path, role_of(program, sites, symbol)))
        else:
            idle = column in axes or found[column].idle
            maps.append(ColumnMap(column, "", "ignore" if idle else "output"))
    guesses = [each.guess for column in table.columns if (each := found.get(column)) is not None and not each.idle]
    gaps: Gaps = "hold" if _sampled(table, axis, unit, program) else "refuse"
    return Proposal(TraceMapping(axis, unit, gaps, tuple(maps)), tuple(guesses))


def sampled(mapping: TraceMapping, interval_ms: int, time: str) -> TraceMapping:
    """What is proposed for a controller that is read again and again, with the time in this column: it has much that is no variable of the
    program, and outputs may come as late as the time between two samples."""
    columns = tuple(
        replace(each, role="ignore") if not each.path
        else replace(each, late_ms=max(each.late_ms, min(2.0 * interval_ms, MAX_LATE_MS))) if each.role == "output"
        else each
        for each in mapping.columns
    )  # fmt: skip
    unit: Unit = mapping.unit if mapping.axis else "ms"
    return replace(mapping, gaps="hold", axis=mapping.axis or time, unit=unit, columns=columns)


@dataclass(slots=True)
class _Found:
    """What is known of a column."""

    guess: Guess
    symbol: Symbol | None = None
    idle: bool = False
    """It is no variable to compare: an expression, or one that another column has already."""


def _found(table: Table, program: Program, columns: list[str], learned: Mapping[str, str]) -> dict[str, _Found]:
    """The surest first, as two columns cannot have one variable."""
    variables = Variables(program)
    found: dict[str, _Found] = {}
    taken = set[int]()
    ranked: list[tuple[float, int, str, tuple[Symbol, ...]]] = []
    for at, column in enumerate(columns):
        named = _named(program, column, learned)
        if named is not None:
            found[column] = _Found(Guess(column, named[1]))
            if named[0].slots or named[0].constant or not taken.isdisjoint(bits_of(named[0])):
                found[column].idle = True
            else:
                taken.update(bits_of(named[0]))
                found[column].symbol = named[0]
        elif _computed(program, column):
            found[column] = _Found(Guess(column, 0.0), idle=True)
        else:
            near = [each for each in variables.like(bare_name(column)) if _holds(table, column, each.symbol)]
            score = near[0].score if near else 0.0
            if len(near) > 1 and near[1].score > score - 0.02:  # it may be the one or the other
                score = min(score, SURE - 0.01)
            found[column] = _Found(Guess(column, round(score, 2), tuple(each.symbol.path for each in near[:3])))
            ranked.append((-score, at, column, tuple(each.symbol for each in near[:1])))
    for negative, _, column, symbols in sorted(ranked, key=lambda each: each[:2]):
        if symbols and -negative >= SURE and taken.isdisjoint(bits_of(symbols[0])):
            taken.update(bits_of(symbols[0]))
            found[column].symbol = symbols[0]
    return found


def _named(program: Program, column: str, learned: Mapping[str, str]) -> tuple[Symbol, float] | None:
    """What a column is called after, or was mapped to before."""
    if column in learned:
        try:
            return resolve(program, learned[column]), 1.0
        except UnknownPath:
            pass
    for name in dict.fromkeys((column, plain_name(column)[0], bare_name(column))):
        for path in _paths(program, name.strip()):
            try:
                return resolve(program, path), 1.0
            except UnknownPath:
                continue
    return None


def _paths(program: Program, name: str) -> Iterator[str]:
    yield name
    for instance in program.shown:
        yield f"{instance.name}.{name}"


def _computed(program: Program, column: str) -> bool:
    """Whether it is an expression, as our own traces have: the program computes its parts, which have columns of their own."""
    name = plain_name(column)[0]
    return not name.isidentifier() and not isinstance(compile_signal(program, name), BadCondition)


def _holds(table: Table, column: str, symbol: Symbol) -> bool:
    """Whether the column's first cells are values of this variable."""
    if not isinstance(symbol.type, Elementary | StringType):
        return False
    at, unit = table.columns.index(column), plain_name(column)[1] or table.durations
    for text in {row[at] for row in table.rows[:_LOOKED_AT]} - {""}:
        try:
            cell_value(symbol.type, text, unit, table.comma)
        except ValueError:
            return False
    return True


# ---- the column of scans or times -----------------------------------------------------------------------------------


def _axis(program: Program, column: str) -> Unit | None:
    """What it counts, if it is called like scans or times and no variable is."""
    unit = axis_of(column)
    return None if unit is None or _named(program, column, {}) is not None else unit


def _best_axis(table: Table, axes: Mapping[str, Unit]) -> tuple[str, Unit]:
    """Scans before times, times before numbers of samples."""
    if table.axis:
        return table.axis, table.unit or "scan"
    scans = [each for each, unit in axes.items() if unit == "scan"]
    ordered = [each for each in scans if not only_counts(each)]
    ordered += [each for each in axes if each not in scans]
    axis = next(iter([*ordered, *scans]), "")
    return axis, axes.get(axis, "scan")


def _sampled(table: Table, axis: str, unit: Unit, program: Program) -> bool:
    """Whether a recorder took every so many scans only: then most scans are missing, and no row is wrong."""
    placed = place(table, axis, unit, program.interval_ns, "hold", Problems())
    return (
        placed is not None and len(placed.scans.of_rows) > 3 and placed.scans.missing >= len(placed.scans.of_rows) - 1
    )
