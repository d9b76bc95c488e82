"""Which variables hold a byte of the image: the way back from offsets to names, down to single values."""

from bisect import bisect_right
from collections.abc import Iterable, Iterator

from scanbench.check.layout import Layout
from scanbench.check.program import Program
from scanbench.check.symbols import RAW_TYPES, Symbol, around, roots
from scanbench.check.types import ELEMENTARY, Kind, Section
from scanbench.plcmodel.areas import Area

_SYSTEM = (
    Symbol("_SubrangeError", "_SubrangeError", ELEMENTARY["BOOL"], "VAR_GLOBAL", Layout.SUBRANGE_ERROR),
    Symbol("_SubrangeErrorCount", "_SubrangeErrorCount", ELEMENTARY["UDINT"], "VAR_GLOBAL", Layout.SUBRANGE_COUNT),
)


class Holders:
    """Names what a program keeps. What is only passed on (inputs of blocks, in-outs) and what the compiler made has no name here."""

    def __init__(self, program: Program) -> None:
        self._layout = program.layout
        every = [*_SYSTEM, *roots(program)]
        self._roots = sorted((each for each in every if not each.slots and not _in_area(each)), key=_offset)
        self._starts = [each.offset for each in self._roots]
        self._located: dict[int, list[Symbol]] = {}
        for symbol in located(every):
            for byte in range(symbol.offset, symbol.offset + symbol.type.size):
                self._located.setdefault(byte, []).append(symbol)

    def at(self, offset: int, mask: int) -> Iterator[Symbol]:
        """The variables that have any of these bits of the byte; addresses of the model where no variable is."""
        area = self._layout.area_at(offset)
        if area is not None:
            yield from self._in_area(*area, offset, mask)
            return
        index = bisect_right(self._starts, offset) - 1
        if index >= 0:
            yield from _down(self._roots[index], offset, mask)

    def _in_area(self, area: Area, byte: int, offset: int, mask: int) -> Iterator[Symbol]:
        """Variables of one bit come first: a word around them says less."""
        known = self._located.get(offset, [])
        for symbol in known:
            if symbol.bit is not None and mask >> symbol.bit & 1:
                yield symbol
        for symbol in known:
            mask &= ~(1 << symbol.bit) if symbol.bit is not None else 0xFF
        for symbol in known:
            if symbol.bit is None and mask:
                yield from _down(symbol, offset, mask)
                mask = 0
        if mask:
            yield self._raw(area, byte, offset, mask)

    def _raw(self, area: Area, byte: int, offset: int, mask: int) -> Symbol:
        if mask & (mask - 1) == 0:
            bit = mask.bit_length() - 1
            name = self._layout.model.format(area, byte, bit, 1)
            return Symbol(name, name, RAW_TYPES[1], "address", offset, bit, (), name)
        name = self._layout.model.format(area, byte - byte % 2, None, 16)
        return Symbol(name, name, RAW_TYPES[16], "address", offset - byte % 2, None, (), name)


def located(symbols: Iterable[Symbol]) -> Iterator[Symbol]:
    """The variables among these and below them that stand in an area of the model. Of an array of blocks, which share them, the
    first one's."""
    barren: set[int] = set()
    for symbol in symbols:
        yield from _located_below(symbol, barren)


def _located_below(symbol: Symbol, barren: set[int]) -> Iterator[Symbol]:
    if symbol.slots:
        return
    if _in_area(symbol):
        yield symbol
        return
    type = symbol.type
    if not symbol.expandable or id(type) in barren:
        return
    found = False
    for member in around(symbol, symbol.offset):
        for each in _located_below(member, barren):
            found = True
            yield each
    if not found:
        barren.add(id(type))


def _down(symbol: Symbol, offset: int, mask: int) -> Iterator[Symbol]:
    """To the single values that have bits of the byte."""
    if not symbol.offset <= offset < symbol.offset + symbol.type.size:
        return
    if not symbol.expandable:
        if symbol.bit is None or mask >> symbol.bit & 1:
            yield symbol
        return
    of_block = symbol.type.kind is Kind.BLOCK and symbol.section != "PROGRAM"
    for each in around(symbol, offset):
        if each.slots or _in_area(each) or "$" in each.name:
            continue
        if not (of_block and each.section == Section.INPUT):
            yield from _down(each, offset, mask)


def _in_area(symbol: Symbol) -> bool:
    return symbol.address is not None


def _offset(symbol: Symbol) -> int:
    return symbol.offset
