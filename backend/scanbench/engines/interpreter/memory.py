"""Values in memory: how each type is read from and written to an address.

A value is an int (also BOOL, references, TIME, DATE, CHAR), a float, a str for a STRING or WSTRING (one character of it
for each character of theirs, so a surrogate counts as one), or bytes for a whole array or structure.
"""

import struct
from collections.abc import Callable

from scanbench.program.types import Elementary, Kind, StringType, Type
from scanbench.program.wide_types import WIDE

Value = int | float | str | bytes
Get = Callable[[int], Value]
"""The value at a byte offset."""
Put = Callable[[int, Value], None]

CODES = {1: ("<b", "<B"), 2: ("<h", "<H"), 4: ("<i", "<I"), 8: ("<q", "<Q")}
"""Of `struct`, signed and unsigned, by size."""
CANONICAL_NAN = {4: bytes.fromhex("0000c07f"), 8: bytes.fromhex("000000000000f87f")}


def packing(type: Elementary) -> struct.Struct:
    """How memory represents a value of a type."""
    if type.kind is Kind.REAL:
        return struct.Struct("<f" if type.size == 4 else "<d")
    signed, unsigned = CODES[type.size]
    return struct.Struct(signed if type.signed else unsigned)


def decode(data: bytes, width: int) -> str:
    """The characters of a string."""
    if width == 1:
        return data.decode("latin-1")
    return "".join(map(chr, struct.unpack(f"<{len(data) // 2}H", data)))


def encode(text: str, width: int) -> bytes:
    if width == 1:
        return text.encode("latin-1")
    return struct.pack(f"<{len(text)}H", *map(ord, text))


def getter(memory: bytearray, type: Type) -> Get:
    """Reads a type; of a BOOL in a whole byte, bit 0."""
    if isinstance(type, StringType):
        return _string_getter(memory, type)
    size = type.size
    if not isinstance(type, Elementary):
        return lambda at: bytes(memory[at : at + size])
    if type.kind is Kind.BOOL:
        return lambda at: memory[at] & 1
    if size == 1 and not type.signed:
        return memory.__getitem__
    if size == WIDE.size:
        signed = type.signed
        return lambda at: int.from_bytes(memory[at : at + size], "little", signed=signed)
    unpack = packing(type).unpack_from
    return lambda at: unpack(memory, at)[0]


def putter(memory: bytearray, type: Type) -> Put:
    """Writes a type; a NaN as the canonical one."""
    if isinstance(type, StringType):
        return _string_putter(memory, type)
    if not isinstance(type, Elementary):

        def put_bytes(at: int, value: Value) -> None:
            assert isinstance(value, bytes)
            memory[at : at + len(value)] = value

        return put_bytes
    if type.size == 1 and not type.signed:
        return memory.__setitem__  # type: ignore[return-value]
    if type.size == WIDE.size:
        return _wide_putter(memory, type)
    pack = packing(type).pack_into
    if type.kind is not Kind.REAL:
        return lambda at, value: pack(memory, at, value)
    canonical, size = CANONICAL_NAN[type.size], type.size

    def put_real(at: int, value: Value) -> None:
        if value != value:  # a NaN
            memory[at : at + size] = canonical
        else:
            pack(memory, at, value)

    return put_real


def _wide_putter(memory: bytearray, type: Elementary) -> Put:
    signed = type.signed

    def put(at: int, value: Value) -> None:
        assert isinstance(value, int)
        memory[at : at + WIDE.size] = value.to_bytes(WIDE.size, "little", signed=signed)

    return put


def _string_getter(memory: bytearray, type: StringType) -> Get:
    capacity, width = type.capacity, type.width

    def get_zero(at: int) -> Value:
        end = memory.find(0, at, at + capacity)
        return decode(bytes(memory[at : at + capacity if end < 0 else end]), 1)

    def get_string(at: int) -> Value:
        length = min(memory[at] | memory[at + 1] << 8, capacity)
        return decode(bytes(memory[at + 2 : at + 2 + length * width]), width)

    return get_zero if type.zero else get_string


def _string_putter(memory: bytearray, type: StringType) -> Put:
    capacity, width = type.capacity, type.width

    def put_zero(at: int, value: Value) -> None:
        assert isinstance(value, str)
        data = encode(value[:capacity], 1) + b"\0"
        memory[at : at + len(data)] = data

    def put_string(at: int, value: Value) -> None:
        assert isinstance(value, str)
        data = encode(value[:capacity], width)
        memory[at : at + 2] = (len(data) // width).to_bytes(2, "little")
        memory[at + 2 : at + 2 + len(data)] = data

    return put_zero if type.zero else put_string
