"""A place in the tokens of one file, and the problems met on the way."""

from scanbench.problems import Problem, Span
from scanbench.syntax.lexer import Lex, Token, span_of, tokenize
from scanbench.syntax.source import Source

MAX_DEPTH = 200
"""Nesting of statements and parentheses; deeper text is refused, as no one can read it and recursion must end."""


class Unexpected(Exception):
    """Raised where parsing cannot go on; whoever can find the next beginning catches it."""


class Cursor:
    def __init__(self, source: Source) -> None:
        self.source = source
        self.tokens, self.problems = tokenize(source)
        self.at = 0
        self.depth = 0

    @property
    def token(self) -> Token:
        return self.tokens[self.at]

    def ahead(self, count: int) -> Token:
        return self.tokens[min(self.at + count, len(self.tokens) - 1)]

    def take(self) -> Token:
        token = self.tokens[self.at]
        if token.kind is not Lex.END:
            self.at += 1
        return token

    def is_(self, *texts: str) -> bool:
        """The next token is one of these operators or keywords."""
        token = self.tokens[self.at]
        return token.kind in (Lex.OPERATOR, Lex.KEYWORD) and token.text in texts

    def accept(self, *texts: str) -> bool:
        if self.is_(*texts):
            self.at += 1
            return True
        return False

    def expect(self, text: str, where: str) -> Token:
        if not self.is_(text):
            self.fail(f"`{text}` expected {where}")
        return self.take()

    def close(self, text: str, where: str) -> None:
        """Expects a closing mark that can be missing without harm: reported behind the last token, then gone on."""
        if not self.accept(text):
            last = self.tokens[max(self.at - 1, 0)]
            span = self.source.span(max(last.end - 1, 0), last.end)
            self.problems.append(Problem("S003", f"`{text}` expected {where}{self._found()}.", span))

    def name(self, what: str) -> Token:
        token = self.token
        if token.kind is Lex.NAME:
            return self.take()
        if token.kind is Lex.KEYWORD:
            self.fail(f"{what} expected; `{token.text}` is a keyword and cannot be a name")
        self.fail(f"{what} expected")
        raise AssertionError

    def fail(self, message: str, token: Token | None = None) -> None:
        token = token or self.token
        self.report("S003", message + self._found(token) + ".", span_of(self.source, token))
        raise Unexpected

    def report(self, code: str, message: str, span: Span) -> None:
        self.problems.append(Problem(code, message, span))

    def here(self) -> Span:
        return span_of(self.source, self.token)

    def span_from(self, start: Token) -> Span:
        """From `start` to the last token taken."""
        return self.source.span(start.start, max(self.tokens[max(self.at - 1, 0)].end, start.end))

    def _found(self, token: Token | None = None) -> str:
        token = token or self.token
        return ", but the file ends here" if token.kind is Lex.END else f", found `{token.text}`"

    def enter(self) -> None:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            self.fail(f"nested more than {MAX_DEPTH} deep; split this up")

    def leave(self) -> None:
        self.depth -= 1
