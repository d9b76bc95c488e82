"""Places in statements and expressions: which bytes they may be, and which a statement evaluates."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import NamedTuple
from zlib import crc32

from scanbench.program.program import (
    Assign,
    Base,
    CallBlock,
    CallFunction,
    Case,
    Evaluate,
    For,
    If,
    Index,
    Load,
    Place,
    Pou,
    RefOf,
    Repeat,
    Stmt,
    While,
)
from scanbench.program.types import Elementary, Kind, Reference, Section, StringType, Type


class Ref(NamedTuple):
    """Bytes that count from a base; of one byte perhaps only some bits."""

    base: Base | None
    """None: through a reference. `begin` is a number of the type that it refers to then."""
    begin: int
    end: int
    mask: int = 0xFF


ANYWHERE = Ref(None, 0, 1 << 32)


def parts(node: object) -> Iterator[object]:
    """The expressions and places in an expression, those that say where a place is included; not what only receives a value."""
    if isinstance(node, CallFunction):
        yield node
        for name, given in zip(node.pou.parameters, node.args, strict=False):
            if not isinstance(given, Place):
                yield from parts(given)
            elif node.pou.frame.members[name].section is Section.OUTPUT:
                yield from parts((given.indices, given.reference))
            else:
                yield from parts(given)
    elif isinstance(node, RefOf):
        yield node
        yield from parts((node.place.indices, node.place.reference))
    elif isinstance(node, Place):
        yield node
        yield from parts((node.indices, node.reference))
    elif isinstance(node, tuple):
        for each in node:
            yield from parts(each)
    elif isinstance(node, Load | Index) or (is_dataclass(node) and type(node).__module__ == Place.__module__):
        if not isinstance(node, Pou):
            yield node
            for field in fields(node):
                yield from parts(getattr(node, field.name))


def inside(instance: Place, ref: Ref) -> Ref:
    """A place of a block that is called, seen by who calls it."""
    whole = ref_of(instance)
    if ref.base is not Base.SELF:
        return ref
    if instance.slot is not None or instance.reference is not None:
        return whole
    reach = whole.end - whole.begin - max(1, instance.type.size)
    return Ref(whole.base, whole.begin + ref.begin, whole.begin + ref.end + reach, ref.mask)


def ref_of(place: Place) -> Ref:
    """The bytes that a place may be."""
    if place.slot is not None:
        return ref_of(place.slot)
    if place.reference is not None:
        return through(place.reference.type)
    end = place.offset + max(1, place.type.size)
    for index in place.indices:
        if isinstance(index.low, int) and isinstance(index.high, int) and isinstance(index.stride, int):
            end += (index.high - index.low) * index.stride
    one_bit = place.bit is not None and not place.indices
    return Ref(place.base, place.offset, end, 1 << (place.bit or 0) if one_bit else 0xFF)


def through(type: Type | None) -> Ref:
    """What a reference of this type may refer to. Only a reference to the same type may refer to a number or a text."""
    target = type.target if isinstance(type, Reference) and not type.pointer else None
    if not isinstance(target, Elementary | StringType) or target.kind is Kind.REF:
        return ANYWHERE
    number = crc32(f"{target.kind}{0 if target.kind is Kind.STRING else target.size}".encode())
    return Ref(None, number, number + 1)


def heads(stmt: Stmt) -> tuple[object, ...]:
    """What a statement evaluates itself, without the statements inside of it."""
    match stmt:
        case Assign():
            return stmt.value, stmt.target.indices, stmt.target.reference
        case CallBlock():
            bound = tuple((actual.indices, actual.reference) for _, actual in stmt.in_outs)
            return tuple(value for _, value in stmt.inputs), bound, stmt.instance.indices, stmt.instance.reference
        case Evaluate():
            return (stmt.call,)
        case If():
            return tuple(condition for condition, _ in stmt.branches)
        case Case():
            return (stmt.selector,)
        case For():
            return stmt.start, stmt.end, stmt.step
        case While():
            return (stmt.condition,)
        case Repeat():
            return (stmt.until,)
        case _:
            return ()


def meet(one: Ref, other: Ref) -> bool:
    """Whether they have a bit in common."""
    if one.base is not other.base or one.begin >= other.end or other.begin >= one.end:
        return False
    return one.end - one.begin > 1 or other.end - other.begin > 1 or bool(one.mask & other.mask)
