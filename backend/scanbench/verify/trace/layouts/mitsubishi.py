"""Data logging files of MELSEC (high speed data logger modules, logging of L/iQ-R/iQ-F CPUs; what GX LogViewer opens).

Layout: MELSEC iQ-R High Speed Data Logger Module User's Manual, appendix *Data Logging File Format*; MELSEC-L CPU Module
User's Manual (Data Logging Function), 3.3; QJ71DL96 User's Manual, 3.6. The first line has `[LOGGING]`, a version, and the
numbers of the lines with data types, with names, and with the first data. CSV, or text with tabs in UTF-16.
"""

import re
from dataclasses import replace
from decimal import Decimal

from scanbench.verify.trace.clock import is_clock, number
from scanbench.verify.trace.layouts.sheet import Sheet, padded, table_of, unique
from scanbench.verify.trace.table import Table, Unit, bad

LAYOUT = "MELSEC data logging"
_KINDS = ("BIT", "SHORT", "USHORT", "LONG", "ULONG", "FLOAT", "DOUBLE", "STRING", "RAW")
_ABOUT = ("INDEX", "TRIGGER", "STEP NO.", "PROGRAM NAME", "STEP", "PROGRAM")


def read(sheet: Sheet) -> Table | None:
    """The table; None where it is no such file."""
    head = sheet.lines[0]
    if re.sub(r"\s", "", head[0]).upper() != "[LOGGING]":
        return None
    try:
        types_at, names_at, data_at = (sheet.numbers.index(int(each)) for each in head[2:5])
    except ValueError:
        raise bad("The first line does not say in which lines the types, the names and the data are.", 1) from None
    kinds, names = sheet.lines[types_at], sheet.lines[names_at]
    width = len(names)
    kinds = padded(kinds, width)
    rows = [padded(cells, width) for cells in sheet.lines[data_at:]]
    keep = [at for at in range(width) if _plain(kinds[at]) in _KINDS and names[at]]
    try:
        axis, unit, times = _axis(kinds, rows)
    except ValueError as error:
        raise bad(f"The interval cannot be read: {error}.", None, "INTERVAL") from None
    columns = [axis, *unique(names[at] for at in keep)] if axis else unique(names[at] for at in keep)
    made = [
        (*([times[line]] if axis else []), *(_cell(row[at], kinds[at]) for at in keep)) for line, row in enumerate(rows)
    ]
    left_out = [
        f"`{names[at]}` is no variable of the program."
        for at in range(width)
        if at not in keep and names[at] and _plain(kinds[at]) in _ABOUT and _plain(kinds[at]) != "INDEX"
    ]
    table = table_of(sheet, columns, made, sheet.numbers[data_at:])
    return replace(
        table, header=sheet.numbers[names_at], layout=LAYOUT, axis=axis, unit=unit, from_start=False, durations="ms",
        left_out=tuple(left_out),
    )  # fmt: skip


def _plain(kind: str) -> str:
    return kind.split("[")[0].strip().upper()


def _axis(kinds: tuple[str, ...], rows: list[tuple[str, ...]]) -> tuple[str, Unit | None, list[str]]:
    """The intervals from one row to the next are the most exact; then date and time, unless rows share one; then the index."""
    places = {_plain(kind): at for at, kind in reversed(list(enumerate(kinds)))}
    if "INTERVAL" in places:
        unit: Unit = "ns" if "ns" in kinds[places["INTERVAL"]].lower() else "us"
        passed = Decimal(0)
        times: list[str] = []
        for row in rows:
            passed += number(row[places["INTERVAL"]] or "0", False) if times else 0
            times.append(str(passed))
        return f"Time [{unit}]", unit, times
    if "DATETIME" in places:
        clocks = [row[places["DATETIME"]].replace("/ ", " ") for row in rows]
        if all(map(is_clock, clocks)) and len(set(clocks)) == len(clocks):
            return "Time", "s", clocks
    if "INDEX" in places:
        return "INDEX", "scan", [row[places["INDEX"]] for row in rows]
    return "", None, []


def _cell(text: str, kind: str) -> str:
    """A number in the notation that its type says."""
    if "[HEX" in kind.replace(" ", "").upper() and text:
        return f"16#{text}"
    return text
