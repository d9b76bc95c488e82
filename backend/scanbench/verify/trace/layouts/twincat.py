"""TwinCAT 3 Scope, *Export to CSV*: below a preamble a block of properties, then groups of channels that share a column of times.

Layout: the files in `tests/data` of github.com/CagtayFabry/pytcs (exports of TwinCAT Scope 3.4.3145.3), and
infosys.beckhoff.com, TE13xx TC3 Scope View, *Export in csv*. In the row `Name` a cell that says `Name` again is above a column
of times, the cells after it are the channels that have them. Times are milliseconds from the first sample, or with *Full
Timestamp* FILETIME: units of 100 ns since 1601.
"""

from dataclasses import dataclass, replace
from decimal import Decimal

from scanbench.verify.trace.clock import number
from scanbench.verify.trace.layouts.sheet import Series, Sheet, joined, table_of, unique
from scanbench.verify.trace.table import Table, bad

LAYOUT = "TwinCAT Scope"
_FILETIME = 10**16
"""Larger numbers are no milliseconds."""
_LABELS = ("data-type", "sampletime[ms]", "symbolname", "symbolbased", "variablesize")


@dataclass(frozen=True, slots=True)
class _Channel:
    name: str
    time: int
    """Index of the column with its times."""
    value: int


def read(sheet: Sheet) -> Table | None:
    """The table; None where it is no such file."""
    labels = {cells[0].lower().replace(" ", ""): at for at, cells in enumerate(sheet.lines[:60])}
    names = next((at for at, cells in enumerate(sheet.lines[:60]) if cells[0] == "Name" and len(cells) > 2), None)
    if names is None:  # with a single channel the row is as short as the first line of the file
        named = [at for at, cells in enumerate(sheet.lines[:60]) if cells[0] == "Name"]
        names = named[1] if len(named) > 1 else None
    if names is None or sum(each in labels for each in _LABELS) < 3:
        return None
    properties = _properties(sheet, names)
    channels, left_out = _channels(sheet.lines[names], properties)
    if not channels:
        raise bad("The export has no column of times: export it with time columns (Timelines).", sheet.numbers[names])
    body = [at for at in range(names + 1 + len(properties), len(sheet.lines)) if _is_data(sheet.lines[at])]
    series = [_series(sheet, channel, body) for channel in channels]
    rows, numbers = joined(series, sheet.comma)
    table = table_of(sheet, ("Time [ms]", *unique(each.name for each in series)), rows, numbers)
    return replace(
        table, header=sheet.numbers[names], layout=LAYOUT, axis="Time [ms]", unit="ms", from_start=False, durations="ms",
        left_out=tuple(left_out),
    )  # fmt: skip


def _properties(sheet: Sheet, names: int) -> dict[str, tuple[str, ...]]:
    """The rows below the names, until the first one with numbers."""
    found: dict[str, tuple[str, ...]] = {}
    for cells in sheet.lines[names + 1 :]:
        if _is_data(cells):
            break
        found[cells[0].lower().replace(" ", "")] = cells
    return found


def _is_data(cells: tuple[str, ...]) -> bool:
    return bool(cells[0]) and cells[0].replace(",", ".").replace(".", "", 1).lstrip("-").isdigit()


def _channels(names: tuple[str, ...], properties: dict[str, tuple[str, ...]]) -> tuple[list[_Channel], list[str]]:
    symbols = properties.get("symbolname", ())
    found: list[_Channel] = []
    left_out = []
    time = None
    for at, name in enumerate(names):
        if name == "Name":
            time = at
        elif name and time is not None:
            symbol = symbols[at] if at < len(symbols) else ""
            if _scaled(properties, at):
                left_out.append(f"`{name}` was scaled by the scope, so it is not what the variable is.")
            elif symbol and any(each.name == symbol for each in found):
                left_out.append(f"`{name}` is `{symbol}` once more.")
            else:
                found.append(_Channel(symbol or name, time, at))
    return found, left_out


def _scaled(properties: dict[str, tuple[str, ...]], at: int) -> bool:
    plain = (("scalefactor", 1), ("offset", 0), ("unitscalefactor", 1), ("unitoffset", 0))
    for label, neutral in plain:
        cells = properties.get(label, ())
        if at < len(cells) and cells[at] and not _is(cells[at], neutral):
            return True
    return False


def _is(text: str, neutral: int) -> bool:
    try:
        return number(text, True) == neutral
    except ValueError:
        return False


def _series(sheet: Sheet, channel: _Channel, body: list[int]) -> Series:
    """Slower channels have fewer rows: their cells end first."""
    times, values, numbers = [], [], []
    for at in body:
        cells = sheet.lines[at]
        if channel.value < len(cells) and cells[channel.time] and cells[channel.value]:
            times.append(cells[channel.time])
            values.append(cells[channel.value])
            numbers.append(sheet.numbers[at])
    if times and len(times[0]) > 16:
        try:
            exact = [number(each, sheet.comma) for each in times]
        except ValueError:
            return Series(channel.name, times, values, numbers)
        if exact[0] > _FILETIME:
            times = [f"{(each - exact[0] // 1) / Decimal(10_000):f}" for each in exact]
    return Series(channel.name, times, values, numbers)
