"""Symbols for people: what is below a path, what completes a text."""

from typing import get_args

from scanbench.program.program import Program
from scanbench.program.types import Elementary, Enumeration, Section, StringType, Subrange
from scanbench.runtime.resource import Resource
from scanbench.symbols.call_sites import formal_of
from scanbench.symbols.instances import instances_of
from scanbench.symbols.memory import NoSuchArea, find, place, words
from scanbench.symbols.rack import terminals
from scanbench.symbols.symbols import Symbol, UnknownPath, complete, members, resolve
from scanbench.wire.host import Found, Lookup
from scanbench.wire.memory import FindWords, PlaceIs, WantPlace, WantWords, WordInfo, WordsAre, WordsFound
from scanbench.wire.symbols import EnumValue, SymbolInfo, SymbolKind, WatchItem

COMPLETIONS = 50
_KINDS: dict[str, SymbolKind] = {kind: kind for kind in get_args(SymbolKind)}


def look_up(program: Program, question: Lookup) -> Found:
    """Answers a `Lookup`."""
    try:
        if question.kind == "complete":
            symbols = complete(program, question.text, COMPLETIONS)
        elif question.kind == "instances":
            symbols = instances_of(program, question.text)
        elif question.kind == "terminals":
            symbols = terminals(program)
        else:
            symbols = members(program, question.text)
    except UnknownPath as error:
        return Found(question.ref, (), error.message, tuple(error.near))
    return Found(question.ref, tuple(map(symbol_info, symbols)))


def words_are(program: Program, question: WantWords) -> WordsAre:
    """Answers a `WantWords`."""
    try:
        found = words(program, question.area, question.first, question.count)
    except NoSuchArea as error:
        return WordsAre(question.ref, (), str(error))
    return WordsAre(
        question.ref, tuple(WordInfo(each.address, tuple(map(symbol_info, each.symbols))) for each in found)
    )


def place_is(program: Program, question: WantPlace) -> PlaceIs:
    """Answers a `WantPlace`."""
    try:
        area, word = place(program, question.path)
    except UnknownPath as error:
        return PlaceIs(question.ref, "", 0, error.message, tuple(error.near))
    return PlaceIs(question.ref, area, word)


def words_found(resource: Resource, question: FindWords) -> WordsFound:
    """Answers a `FindWords`, between two scans."""
    scan = resource.header.scan
    try:
        found = find(resource.program, resource.memory, question.area, question.pattern, question.first, question.most)
    except NoSuchArea as error:
        return WordsFound(question.ref, scan, (), str(error))
    return WordsFound(question.ref, scan, tuple(found))


def watch_item(program: Program, id: int, path: str) -> tuple[WatchItem, Symbol | None]:
    """One path to watch, and its symbol when values of it can be sent."""
    try:
        symbol = resolve(program, path)
    except UnknownPath as error:
        return WatchItem(id, path, None, False, error.message, tuple(error.near)), None
    sent = isinstance(symbol.type, Elementary | StringType)
    in_out = bool(symbol.slots) and formal_of(program, symbol.path) is not None
    return WatchItem(id, path, symbol_info(symbol, in_out), sent), symbol if sent else None


def symbol_info(symbol: Symbol, in_out: bool = False) -> SymbolInfo:
    """A symbol as data; `in_out`: its path leads through one."""
    simple = isinstance(symbol.type, Elementary | StringType)
    return SymbolInfo(
        path=symbol.path,
        name=symbol.name,
        type=symbol.type.name,
        kind=_KINDS[symbol.type.kind],
        size=symbol.type.size,
        address=symbol.address,
        writable=symbol.writable,
        section=str(symbol.section),
        expandable=not simple,
        values=tuple(EnumValue(*each) for each in symbol.type.values) if isinstance(symbol.type, Enumeration) else (),
        range=_range(symbol.type) if isinstance(symbol.type, Subrange) else "",
        in_out=in_out or symbol.section == Section.IN_OUT,
    )


def _range(type: Subrange) -> str:
    return f"{type.base_name} ({type.low}..{type.high})"
