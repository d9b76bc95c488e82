"""What a column of scans or times is called, and what it counts."""

import re

from scanbench.verify.trace.table import Unit

TIME_UNITS: tuple[Unit, ...] = ("ns", "us", "ms", "s")
_SCANS = ("scan", "scans", "cycle", "スキャン")
_TIMES = ("time", "timestamp", "t", "datetime", "zeit", "zeitstempel", "時間", "時刻", "日時")
_COUNTS = ("sample", "samples", "sampleno", "samplenumber", "index", "no", "recordno", "サンプル")
"""Rows are numbered: they are scans only where nothing better is there, and never count from the controller's start."""
_UNITS = r"ns|us|µs|μs|ms|s|sec|msec|usec"
_NAMED = re.compile(
    rf"(.*\S)\s*(?:\[\s*({_UNITS})\s*\]|\(\s*({_UNITS})\s*\)|\s/\s*({_UNITS})|\sin\s({_UNITS}))", re.IGNORECASE
)
_TAILED = re.compile(r"(\w+)_(ns|us|ms|s)", re.IGNORECASE)
_BRACKETED = re.compile(r"(.*\S)\s*[\[(]\s*([^\d\[\]()][^\[\]()]*)\s*[\])]")


def plain_name(column: str) -> tuple[str, Unit | None]:
    """A column's name without the unit in brackets after it, and the unit if it is one of time."""
    found = _NAMED.fullmatch(column)
    if found is None:
        return column, None
    return found.group(1), unit_of(next(filter(None, found.groups()[1:])))


def bare_name(column: str) -> str:
    """A column's name without any unit in brackets after it: `speed [mm/s]` is `speed`."""
    name = plain_name(column)[0]
    found = _BRACKETED.fullmatch(name)
    return name if found is None else found.group(1)


def axis_of(column: str) -> Unit | None:
    """What an axis of this name counts; None: by its name it is none."""
    name, unit = plain_name(column)
    tailed = _TAILED.fullmatch(name) if unit is None else None
    if tailed is not None:
        name, unit = tailed.group(1), unit_of(tailed.group(2))
    short = _short(name)
    if short in (*_SCANS, *_COUNTS):
        return "scan" if unit is None else None
    return (unit or "s") if short in _TIMES else None


def only_counts(column: str) -> bool:
    """Whether the rows are numbered by this column, which need not be scans."""
    return _short(column) in _COUNTS


def _short(name: str) -> str:
    """`Time stamp` is timestamp, `Sample no.` sampleno."""
    return name.lower().replace(" ", "").rstrip(".")


def unit_of(text: str) -> Unit:
    """The unit of time that is written so."""
    short = text.strip().lower().replace("µ", "u").replace("μ", "u").replace("sec", "s")
    return next((each for each in TIME_UNITS if each == short), "s")
