"""How the columns of a trace file are meant: which variable of the project each one is, and whether it goes in or comes out."""

import json
from dataclasses import asdict, dataclass
from math import inf
from typing import Literal, TypeVar, get_args

from scanbench.debug.writers import writers
from scanbench.program.program import Program
from scanbench.symbols.sites import Sites
from scanbench.symbols.symbols import Symbol
from scanbench.verify.trace.table import Table, Unit

T = TypeVar("T", bound=str)
Role = Literal["input", "output", "ignore"]
"""input: the monitor gets it before each scan. output: what the monitor comes to is compared with it."""
Gaps = Literal["refuse", "skip", "hold"]
"""Of scans that are missing. refuse: the file. skip: nothing is run there, and the next row is taken over. hold: they are run
with the inputs as they were, and nothing is compared."""

Sampled = Literal["end", "begin"]
"""When in a scan the controller took its samples. end: after the program. begin: before it, so the outputs are those of the scan
before."""
MAX_LATE_MS = 10_000.0


class BadMapping(ValueError):
    """This is no mapping; the message says what a mapping looks like."""


@dataclass(frozen=True, slots=True)
class ColumnMap:
    """One column."""

    column: str
    """As the file names it."""
    path: str = ""
    """Variable or address of the project."""
    role: Role = "ignore"
    absolute: float = 0.0
    """Of an output: by so much its number may differ."""
    relative: float = 0.0
    """The same as a part of what was recorded: 0.01 is one hundredth."""
    late_ms: float = 0.0
    """So much earlier or later its value may come, in milliseconds."""


@dataclass(frozen=True, slots=True)
class TraceMapping:
    """All of them."""

    axis: str = ""
    """Column with scan or time; empty: a row is a scan, the first one scan 0."""
    unit: Unit = "scan"
    gaps: Gaps = "refuse"
    columns: tuple[ColumnMap, ...] = ()
    sampled: Sampled = "end"

    def to_json(self) -> str:
        """As it is saved, and given to `scanbench verify --map`."""
        return json.dumps(asdict(self), ensure_ascii=False, indent=1)

    @staticmethod
    def from_json(text: str) -> "TraceMapping":
        """Raises `BadMapping`."""
        try:
            found: object = json.loads(text)
        except (json.JSONDecodeError, RecursionError) as error:
            raise BadMapping(f"The mapping is not JSON: {error}") from None
        if not isinstance(found, dict):
            raise BadMapping(
                'A mapping is an object: {"axis": "scan", "unit": "scan", "gaps": "refuse", "columns": [...]}'
            )
        _only(found, ("axis", "unit", "gaps", "columns", "sampled"), "a mapping")
        columns = found.get("columns", [])
        if not isinstance(columns, list):
            raise BadMapping(
                '"columns" of a mapping is a list: [{"column": "speed", "path": "Main.speed", "role": "input"}]'
            )
        return TraceMapping(
            _text(found, "axis"),
            _one(found, "unit", get_args(Unit)),
            _one(found, "gaps", get_args(Gaps)),
            tuple(_column(each, index) for index, each in enumerate(columns)),
            _one(found, "sampled", get_args(Sampled)),
        )


def fits(mapping: TraceMapping, table: Table) -> bool:
    """Whether a saved mapping is one of this table: it knows every column, and every column that it needs is there."""
    known = {each.column for each in mapping.columns} | {mapping.axis}
    needed = {each.column for each in mapping.columns if each.role != "ignore"} | {mapping.axis} - {""}
    return needed <= set(table.columns) <= known


def bits_of(symbol: Symbol) -> range:
    """The bits of the image that hold a variable which is not reached through an in-out."""
    if symbol.bit is not None:
        return range(8 * symbol.offset + symbol.bit, 8 * symbol.offset + symbol.bit + 1)
    return range(8 * symbol.offset, 8 * (symbol.offset + symbol.type.size))


def role_of(program: Program, sites: Sites, symbol: Symbol) -> Role:
    """Whether the program writes it."""
    return "output" if written(program, sites, symbol) else "input"


def written(program: Program, sites: Sites, symbol: Symbol) -> bool:
    """Whether some statement of the program may write it."""
    if symbol.slots:
        return True
    whole = symbol if symbol.bit is None else _byte(symbol)
    found = writers(program, sites, whole)
    return found is None or bool(found)


def _byte(symbol: Symbol) -> Symbol:
    return Symbol(symbol.path, symbol.name, symbol.type, symbol.section, symbol.offset, None, (), symbol.address)


# ---- reading a mapping ----------------------------------------------------------------------------------------------


def _column(given: object, index: int) -> ColumnMap:
    if not isinstance(given, dict):
        raise BadMapping(f"Column {index} of the mapping is no object with column, path and role.")
    _only(given, ("column", "path", "role", "absolute", "relative", "late_ms"), f"column {index} of the mapping")
    column = _text(given, "column")
    if not column:
        raise BadMapping(f'Column {index} of the mapping needs its name in the file, "column".')
    within = (
        _number(given, each, most) for each, most in (("absolute", inf), ("relative", 1), ("late_ms", MAX_LATE_MS))
    )
    return ColumnMap(column, _text(given, "path"), _one(given, "role", get_args(Role), "ignore"), *within)


def _only(given: dict[str, object], names: tuple[str, ...], what: str) -> None:
    unknown = next((each for each in given if each not in names), None)
    if unknown is not None:
        raise BadMapping(f"`{unknown}` is unknown in {what}; there are {', '.join(names)}.")


def _text(given: dict[str, object], name: str) -> str:
    found = given.get(name, "")
    if not isinstance(found, str):
        raise BadMapping(f'"{name}" of the mapping must be a text.')
    return found.strip()


def _one(given: dict[str, object], name: str, known: tuple[T, ...], default: str = "") -> T:
    text = _text(given, name) or default or known[0]
    found = next((each for each in known if each == text), None)
    if found is None:
        raise BadMapping(f'"{name}" of the mapping is `{text}`; it may be {", ".join(known)}.')
    return found


def _number(given: dict[str, object], name: str, most: float) -> float:
    found = given.get(name, 0)
    if isinstance(found, bool) or not isinstance(found, int | float) or not 0 <= found <= most or found == inf:
        if most == inf:
            raise BadMapping(f'"{name}" of the mapping is `{found}`; it may be a number from 0 on.')
        raise BadMapping(f'"{name}" of the mapping is `{found}`; it may be a number from 0 to {most:g}.')
    return float(found)
