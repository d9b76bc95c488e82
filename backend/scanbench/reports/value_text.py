"""Values of columns as text, for reports and exports: in the formats of the watch table."""

import re
import struct
from functools import lru_cache
from typing import Literal, get_args

from scanbench.program.types import Elementary, Enumeration, Kind, StringType, Type
from scanbench.symbols.values import DATES, format_time, format_value
from scanbench.verify.contract import Column, Mismatch

Format = Literal["default", "decimal", "signed", "unsigned", "hex", "binary", "bcd", "float", "time", "ascii"]
"""The same names, and the same meaning, as of a row of the watch table."""
FORMATS: tuple[Format, ...] = get_args(Format)
_NUMBERS = (Kind.INT, Kind.UINT, Kind.BITS)


def value_text(column: Column, data: bytes | None, format: Format = "default") -> str:
    """A value as people write it; nothing where there is none. A format that the type does not have is the usual one."""
    if not data:
        return ""
    type = type_of(column)
    if type is None or len(data) != column.size:
        return raw(data)
    if format == "default" or not isinstance(type, Elementary) or isinstance(type, Enumeration):
        return format_value(type, data)
    return _in_format(type, data, format) or format_value(type, data)


def column_of(difference: Mismatch, columns: tuple[Column, ...] = ()) -> Column:
    """What a difference says of its variable, with the names of its values if a column knows them."""
    known = next((each for each in columns if each.name == difference.name and each.size == difference.size), None)
    return known or Column(difference.name, difference.type, difference.kind, difference.size)


def raw(data: bytes) -> str:
    """Bytes as one number, the highest first."""
    return f"16#{data[::-1].hex().upper()}"


def differing_bits(one: bytes, other: bytes) -> list[int]:
    """Numbers of the bits that are not the same, from 0; none where one of the values does not exist."""
    if len(one) != len(other):
        return []
    bits = int.from_bytes(one, "little") ^ int.from_bytes(other, "little")
    return [number for number in range(8 * len(one)) if bits >> number & 1]


@lru_cache(maxsize=4096)
def type_of(column: Column) -> Type | None:
    """The type as far as texts need it; None where a column does not say enough."""
    if column.kind == Kind.STRING:
        width = 2 if column.type.upper().startswith("W") else 1
        said = re.search(r"\[(\d+)\]", column.type)
        return StringType(int(said.group(1)) if said else (column.size - 2) // width, width)
    if column.size not in (1, 2, 4, 8):
        return None
    if column.values:
        kind = Kind.INT if column.kind == "enum" else Kind(column.kind)
        return Enumeration(column.type, kind, column.size, column.values)
    if column.kind not in (*_NUMBERS, Kind.BOOL, Kind.REAL, Kind.TIME, Kind.DATE, Kind.CHAR, Kind.REF):
        return None
    if column.kind == Kind.DATE and column.type.removeprefix("L") not in DATES:
        return None
    return Elementary(column.type, Kind(column.kind), column.size)


def _in_format(type: Elementary, data: bytes, format: Format) -> str:
    """Empty where the type has no such format."""
    bits, signed = int.from_bytes(data, "little"), int.from_bytes(data, "little", signed=True)
    if type.kind is Kind.REAL:
        return _based(bits, len(data), format)
    if type.kind is Kind.TIME:
        return f"{signed / 1e6:.15g}" if format == "decimal" else raw(data) if format == "hex" else ""
    if type.kind not in _NUMBERS:
        return ""
    number = signed if type.kind is Kind.INT else bits
    match format:
        case "decimal":
            return str(number)
        case "signed":
            return str(signed)
        case "unsigned":
            return str(bits)
        case "bcd":
            digits = data[::-1].hex().upper()
            return digits if digits.isdigit() else f"16#{digits}"
        case "float":
            return repr(_real(data)) if len(data) >= 4 else ""
        case "time":
            return format_time(number * 1_000_000)
        case "ascii":
            return f"'{''.join(chr(each) if 0x20 <= each < 0x7F else '.' for each in data[::-1])}'"
    return _based(bits, len(data), format)


def _real(data: bytes) -> float:
    value = float(struct.unpack("<f" if len(data) == 4 else "<d", data)[0])
    return float(f"{value:.7g}") if len(data) == 4 else value


def _based(bits: int, size: int, format: Format) -> str:
    if format == "hex":
        return f"16#{bits:0{2 * size}X}"
    return f"2#{bits:0{8 * size}b}" if format == "binary" else ""
