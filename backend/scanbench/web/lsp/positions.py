"""Positions of LSP (lines from 0; UTF-16 units, or characters where client and server agreed on that) and ours."""

from lsprotocol import types

from scanbench.language.index import Occurrence
from scanbench.language.reading import Reading
from scanbench.problems import Span


class Positions:
    """Translates for one reading; `utf16` says what the client counts."""

    def __init__(self, reading: Reading, utf16: bool) -> None:
        self._reading = reading
        self._utf16 = utf16

    def ours(self, file: str, position: types.Position) -> int:
        """The position in the text of a file."""
        column = position.character
        start = self._reading.position(file, position.line + 1, 1)
        if self._utf16:
            text = self._reading.text(file)
            end = text.find("\n", start)
            line = text[start : len(text) if end < 0 else end]
            column = column if line.isascii() else _characters(line, column)
        return self._reading.position(file, position.line + 1, column + 1)

    def theirs(self, file: str, position: int) -> types.Position:
        """The same for the client."""
        line, column = self._reading.place(file, position)
        return types.Position(line - 1, self._units(file, position - column + 1, position))

    def between(self, file: str, start: int, end: int) -> types.Range:
        """A stretch of a text."""
        return types.Range(self.theirs(file, start), self.theirs(file, end))

    def span(self, span: Span) -> types.Range:
        """Where a span is; of a file that is not of the project the beginning."""
        if span.file not in self._reading.files:
            return types.Range(types.Position(0, 0), types.Position(0, 0))
        start = self._reading.position(span.file, span.line, span.column)
        return self.between(span.file, start, self._reading.position(span.file, span.end_line, span.end_column))

    def occurrence(self, found: Occurrence) -> types.Range:
        """Where a name is."""
        return self.span(found.span)

    def _units(self, file: str, start: int, end: int) -> int:
        if not self._utf16:
            return end - start
        text = self._reading.text(file)[start:end]
        return len(text) if text.isascii() else len(text.encode("utf-16-le")) // 2


def _characters(line: str, units: int) -> int:
    """So many characters take so many units of UTF-16."""
    return len(line.encode("utf-16-le")[: 2 * units].decode("utf-16-le", "ignore"))
