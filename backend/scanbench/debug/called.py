"""What people call a place of the image: the path of the variable that lives there, its address."""

from collections.abc import Iterator

from scanbench.check.layout import Layout
from scanbench.check.program import Program
from scanbench.check.symbols import RAW_TYPES, Symbol, at_offset, starting_at
from scanbench.check.types import BOOL, Record, Type, is_derived


def variable_at(program: Program, offset: int, bit: int | None, type: Type) -> Symbol | None:
    """The variable of this type that lives there, other than in a frame."""
    if offset < Layout.HEADER_SIZE or offset >= program.layout.state_size:
        return None
    found = list(starting_at(program, offset))
    same = (each for each in found if each.type == type and each.bit == bit)
    return next(same, None) or next((each for each in found if _is_a(each.type, type)), None)


def called(program: Program, offset: int, bit: int | None, type: Type) -> str:
    """`Main.tank[3].level (D120)`, `D100`, `temporary Mix.t`: for people."""
    symbol = variable_at(program, offset, bit, type)
    address = address_at(program, offset, bit, type)
    if symbol is not None:
        return f"{symbol.path} ({address})" if address and address != symbol.path else symbol.path
    if address:
        return address
    for pou in program.pous:
        if pou.frame_offset <= offset < pou.frame_offset + pou.frame.size:
            return f"temporary {pou.name}{_in_frame(pou.frame, offset - pou.frame_offset)}"
    return at_offset(program, offset)


def address_at(program: Program, offset: int, bit: int | None, type: Type) -> str:
    """In the vendor's notation, where it is in an area of the model."""
    found = program.layout.area_at(offset)
    if found is None:
        return ""
    area, byte = found
    bits = 1 if bit is not None else 8 * type.size
    if bits not in RAW_TYPES or (type == BOOL and bit is None):
        bits = 16
    return program.layout.model.format(area, byte, bit, bits)


def _in_frame(frame: Record, offset: int) -> str:
    found: Iterator[str] = (
        f".{each.name}"
        for each in frame.members.values()
        if not each.hidden and each.offset <= offset < each.offset + each.storage
    )
    return next(found, "")


def _is_a(type: Type, base: Type) -> bool:
    return isinstance(type, Record) and isinstance(base, Record) and is_derived(type, base)
