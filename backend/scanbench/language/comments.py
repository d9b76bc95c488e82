"""Comments and pragmas of a text: what is between its tokens and not blank."""

from collections.abc import Iterator
from dataclasses import dataclass

from scanbench.syntax.lexer import Lex, Tokens, nested_end

_CLOSERS = {"(": "*)", "/": "*/", "{": "}"}


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment or pragma; also a string that its line does not close."""

    text: str
    """With its marks."""
    start: int
    end: int
    """Position after it."""

    @property
    def goes_on(self) -> bool:
        """Whether what is typed directly after it belongs to it."""
        if self.text.startswith(("//", "'", '"')):
            return True
        closer = _CLOSERS[self.text[0]]
        return len(self.text) < 2 * len(closer) or not self.text.endswith(closer)

    @property
    def said(self) -> str:
        """What it says, without marks and ornaments; nothing for a pragma."""
        if self.text.startswith("//"):
            return self.text.lstrip("/").strip()
        if not self.text.startswith(("(*", "/*")):
            return ""
        inner = self.text[2:].removesuffix(_CLOSERS[self.text[0]])
        return "\n".join(line.strip().strip("*").strip() for line in inner.strip().splitlines()).strip()


def comments(text: str, tokens: Tokens) -> Iterator[Comment]:
    """All of a text, in order."""
    at = 0
    for kind, start, token in zip(tokens.kinds, tokens.starts, tokens.texts, strict=True):
        if at < start and not text[at:start].isspace():
            yield from between(text, at, start)
        if kind is Lex.END:
            return
        at = start + len(token)


def between(text: str, start: int, end: int) -> Iterator[Comment]:
    """Those between two tokens."""
    at = start
    while at < end:
        if text[at] in "'\"" or text.startswith("//", at):
            close = _line_end(text, at)
        elif text.startswith(("(*", "/*", "{"), at):
            close = nested_end(text, at, end)
            close = end if close < 0 else close
        else:  # a blank, or what cannot be read
            at += 1
            continue
        yield Comment(text[at:close].rstrip(), at, close)
        at = close


def _line_end(text: str, at: int) -> int:
    close = text.find("\n", at)
    return len(text) if close < 0 else close
