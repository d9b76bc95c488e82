"""A memory area word by word: what each word is called, which variables lie in it, and where a value is found."""

from collections.abc import Sequence
from dataclasses import dataclass

from scanbench.plcmodel.areas import Area
from scanbench.program.program import Program
from scanbench.symbols.located import located
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve

WORD = 2
"""Bytes of a word."""


class NoSuchArea(Exception):
    """The model has no area of this name; the message says which it has."""


@dataclass(frozen=True, slots=True)
class Word:
    """One word of an area."""

    address: str
    """In the vendor's notation, as a word: `D100`, `K4X20`."""
    symbols: tuple[Symbol, ...]
    """The variables that lie in it, at least in part."""


def words(program: Program, name: str, first: int, count: int) -> list[Word]:
    """`count` words of an area from its word number `first` on, or as many as there are. `NoSuchArea`."""
    area = _area(program, name)
    model, start = program.layout.model, program.layout.areas[name]
    last = min(first + count, area.words)
    lying: dict[int, list[Symbol]] = {}
    for offset, symbols in sorted(located(program).items()):
        for symbol in sorted(symbols, key=lambda each: each.bit or 0):
            begin, end = offset - start, offset - start + max(symbol.type.size, 1)
            for word in range(max(begin // WORD, first), min(-(-end // WORD), last)):
                lying.setdefault(word, []).append(symbol)
    return [
        Word(model.format(area, WORD * word, None, 8 * WORD), tuple(lying.get(word, ())))
        for word in range(first, last)
    ]  # fmt: skip


def place(program: Program, path: str) -> tuple[str, int]:
    """The area and the number of the word in which a variable or an address lies. `UnknownPath`."""
    symbol = resolve(program, path)
    found = None if symbol.slots else program.layout.area_at(symbol.offset)
    if found is None:
        raise UnknownPath(f"`{symbol.path}` has no address: it does not lie in a memory area of the model.")
    area, byte = found
    return area.name, byte // WORD


def find(program: Program, image: Sequence[int], name: str, pattern: bytes, first: int, most: int) -> list[int]:
    """The numbers of at most `most` words from `first` on at which these bytes begin. `NoSuchArea`."""
    area = _area(program, name)
    start = program.layout.areas[name]
    data = bytes(image[start : start + area.size])
    found: list[int] = []
    at = data.find(pattern, WORD * first) if pattern else -1
    while at >= 0 and len(found) < most:
        if at % WORD == 0:
            found.append(at // WORD)
        at = data.find(pattern, at + 1)
    return found


def _area(program: Program, name: str) -> Area:
    areas = {area.name: area for area in program.layout.model.areas}
    if name not in areas:
        raise NoSuchArea(f"there is no memory area {name!r}; the areas are {', '.join(areas)}")
    return areas[name]
