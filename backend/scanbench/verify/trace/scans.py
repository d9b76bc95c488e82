"""Which scans the rows of a trace are: by its column of scans or times."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from statistics import median

from scanbench.syntax.literals import UNITS_NS, duration
from scanbench.verify.trace.axis import only_counts
from scanbench.verify.trace.clock import is_clock, number, seconds
from scanbench.verify.trace.table import Problems, Table, Unit

MAX_SCAN = 1 << 53
MAX_MISSING = 5_000_000
"""Scans in all gaps of a trace."""
NEAR = 0.1
"""Part of a scan by which the first time may miss one, to count from the controller's start: what is written down is rounded."""
JITTER = 0.4
"""Part of a scan by which a time may miss its place between those before it."""
FOLLOW = 0.1
"""How much of what a time misses its place by is taken over: clocks do not run alike."""


@dataclass(frozen=True, slots=True)
class Scans:
    """The scan of each row, in order; `cold`: the first one is the first scan after a cold start."""

    of_rows: Sequence[int]
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


@dataclass(frozen=True, slots=True)
class Placed:
    """A table with a row for each of its scans."""

    table: Table
    scans: Scans


def place(table: Table, axis: str, unit: Unit, interval_ns: int, gaps: str, problems: Problems) -> Placed | None:
    """The scans of all rows; rows of one scan that have the values of different signals become one. None where problems were
    added."""
    before = problems.count
    if not axis:
        return Placed(table, Scans(tuple(range(len(table.rows))), table.from_start, 0))
    numbers = _numbers(table, axis, unit, problems)
    if problems.count > before:
        return None
    if unit == "scan":
        found, cold = _counted(numbers, table, axis, problems), table.from_start and not only_counts(axis)
    else:
        found, cold = _timed(numbers, table, axis, unit, interval_ns, problems)
        if problems.count == before:
            table, found = _joined(table, axis, found)
    missing = _in_order(found, table, axis, unit, gaps, problems) if problems.count == before else 0
    if problems.count > before:
        return None
    return Placed(table, Scans(tuple(found), cold and found[0] == 0, missing))


# ---- the cells ------------------------------------------------------------------------------------------------------


def _numbers(table: Table, axis: str, unit: Unit, problems: Problems) -> list[Decimal]:
    index = table.columns.index(axis)
    texts = [row[index] for row in table.rows]
    if _on_clock(table, axis, unit):
        try:
            return seconds(texts)
        except ValueError:
            pass  # each one is looked at below
    found = []
    for text, row in zip(texts, table.numbers, strict=True):
        try:
            found.append(_number(text, unit, table.comma))
        except ValueError as error:
            what = "scan" if unit == "scan" else "time"
            problems.add(row, axis, f"A row needs its {what}: {error}.", cause="axis")
            found.append(Decimal(0))
    return found


def _on_clock(table: Table, axis: str, unit: Unit) -> bool:
    """Whether the times are those of a clock."""
    return unit == "s" and is_clock(table.rows[0][table.columns.index(axis)])


def _number(text: str, unit: Unit, comma: bool) -> Decimal:
    if not text:
        raise ValueError("the cell is empty")
    if unit == "s" and is_clock(text):
        return seconds([text])[0]
    if unit != "scan" and text.upper().startswith(("T#", "TIME#", "LT#", "LTIME#")):
        return Decimal(duration(text.split("#", 1)[1])) / UNITS_NS[unit]
    return number(text, comma)


def _counted(numbers: list[Decimal], table: Table, axis: str, problems: Problems) -> list[int]:
    for each, row in zip(numbers, table.numbers, strict=True):
        if each != int(each) or not 0 <= each <= MAX_SCAN:
            message = f"{each} is not the number of a scan: write whole numbers from 0 on."
            problems.add(row, axis, message, cause="number")
    return [int(each) for each in numbers]


# ---- times ----------------------------------------------------------------------------------------------------------


def _timed(
    numbers: list[Decimal], table: Table, axis: str, unit: Unit, interval_ns: int, problems: Problems
) -> tuple[list[int], bool]:
    """Times count from the PLC's start; where the first one cannot, from the first row, which is scan 1 then: not the first
    cycle of a program. A controller does not take its samples evenly, and its clock is not ours: a time belongs to the scan
    that is nearest to it, going by the times before it."""
    before = problems.count
    exact = [each * UNITS_NS[unit] / interval_ns for each in numbers]
    start = exact[0]
    for time, shown, row in zip(exact, numbers, table.numbers, strict=True):
        if abs(time - start) > MAX_SCAN or abs(time) > MAX_SCAN << 10:
            message = f"{shown:.6g} is too far from the time of the first row."
            problems.add(row, axis, message, cause="far")
    if problems.count > before:
        return [0] * len(numbers), False
    counts = (
        table.from_start
        and not _on_clock(table, axis, unit)
        and 0 <= start <= MAX_SCAN
        and abs(start - round(start)) <= NEAR
    )
    in_scans = [float(each if counts else each - start) for each in exact]
    apart = _apart(in_scans)
    if apart is not None and apart < 1 - JITTER and _clash(in_scans, table, axis):
        message = (
            f"The rows are {apart * interval_ns / 1e6:.3g} ms apart, but the program's interval is {interval_ns / 1e6:g} ms: "
            "give the task the interval that it has in the controller."
        )
        problems.add(table.numbers[0], axis, message, cause="interval")
        return [0] * len(numbers), counts
    phase = 0.0 if counts else _phase(in_scans)
    found = []
    for each, shown, row in zip(in_scans, numbers, table.numbers, strict=True):
        near = math.floor(each - phase + 0.5)
        off = each - phase - near
        if abs(off) > JITTER:
            what = f"{shown.normalize():f} {unit}"
            message = f"{what} is between two scans: the program's interval is {interval_ns / 1e6:g} ms."
            problems.add(row, axis, message, cause="between")
        phase += FOLLOW * off
        found.append(near)
    return (found if counts else [each - found[0] + 1 for each in found]), counts


def _apart(in_scans: Sequence[float]) -> float | None:
    """How many scans a row is after the one before it, in most cases."""
    apart = [after - before for before, after in itertools.pairwise(in_scans) if after > before]
    return median(apart) if apart else None


def _clash(in_scans: Sequence[float], table: Table, axis: str) -> bool:
    """Whether more than a few rows cannot be those of one scan: the same signals have values in them."""
    index = table.columns.index(axis)
    pairs = zip(in_scans, in_scans[1:], table.rows, table.rows[1:], strict=False)
    both = sum(1 for one, two, row, other in pairs if two - one < 1 - JITTER and not _agree(row, other, index))
    return both * 4 > len(in_scans)


def _agree(row: tuple[str, ...], other: tuple[str, ...], axis: int) -> bool:
    """Whether they say nothing different of any signal."""
    cells = enumerate(zip(row, other, strict=True))
    return all(not one or not two or one == two for at, (one, two) in cells if at != axis)


def _phase(in_scans: Sequence[float]) -> float:
    """Where in a scan most of the first times are: between -0.5 and 0.5."""
    first = in_scans[:64]
    turns = [2 * math.pi * each for each in first]
    across, along = sum(map(math.sin, turns)), sum(map(math.cos, turns))
    if math.hypot(across, along) < 0.1 * len(first):  # they say nothing: the first one counts
        return in_scans[0] - math.floor(in_scans[0] + 0.5)
    return math.atan2(across, along) / (2 * math.pi)


def _joined(table: Table, axis: str, found: list[int]) -> tuple[Table, list[int]]:
    """Rows of one scan as one, where they say nothing different of any signal: they come from different tasks."""
    index = table.columns.index(axis)
    rows: list[tuple[str, ...]] = []
    numbers: list[int] = []
    scans: list[int] = []
    for row, at, scan in zip(table.rows, table.numbers, found, strict=True):
        if scans and scans[-1] == scan and _agree(rows[-1], row, index):
            rows[-1] = tuple(one or two for one, two in zip(rows[-1], row, strict=True))
            continue
        rows.append(row)
        numbers.append(at)
        scans.append(scan)
    if len(rows) == len(table.rows):
        return table, found
    return replace(table, rows=tuple(rows), numbers=numbers), scans


# ---- the order ------------------------------------------------------------------------------------------------------


def _in_order(found: list[int], table: Table, axis: str, unit: Unit, gaps: str, problems: Problems) -> int:
    missing = 0
    for before, scan, row in zip(found, found[1:], table.numbers[1:], strict=False):
        if scan == before:
            problems.add(row, axis, f"Scan {scan} has two rows.", cause="twice")
        elif scan < before:
            message = f"Scan {scan} comes after scan {before}: the rows must be in order of time."
            problems.add(row, axis, message, cause="order")
        elif scan > before + 1:
            missing += scan - before - 1
            if gaps == "refuse":
                stretch = f"scan {before + 1} is" if scan == before + 2 else f"scans {before + 1} to {scan - 1} are"
                message = (
                    f"Before this row {stretch} missing. Choose what to do in gaps: hold the inputs, or skip them."
                )
                problems.add(row, axis, message, cause="gap")
    if missing > MAX_MISSING:
        message = f"{missing:,} scans are missing, at most {MAX_MISSING:,} may be: cut the file in its gaps."
        problems.add(None, axis, message)
    return missing
