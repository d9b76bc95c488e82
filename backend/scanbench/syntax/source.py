"""A source text and its places."""

from bisect import bisect_right
from dataclasses import dataclass, field

from scanbench.problems import Span


@dataclass(slots=True)
class Source:
    """One file's text under the name that problems show."""

    name: str
    text: str
    _starts: list[int] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._starts = [0]
        at = self.text.find("\n")
        while at >= 0:
            self._starts.append(at + 1)
            at = self.text.find("\n", at + 1)

    def span(self, start: int, end: int) -> Span:
        """The span of text[start:end]."""
        line = bisect_right(self._starts, start)
        end_line = line if end - start < 2 else bisect_right(self._starts, end)
        first, last = self._starts[line - 1], self._starts[end_line - 1]
        return Span(self.name, line, start - first + 1, end_line, end - last + 1)


def decode(data: bytes) -> str:
    """Text of a file: UTF-8 with or without BOM, else Latin-1, as older tools export it. Line ends become LF."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.removeprefix(b"\xef\xbb\xbf").decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n")
