"""Values of columns as text, for reports and exports: in the formats of the watch table."""

import re
from functools import lru_cache

from scanbench.program.types import Elementary, Enumeration, Kind, StringType, Type
from scanbench.symbols.values import DATES, NUMBERS, Format, format_value, raw
from scanbench.verify.contract import Column, Mismatch


def value_text(column: Column, data: bytes | None, format: Format = "default") -> str:
    """A value as people write it; nothing where there is none. A format that the type does not have is the usual one."""
    if not data:
        return ""
    type = type_of(column)
    if type is None or len(data) != column.size:
        return raw(data)
    return format_value(type, data, format)


def column_of(difference: Mismatch, columns: tuple[Column, ...] = ()) -> Column:
    """What a difference says of its variable, with the names of its values if a column knows them."""
    known = next((each for each in columns if each.name == difference.name and each.size == difference.size), None)
    return known or Column(difference.name, difference.type, difference.kind, difference.size)


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
        capacity = int(said.group(1)) if said else (column.size - 2) // width
        return StringType(capacity, width, zero=column.size == capacity + 1)
    if column.size not in (1, 2, 4, 8):
        return None
    if column.values:
        kind = Kind.INT if column.kind == "enum" else Kind(column.kind)
        return Enumeration(column.type, kind, column.size, column.values)
    if column.kind not in (*NUMBERS, Kind.BOOL, Kind.REAL, Kind.TIME, Kind.DATE, Kind.CHAR, Kind.REF):
        return None
    if column.kind == Kind.DATE and column.type.removeprefix("L") not in DATES:
        return None
    return Elementary(column.type, Kind(column.kind), column.size)
