"""The terminals of a PLC: the words of its inputs and outputs that a program uses, with the variables that lie there."""

from collections.abc import Iterator
from dataclasses import replace

from scanbench.plcmodel.areas import IecMap
from scanbench.program.program import Program
from scanbench.program.types import BOOL
from scanbench.symbols.located import address, located
from scanbench.symbols.symbols import Symbol

INPUT, OUTPUT = "input", "output"
"""The section of a symbol that is a whole word of one side."""
_SIDES = {"I": INPUT, "Q": OUTPUT}
_MOST_WORDS = 32
"""Of each side."""


def terminals(program: Program) -> list[Symbol]:
    """The words in order, inputs first. Each is followed by what lies in it: its bits, each as a variable where one has it and else
    as an address, or the variables that are larger than a bit. Where nothing is used, the first word of each side."""
    at = located(program)
    found: list[Symbol] = []
    for letter, side in _SIDES.items():
        maps = [each for each in program.layout.model.iec_maps if each.letter == letter]
        words = [word for each in maps for word in _used(program, each, at)]
        if not words:
            words = [(each, each.first) for each in maps[:1]]
        for each, word in words[:_MOST_WORDS]:
            found += _word(program, each, word, side, at)
    return found


def _used(program: Program, each: IecMap, known: dict[int, list[Symbol]]) -> list[tuple[IecMap, int]]:
    """The words of a side that a variable lies in."""
    start = program.layout.areas[each.area.name]
    ends = [(symbol.offset - start, symbol.type.size) for symbols in known.values() for symbol in symbols]
    at = {(offset + byte) // 2 for offset, size in ends for byte in range(size)}
    return [(each, word) for word in sorted(at) if each.first <= word < each.first + each.words]


def _word(program: Program, each: IecMap, word: int, side: str, known: dict[int, list[Symbol]]) -> Iterator[Symbol]:
    start = program.layout.areas[each.area.name]
    model, byte = program.layout.model, 2 * word
    here = [symbol for at in (byte, byte + 1) for symbol in known.get(start + at, ())]
    whole = address(program, model.word_text(each.area, byte))
    if whole is None:
        return
    yield replace(whole, section=side)
    larger = [symbol for symbol in here if symbol.type != BOOL]
    yield from larger
    if larger and len(larger) == len(here):
        return
    bits = {(symbol.offset - start, symbol.bit): symbol for symbol in here if symbol.type == BOOL}
    for bit in range(16):
        place = byte + bit // 8, bit % 8
        terminal = bits.get(place) or address(program, model.format(each.area, *place, 1))
        if terminal is not None:
            yield terminal
