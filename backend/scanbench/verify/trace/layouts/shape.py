"""Files whose layout nobody has told us: lines about the recording, a line of names, perhaps lines about the columns, then rows of
values. The rows are found first, as they all begin with a number or a time and are equally long.

So are read the exports of CODESYS V3 (CSV), TIA Portal, Sysmac Studio, CX-Programmer, EcoStruxure, and others: of these no
description is published, or none that we could find; see docs/trace-format.md.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from scanbench.verify.trace.axis import axis_of, bare_name, plain_name
from scanbench.verify.trace.clock import is_clock, is_date
from scanbench.verify.trace.layouts.sheet import Series, Sheet, is_moment, is_value, joined, padded, table_of, unique
from scanbench.verify.trace.table import Table, Unit

_UNITS = ("ns", "us", "µs", "ms", "s", "sec", "min", "%", "mm", "m", "bar", "°c", "v", "a", "rpm", "hz", "-", "")
_SAY = {"codesys": "CODESYS trace", "sysmac": "Sysmac Studio data trace", "cx-programmer": "CX-Programmer data trace",
        "tia": "TIA Portal trace", "siemens": "TIA Portal trace", "simatic": "TIA Portal trace"}  # fmt: skip
"""Words in the lines about the recording, and what they say."""
_NUMBERS = ("no", "number", "index", "sample", "sampling", "record", "nr")
_MOMENTS = ("time", "zeit", "timestamp", "時刻", "時間", "date")


def read(sheet: Sheet) -> Table | None:
    """The table; None where no rows of values are found."""
    body = _body(sheet)
    if body is None:
        return None
    first, end, width = body
    names_at = _names(sheet, first, width)
    if names_at is None or any(is_moment(cells[0]) for cells in sheet.lines[names_at:first]):
        return None  # what begins like a row is one, and it is not as the others are
    rows = [padded(cells, width) for cells in sheet.lines[first:end]]
    numbers = list(sheet.numbers[first:end])
    columns = _titles(sheet, names_at, first, width)
    layout = _said(sheet, names_at)
    made = _pairs(sheet, columns, rows, numbers)
    if made is not None:
        layout = layout or "times for each signal"
    elif names_at > 0 or end < len(sheet.lines) or first > 1 or is_date(rows[0][0]):
        made, layout = _wide(sheet, columns, rows, numbers), layout or "lines above the names"
    return None if made is None else replace(made, header=sheet.numbers[names_at], layout=layout, from_start=False)


def lines_of_data(sheet: Sheet) -> int:
    """How many rows of values there are: of several delimiters that with most of them is right."""
    body = _body(sheet)
    return 0 if body is None else (body[1] - body[0]) * body[2]


def _body(sheet: Sheet) -> tuple[int, int, int] | None:
    """Index of the first row of values, that after the last one, and how many columns they have."""
    end = len(sheet.lines)
    while end and not _is_row(sheet.lines[end - 1]):
        end -= 1
        if len(sheet.lines) - end > 3 or is_moment(sheet.lines[end][0]):  # no footer is as long, or begins like a row
            return None
    first = end
    while first and _is_row(sheet.lines[first - 1]):
        first -= 1
    if end - first < 1:
        return None
    width = Counter(_used(cells) for cells in sheet.lines[first:end]).most_common(1)[0][0]
    if width < 2 or any(_used(cells) > width for cells in sheet.lines[first:end]):
        return None
    return first, end, width


def _used(cells: tuple[str, ...]) -> int:
    """How many cells there are without empty ones at the end. A row may end in signals without a value, so this can be less."""
    return max((at for at, each in enumerate(cells, 1) if each), default=0)


def _is_row(cells: tuple[str, ...]) -> bool:
    if len(cells) < 2 or not is_moment(cells[0]):
        return False
    rest = [each for each in cells[1:] if each]
    return bool(rest) and 2 * sum(is_value(each) or is_moment(each) for each in rest) >= len(rest)


def _names(sheet: Sheet, first: int, width: int) -> int | None:
    """The line of names: that with most cells that can be names of a signal, all of them different; the first of several."""
    best, most = None, 0
    for at in range(max(0, first - 12), first):
        cells = sheet.lines[at]
        if not width - 1 <= len(cells) <= width + 1 or _used(cells) < width - 1:
            continue
        names = [each for each in cells if each and not is_value(each)]
        score = len(set(names)) if len(names) * 2 > width else 0
        if score > most:
            best, most = at, score
    return best


def _titles(sheet: Sheet, names_at: int, first: int, width: int) -> list[str]:
    """The names; with the unit below them, where there is a line of units."""
    names = list(padded(sheet.lines[names_at], width))
    for at in range(names_at + 1, first):
        cells = padded(sheet.lines[at], width)
        units = [each.strip("[]()").strip() for each in cells]
        if any(units) and all(unit.lower() in _UNITS for unit in units):
            return [
                f"{name} [{unit}]" if unit and unit != "-" and plain_name(name)[1] is None else name
                for name, unit in zip(names, units, strict=True)
            ]
    return names


def _said(sheet: Sheet, names_at: int) -> str:
    above = " ".join(" ".join(cells) for cells in sheet.lines[:names_at]).lower()
    return next((layout for word, layout in _SAY.items() if word in above), "")


def _wide(sheet: Sheet, columns: list[str], rows: list[tuple[str, ...]], numbers: list[int]) -> Table | None:
    """One column of times for all signals; date and time of day may be in two."""
    if all(is_date(row[0]) for row in rows) and all(is_clock(row[1]) for row in rows):
        rows = [(f"{row[0]} {row[1]}", *row[2:]) for row in rows]
        columns = ["Time", *columns[2:]]
    elif not columns[0]:
        columns = ["Time" if is_clock(rows[0][0]) else "Index", *columns[1:]]
    keep = [at for at, each in enumerate(columns) if each]
    if len(keep) < 2:
        return None
    titles = unique(columns[at] for at in keep)
    made = table_of(sheet, titles, [tuple(row[at] for at in keep) for row in rows], numbers)
    axis, unit = _axis(titles, made.rows)
    idle = [at for at, each in enumerate(titles[:3]) if each != axis and _is_idle(each, [row[at] for row in made.rows])]
    keep = [at for at in range(len(titles)) if at not in idle]
    return replace(
        made,
        columns=tuple(titles[at] for at in keep),
        rows=tuple(tuple(row[at] for at in keep) for row in made.rows),
        axis=axis,
        unit=unit,
        left_out=tuple(f"`{titles[at]}` is no variable of the program." for at in idle),
    )


def _axis(columns: list[str], rows: tuple[tuple[str, ...], ...]) -> tuple[str, Unit | None]:
    """The column of times: of those in front, that with a clock, or a name that says time; else that of numbers of rows."""
    front = columns[: min(3, len(columns) - 1)]
    for at, each in enumerate(front):
        if all(is_clock(row[at]) for row in rows) and len({row[at] for row in rows}) == len(rows):
            return each, "s"
    named: list[tuple[str, Unit | None]] = [(each, unit) for each in front if (unit := _moment(each)) is not None]
    times = next(((each, unit) for each, unit in named if unit != "scan"), None)
    return times or next(iter(named), ("", None))


def _is_idle(column: str, cells: list[str]) -> bool:
    """Whether it is a further column of times, or numbers the rows."""
    if _moment(column) not in (None, "scan"):
        return True
    counted = all(each.isdigit() for each in cells)
    return counted and _counts(column) and all(int(two) - int(one) == 1 for one, two in pairwise(cells))


def _counts(column: str) -> bool:
    words = column.lower().replace(".", " ").split()
    return any(word in _NUMBERS for word in words)


def _moment(column: str) -> Unit | None:
    """What a column in front counts: its name may have more words than one of our own files, as in `Elapsed time [ms]`."""
    known = axis_of(column)
    if known is not None:
        return known
    name, unit = plain_name(column)
    return (unit or "s") if any(word in name.lower() for word in _MOMENTS) and "." not in name else None


def _pairs(sheet: Sheet, columns: list[str], rows: list[tuple[str, ...]], numbers: list[int]) -> Table | None:
    """Each signal with a column of times of its own before it: `Time;A;Time;B`, or `A.Time;A.Value;B.Time;B.Value`."""
    if not is_paired(columns):
        return None
    unit = _moment(_last_word(columns[0]))
    if all(is_clock(row[0]) for row in rows):
        unit = "s"
    series = []
    for at in range(0, len(columns), 2):
        there = [line for line, row in enumerate(rows) if row[at] and row[at + 1]]
        times, values = [rows[line][at] for line in there], [rows[line][at + 1] for line in there]
        series.append(Series(_signal(columns[at], columns[at + 1]), times, values, [numbers[line] for line in there]))
    made, lines = joined(series, sheet.comma)
    axis = f"Time [{unit}]"
    table = table_of(sheet, (axis, *unique(each.name for each in series)), made, lines)
    return replace(table, axis=axis, unit=unit)


def is_paired(columns: Sequence[str]) -> bool:
    """Whether every other column is one of times."""
    units = {_moment(_last_word(each)) for each in columns[::2]}
    return len(columns) >= 4 and len(columns) % 2 == 0 and len(units) == 1 and not units & {None, "scan"}


def _last_word(column: str) -> str:
    """`PLC_PRG.x.Time [ms]` is a column of times, too."""
    name, unit = plain_name(column)
    word = name.replace(".", " ").replace("_", " ").split(" ")[-1]
    return f"{word} [{unit}]" if unit is not None else word


def _signal(time: str, value: str) -> str:
    """The signal of two columns: its name is above the values, or above both with a word after it."""
    name = bare_name(value)
    for word in (".Value", " Value", "_Value", ".Wert", " Wert"):
        name = name.removesuffix(word)
    return name or bare_name(time)
