"""Trace files of Panasonic FP7/FP0H (Control FPWIN GR7/Pro 7, logging/trace function).

Layout: FP0H User's Manual, 1.3.3 *File Format (For Trace Function)*; infohub.industry.panasonic.eu, Control FPWIN Pro 7, *Trace*.
Rows of comments (any of them may be missing): `Date,Time,Obtaining interval,1,2,...`, the names of the data, and further ones;
then date, time of day, interval since the row before, values. The interval is in units of 10 us (FP0H) or 10 ms (FP7): which
one follows from the time that the whole file takes.
"""

from dataclasses import replace
from decimal import Decimal

from scanbench.verify.trace.clock import is_clock, is_date, number, seconds
from scanbench.verify.trace.layouts.sheet import Sheet, padded, table_of, unique
from scanbench.verify.trace.table import Table, bad

LAYOUT = "FPWIN trace"
_TEN_US, _TEN_MS = Decimal("0.01"), Decimal(10)
"""Milliseconds."""


def read(sheet: Sheet) -> Table | None:
    """The table; None where it is no such file."""
    head = sheet.lines[0]
    if [each.lower().replace(" ", "") for each in head[:3]] != ["date", "time", "obtaininginterval"]:
        return None
    data = next((at for at, cells in enumerate(sheet.lines) if _is_data(cells)), None)
    if data is None:
        raise bad("The file has no row with values.", sheet.numbers[0])
    rows = [(cells, at) for cells, at in zip(sheet.lines[data:], sheet.numbers[data:], strict=True) if _is_data(cells)]
    width = len(rows[0][0])
    names = next((cells for cells in sheet.lines[1:data] if not any(cells[:3]) and any(cells[3:])), head)
    passed = Decimal(0)
    times: list[Decimal] = []
    for cells, at in rows:
        try:
            passed += number(cells[2] or "0", sheet.comma) if times else 0
        except ValueError as error:
            raise bad(f"The interval cannot be read: {error}.", at) from None
        times.append(passed)
    try:
        step = _step(passed, seconds([f"{cells[0]} {cells[1]}" for cells, _ in rows])[-1])
    except ValueError as error:
        raise bad(f"The time cannot be read: {error}.", None, head[1]) from None
    made = [
        (f"{time * step:f}", *padded(cells, width)[3:]) for time, (cells, _) in zip(times, rows, strict=True)
    ]  # fmt: skip
    columns = ("Time [ms]", *unique(padded(names, width)[3:]))
    table = table_of(sheet, columns, made, [at for _, at in rows])
    return replace(
        table, header=sheet.numbers[0], layout=LAYOUT, axis="Time [ms]", unit="ms", from_start=False, durations="ms"
    )


def _is_data(cells: tuple[str, ...]) -> bool:
    return len(cells) > 3 and is_date(cells[0]) and is_clock(cells[1]) and cells[3].upper() != "STOP TRG"


def _step(units: Decimal, took: Decimal) -> Decimal:
    """Milliseconds of a unit: the one with which all intervals together come closest to the seconds that the rows took."""
    return min((_TEN_US, _TEN_MS), key=lambda each: abs(units * each / 1000 - took))
