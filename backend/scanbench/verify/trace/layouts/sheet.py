"""A file of some tool as lines of cells, and the signals that are found in it as a table."""

import csv
import io
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from scanbench.verify.trace.clock import is_clock, is_date, times_of
from scanbench.verify.trace.table import MAX_ROWS, Table, bad, check_size

DELIMITERS = "\t;,"
_NUMBER = re.compile(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?")
_WORDS = frozenset(("true", "false", "on", "off", "nan", "inf", "-inf", ""))


@dataclass(frozen=True, slots=True)
class Sheet:
    """The lines of a file that are not empty."""

    name: str
    note: str
    delimiter: str
    lines: tuple[tuple[str, ...], ...]
    """Their cells, without spaces around them."""
    numbers: tuple[int, ...]
    """Of the lines in the file, from 1."""

    @property
    def comma(self) -> bool:
        """Whether numbers may have a decimal comma."""
        return self.delimiter != ","


@dataclass(frozen=True, slots=True)
class Series:
    """A signal with times of its own."""

    name: str
    times: Sequence[str]
    values: Sequence[str]
    numbers: Sequence[int]
    """Of the lines they are from."""


def sheet_of(text: str, name: str, note: str, delimiter: str) -> Sheet | None:
    """The lines of a file; None where they cannot be read with this delimiter."""
    lines, numbers = [], []
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, skipinitialspace=delimiter != "\t")
    try:
        for cells in reader:
            if any(each.strip() for each in cells):
                lines.append(tuple(each.strip() for each in cells))
                numbers.append(reader.line_num)
    except csv.Error:
        return None
    return Sheet(name, note, delimiter, tuple(lines), tuple(numbers))


def is_value(text: str) -> bool:
    """Whether it looks like the value of a signal, and not like a name; an empty text does."""
    plain = text.strip()
    return plain.lower() in _WORDS or _NUMBER.fullmatch(plain) is not None or "#" in plain or plain.startswith("'")


def is_moment(text: str) -> bool:
    """Whether it may be what a row of values begins with: a number, a date, or a time of day."""
    plain = text.strip()
    return bool(plain) and (_NUMBER.fullmatch(plain) is not None or is_clock(plain) or is_date(plain))


def joined(series: Sequence[Series], comma: bool) -> tuple[list[tuple[str, ...]], list[int]]:
    """Signals with times of their own as rows: time, then a cell for each signal, which is empty where it has no value at that
    time. With the line of each row. Raises `BadTraceFile`."""
    places: dict[str, list[str]] = {}
    numbers: dict[str, int] = {}
    for at, each in enumerate(series):
        for time, value, number in zip(each.times, each.values, each.numbers, strict=True):
            if time not in places:
                places[time] = [""] * len(series)
                numbers[time] = number
            places[time][at] = value
        if len(places) > MAX_ROWS:
            check_size(1 + len(series), len(places))
    check_size(1 + len(series), len(places))
    keys = list(places)
    times = times_of(keys, comma)
    if times is None:
        wrong = next((key for key in keys if times_of([key], comma) is None), "")
        raise bad(f"`{wrong}` is not a time.", numbers.get(wrong))
    ordered = [key for _, key in sorted(zip(times, keys, strict=True), key=lambda each: each[0])]
    return [(key, *places[key]) for key in ordered], [numbers[key] for key in ordered]


def unique(names: Iterable[str]) -> list[str]:
    """The same names; one that is there already gets a number."""
    found: list[str] = []
    for each in names:
        name, count = each, 1
        while name in found:
            count += 1
            name = f"{each} ({count})"
        found.append(name)
    return found


def padded(cells: Sequence[str], width: int) -> tuple[str, ...]:
    """So many cells: empty ones are added, those after the last column are dropped."""
    return tuple(cells[:width]) + ("",) * (width - len(cells))


def table_of(sheet: Sheet, columns: Sequence[str], rows: Sequence[tuple[str, ...]], numbers: Sequence[int]) -> Table:
    """A table without what its layout knows besides."""
    check_size(len(columns), len(rows))
    return Table(sheet.name, tuple(columns), tuple(rows), list(numbers), None, sheet.comma, sheet.note)
