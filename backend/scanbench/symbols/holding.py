"""Which variables hold a byte of the image: the way back from offsets to names, down to single values."""

from bisect import bisect_right
from collections.abc import Generator, Iterable, Iterator
from typing import NamedTuple

from scanbench.plcmodel.areas import Area
from scanbench.program.layout import Layout
from scanbench.program.origin import in_library
from scanbench.program.program import Program
from scanbench.program.types import ELEMENTARY, Kind, Record, Section
from scanbench.symbols.symbols import RAW_TYPES, Symbol, around, roots

_SYSTEM = (
    Symbol("_SubrangeError", "_SubrangeError", ELEMENTARY["BOOL"], "VAR_GLOBAL", Layout.SUBRANGE_ERROR),
    Symbol("_SubrangeErrorCount", "_SubrangeErrorCount", ELEMENTARY["UDINT"], "VAR_GLOBAL", Layout.SUBRANGE_COUNT),
)


class Held(NamedTuple):
    """A variable that has a byte."""

    symbol: Symbol


class Holders:
    """Names what a program keeps: all that the user declared, and the outputs of the library's blocks. What is only passed on
    (in-outs, and unless they are wanted inputs of blocks), the inside of the library's blocks, and what the compiler made have no
    name here."""

    def __init__(self, program: Program, inputs: bool = False) -> None:
        """`inputs`: those of blocks, too."""
        self._layout, self._inputs = program.layout, inputs
        self._library = {pou.instance.name for pou in program.pous if in_library(pou.span)}
        tops = [*_SYSTEM, *roots(program)]
        self._roots = sorted((each for each in tops if not each.slots and not _in_area(each)), key=_offset)
        self._starts = [each.offset for each in self._roots]
        self._located: dict[int, list[Symbol]] = {}
        for symbol in located(tops):
            for byte in range(symbol.offset, symbol.offset + symbol.type.size):
                self._located.setdefault(byte, []).append(symbol)

    def at(self, offset: int, mask: int) -> Iterator[Held]:
        """The variables that have any of these bits of the two bytes from an even offset on, in the order of the bytes.

        Addresses of the model where no variable is: of the bit when it is one, else of the word.
        """
        area = self._layout.area_at(offset)
        left = 0
        for index in range(2):
            part = mask >> 8 * index & 0xFF
            if area is not None:
                left |= (yield from self._in_area(offset + index, part)) << 8 * index
            elif part and (root := bisect_right(self._starts, offset + index) - 1) >= 0:
                yield from self._down(self._roots[root], offset + index, part)
        if left and area is not None:
            yield Held(self._raw(*area, offset, left))

    def _in_area(self, offset: int, mask: int) -> Generator[Held, None, int]:
        """Variables of one bit come first: a word around them says less. Returns the bits that no variable has."""
        known = self._located.get(offset, [])
        for symbol in known:
            if symbol.bit is not None and mask >> symbol.bit & 1:
                yield Held(symbol)
        left = mask
        for symbol in known:
            left &= ~(1 << symbol.bit) if symbol.bit is not None else 0xFF
        for symbol in known:
            if symbol.bit is None and left:
                yield from self._down(symbol, offset, mask)
                left = 0
        return left

    def _down(self, symbol: Symbol, offset: int, mask: int) -> Iterator[Held]:
        """To the single values that have bits of the byte."""
        if not symbol.offset <= offset < symbol.offset + symbol.type.size:
            return
        if not symbol.expandable:
            if symbol.bit is None or mask >> symbol.bit & 1:
                yield Held(symbol)
            return
        of_library = isinstance(symbol.type, Record) and symbol.type.name in self._library
        of_block = symbol.type.kind is Kind.BLOCK and symbol.section != "PROGRAM"
        for each in around(symbol, offset):
            if each.slots or _in_area(each) or "$" in each.name:
                continue
            if of_block and each.section == Section.INPUT and not self._inputs:
                continue
            if not of_library or each.section == Section.OUTPUT:
                yield from self._down(each, offset, mask)

    def _raw(self, area: Area, byte: int, offset: int, mask: int) -> Symbol:
        if mask & (mask - 1) == 0:
            index, bit = divmod(mask.bit_length() - 1, 8)
            name = self._layout.model.format(area, byte + index, bit, 1)
            return Symbol(name, name, RAW_TYPES[1], "address", offset + index, bit, (), name)
        name = self._layout.model.format(area, byte, None, 16)
        return Symbol(name, name, RAW_TYPES[16], "address", offset, None, (), name)


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


def _in_area(symbol: Symbol) -> bool:
    return symbol.address is not None


def _offset(symbol: Symbol) -> int:
    return symbol.offset
