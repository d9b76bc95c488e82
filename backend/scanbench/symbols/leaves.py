"""Single values in the bytes of a variable, with their names."""

from typing import NamedTuple

from scanbench.program.types import BOOL, ArrayType, Elementary, Record, StringType
from scanbench.symbols.descent import Descent, Part
from scanbench.symbols.symbols import RAW_TYPES

WHOLE = 0xFF
_PARTS = {1: "B", 2: "W", 4: "D"}


class Leaf(NamedTuple):
    """A single value in the image, and what it is called."""

    name: str
    type: Elementary | StringType
    offset: int
    bit: int | None
    passing: bool = False
    """A temporary of what was called: it means nothing after that call."""
    raw: bool = False
    """No variable, an address of the model."""

    @property
    def bits(self) -> int:
        """Those of its byte, where it is a part of one."""
        return WHOLE if self.bit is None else 1 << self.bit

    def cut(self, data: bytes | bytearray, start: int = 0) -> bytes:
        """Its value, in bytes of the image that begin at `start`; of a string also the bytes after its end."""
        at = self.offset - start
        if self.bit is not None:
            return bytes((data[at] >> self.bit & 1,))
        return bytes(data[at : at + self.type.size])


def leaves(descent: Descent, part: Part, offset: int, size: int, bits: int = WHOLE, whole: bool = False) -> list[Leaf]:
    """The single values in these bytes of a variable; of one that is only used in part that part, unless `whole`."""
    found: list[Leaf] = []
    _add(descent, part, offset, size, bits, whole, found)
    return found


def _add(
    descent: Descent, part: Part, offset: int, size: int, bits: int, whole: bool, found: list[Leaf]
) -> None:  # fmt: skip
    type = part.type
    if isinstance(type, Record | ArrayType):
        inner = [each for each in descent.inner(part, offset, offset + size) if _is_shown(each)]
        if len(inner) > 1 and isinstance(type, Record) and type.overlaps:
            inner = [min(inner, key=lambda each: (each.offset != offset, abs(each.type.size - size)))]
        for each in inner:
            _add(descent, each, offset, size, bits, whole, found)
    elif part.bit is not None:
        if bits >> part.bit & 1:
            found.append(Leaf(part.name, BOOL, part.offset, part.bit))
    elif isinstance(type, Elementary | StringType):
        found.append(
            Leaf(part.name, type, part.offset, None)
            if whole
            else _leaf(part.name, type, part.offset, offset, size, bits)
        )


def _is_shown(part: Part) -> bool:
    member = part.member
    return member is None or not (member.hidden or member.bound or member.incomplete)


def _leaf(name: str, type: Elementary | StringType, start: int, offset: int, size: int, bits: int) -> Leaf:
    """The variable, or the part of it that these bytes are."""
    if type == BOOL:
        return Leaf(name, type, start, None)
    if bits != WHOLE:
        bit = bits.bit_length() - 1
        return Leaf(f"{name}.{8 * (offset - start) + bit}", BOOL, offset, bit)
    if offset <= start and start + type.size <= offset + size:
        return Leaf(name, type, start, None)
    at = max(start, offset)
    count = min(start + type.size, offset + size) - at
    if isinstance(type, StringType) or count not in _PARTS or (at - start) % count:
        return Leaf(f"{name} (part)", RAW_TYPES[8], at, None)
    return Leaf(f"{name}.%{_PARTS[count]}{(at - start) // count}", RAW_TYPES[8 * count], at, None)
