"""How the types of the language look in LLVM IR, and which numbers they hold."""

import math
import struct

from scanbench.program.types import BOOL, ArrayType, Elementary, Kind, OpenArray, Record, StringType, Type

NAN = {4: "0x7FF8000000000000", 8: "0x7FF8000000000000"}
"""The canonical NaN; LLVM writes a float constant as the double of the same value."""

STRING_HEAD = 2
"""Bytes of the length before the characters, where there is one."""


def stored(type: Elementary) -> str:
    """The type of the bytes in the image."""
    return "i8" if type.kind is Kind.BOOL else value_type(type)


def value_type(type: Elementary) -> str:
    """The type of a value in a register."""
    if type.kind is Kind.REAL:
        return "float" if type.size == 4 else "double"
    return f"i{type.bits}"


def wrap(value: int, bits: int) -> int:
    """The number as LLVM prints it: two's complement of this width."""
    value &= (1 << bits) - 1
    return value - (1 << bits) if bits > 1 and value >> (bits - 1) else value


def integer(value: int, type: Elementary) -> str:
    """A constant of an integer-like type."""
    if type.bits == 1:
        return "true" if value & 1 else "false"
    return str(wrap(value, type.bits))


def real(value: float, type: Elementary) -> str:
    """A constant of REAL or LREAL."""
    if math.isnan(value):
        return NAN[type.size]
    if type.size == 4 and not math.isinf(value):
        try:
            value = struct.unpack("<f", struct.pack("<f", value))[0]
        except OverflowError:
            value = math.copysign(math.inf, value)
    return f"0x{struct.unpack('<Q', struct.pack('<d', value))[0]:016X}"


def is_real(type: Type) -> bool:
    return type.kind is Kind.REAL


def has_members(type: Type) -> bool:
    """Whether its bytes are also known by the names of members."""
    if isinstance(type, ArrayType | OpenArray):
        return has_members(type.element)
    return isinstance(type, Record)


def elementary(type: Type | None) -> Elementary:
    """The type, which the checker promised to be elementary."""
    assert isinstance(type, Elementary), f"elementary type expected, not {type}"
    return type


def string(type: Type | None) -> StringType:
    """The type, which the checker promised to be a STRING."""
    assert isinstance(type, StringType), f"STRING expected, not {type}"
    return type


__all__ = [
    "BOOL",
    "NAN",
    "STRING_HEAD",
    "elementary",
    "has_members",
    "integer",
    "is_real",
    "real",
    "stored",
    "string",
    "value_type",
    "wrap",
]
