"""What a place of the image is called: the variable of a type that lives there, as a symbol that means this place again."""

from collections.abc import Iterator

from scanbench.program.copies import Spot
from scanbench.program.program import Pou, Program
from scanbench.program.types import BOOL, ArrayType, Elementary, Record, Type
from scanbench.symbols.symbols import Symbol, UnknownPath, around, members, resolve, roots, roots_at


def variable_at(program: Program, place: Spot, type: Type) -> Symbol | None:
    """The variable, or part of one, or address; None where nothing of this type is there, as behind a stray pointer."""
    for path in _paths(program, place, type):
        try:
            symbol = resolve(program, path)
        except UnknownPath:
            continue
        if not symbol.slots and same_place((symbol.offset, symbol.bit), place) and _fits(symbol.type, type):
            return symbol
    return None


def same_place(one: Spot, other: Spot) -> bool:
    """Whether two places are one; a BOOL that has its byte for itself is bit 0 of that."""
    return one[0] == other[0] and (one[1] or 0) == (other[1] or 0)


def temporary_at(program: Program, offset: int) -> tuple[Pou, str] | None:
    """The POU whose temporary this is, and its name there; empty for what the compiler keeps."""
    for pou in program.pous:
        if pou.frame_offset <= offset < pou.frame_offset + pou.frame.size:
            inside = (
                each
                for each in pou.frame.members.values()
                if each.offset <= offset - pou.frame_offset < each.offset + each.storage and not each.hidden
            )
            found = next(inside, None)
            return pou, "" if found is None else found.name
    return None


def _fits(found: Type, wanted: Type) -> bool:
    """Whether this may be what was passed for one of the wanted type: a block may be of one that extends it."""
    known: Record | None = found if isinstance(found, Record) else None
    while known is not None:
        if known is wanted or known.name == wanted.name:
            return True
        known = known.base
    return found == wanted or found.name == wanted.name or _open(found, wanted)


def _open(found: Type, wanted: Type) -> bool:
    return isinstance(found, ArrayType) and wanted.size == 0 and found.element.name in wanted.name


def _paths(program: Program, place: Spot, type: Type) -> Iterator[str]:
    offset, bit = place
    found = program.layout.area_at(offset)
    if found is not None:
        for each in located(program):
            if each.offset <= offset < each.offset + each.type.size and (each.bit is None or each.bit == bit):
                yield from _below(each, place, type)
        area, byte = found
        bits = 1 if type == BOOL else 8 * type.size
        if bits in (1, 8, 16, 32, 64):
            yield program.layout.model.format(area, byte, (bit or 0) if bits == 1 else None, bits)
        return
    for root in roots_at(program, offset):
        if root.address is None:
            yield from _below(root, place, type)
            return


def _below(symbol: Symbol, place: Spot, type: Type) -> Iterator[str]:
    """Down to what begins there, from the outermost of the type."""
    offset, bit = place
    if symbol.offset == offset and _fits(symbol.type, type):
        yield symbol.path
    if isinstance(symbol.type, Elementary):
        part, within = offset - symbol.offset, bit or 0
        if type == BOOL:
            yield f"{symbol.path}.{8 * part + within}"
        elif type.size < symbol.type.size:
            letter = {1: "B", 2: "W", 4: "D"}.get(type.size, "B")
            yield f"{symbol.path}.%{letter}{part // max(1, type.size)}"
        return
    for inner in around(symbol, offset):
        if not inner.slots and inner.address is None and inner.offset <= offset < inner.offset + inner.type.size:
            yield from _below(inner, place, type)


def located(program: Program) -> Iterator[Symbol]:
    """The declared variables at addresses of the model."""
    known: dict[int, bool] = {}
    ahead = list(roots(program))[::-1]
    while ahead:
        symbol = ahead.pop()
        if symbol.slots:
            continue
        if symbol.address is not None:
            yield symbol
        elif _has_located(symbol.type, known):
            ahead += members(program, symbol.path)[::-1]


def _has_located(type: Type, known: dict[int, bool]) -> bool:
    if isinstance(type, ArrayType):
        return _has_located(type.element, known)
    if not isinstance(type, Record):
        return False
    if id(type) not in known:
        known[id(type)] = any(
            each.located or (not each.bound and _has_located(each.type, known)) for each in type.members.values()
        )
    return known[id(type)]
