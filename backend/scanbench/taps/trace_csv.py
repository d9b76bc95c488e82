"""Samples as CSV: the scan, its time, and a column for each signal, as people write the values."""

import csv
import io
from collections.abc import Callable, Iterable, Iterator, Sequence

from scanbench.program.types import Elementary, Kind
from scanbench.taps.trace import TraceSignal
from scanbench.taps.trace_buffer import Samples, number_type

PIECE = 1 << 18
"""Characters that are made at a time."""


def to_csv(pages: Iterable[Samples], signals: Sequence[TraceSignal], interval_ns: int) -> Iterator[str]:
    """The text, page by page. A field is empty where a signal has no value; TIME and the like are in seconds."""
    out = io.StringIO()
    write = csv.writer(out, lineterminator="\r\n").writerow
    write(["scan", "time [s]", *(_guarded(f"{each.text}{_unit(each)}") for each in signals)])
    texts = [_texts(each) for each in signals]
    types = [Elementary("", Kind(each.kind or "bool"), each.size or 1) for each in signals]
    for page in pages:
        yield _taken(out)
        values = [
            column.astype(f"<u{type.size}").view(number_type(type)).tolist()
            for column, type in zip(page.values, types, strict=True)
        ]
        for at, (scan, valid) in enumerate(zip(page.scans.tolist(), page.valid.tolist(), strict=True)):
            row = [
                text(of[at]) if valid >> index & 1 else ""
                for index, (of, text) in enumerate(zip(values, texts, strict=True))
            ]
            write([scan, f"{scan * interval_ns / 1e9:.9g}", *row])
            if out.tell() > PIECE:
                yield _taken(out)
    yield _taken(out)


def _taken(out: io.StringIO) -> str:
    text = out.getvalue()
    out.seek(0)
    out.truncate()
    return text


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
