"""Types of IEC 61131-3 as types of OPC UA, and values of them. (OPC 30000, PLCopen, section 5.2: data types.)"""

import struct
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any

from asyncua import ua

from scanbench.comm.opcua.ids import standard
from scanbench.program.strings import characters, stored
from scanbench.program.types import ArrayType, Elementary, Enumeration, Kind, StringType, Type, base_of

MOST_ELEMENTS = 65_536
"""An array with more elements has no value as a whole."""
_1970 = datetime(1970, 1, 1, tzinfo=UTC)
_NS_MS, _NS_US, _DAY_NS = 1_000_000, 1000, 86_400_000_000_000
_INT32 = range(-(1 << 31), 1 << 31)
_NUMBERS = {
    "BOOL": ("?", ua.VariantType.Boolean), "SINT": ("b", ua.VariantType.SByte), "INT": ("<h", ua.VariantType.Int16),
    "DINT": ("<i", ua.VariantType.Int32), "LINT": ("<q", ua.VariantType.Int64), "USINT": ("B", ua.VariantType.Byte),
    "UINT": ("<H", ua.VariantType.UInt16), "UDINT": ("<I", ua.VariantType.UInt32), "ULINT": ("<Q", ua.VariantType.UInt64),
    "BYTE": ("B", ua.VariantType.Byte), "WORD": ("<H", ua.VariantType.UInt16), "DWORD": ("<I", ua.VariantType.UInt32),
    "LWORD": ("<Q", ua.VariantType.UInt64), "REAL": ("<f", ua.VariantType.Float), "LREAL": ("<d", ua.VariantType.Double),
    "CHAR": ("B", ua.VariantType.Byte), "WCHAR": ("<H", ua.VariantType.UInt16),
}  # fmt: skip


class NoValue(ValueError):
    """What a client gives is no value of the type."""


@dataclass(frozen=True, slots=True)
class Form:
    """How a type looks in OPC UA."""

    variant: ua.VariantType
    data_type: ua.NodeId | str
    """The node of the type; the name of an enumeration, which has a node of its own."""
    size: int
    """Bytes in memory."""
    read: Callable[[bytes], Any]
    """The value in these bytes."""
    write: Callable[[Any], bytes]
    """The bytes of a value; `NoValue`."""
    dimensions: tuple[int, ...] = ()
    """Of an array."""

    def value(self, data: bytes) -> ua.Variant:
        """What a client is given."""
        return ua.Variant(self.read(data), self.variant, is_array=bool(self.dimensions))

    def data(self, variant: ua.Variant) -> bytes:
        """The bytes of what a client gives; `NoValue`, `TypeError` where it is of a different type."""
        if variant.VariantType != self.variant or bool(variant.is_array) != bool(self.dimensions):
            raise TypeError
        return self.write(variant.Value)


def form_of(type: Type) -> Form | None:
    """None where the type has no single value: structures, references, very large arrays."""
    if isinstance(type, ArrayType):
        element = form_of(type.element)
        if element is None or element.dimensions or type.count > MOST_ELEMENTS:
            return None
        return _array(type, element)
    if isinstance(type, StringType):
        return _text(type)
    if isinstance(type, Elementary) and type.kind is not Kind.REF:
        return _single(type)
    return None


def _single(type: Elementary) -> Form:
    if isinstance(type, Enumeration) and all(number in _INT32 for _, number in type.values):
        return _enumeration(type)
    name = base_of(type).name.removeprefix("L")
    if name == "TIME":
        return _duration(type)
    if type.kind is Kind.DATE:
        return _date(type, name)
    letters, variant = _NUMBERS[base_of(type).name]
    return _number(type, letters, variant)


def _number(type: Elementary, letters: str, variant: ua.VariantType) -> Form:
    """Numbers and BOOL."""
    packing = struct.Struct(letters)

    def read(data: bytes) -> object:
        return packing.unpack(data)[0]

    def write(value: Any) -> bytes:
        try:
            return bytes(packing.pack(value))
        except (struct.error, OverflowError):
            raise NoValue from None

    return Form(variant, standard(variant.value), type.size, read, write)


def _enumeration(type: Enumeration) -> Form:
    """Whole numbers, of whatever size they are in memory."""

    def read(data: bytes) -> int:
        return int.from_bytes(data, "little", signed=type.signed)

    def write(value: int) -> bytes:
        if all(number != value for _, number in type.values):
            raise NoValue
        return value.to_bytes(type.size, "little", signed=type.signed)

    return Form(ua.VariantType.Int32, type.name, type.size, read, write)


def _duration(type: Elementary) -> Form:
    def read(data: bytes) -> float:
        return int.from_bytes(data, "little", signed=True) / _NS_MS

    def write(value: float) -> bytes:
        try:
            return round(value * _NS_MS).to_bytes(8, "little", signed=True)
        except (OverflowError, ValueError):
            raise NoValue from None

    return Form(ua.VariantType.Double, standard(ua.ObjectIds.Duration), type.size, read, write)


def _date(type: Elementary, name: str) -> Form:
    """Points in time, in steps of a microsecond; a time of day is that of 1970-01-01."""

    def read(data: bytes) -> datetime:
        return _1970 + timedelta(microseconds=int.from_bytes(data, "little", signed=True) // _NS_US)

    def write(value: Any) -> bytes:
        if not isinstance(value, datetime):
            raise NoValue
        aware = value if value.tzinfo is not None else value.replace(tzinfo=UTC)
        number = (aware - _1970) // timedelta(microseconds=1) * _NS_US
        if name == "DATE":
            number -= number % _DAY_NS
        elif name == "TIME_OF_DAY":
            number %= _DAY_NS
        try:
            return number.to_bytes(8, "little", signed=True)
        except OverflowError:
            raise NoValue from None

    return Form(ua.VariantType.DateTime, standard(ua.ObjectIds.UtcTime), type.size, read, write)


def _text(type: StringType) -> Form:
    coding = "utf-16-le" if type.width == 2 else "latin-1"

    def read(data: bytes) -> str:
        return characters(type, data).decode(coding, "replace")

    def write(value: Any) -> bytes:
        try:
            data = ("" if value is None else str(value)).encode(coding)
        except UnicodeEncodeError:
            raise NoValue from None
        if len(data) > type.capacity * type.width or (type.zero and b"\0" in data):
            raise NoValue
        return stored(type, data)

    return Form(ua.VariantType.String, standard(ua.ObjectIds.String), type.size, read, write)


def _array(type: ArrayType, element: Form) -> Form:
    dimensions = tuple(high - low + 1 for low, high in type.bounds)
    size, count = element.size, type.count

    def read(data: bytes) -> list[Any]:
        return _shaped([element.read(data[at : at + size]) for at in range(0, count * size, size)], dimensions)

    def write(value: Any) -> bytes:
        flat = list(_flat(value))
        if len(flat) != count:
            raise NoValue
        return b"".join(element.write(each).ljust(size, b"\0") for each in flat)

    return Form(element.variant, element.data_type, type.size, read, write, dimensions)


def _shaped(flat: Sequence[Any], dimensions: Sequence[int]) -> list[Any]:
    """As a list of lists, the last index moves fastest."""
    for each in reversed(dimensions[1:]):
        flat = [list(flat[at : at + each]) for at in range(0, len(flat), each)]
    return list(flat)


def _flat(value: Any) -> Iterator[Any]:
    if isinstance(value, list | tuple):
        for each in value:
            yield from _flat(each)
    elif value is not None:
        yield value
