"""The variables of a program that have an address, by where they lie."""

from collections import defaultdict

from scanbench.program.program import Program
from scanbench.program.types import ArrayType, Record, Type
from scanbench.symbols.symbols import Symbol, UnknownPath, members, resolve, roots

_MOST_ELEMENTS = 4096
"""Of a larger array with an address only the array is told."""


def located(program: Program) -> dict[int, list[Symbol]]:
    """The variables with an address, by the byte of the image where they begin; structures and arrays as their members.
    Not those whose address VAR_CONFIG says (`AT %I*`)."""
    found: defaultdict[int, list[Symbol]] = defaultdict(list)
    known: dict[int, bool] = {}
    ahead = list(roots(program))[::-1]
    while ahead:
        symbol = ahead.pop()
        if symbol.slots:
            continue
        large = isinstance(symbol.type, ArrayType) and symbol.type.count > _MOST_ELEMENTS
        if symbol.address is not None and (large or not symbol.expandable):
            found[symbol.offset].append(symbol)
        elif symbol.expandable and (symbol.address is not None or _holds(symbol.type, known)):
            ahead += members(program, symbol.path)[::-1]
    return found


def _holds(type: Type, known: dict[int, bool]) -> bool:
    """Whether something in a variable of this type has an address; most blocks have nothing, and are not looked through."""
    if isinstance(type, ArrayType):
        return _holds(type.element, known)
    if not isinstance(type, Record):
        return False
    if id(type) not in known:
        known[id(type)] = False  # while it is looked at: a block may refer to itself
        known[id(type)] = any(member.located or _holds(member.type, known) for member in type.members.values())
    return known[id(type)]


def address(program: Program, text: str) -> Symbol | None:
    """The place of this address; None where the program's model has none."""
    try:
        return resolve(program, text)
    except UnknownPath:
        return None
