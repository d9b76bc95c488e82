"""Samples as CSV: the scan, its time, and a column for each signal, as people write the values."""

import csv
import io
from collections.abc import Callable, Iterator, Sequence

from scanbench.check.types import Elementary, Kind
from scanbench.taps.trace import TraceSignal
from scanbench.taps.trace_buffer import Samples, number_type

LINES = 4096
"""That are made at a time."""


def to_csv(samples: Samples, signals: Sequence[TraceSignal], interval_ns: int) -> Iterator[str]:
    """The text, piece by piece. A field is empty where a signal has no value; TIME and the like are in seconds."""
    out = io.StringIO()
    write = csv.writer(out, lineterminator="\r\n").writerow
    write(["scan", "time [s]", *(_guarded(f"{each.text}{_unit(each)}") for each in signals)])
    texts = [_texts(each) for each in signals]
    columns = [
        column.astype(f"<u{each.size or 1}").view(
            number_type(Elementary("", Kind(each.kind or "bool"), each.size or 1))
        )
        for column, each in zip(samples.values, signals, strict=True)
    ]
    for start in range(0, len(samples), LINES):
        piece = slice(start, start + LINES)
        values = [column[piece].tolist() for column in columns]
        for at, (scan, valid) in enumerate(
            zip(samples.scans[piece].tolist(), samples.valid[piece].tolist(), strict=True)
        ):
            row = [
                text(of[at]) if valid >> index & 1 else ""
                for index, (of, text) in enumerate(zip(values, texts, strict=True))
            ]
            write([scan, f"{scan * interval_ns / 1e9:.9g}", *row])
        yield out.getvalue()
        out.seek(0)
        out.truncate()
    if not len(samples):
        yield out.getvalue()


def _unit(signal: TraceSignal) -> str:
    return " [s]" if signal.kind == Kind.TIME else ""


def _guarded(text: str) -> str:
    """A spreadsheet takes a field that begins like this for a formula."""
    return f"'{text}" if text[:1] in "=+-@" else text


def _texts(signal: TraceSignal) -> Callable[[float], str]:
    if signal.kind == Kind.TIME:
        return lambda value: f"{value / 1e9:.9g}"
    if signal.kind == Kind.REAL:
        return lambda value: f"{value:.{9 if signal.size == 4 else 17}g}"
    names = {number: name for name, number in signal.values}
    return lambda value: names.get(int(value), str(int(value)))
