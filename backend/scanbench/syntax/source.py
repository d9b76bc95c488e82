"""A source text and its places."""

import codecs
from bisect import bisect_right
from contextlib import suppress

from scanbench.problems import Span


class Source:
    """One file's text, or a stretch of it, under the name that problems show."""

    __slots__ = ("_starts", "above", "defined", "name", "text")

    def __init__(self, name: str, text: str, above: int = 0, defined: frozenset[str] = frozenset()) -> None:
        self.name, self.text = name, text
        self.defined = defined
        """Names, in upper case, that the project defines for conditional pragmas."""
        self.above = above
        """Lines of the file before this text. It changes when text above is edited: spans then say their new places."""
        self._starts: list[int] | None = None

    def edit(self, text: str) -> None:
        """Replaces the text; spans before the first difference stay valid."""
        self.text, self._starts = text, None

    def span(self, start: int, end: int) -> Span:
        """The span of text[start:end]."""
        return Stretch(self, start, end)

    def line(self, at: int) -> int:
        """The line of the character at this position, from 1."""
        return bisect_right(self._line_starts(), at) + self.above

    def place(self, at: int) -> tuple[int, int]:
        """Line and column of the character at this position, from 1."""
        starts = self._line_starts()
        line = bisect_right(starts, at)
        return line + self.above, at - starts[line - 1] + 1

    def _line_starts(self) -> list[int]:
        if self._starts is None:
            self._starts = starts = [0]
            at = self.text.find("\n")
            while at >= 0:
                starts.append(at + 1)
                at = self.text.find("\n", at + 1)
        return self._starts


class Stretch(Span):
    """A span that finds its lines and columns only when someone asks: most spans of a tree are never shown."""

    __slots__ = ("_end", "_source", "_start")

    # plain assignment, which a frozen dataclass forbids and its speed needs
    __setattr__ = object.__setattr__

    def __init__(self, source: Source, start: int, end: int) -> None:
        self._source = source
        self._start = start
        self._end = end

    @property
    def source(self) -> Source:
        """The text that it is a stretch of."""
        return self._source

    @property
    def start(self) -> int:
        """The position of its first character in the source."""
        return self._start

    @property
    def end(self) -> int:
        """The position after its last character in the source."""
        return self._end

    @property
    def file(self) -> str:
        return self._source.name

    @property
    def line(self) -> int:
        return self._source.line(self._start)

    @property
    def column(self) -> int:
        return self._source.place(self._start)[1]

    @property
    def end_line(self) -> int:
        return self._source.place(self._end)[0] if self._end - self._start > 1 else self.line

    @property
    def end_column(self) -> int:
        # the end of a single character is on its line, also when that character ends the line
        return (
            self._source.place(self._end)[1] if self._end - self._start > 1 else self.column + self._end - self._start
        )

    def to(self, last: Span) -> Span:
        if isinstance(last, Stretch) and last._source is self._source:
            return Stretch(self._source, self._start, last._end)
        return Span(self.file, self.line, self.column, last.end_line, last.end_column)

    def last(self, length: int) -> Span:
        return Stretch(self._source, self._end - length, self._end)

    def plain(self) -> Span:
        """The same as a span of its own, which keeps no text alive."""
        line, column = self._source.place(self._start)
        return Span(self.file, line, column, self.end_line, self.end_column)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Stretch) and other._source is self._source:
            return self._start == other._start and self._end == other._end
        if not isinstance(other, Span):
            return NotImplemented
        mine = (self.file, self.line, self.column, self.end_line, self.end_column)
        return mine == (other.file, other.line, other.column, other.end_line, other.end_column)

    def __hash__(self) -> int:
        return hash((self.file, self.line, self.column, self.end_line, self.end_column))

    def __repr__(self) -> str:
        return repr(self.plain())

    def __reduce__(self) -> tuple[type[Span], tuple[str, int, int, int, int]]:
        return Span, (self.file, self.line, self.column, self.end_line, self.end_column)


def decode(data: bytes) -> str:
    """Text of a file: UTF-8, UTF-16, else Windows-1252 or Latin-1, as older tools export it. Line ends become LF."""
    mark, encoding = _encoding(data)
    return data[len(mark) :].decode(encoding).replace("\r\n", "\n").replace("\r", "\n")


def _encoding(data: bytes) -> tuple[bytes, str]:
    """The byte order mark that the bytes begin with, and the encoding of the rest."""
    marks = {codecs.BOM_UTF8: "utf-8", codecs.BOM_UTF16_LE: "utf-16-le", codecs.BOM_UTF16_BE: "utf-16-be"}
    mark = next((each for each in marks if data.startswith(each)), b"")
    unmarked = {0: "utf-16-be", 1: "utf-16-le"}.get(data[:2].find(0), "utf-8")  # its first character is one of ASCII
    for encoding in (marks.get(mark, unmarked), "cp1252"):
        with suppress(UnicodeDecodeError):
            data[len(mark) :].decode(encoding)
            return mark, encoding
    return mark, "latin-1"


def encoded(text: str, like: bytes) -> bytes:
    """A text with LF as bytes, in the encoding and with the line ends of the file that these bytes are."""
    mark, encoding = _encoding(like)
    was = like[len(mark) :].decode(encoding)
    end = "\r\n" if "\r\n" in was else "\r" if "\r" in was and "\n" not in was else "\n"
    return mark + text.replace("\n", end).encode(encoding)
