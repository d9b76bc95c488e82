"""What people call a place of the image: the path of the variable that lives there, its address."""

from scanbench.program.program import Program
from scanbench.program.types import BOOL, Type
from scanbench.symbols.named import temporary_at, variable_at
from scanbench.symbols.symbols import RAW_TYPES, at_offset


def name_of(program: Program, offset: int, bit: int | None, type: Type) -> str:
    """`Main.tank[3].level (D120)`, `D100`, `temporary Mix.t`: for people."""
    symbol = variable_at(program, (offset, bit), type)
    address = address_at(program, offset, bit, type)
    if symbol is not None:
        return f"{symbol.path} ({address})" if address and address != symbol.path else symbol.path
    if address:
        return address
    temporary = temporary_at(program, offset)
    if temporary is not None:
        return f"temporary {'.'.join(filter(None, (temporary[0].name, temporary[1])))}"
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
