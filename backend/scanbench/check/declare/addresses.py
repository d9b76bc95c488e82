"""Addresses of the model, and places inside of structures -> where a variable lives."""

import re

from scanbench.check.declare.declarations import Declarations
from scanbench.problems import Span
from scanbench.program.types import ArrayType, Elementary, Kind, Member, Record, Type
from scanbench.syntax import tree

RELATIVE = re.compile(r"%([XBWDL])(\d+)(?:\.([0-7]))?", re.IGNORECASE)
UNIT_BYTES = {"X": 1, "B": 1, "W": 2, "D": 4, "L": 8}


def offset_of(declared: Declarations, address: str, type: Type, span: Span) -> tuple[int, int | None]:
    """Offset in the image, and bit, of an address of the model for a variable of this type."""
    if address.endswith("*"):
        raise declared.report.reject(
            "D005", "A whole address is needed here; only VAR and VAR_GLOBAL wait for one.", span
        )
    location = declared.model.locate(address)
    if location is None:
        raise declared.report.reject("D005", f"{declared.model.why_not(address)}.", span)
    bool_type = isinstance(type, Elementary) and type.kind is Kind.BOOL
    if bool_type != (location.bits == 1):
        area, byte = location.area, location.byte
        if bool_type:
            need = f"it needs a bit, e.g. `{declared.model.format(area, byte, 0, 1)}`"
        else:  # D40000 is a bit where there is no such word
            is_bit, word = (
                declared.model.format(area, byte, location.bit, 1),
                declared.model.format(area, byte & ~1, None, 16),
            )
            need = f"it is the bit {is_bit}; a whole word is written like `{word}`"
        raise declared.report.reject("D005", f"`{address}` does not fit {type}: {need}.", span)
    if _has_bool(type) and not bool_type:
        raise declared.report.reject(
            "D005", f"{type} has BOOL members, which take bytes; locate them one by one.", span
        )
    if location.byte + type.size > location.area.size:
        raise declared.report.reject(
            "D005", f"{type} takes {type.size} bytes and goes beyond the end of area {location.area.name}.", span
        )
    return declared.areas[location.area.name] + location.byte, location.bit


def locate(declared: Declarations, member: Member, variable: tree.Variable) -> None:
    """Gives a variable the place of its address, and its start value there."""
    address, span = variable.address or "", variable.address_span or variable.span
    member.offset, member.bit = offset_of(declared, address, member.type, span)
    member.address = address
    if variable.initial is None:
        return
    if member.bit is None:
        declared.located.append((member.offset, 0xFF, member.initial))
    else:
        declared.located.append((member.offset, 1 << member.bit, bytes([member.initial[0] << member.bit])))


def is_relative(address: str) -> bool:
    """Whether it counts from the start of a structure: `%B4`, `%X3.0`."""
    return RELATIVE.fullmatch(address) is not None


def place_relative(declared: Declarations, owner: Record, member: Member, address: str, span: Span) -> None:
    """Gives the member of a structure the place that it asks for."""
    match = RELATIVE.fullmatch(address)
    assert match is not None
    letter, unit, bit = match.group(1).upper(), int(match.group(2)), match.group(3)
    offset = unit * UNIT_BYTES[letter]
    is_bit = isinstance(member.type, Elementary) and member.type.kind is Kind.BOOL
    if (letter == "X") != is_bit:
        need = "a bit, `%X3.0`" if is_bit else "a byte or larger, `%B4`"
        raise declared.report.reject("D005", f"`{address}` does not fit {member.type}: it needs {need}.", span)
    if letter == "X":
        offset, member.bit = (unit, int(bit)) if bit is not None else divmod(unit, 8)
    elif bit is not None:
        raise declared.report.reject("D005", f"`{address}` has a bit number; only `%X` has one.", span)
    first, last = _bits(member, offset)
    for other in owner.members.values():
        low, high = _bits(other, other.offset)
        if not owner.overlaps and first < high and low < last:
            raise declared.report.reject(
                "D005",
                f"`{member.name}` shares bytes with `{other.name}`; write STRUCT OVERLAP if that is meant.",
                span,
            )
    owner.place_at(member, offset)


def _bits(member: Member, offset: int) -> tuple[int, int]:
    if member.bit is not None:
        return 8 * offset + member.bit, 8 * offset + member.bit + 1
    return 8 * offset, 8 * (offset + member.storage)


def _has_bool(type: Type) -> bool:
    if isinstance(type, ArrayType):
        return _has_bool(type.element)
    if isinstance(type, Record):
        return any(_has_bool(member.type) for member in type.members.values())
    return type.kind is Kind.BOOL
