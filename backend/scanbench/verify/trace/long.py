"""The long form of a trace: a row is one value of one variable. It comes out wide, a row for each scan."""

from dataclasses import replace

from scanbench.verify.trace.axis import axis_of
from scanbench.verify.trace.clock import times_of
from scanbench.verify.trace.table import Problems, Table, check_size

_VARIABLES = ("variable", "signal", "name", "tag")
_VALUE = "value"


def widened(table: Table) -> Table:
    """The same table with a column for each variable, if it is long. Raises `BadTraceFile`."""
    found = _columns(table.columns)
    if found is None:
        return table
    axis, variable, value = found
    names: dict[str, int] = {}
    cells: dict[str, dict[int, str]] = {}
    numbers: dict[str, int] = {}
    problems = Problems()
    for row, at in zip(table.rows, table.numbers, strict=True):
        key, name = row[axis], row[variable]
        if not key:
            message = "The cell is empty: a row needs its scan or time."
            problems.add(at, table.columns[axis], message, cause="empty")
        if not name:
            message = "The cell is empty: a row needs the name of its variable."
            problems.add(at, table.columns[variable], message, cause="empty")
        if not key or not name:
            continue
        place = names.setdefault(name, len(names))
        line = cells.setdefault(key, {})
        numbers.setdefault(key, at)
        if place in line:
            problems.add(at, name, f"`{name}` has two values at {table.columns[axis]} {key}.", cause="twice")
        line[place] = row[value]
        if not len(names) % 100:
            check_size(1 + len(names), len(cells))
    problems.refuse()
    check_size(1 + len(names), len(cells))
    keys = _ordered(list(cells), table.comma)
    rows = tuple((key, *(cells[key].get(place, "") for place in range(len(names)))) for key in keys)
    columns = (table.columns[axis], *names)
    return replace(table, columns=columns, rows=rows, numbers=[numbers[key] for key in keys])


def _columns(columns: tuple[str, ...]) -> tuple[int, int, int] | None:
    """The indices of the columns with the scan or time, the variable's name, and the value."""
    if len(columns) != 3:
        return None
    axis = next((at for at, each in enumerate(columns) if axis_of(each) is not None), None)
    variable = next((at for at, each in enumerate(columns) if each.lower() in _VARIABLES), None)
    value = next((at for at, each in enumerate(columns) if each.lower() == _VALUE), None)
    return None if axis is None or variable is None or value is None else (axis, variable, value)


def _ordered(keys: list[str], comma: bool) -> list[str]:
    """Sorted by number, as a file may have the variables one after the other. Unchanged if any is no number: that is reported later."""
    known = times_of(keys, comma)
    return keys if known is None else sorted(keys, key=dict(zip(keys, known, strict=True)).__getitem__)
