"""Reads a trace file, whole or not at all: CSV or JSON as in docs/trace-format.md, or what a tool of some vendor writes."""

import codecs

from scanbench.verify.trace.clock import is_date
from scanbench.verify.trace.csv import read_csv
from scanbench.verify.trace.json import read_json
from scanbench.verify.trace.layouts.recognise import read_by_shape, read_known
from scanbench.verify.trace.layouts.shape import is_paired
from scanbench.verify.trace.layouts.sheet import is_moment
from scanbench.verify.trace.long import widened
from scanbench.verify.trace.table import MAX_BYTES, BadTraceFile, Table, bad, check_size

__all__ = ["MAX_BYTES", "BadTraceFile", "Table", "read_trace"]


def read_trace(data: bytes, name: str) -> Table:
    """The table in a file of this name. Raises `BadTraceFile`, which says where and why."""
    if len(data) > MAX_BYTES:
        raise bad(f"The file has {len(data):,} bytes; at most {MAX_BYTES:,} are read. Cut it into several files.")
    text, note = _text(data)
    if not text.strip():
        raise bad("The file is empty.")
    json = text.lstrip()[0] in "[{" if not name.lower().endswith((".csv", ".txt", ".tsv")) else False
    table = widened(read_json(text, name, note)) if json or name.lower().endswith(".json") else _lines(text, name, note)
    check_size(len(table.columns), len(table.rows))
    if not table.rows:
        raise bad("The file has names of columns, but no row with values.", table.header)
    return table


def _lines(text: str, name: str, note: str) -> Table:
    """A file of lines: of a tool that we know, as our format says, or by its shape. What it is if not even that is said of our
    format."""
    known = read_known(text, name, note)
    if known is not None:
        return known
    try:
        table = read_csv(text, name, note)
    except BadTraceFile:
        shaped = read_by_shape(text, name, note)
        if shaped is None:
            raise
        return shaped
    if table.rows and (not is_moment(table.rows[0][0]) or is_date(table.rows[0][0]) or is_paired(table.columns)):
        shaped = read_by_shape(text, name, note)  # there are lines below the names, or more columns of times
        if shaped is not None:
            return shaped
    return widened(table)


def _text(data: bytes) -> tuple[str, str]:
    """The text, and what is to be said of how it was read."""
    for mark, encoding in (
        (codecs.BOM_UTF8, "utf-8-sig"),
        (codecs.BOM_UTF16_LE, "utf-16"),
        (codecs.BOM_UTF16_BE, "utf-16"),
    ):
        if data.startswith(mark):
            try:
                return data.decode(encoding), ""
            except UnicodeDecodeError as error:
                raise bad(
                    f"The file says that it is {encoding.removesuffix('-sig').upper()}, but is not: byte {error.start}."
                ) from None
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        return _guessed(data, error.start)
    if "\0" in text:
        raise bad("The file has zero bytes, so it is no text. Save it as CSV or JSON in UTF-8.")
    return text, ""


def _guessed(data: bytes, at: int) -> tuple[str, str]:
    if b"\0" in data:
        raise bad(f"The file is no text (byte {at} is not UTF-8). Save it as CSV or JSON in UTF-8.")
    encoding, named = "latin-1", "Latin-1"
    if any(0x80 <= byte < 0xA0 for byte in data):  # no characters in Latin-1, but half of the lead bytes of Shift_JIS
        encoding, named = "cp932", "Shift_JIS (CP932)"
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        encoding, named = "cp1252", "Windows-1252"
        text = data.decode(encoding, "replace")
    return text, f"The file is not UTF-8 (byte {at}); it was read as {named}."
