"""Conditional pragmas of CODESYS and TwinCAT: `{define x}`, `{undefine x}`, `{IF defined (x)}`, `{ELSIF ..}`, `{ELSE}`, `{END_IF}`.

What they exclude is not compiled. A name that the text itself defines is known, from there to the end of its file; so are those of
the project (`defines` in language.json), and the three that say what kind of controller this is. What asks for something else (a variable, a type, an attribute, the value of a name) is
refused, as nothing here could tell which branch the vendor's tool takes. From
https://content.helpme-codesys.com/en/CODESYS%20Development%20System/_cds_pragma_conditional.html
"""

import re
from dataclasses import dataclass, field
from itertools import compress

from scanbench.problems import Problem
from scanbench.syntax.lexer import AHEAD, Tokens
from scanbench.syntax.source import Source

_PRAGMA = re.compile(r"\{\s*(define|undefine|IF|ELSIF|ELSE|END_IF)\b(.*)\}", re.IGNORECASE | re.DOTALL)
_PART = re.compile(r"\s*(?:defined\s*\(\s*(?P<name>\w+)\s*\)|(?P<word>NOT|AND|OR)\b|(?P<sign>[()]))", re.IGNORECASE)
_CONTROLLER = {"ISLITTLEENDIAN": True, "ISSIMULATIONMODE": False, "ISFPUSUPPORTED": True}


def conditions(tokens: Tokens) -> list[tuple[int, str, str]]:
    """Position, word in upper case and what follows it, of each pragma of this kind."""
    found = ((at, _PRAGMA.fullmatch(text)) for at, text in tokens.pragmas)
    return [(at, match.group(1).upper(), match.group(2).strip()) for at, match in found if match]


@dataclass(slots=True)
class _Branch:
    """An IF that is open."""

    at: int
    around: bool
    """Whether what is around it is compiled."""
    taken: bool
    """Whether one of its branches was taken."""
    now: bool
    """Whether the branch that is open is taken."""


class _Refused(Exception):
    """A condition that is not understood."""


@dataclass(slots=True)
class _Reader:
    source: Source
    defined: set[str] = field(default_factory=set)
    open: list[_Branch] = field(default_factory=list)
    dead: list[tuple[int, int]] = field(default_factory=list)
    problems: list[Problem] = field(default_factory=list)

    @property
    def live(self) -> bool:
        """Whether what follows is compiled."""
        return not self.open or (self.open[-1].around and self.open[-1].now)

    def read(self, at: int, word: str, rest: str) -> None:
        if word == "IF":
            true = self.live and self._holds(at, rest)
            self.open.append(_Branch(at, self.live, true, true))
        elif word in ("DEFINE", "UNDEFINE"):
            name = rest.split()[0].upper() if rest else ""
            if self.live and name:
                (self.defined.add if word == "DEFINE" else self.defined.discard)(name)
        elif not self.open:
            self._told("S003", f"`{{{word}}}` belongs to no `{{IF ...}}`; remove it.", at)
        elif word == "END_IF":
            self.open.pop()
        else:
            branch = self.open[-1]
            branch.now = branch.around and not branch.taken and (word == "ELSE" or self._holds(at, rest))
            branch.taken = branch.taken or branch.now

    def _holds(self, at: int, text: str) -> bool:
        try:
            parts = _parts(text)
            found = _either(parts, self.defined)
            if parts:
                raise _Refused
        except _Refused:
            self._told(
                "X001",
                f"The condition `{text}` is not understood: only `defined (name)` with NOT, AND and OR is. Remove the "
                "pragma, and the branch that your controller does not take.",
                at,
            )
            return True
        return found

    def _told(self, code: str, message: str, at: int) -> None:
        self.problems.append(Problem(code, message, self.source.span(at, at + 1)))


def _parts(text: str) -> list[str]:
    """The words of a condition; a name that is asked for as `?NAME`."""
    made, at = [], 0
    text = text.strip()
    while at < len(text):
        match = _PART.match(text, at)
        if match is None:
            raise _Refused
        at = match.end()
        name = match.group("name")
        made.append(f"?{name.upper()}" if name else (match.group("word") or match.group("sign")).upper())
    return made


def _either(parts: list[str], defined: set[str]) -> bool:
    found = _both(parts, defined)
    while parts and parts[0] == "OR":
        parts.pop(0)
        found = _both(parts, defined) or found
    return found


def _both(parts: list[str], defined: set[str]) -> bool:
    found = _one(parts, defined)
    while parts and parts[0] == "AND":
        parts.pop(0)
        found = _one(parts, defined) and found
    return found


def _one(parts: list[str], defined: set[str]) -> bool:
    first = parts.pop(0) if parts else ""
    if first == "NOT":
        return not _one(parts, defined)
    if first == "(":
        found = _either(parts, defined)
        if not parts or parts.pop(0) != ")":
            raise _Refused
        return found
    if not first.startswith("?"):
        raise _Refused
    return _CONTROLLER.get(first[1:], first[1:] in defined)


def chosen(source: Source, tokens: Tokens) -> tuple[Tokens, list[Problem]]:
    """The tokens that the conditional pragmas leave, and what is wrong with these."""
    found = conditions(tokens)
    if not found:
        return tokens, []
    reader = _Reader(source, set(source.defined))
    for at, word, rest in found:
        live = reader.live
        reader.read(at, word, rest)
        if live and not reader.live:
            reader.dead.append((at, len(source.text)))
        elif reader.live and not live:
            reader.dead[-1] = (reader.dead[-1][0], at)
    if reader.open:
        reader._told("S003", "`{IF ...}` has no `{END_IF}`; write it where the condition ends.", reader.open[0].at)
        return tokens, reader.problems
    count = len(tokens.starts) - AHEAD
    keep = [not any(first <= at < last for first, last in reader.dead) for at in tokens.starts[:count]]
    keep += [True] * AHEAD
    kinds, texts, starts = (
        list(compress(tokens.kinds, keep)),
        list(compress(tokens.texts, keep)),
        list(compress(tokens.starts, keep)),
    )
    return Tokens(kinds, texts, starts, tokens.pragmas), reader.problems
