"""What a quick fix is, and how it finds its place in a text."""

from dataclasses import dataclass

from scanbench.syntax.lexer import Lex, tokenize
from scanbench.syntax.source import Source, Stretch


@dataclass(frozen=True, slots=True)
class Fix:
    """One way to mend a problem: a stretch of the file becomes a text."""

    title: str
    start: int
    end: int
    text: str


def balanced(text: str, start: int, end: int) -> tuple[int, int]:
    """The stretch with the parentheses around it whose other half is inside: the place of an expression leaves its outer ones out."""
    open_, missing = 0, 0
    for token in pieces(text[start:end]):
        if token in "([":
            open_ += 1
        elif token in ")]" and open_:
            open_ -= 1
        elif token in ")]":
            missing += 1
    while missing and (before := text[:start].rstrip())[-1:] in ("(", "["):
        start, missing = len(before) - 1, missing - 1
    while open_ and (after := text[end:].lstrip())[:1] in (")", "]"):
        end, open_ = len(text) - len(after) + 1, open_ - 1
    return start, end


def pieces(text: str) -> list[str]:
    """The tokens of a text."""
    found = tokenize(Source("typed", text))[0]
    return [text for text, kind in zip(found.texts, found.kinds, strict=True) if kind is not Lex.END]


def offset(text: str, token: str) -> int:
    """Where the first such token is in a text, outside of its parentheses; -1 where there is none."""
    found = tokenize(Source("typed", text))[0]
    depth = 0
    for piece, start in zip(found.texts, found.starts, strict=False):
        depth += (piece in ("(", "[")) - (piece in (")", "]"))
        if piece == token and depth <= 0:
            return start
    return -1


def stretch(span: object) -> tuple[int, int]:
    """The beginning and the end of a place in a text that was parsed by itself."""
    assert isinstance(span, Stretch)
    return span.start, span.end
