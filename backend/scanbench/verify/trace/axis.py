"""Which scans the rows of a trace are: by its column of scans or times."""

import re
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from typing import Literal

from scanbench.syntax.literals import UNITS_NS, duration
from scanbench.verify.trace.table import Problems, Table

Unit = Literal["scan", "ns", "us", "ms", "s"]
TIME_UNITS: tuple[Unit, ...] = ("ns", "us", "ms", "s")
_SCANS = ("scan", "scans", "cycle", "スキャン")
_TIMES = ("time", "timestamp", "t", "時間", "時刻")
_NAMED = re.compile(r"(.*\S)\s*(?:\[\s*(ns|us|µs|ms|s|sec)\s*\]|\(\s*(ns|us|µs|ms|s|sec)\s*\))", re.IGNORECASE)
_TAILED = re.compile(r"(\w+)_(ns|us|ms|s)", re.IGNORECASE)
_COMMA = re.compile(r"([+-]?\d*),(\d+(?:[eE][+-]?\d+)?)")
MAX_SCAN = 1 << 53
MAX_MISSING = 5_000_000
"""Scans in all gaps of a trace."""
_NEAR = Decimal("0.1")
"""Part of a scan by which a time may miss it: what controllers write down is rounded."""


@dataclass(frozen=True, slots=True)
class Scans:
    """The scan of each row, in order; `cold`: the first one is the first scan after a cold start."""

    of_rows: tuple[int, ...]
    cold: bool
    missing: int

    @property
    def first(self) -> int:
        """The first row's."""
        return self.of_rows[0]

    @property
    def last(self) -> int:
        """The last row's."""
        return self.of_rows[-1]


def plain_name(column: str) -> tuple[str, Unit | None]:
    """A column's name without the unit in brackets after it, and the unit."""
    found = _NAMED.fullmatch(column)
    if found is None:
        return column, None
    return found.group(1), _unit(found.group(2) or found.group(3))


def axis_of(column: str) -> Unit | None:
    """What an axis of this name counts; None: by its name it is none."""
    name, unit = plain_name(column)
    tailed = _TAILED.fullmatch(name) if unit is None else None
    if tailed is not None:
        name, unit = tailed.group(1), _unit(tailed.group(2))
    if name.lower() in _SCANS:
        return "scan" if unit is None else None
    return (unit or "s") if name.lower() in _TIMES else None


def _unit(text: str) -> Unit:
    short = text.lower().replace("µ", "u")
    return next((each for each in TIME_UNITS if each == short), "s")


def number(text: str, comma: bool) -> Decimal:
    """The decimal number in the text of a cell. Raises ValueError with the notation that is expected."""
    plain = text.strip().replace("\u2212", "-")
    found = _COMMA.fullmatch(plain)
    if found is not None:
        if not comma:
            raise ValueError(f"`{text}` has a comma: write the number with a decimal point")
        plain = f"{found.group(1)}.{found.group(2)}"
    try:
        value = Decimal(plain)
    except InvalidOperation:
        raise ValueError(f"`{text}` is not a number") from None
    if not value.is_finite():
        raise ValueError(f"`{text}` is not a finite number")
    return value


def scans_of(table: Table, axis: str, unit: Unit, interval_ns: int, gaps: str, problems: Problems) -> Scans | None:
    """The scans of all rows; None where problems were added."""
    before = len(problems.found)
    if not axis:
        return Scans(tuple(range(len(table.rows))), True, 0)
    index = table.columns.index(axis)
    numbers = [_number(row[index], at, table, axis, unit, problems) for row, at in _numbered(table)]
    if len(problems.found) > before:
        return None
    if unit == "scan":
        found, cold = _counted(numbers, table, axis, problems), True
    else:
        found, cold = _timed(numbers, table, axis, unit, interval_ns, problems)
    missing = _in_order(found, table, axis, gaps, problems) if len(problems.found) == before else 0
    if len(problems.found) > before:
        return None
    return Scans(tuple(found), cold and found[0] == 0, missing)


def _numbered(table: Table) -> "list[tuple[tuple[str, ...], int]]":
    return list(zip(table.rows, table.numbers, strict=True))


def _number(text: str, row: int, table: Table, axis: str, unit: Unit, problems: Problems) -> Decimal:
    try:
        if not text:
            raise ValueError("the cell is empty")
        if unit != "scan" and text.upper().startswith(("T#", "TIME#")):
            return Decimal(duration(text.split("#", 1)[1])) / UNITS_NS[unit]
        return number(text, table.comma)
    except ValueError as error:
        problems.add(row, axis, f"A row needs its {'scan' if unit == 'scan' else 'time'}: {error}.")
        return Decimal(0)


def _counted(numbers: list[Decimal], table: Table, axis: str, problems: Problems) -> list[int]:
    for each, row in zip(numbers, table.numbers, strict=True):
        if each != int(each) or not 0 <= each <= MAX_SCAN:
            problems.add(row, axis, f"{each} is not the number of a scan: write whole numbers from 0 on.")
    return [int(each) for each in numbers]


def _timed(
    numbers: list[Decimal], table: Table, axis: str, unit: Unit, interval_ns: int, problems: Problems
) -> tuple[list[int], bool]:
    """Times count from the PLC's start; where the first one cannot, from the first row, which is scan 1 then: not the first
    cycle of a program."""
    in_scans = [each * UNITS_NS[unit] / interval_ns for each in numbers]
    start = in_scans[0]
    counts = 0 <= start <= MAX_SCAN and abs(start - round(start)) <= _NEAR
    if not counts:
        in_scans = [each - start + 1 for each in in_scans]
    found = []
    for each, shown, row in zip(in_scans, numbers, table.numbers, strict=True):
        near = round(each)
        if abs(each - near) > _NEAR:
            problems.add(
                row, axis, f"{shown} {unit} is between two scans: the program's interval is {interval_ns / 1e6:g} ms."
            )
        found.append(near)
    return found, counts


def _in_order(found: list[int], table: Table, axis: str, gaps: str, problems: Problems) -> int:
    missing = 0
    for before, scan, row in zip(found, found[1:], table.numbers[1:], strict=False):
        if scan == before:
            problems.add(row, axis, f"Scan {scan} has two rows.")
        elif scan < before:
            problems.add(row, axis, f"Scan {scan} comes after scan {before}: the rows must be in order of time.")
        elif scan > before + 1:
            missing += scan - before - 1
            if gaps == "refuse":
                stretch = f"scan {before + 1} is" if scan == before + 2 else f"scans {before + 1} to {scan - 1} are"
                problems.add(
                    row,
                    axis,
                    f"Before this row {stretch} missing. Choose what to do in gaps: hold the inputs, or skip them.",
                )
        if problems.full:
            break
    if missing > MAX_MISSING:
        problems.add(
            None, axis, f"{missing:,} scans are missing, at most {MAX_MISSING:,} may be: cut the file in its gaps."
        )
    return missing
