"""Whose layout a file has."""

from collections.abc import Callable

from scanbench.verify.trace.layouts import codesys, mitsubishi, panasonic, rockwell, shape, twincat
from scanbench.verify.trace.layouts.sheet import DELIMITERS, Sheet, sheet_of
from scanbench.verify.trace.table import Table

_KNOWN: tuple[Callable[[Sheet], Table | None], ...] = (twincat.read, mitsubishi.read, rockwell.read, panasonic.read)


def read_known(text: str, name: str, note: str) -> Table | None:
    """The table of a file whose layout we know; None where it is none of these. Raises `BadTraceFile`."""
    if text.lstrip()[:1] == "<":
        return codesys.read_xml(text, name, note)
    made = codesys.read_text(text, name, note)
    if made is not None:
        return made
    for delimiter in _in_question(text):
        sheet = sheet_of(text, name, note, delimiter)
        if sheet is None or not sheet.lines:
            continue
        for read in _KNOWN:
            made = read(sheet)
            if made is not None:
                return made
    return None


def read_by_shape(text: str, name: str, note: str) -> Table | None:
    """The table of a file that has lines about the recording before its names and rows; None where no such rows are found."""
    sheets = [each for delimiter in _in_question(text) if (each := sheet_of(text, name, note, delimiter)) is not None]
    best = max(sheets, key=shape.lines_of_data, default=None)
    return None if best is None or not shape.lines_of_data(best) else shape.read(best)


def _in_question(text: str) -> list[str]:
    """Delimiters that the file has at all."""
    return [each for each in DELIMITERS if each in text]
