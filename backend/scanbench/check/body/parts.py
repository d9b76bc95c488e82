"""Parts of integers and bit strings: a bit, a byte, a word, a double word."""

from dataclasses import replace

from scanbench.check.body.context import Body
from scanbench.check.declare.scopes import decode
from scanbench.check.uses import variable_symbol
from scanbench.problems import Span
from scanbench.program.program import Place
from scanbench.program.types import BOOL, ELEMENTARY, Elementary, Kind, Type
from scanbench.syntax import tree

WIDTHS = {
    "X": BOOL,
    "B": ELEMENTARY["BYTE"],
    "W": ELEMENTARY["WORD"],
    "D": ELEMENTARY["DWORD"],
    "L": ELEMENTARY["LWORD"],
}
PARTED = (Kind.INT, Kind.UINT, Kind.BITS)


def named_part(body: Body, place: Place, node: tree.MemberOf) -> Place:
    """`word.READY` of vendors: a CONSTANT names the bit."""
    found = body.scope.find(node.name)
    known = decode(found[0].type, found[0].initial) if found and found[0].constant and found[0].initial else None
    if known is None or not isinstance(known.value, int):
        raise body.report.reject("T010", f"{place.type} has no members; a bit of it is `.0`, `.1`, ...", node.span)
    assert found is not None
    body.report.use(node.span, node.name, variable_symbol(found[0], found[2]))
    return part(body, place, "X", known.value, node.span)


def part(body: Body, place: Place, size: str, index: int, span: Span) -> Place:
    """A bit (X), byte, word or double word of an integer or bit string, number 0 the lowest."""
    whole, narrow = part_type(body, place.type, size, index, span)
    if size == "X":
        return replace(place, type=narrow, offset=place.offset + index // 8, bit=index % 8)
    assert whole.size >= narrow.size
    return replace(place, type=narrow, offset=place.offset + index * narrow.size)


def part_type(body: Body, type: Type | None, size: str, index: int, span: Span) -> tuple[Elementary, Elementary]:
    """The type of the whole and of the part, when there is such a part."""
    narrow = WIDTHS[size]
    if not isinstance(type, Elementary) or type.kind not in PARTED:
        raise body.report.reject("T010", f"{type} has no parts; only integers and bit strings have.", span)
    count = type.bits // narrow.bits if size == "X" or narrow.size < type.size else 0
    if not 0 <= index < count:
        shown_part = f".{index}" if size == "X" else f".%{size}{index}"
        which = f"it has {count} of that size" if count else "it is no larger than that"
        raise body.report.reject("T012", f"{type} has no part `{shown_part}`: {which}.", span)
    return type, narrow
