"""Addresses within a data block, as SCL has them: `"Data".DBW4` is the word from byte 4 on.

The bytes are those of a block with standard access (not optimized): BOOLs one after the other, bytes at any byte, all else at even
ones, high bytes first. An address that is one variable, or a part of one, is that; what would be of several is refused.
From the Programming Guide for S7-1200/S7-1500 and the TIA Portal's help, *Addressing tags in data blocks*.
"""

import re
from dataclasses import replace

from scanbench.check.body.context import Body
from scanbench.check.body.overlays import is_bit, members_at, size_of, step_of
from scanbench.check.body.parts import PARTED, WIDTHS, part
from scanbench.problems import Span
from scanbench.program.program import Base, Place
from scanbench.program.shown import shown
from scanbench.program.types import ArrayType, Elementary, Kind, Record, Section, Type, base_of
from scanbench.syntax import tree
from scanbench.syntax.lexer import DATA
from scanbench.syntax.scl import is_scl

_NAMED = re.compile(r"D(?:B?([BWD]))(\d{1,5})", re.IGNORECASE)
"""`DBW4` or `DW4` after a point; of bits the reader makes an address."""


def named_address(node: tree.MemberOf) -> tree.PartialAccess | None:
    """The address that this is in SCL, where a block has no member of that name; None of other names."""
    found = _NAMED.fullmatch(node.name) if is_scl(node.span.file) and isinstance(node.owner, tree.Name) else None
    if found is None:
        return None
    return tree.PartialAccess(node.owner, f"{DATA}{found[1].upper()}", 8 * int(found[2]), node.span)


def of_data(body: Body, place: Place, node: tree.PartialAccess) -> Place:
    """What is at this address of the data block."""
    size, (byte, bit) = node.size.removeprefix(DATA), divmod(node.index, 8)
    made = _leaf(place, place.type, byte, bit) if place.base is Base.IMAGE else None
    found = None if made is None else _sized(body, *made, size, bit, node.span)
    if found is None:
        raise body.report.reject(
            "X001", f"`{shown(node)}` is not one variable of this block, nor a part of one. Write the names "
            "of its variables.", node.span,
        )  # fmt: skip
    return found


def _leaf(place: Place, type: Type, byte: int, bit: int) -> tuple[Place, int] | None:
    """The elementary variable at this byte, and how far into it that is."""
    if isinstance(type, ArrayType):
        bits = is_bit(type.element)
        number = 8 * byte + bit if bits else byte // step_of(type.element)
        if number >= type.count:
            return None
        inner = replace(place, type=type.element, offset=place.offset + number * type.element.size)
        return (inner, 0) if bits else _leaf(inner, type.element, byte % step_of(type.element), bit)
    if isinstance(type, Record) and _is_plain(type):
        for member, at, first in members_at(type):
            exact = (at, first) == (byte, bit) if is_bit(member.type) else at <= byte < at + size_of(member.type)
            if exact:
                inner = replace(place, type=member.type, offset=place.offset + member.offset, bit=member.bit)
                return (inner, 0) if is_bit(member.type) else _leaf(inner, member.type, byte - at, bit)
        return None
    return (place, byte) if isinstance(type, Elementary) else None


def _is_plain(record: Record) -> bool:
    """Whether the variables of a block are all that it has: a structure, or a data block that is kept in part."""
    own = (Section.MEMBER, Section.VAR)
    return record.kind is Kind.STRUCT or all(
        each.section in own and not each.hidden for each in record.members.values()
    )


def _sized(body: Body, place: Place, into: int, size: str, bit: int, span: Span) -> Place | None:
    """The part of a variable from this byte on, as what the address says."""
    type, wanted = place.type, WIDTHS[size]
    assert isinstance(type, Elementary)
    plain = base_of(type)
    if plain.kind is Kind.BOOL or size == "X":
        if plain.kind is Kind.BOOL:
            return place if size == "X" else None
        return part(body, place, "X", 8 * (plain.size - 1 - into) + bit, span) if plain.kind in PARTED else None
    if plain.size == wanted.size and into == 0 and (plain.kind in PARTED or plain.name in ("REAL", "CHAR")):
        return replace(place, type=wanted)
    if plain.kind not in PARTED or into % wanted.size or into + wanted.size > plain.size:
        return None
    return part(body, place, size, (plain.size - into) // wanted.size - 1, span)
