"""Trends of Studio 5000 Logix Designer, saved as CSV: keyword rows, then `Header:` with the tags, then `Data` rows.

Layout: public readers and writers of it (`parseStudio5000CSV` in several web viewers of such files, and a writer that begins with
`Controller Name:`, `Trend Name:`, `Trend Tags:`, `Sample Period:`, `Start Trigger:`). Date and time of day are two cells, and the
milliseconds come after a semicolon: `Data,11/28/2026,10:15:20;125,1,0.5`.
"""

from dataclasses import replace

from scanbench.verify.trace.layouts.sheet import Sheet, padded, table_of, unique
from scanbench.verify.trace.table import Table

LAYOUT = "Studio 5000 trend"


def read(sheet: Sheet) -> Table | None:
    """The table; None where it is no such file."""
    head = next((at for at, cells in enumerate(sheet.lines[:60]) if cells[0].lower() == "header:"), None)
    if head is None or len(sheet.lines[head]) < 4:
        return None
    tags = [each for each in sheet.lines[head][3:] if each]
    width = 3 + len(tags)
    rows, numbers = [], []
    for cells, at in zip(sheet.lines[head + 1 :], sheet.numbers[head + 1 :], strict=True):
        if cells[0].lower() == "data":
            cells = padded(cells, width)
            rows.append((f"{cells[1]} {cells[2].replace(';', '.')}", *cells[3:]))
            numbers.append(at)
    table = table_of(sheet, ("Time", *unique(tags)), rows, numbers)
    return replace(
        table, header=sheet.numbers[head], layout=LAYOUT, axis="Time", unit="s", from_start=False, durations="ms"
    )
