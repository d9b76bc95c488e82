"""A place in the tokens of one file, and the problems met on the way."""

import re
import sys
from collections.abc import Collection

from scanbench.problems import Problem, Span
from scanbench.syntax import tree
from scanbench.syntax.conditions import chosen
from scanbench.syntax.lexer import AHEAD, DRAWN, Lex, Tokens, tokenize
from scanbench.syntax.pragmas import in_out_pragmas, subrange_policies
from scanbench.syntax.source import Source, Stretch

MAX_DEPTH = 200
"""Nesting of statements and parentheses; deeper text is refused, as no one can read it and recursion must end."""
FRAMES_A_LEVEL = 20
"""Python frames between one parenthesis and the next: an operand of each strength, and the rules between."""
FRAMES_OF_TYPES = 30_000
"""Python frames for types that contain each other and calls that lead to calls: they take no room on the stack of C."""
sys.setrecursionlimit(max(sys.getrecursionlimit(), MAX_DEPTH * FRAMES_A_LEVEL + 1000, FRAMES_OF_TYPES))
MAX_PROBLEMS = 1000
"""Of one file; a text with more is not a program, and nobody reads so many."""

NAME = Lex.NAME


class Unexpected(Exception):
    """Raised where parsing cannot go on; whoever can find the next beginning catches it."""


COMBINES = re.compile(r"[-+*/]=")


class Cursor:
    """A token is the number of its place; `texts[token]` is what was written, keywords in upper case.

    No name, number or string is spelt like a keyword or operator, so comparing texts is enough to find those. Words
    that are keywords only in places (METHOD, BY, ...) are names here, and are asked for with `word` and `accept_word`.
    """

    def __init__(self, source: Source, tokens: Tokens | None = None) -> None:
        """`tokens` are given where only parts of the text are to be read."""
        self.source = source
        self.problems: list[Problem] = []
        if tokens is None:
            tokens, self.problems = tokenize(source)
        if tokens.pragmas:
            tokens, wrong = chosen(source, tokens)
            self.problems += wrong
        self.kinds, self.texts, self.starts, self.pragmas = tokens.kinds, tokens.texts, tokens.starts, tokens.pragmas
        self.in_out_pragmas = in_out_pragmas(self.pragmas)
        """Those that no FUNCTION_BLOCK has taken yet."""
        self.subrange_policies = subrange_policies(self.pragmas)
        """Those that no declaration has taken yet."""
        self.at = 0
        self.depth = 0
        self.wires: set[str] | None = None
        """In a function block diagram: the wires that were read, in upper case. Elsewhere `#x` is a variable of one vendor."""
        self.wall = -1
        """The token at which reading stops although it could be a name: END_RUNG, or the step after an ACTION without END_ACTION; else -1."""
        self.parts = False
        """Whether a start value may name parts at any depth, `(a.b := 1, c[2] := 3)`: in the texts of one vendor."""
        self.actions: list[tuple[str, Span, list[tree.PouDeclaration]]] = []
        """Actions that are written apart from their POU, and its name."""
        self.combines = bool(COMBINES.search(source.text))
        """Whether the text may have assignments like `x += 1`."""
        self.variadic = False
        """Whether a declaration with `...` was read."""
        self.asked: list[tree.NamedType] = []
        """Generic blocks that the statements of this POU make by `__NEW`."""
        self.list_name = ""
        """Of the variables that a vendor keeps in a list of its own."""
        self.namespace = ""
        self.visible: tuple[str, ...] = ()
        """Namespaces that USING names, here."""
        self._told = -AHEAD
        """The mark of a different language that was reported last."""
        self._lost = -1
        """Up to this token nothing more is reported: what encloses it was left for nesting too deep."""

    def take(self) -> int:
        """The next token; the end is never passed."""
        at = self.at
        if self.kinds[at] is not Lex.END:
            self.at = at + 1
        return at

    def is_(self, *texts: str) -> bool:
        """The next token is one of these operators or keywords."""
        return self.texts[self.at] in texts

    def ended(self) -> bool:
        return self.kinds[self.at] is Lex.END

    def accept(self, text: str) -> bool:
        if self.texts[self.at] == text:
            self.at += 1
            return True
        return False

    def word(self, ahead: int = 0) -> str:
        """The name that comes next, in upper case; empty when something else comes."""
        at = self.at + ahead
        return self.texts[at].upper() if self.kinds[at] is NAME else ""

    def accept_word(self, *words: str) -> bool:
        if self.word() in words:
            self.at += 1
            return True
        return False

    def expect(self, text: str, where: str) -> int:
        if self.texts[self.at] != text:
            raise self.fail(f"`{text}` expected {where}")
        return self.take()

    def close(self, text: str, where: str) -> None:
        """Expects a closing mark that can be missing without harm: reported after the last token, then gone on."""
        if self.texts[self.at] == text:
            self.at += 1
            return
        end = self.end_of(max(self.at - 1, 0))
        if not self._foreign(self.at):
            self.report("S003", f"`{text}` expected {where}{self.found()}.", self.source.span(max(end - 1, 0), end))

    def name(self, what: str) -> int:
        kind = self.kinds[self.at]
        if kind is NAME and self.at != self.wall:
            self.at += 1
            return self.at - 1
        if kind is Lex.KEYWORD:
            raise self.fail(f"{what} expected; `{self.texts[self.at]}` is a keyword and cannot be a name")
        if kind is Lex.STRING and self.texts[self.at][0] == '"':
            raise self.quoted(self.at)
        raise self.fail(f"{what} expected")

    def quoted(self, token: int) -> Unexpected:
        """To be raised where one vendor writes a name in quotes."""
        message = f"Names in quotes are not supported; write {self.texts[token][1:-1]}."
        self.report("X001", message, self.span_of(token))
        return Unexpected()

    def qualified(self, what: str) -> str:
        """`Name.Name`, as written."""
        parts = [self.texts[self.name(what)]]
        while self.texts[self.at] == "." and self.kinds[self.at + 1] is NAME:
            parts.append(self.texts[self.at + 1])
            self.at += 2
        return ".".join(parts)

    def fail(self, message: str, token: int | None = None) -> Unexpected:
        """To be raised, after reporting what is wrong with this token."""
        token = self.at if token is None else token
        if not self._foreign(token):
            self.report("S003", message + self.found(token) + ".", self.span_of(token))
        return Unexpected()

    def _foreign(self, token: int) -> bool:
        """Reports a mark that means something in other languages, where nothing of ours has it."""
        text = self.texts[token]
        if text not in DRAWN:
            return False
        if self._told in (token, token - 1):
            return True  # of two in a row, each for itself has no meaning either
        twice = self.texts[token + 1] == text and self.starts[token + 1] == self.starts[token] + 1
        message = f"`{2 * text if twice else text}` is of another language; {DRAWN[text]}."
        self.report("S001", message, self.span_of(token))
        self._told = token
        return True

    def report(self, code: str, message: str, span: Span) -> None:
        if len(self.problems) < MAX_PROBLEMS and self.at > self._lost:
            self.problems.append(Problem(code, message, span))

    def here(self) -> Span:
        return self.span_of(self.at)

    def span_of(self, token: int) -> Span:
        start = self.starts[token]
        return Stretch(self.source, start, start + (len(self.texts[token]) or 1))

    def span_from(self, token: int) -> Span:
        """From `token` to the last one taken."""
        end = self.end_of(max(self.at - 1, 0))
        return Stretch(self.source, self.starts[token], max(end, self.end_of(token)))

    def end_of(self, token: int) -> int:
        return self.starts[token] + len(self.texts[token])

    def line_of(self, token: int) -> int:
        return self.source.line(self.starts[token])

    def found(self, token: int | None = None) -> str:
        text = self.texts[self.at if token is None else token]
        return f", found `{text[:40]}`" if text else ", but the file ends here"

    def enter(self, until: Collection[str] = ()) -> None:
        """One level deeper. Where that is too deep, the text goes on at the next of `until`: all around is left as well."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            failed = self.fail(f"nested more than {MAX_DEPTH} deep; split this up")
            if until:
                while not self.ended() and self.texts[self.at] not in until:
                    self.at += 1
                self._lost = self.at
            raise failed

    def leave(self) -> None:
        self.depth -= 1
