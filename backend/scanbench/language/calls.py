"""Who calls whom: POUs and methods of the project. The call of an instance is a call of its block."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache

from scanbench.check.declare.names import qualified
from scanbench.check.uses import Symbol
from scanbench.language.called import block_of, calls_of, named, symbol_of
from scanbench.language.entry import Entry
from scanbench.language.navigate import definitions, family, named_at
from scanbench.language.reading import Reading
from scanbench.language.symbols import POUS, Extent, extents
from scanbench.problems import Span
from scanbench.syntax import tree

END = 1 << 62
"""After the last position of any text."""


@dataclass(frozen=True, slots=True)
class Party:
    """A POU or method that calls or is called."""

    symbol: Symbol
    entry: Entry


@dataclass(slots=True)
class Calls:
    """All calls of one party by the one that was asked about, or the other way round."""

    party: Party
    names: list[Span] = field(default_factory=list)
    """Where the name of what is called is written, in the text of the caller."""


def party_at(reading: Reading, file: str, position: int) -> Party | None:
    """The POU or method that is named at a position, also by an instance of it; where none is, the one around."""
    found = named_at(reading, file, position)
    named = None if found is None else _runs(reading, found.symbol)
    for symbol in (named, _around(reading, file, position)):
        # of the library nothing is declared in the project
        party = None if symbol is None else next(_parties(reading, symbol, lambda file: extents(reading, file)), None)
        if party is not None:
            return party
    return None


def _around(reading: Reading, file: str, position: int) -> Symbol | None:
    around = reading.around(file, position)
    if around is None:
        return None
    key = qualified(around.pou.namespace, around.pou.name).upper()
    return Symbol("pou", "", key) if around.method is None else Symbol("method", key, around.method.name.upper())


def incoming(reading: Reading, symbol: Symbol) -> list[Calls]:
    """Who calls it; of a method also by those that it overrides or that override it, as the instance decides which one runs."""
    wanted = frozenset(family(reading, symbol))
    blocks = cache(lambda file: extents(reading, file))
    found: list[Calls] = []
    for file in reading.files:
        for caller, pou in _bodies(reading, file):
            names = [span for span, called in _called(reading, pou) if called in wanted]
            if names:
                found.append(Calls(_party(reading, caller, pou, blocks(file)), names))
    return found


def outgoing(reading: Reading, symbol: Symbol) -> list[Calls]:
    """Whom it calls, in the order of the first calls; not the library."""
    found: dict[Symbol, Calls] = {}
    blocks = cache(lambda file: extents(reading, file))
    for each in definitions(reading, symbol):
        if isinstance(each.node, tree.PouDeclaration) and each.symbol == symbol:
            for span, called in _called(reading, each.node):
                if called not in found:
                    party = next(_parties(reading, called, blocks), None)
                    if party is None:
                        continue
                    found[called] = Calls(party)
                found[called].names.append(span)
    return list(found.values())


def _called(reading: Reading, pou: tree.PouDeclaration) -> list[tuple[Span, Symbol]]:
    """The calls of one body in order: where the name of what is called is, and what runs."""
    found = []
    for call in calls_of(pou, 0, END):
        symbol, span = symbol_of(reading, call), named(call.callee)
        runs = None if symbol is None else _runs(reading, symbol)
        if symbol is not None and span is not None and runs is not None:
            found.append((span.last(len(symbol.name.rpartition(".")[2])), runs))
    return sorted(found, key=lambda each: (each[0].line, each[0].column))


def _runs(reading: Reading, symbol: Symbol) -> Symbol | None:
    """What runs where this is called; of a variable the block that it is an instance of."""
    if symbol.kind == "variable":
        record = block_of(reading, symbol)
        owner = None if record is None else reading.project.checker.pous.classes.of(record)
        return None if owner is None else Symbol("pou", "", owner.name.upper())
    return symbol if symbol.kind in ("pou", "method") else None


def _bodies(reading: Reading, file: str) -> Iterator[tuple[Symbol, tree.PouDeclaration]]:
    for chunk in reading.files[file].chunks:
        for pou in chunk.file.pous:
            key = qualified(pou.namespace, pou.name).upper()
            yield Symbol("pou", "", key), pou
            for each in pou.methods:
                yield Symbol("method", key, each.name.upper()), each


def _parties(reading: Reading, symbol: Symbol, blocks: Callable[[str], dict[int, Extent]]) -> Iterator[Party]:
    """Where the project declares it."""
    for each in definitions(reading, symbol):
        if isinstance(each.node, tree.PouDeclaration):
            yield _party(reading, each.symbol, each.node, blocks(each.span.file))


def _party(reading: Reading, symbol: Symbol, pou: tree.PouDeclaration, blocks: dict[int, Extent]) -> Party:
    span = pou.span
    at = reading.position(span.file, span.line, span.column)
    start, end = blocks.get(at, (at, at + len(pou.name)))
    name = pou.name if symbol.kind == "method" else qualified(pou.namespace, pou.name)
    return Party(symbol, Entry(name, POUS[pou.kind], symbol.owner, span, start, end))
