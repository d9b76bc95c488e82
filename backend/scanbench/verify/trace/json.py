"""Trace files in JSON: `{"axis": "scan", "columns": [...], "rows": [[...], ...]}`, or a list of objects."""

import json
from collections.abc import Sequence

from scanbench.verify.trace.table import MAX_COLUMNS, MAX_ROWS, Problems, Table, bad, check_size

UNITS = ("ns", "us", "ms", "s")


class _Number(str):
    """A number as it was written: how many digits it has tells how exact it is."""


class _Twice(ValueError):
    """An object has a key twice."""


def read_json(text: str, name: str, note: str = "") -> Table:
    """The table; raises `BadTraceFile`."""
    try:
        found: object = json.loads(
            text, parse_float=_Number, parse_int=_Number, parse_constant=_Number, object_pairs_hook=_object
        )
    except json.JSONDecodeError as error:
        raise bad(f"The file is not JSON: {error.msg} (line {error.lineno}, column {error.colno}).") from None
    except RecursionError:
        raise bad("The file is nested too deeply for a trace.") from None
    except _Twice as error:
        raise bad(f"An object of the file has `{error}` twice.") from None
    if isinstance(found, dict):
        return _of_rows(found, name, note)
    if isinstance(found, list):
        return _of_objects(found, name, note)
    raise bad('A trace in JSON is a list of objects, or an object with "columns" and "rows".')


def _object(pairs: list[tuple[str, object]]) -> dict[str, object]:
    made = dict(pairs)
    if len(made) != len(pairs):
        names = [name for name, _ in pairs]
        raise _Twice(next(each for each in names if names.count(each) > 1))
    return made


def _of_rows(given: dict[str, object], name: str, note: str) -> Table:
    columns, rows = given.get("columns"), given.get("rows")
    axis, unit = given.get("axis", ""), given.get("unit", "")
    if not isinstance(columns, list) or not isinstance(rows, list):
        missing = '"rows"' if isinstance(columns, list) else '"columns"'
        raise bad(
            f'The object needs {missing}, a list: {{"axis": "scan", "columns": ["scan", "x"], "rows": [[0, 1]]}}.'
        )
    names = _names(columns)
    if axis != "" and axis not in names:
        raise bad(f'"axis" is `{axis}`, but there is no such column.')
    if unit != "" and unit not in UNITS:
        raise bad(f'"unit" is `{unit}`; it may be one of {", ".join(UNITS)}.')
    if unit != "" and axis != "":
        names = [f"{each} [{unit}]" if each == axis else each for each in names]
    problems = Problems()
    made: list[tuple[str, ...]] = []
    check_size(len(names), len(rows))
    for index, row in enumerate(rows):
        if not isinstance(row, list) or len(row) != len(names):
            count = f"has {len(row)} cells" if isinstance(row, list) else "is no list"
            problems.add(index, "", f"The row {count}, but there are {len(names)} columns.", cause="cells")
            continue
        made.append(tuple(_cell(cell, index, column, problems) for cell, column in zip(row, names, strict=True)))
    problems.refuse()
    return Table(name, tuple(names), tuple(made), range(len(made)), note=note)


def _of_objects(given: list[object], name: str, note: str) -> Table:
    problems = Problems()
    names: dict[str, None] = {}
    if len(given) > MAX_ROWS:
        check_size(1, len(given))
    for index, row in enumerate(given):
        if not isinstance(row, dict):
            problems.add(index, "", "The row is no object with a value for each column.", cause="object")
            continue
        names.update(dict.fromkeys(row))
        if len(names) > MAX_COLUMNS:
            break
    problems.refuse()
    check_size(len(names), len(given))
    _names(list(names))
    rows = [
        tuple(_cell(row.get(column), index, column, problems) for column in names)
        for index, row in enumerate(given)
        if isinstance(row, dict)
    ]
    problems.refuse()
    return Table(name, tuple(names), tuple(rows), range(len(rows)), note=note)


def _names(columns: Sequence[object]) -> list[str]:
    problems, found = Problems(), []
    for index, each in enumerate(columns):
        text = each.strip() if isinstance(each, str) and not isinstance(each, _Number) else ""
        if not text:
            problems.add(None, "", f"Column {index} has no name.")
        elif text in found:
            problems.add(None, text, f"There are two columns `{text}`.")
        found.append(text)
    problems.refuse()
    return found


def _cell(value: object, index: int, column: str, problems: Problems) -> str:
    """The text that a cell of a CSV file would have for this value."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, str):
        return str(value).strip() or "''"
    problems.add(index, column, "The cell is a list or an object; write one value.", cause="value")
    return ""
