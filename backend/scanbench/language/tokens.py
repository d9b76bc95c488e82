"""What kind of thing each name of a text means, for colours."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from scanbench.check.build import Checker
from scanbench.check.uses import Symbol
from scanbench.language.declared import PARAMETERS, member_of
from scanbench.language.reading import Reading
from scanbench.program.origin import in_library
from scanbench.program.types import Section

TokenKind = Literal["variable", "parameter", "property", "function", "method", "class", "type", "enumMember"]
Modifier = Literal["readonly", "declaration", "defaultLibrary"]


@dataclass(frozen=True, slots=True)
class Token:
    start: int
    """In its file; tokens are on one line."""
    end: int
    kind: TokenKind
    modifiers: tuple[Modifier, ...] = ()


Looks = tuple[TokenKind, tuple[Modifier, ...]]


def tokens(reading: Reading, file: str, start: int, end: int) -> list[Token]:
    """The names of a stretch of a file, in order, each once."""
    known: dict[Symbol, Looks] = {}
    found: dict[int, Token] = {}
    for first, after, symbol, declared in _names(reading, file, start, end):
        looks = known.get(symbol)
        if looks is None:
            looks = known[symbol] = _looks(reading.project.checker, symbol)
        kind, modifiers = looks
        found[first] = Token(first, after, kind, (*modifiers, "declaration") if declared else modifiers)
    return [found[each] for each in sorted(found)]


def _names(reading: Reading, file: str, start: int, end: int) -> Iterator[tuple[int, int, Symbol, bool]]:
    """Where a name is, what it means, and whether it is declared there: declarations come last, as they may count as uses, too."""
    for first, after, symbol in reading.index.between(file, start, end):
        yield max(first, after - len(symbol.name.rpartition(".")[2])), after, symbol, False  # without its namespace
    for at, each in reading.declared_between(file, start, end):
        yield at, at + len(each.name), each.symbol, True


def _looks(checker: Checker, symbol: Symbol) -> Looks:
    match symbol.kind:
        case "variable":
            return _variable(checker, symbol)
        case "value":
            return "enumMember", ()
        case "type":
            return "type", ()
        case "function":
            return "function", ("defaultLibrary",)
        case "method":
            owner = checker.pous.classes.by_key.get(symbol.owner)
            halves = (f"{symbol.name}.GET", f"{symbol.name}.SET")
            own = owner is not None and any(owner.find(each) is not None for each in halves)
            return ("property" if own else "method"), ()
    return _pou(checker, symbol.name)


def _variable(checker: Checker, symbol: Symbol) -> Looks:
    member = member_of(checker, symbol)
    if member is None:
        return "variable", ()
    modifiers: list[Modifier] = []
    if member.constant:
        modifiers.append("readonly")
    if in_library(member.span):
        modifiers.append("defaultLibrary")
    if member.section in PARAMETERS:
        return "parameter", tuple(modifiers)
    return ("property" if member.section is Section.MEMBER else "variable"), tuple(modifiers)


def _pou(checker: Checker, key: str) -> Looks:
    if key in checker.pous.generic:
        return "function", ()
    function = checker.pous.functions.get(key)
    block = checker.declarations.block_trees.get(key)
    span = function.span if function is not None else block.span if block is not None else None
    standard: tuple[Modifier, ...] = ("defaultLibrary",) if span is not None and in_library(span) else ()
    return ("class" if function is None else "function"), standard
