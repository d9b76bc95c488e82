"""Tokens of SCL that are read from the first to the last, and those of the standard that are written instead."""

from scanbench.problems import Problem
from scanbench.syntax.lexer import Lex, Tokens
from scanbench.syntax.source import Source


class Rewriter:
    """What is read, what is written, and where it is."""

    def __init__(self, source: Source, tokens: Tokens) -> None:
        self.problems: list[Problem] = []
        self._source = source
        self._in, self._out = tokens, Tokens([], [], [], tokens.pragmas)
        self._at = 0
        self._locals: set[str] = set()
        """Names that are declared in this block, or written with `#`, in upper case."""
        self._declares = False
        """Between VAR and END_VAR."""
        self._starts = False
        """Among the start values after BEGIN of a data block."""
        self._depth = 0
        """Of parentheses."""

    def _refuse(self, message: str, at: int) -> None:
        self.problems.append(Problem("X001", message, self._source.span(at, at + 1)))

    def _put(self, kind: Lex, text: str, at: int) -> None:
        self._out.kinds.append(kind)
        self._out.texts.append(text)
        self._out.starts.append(at)

    def _word(self, ahead: int = 0) -> str:
        at = max(0, min(self._at + ahead, len(self._in.texts) - 1))
        return "" if self._in.kinds[at] is Lex.STRING else self._in.texts[at].upper()

    def _ended(self) -> bool:
        return self._in.kinds[self._at] is Lex.END

    def _begins_line(self) -> bool:
        before = self._in.starts[self._at - 1] if self._at else 0
        return self._at == 0 or "\n" in self._source.text[before : self._in.starts[self._at]]

    def _skip_line(self) -> None:
        end = self._source.text.find("\n", self._in.starts[self._at])
        while not self._ended() and (end < 0 or self._in.starts[self._at] < end):
            self._at += 1

    def _several(self, tokens: tuple[tuple[Lex, str], ...], at: int) -> None:
        for kind, text in tokens:
            self._put(kind, text, at)

    def _skip_to(self, end: int) -> None:
        while not self._ended() and self._in.starts[self._at] < end:
            self._at += 1
