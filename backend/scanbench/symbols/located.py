"""The variables of a program that have an address, by where they lie."""

from collections import defaultdict

from scanbench.program.program import Program
from scanbench.program.types import Record
from scanbench.symbols.symbols import Symbol, UnknownPath, members, resolve, roots

_MOST_VISITED = 20_000
"""Variables that are looked at; those with an address are declared in programs and globals, which come first."""


def located(program: Program) -> dict[int, list[Symbol]]:
    """The variables with an address, by the byte of the image where they begin; structures and arrays as their members."""
    found: defaultdict[int, list[Symbol]] = defaultdict(list)
    ahead, visited = list(roots(program))[::-1], 0
    while ahead and visited < _MOST_VISITED:
        symbol = ahead.pop()
        visited += 1
        if symbol.slots:
            continue
        if not symbol.expandable:
            if symbol.address is not None:
                found[symbol.offset].append(symbol)
        elif isinstance(symbol.type, Record) or symbol.address is not None:
            ahead += members(program, symbol.path)[::-1]
    return found


def address(program: Program, text: str) -> Symbol | None:
    """The place of this address; None where the program's model has none."""
    try:
        return resolve(program, text)
    except UnknownPath:
        return None
