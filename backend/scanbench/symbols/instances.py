"""Where the instances of a POU are: the paths under which its text can be looked at with values."""

from collections.abc import Iterator

from scanbench.program.program import Pou, Program
from scanbench.program.types import ArrayType, Record, Type
from scanbench.symbols.symbols import Symbol, members, roots


def instances_of(program: Program, pou: str, limit: int = 1000) -> list[Symbol]:
    """Instances of a PROGRAM, FUNCTION_BLOCK or CLASS, and of what extends it, in order of declaration."""
    name = pou.upper()
    holding: dict[int, bool] = {}
    found: list[Symbol] = []
    for symbol in _walk(program, name, holding):
        found.append(symbol)
        if len(found) >= limit:
            break
    return found


def owner_of(pou: Pou) -> Record | None:
    """The variables of the instances whose code it is; None for a FUNCTION."""
    if pou.kind != "function":
        return pou.instance
    type = pou.this.type if pou.this is not None else None
    return type if isinstance(type, Record) else None


def _walk(program: Program, name: str, holding: dict[int, bool]) -> Iterator[Symbol]:
    ahead = list(roots(program))[::-1]
    while ahead:
        symbol = ahead.pop()
        if symbol.slots:  # an in-out or a reference: what it refers to is found where it lives
            continue
        if _is(symbol.type, name):
            yield symbol
        if _holds(symbol.type, name, holding):
            ahead += members(program, symbol.path)[::-1]


def _is(type: Type, name: str) -> bool:
    while isinstance(type, Record):
        if type.name.upper() == name:
            return True
        if type.base is None:
            return False
        type = type.base
    return False


def _holds(type: Type, name: str, known: dict[int, bool]) -> bool:
    """Whether anything below is one; so large arrays of numbers are not walked."""
    if isinstance(type, ArrayType):
        return _is(type.element, name) or _holds(type.element, name, known)
    if not isinstance(type, Record):
        return False
    if id(type) not in known:
        known[id(type)] = False
        inner = [member.type for member in type.members.values() if not member.hidden]
        known[id(type)] = any(_is(each, name) or _holds(each, name, known) for each in inner)
    return known[id(type)]
