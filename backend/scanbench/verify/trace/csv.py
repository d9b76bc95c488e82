"""Trace files in CSV: a line of names, then a line for each scan, as spreadsheets and PLC tools write them."""

import csv
import io
import re

from scanbench.verify.trace.table import MAX_COLUMNS, MAX_ROWS, Problems, Table, bad, check_size

_SEPARATOR = re.compile(r"sep=(.)\r?\n", re.IGNORECASE)
"""A first line that Excel understands."""
_QUOTED = re.compile(r'"[^"]*"')
_DELIMITERS = ";\t,"


def read_csv(text: str, name: str, note: str = "") -> Table:
    """The table; raises `BadTraceFile`."""
    given = _SEPARATOR.match(text)
    skipped = 1 if given else 0
    body = text[given.end() :] if given else text
    delimiter = given.group(1) if given else _delimiter(body)
    lines = csv.reader(io.StringIO(body, newline=""), delimiter=delimiter, strict=True, skipinitialspace=True)
    columns: tuple[str, ...] = ()
    header, at = 0, 0
    rows: list[tuple[str, ...]] = []
    numbers: list[int] = []
    problems = Problems()
    same: dict[str, str] = {}  # most cells are one of a few texts
    try:
        for cells in lines:
            number, at = at + 1 + skipped, lines.line_num
            if not any(each.strip() for each in cells):
                continue
            if not columns:
                columns, header = _names(cells, number), number
                continue
            row = _cells(cells, len(columns))
            if len(row) != len(columns):
                message = f"The row has {len(row)} cells, but there are {len(columns)} columns."
                problems.add(number, "", message, cause="cells")
                continue
            rows.append(tuple(same.setdefault(each, each) for each in row))
            numbers.append(number)
            if len(rows) > MAX_ROWS or not len(rows) % 10_000:
                check_size(len(columns), len(rows))
    except csv.Error as error:
        raise bad(f"The line cannot be read: {error}.", lines.line_num + skipped) from None
    problems.refuse()
    return Table(name, columns, tuple(rows), numbers, header, delimiter != ",", note)


def _delimiter(text: str) -> str:
    """The delimiter that occurs most often in the first line that is not empty."""
    first = next((line for line in text.splitlines() if line.strip()), "")
    plain = _QUOTED.sub("", first)
    return max(_DELIMITERS, key=plain.count) if any(each in plain for each in _DELIMITERS) else ","


def _cells(cells: list[str], count: int) -> list[str]:
    """The cells without empty ones after the last column."""
    found = [each.strip() for each in cells]
    while len(found) > count and not found[-1]:
        found.pop()
    return found


def _names(cells: list[str], number: int) -> tuple[str, ...]:
    found = [_name(each) for each in cells]
    while found and not found[-1]:
        found.pop()
    if len(found) > MAX_COLUMNS:
        check_size(len(found), 0)
    problems = Problems()
    for index, each in enumerate(found):
        if not each:
            problems.add(number, "", f"Column {index + 1} has no name.")
        elif each in found[:index]:
            problems.add(number, each, f"There are two columns `{each}`.")
    problems.refuse()
    return tuple(found)


def _name(cell: str) -> str:
    """Our own files put a quote before what a spreadsheet would take for a formula."""
    text = cell.strip()
    return text[1:] if text[:1] == "'" and text[1:2] in ("=", "+", "-", "@") else text
