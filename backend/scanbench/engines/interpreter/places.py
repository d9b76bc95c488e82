"""Reading and writing places of the image."""

import math
import struct
from collections.abc import Callable

from scanbench.check.program import Base, Expr, Place
from scanbench.check.types import Elementary, Kind, StringType

Value = int | float | bytes
Read = Callable[[int], Value]
"""Takes the offset of the running instance."""
Write = Callable[[int, Value], None]
Address = Callable[[int], int]
Reference = Callable[[int], int]

FORMATS = {
    (Kind.BOOL, 1): "<B", (Kind.INT, 1): "<b", (Kind.INT, 2): "<h", (Kind.INT, 4): "<i", (Kind.INT, 8): "<q",
    (Kind.UINT, 1): "<B", (Kind.UINT, 2): "<H", (Kind.UINT, 4): "<I", (Kind.UINT, 8): "<Q",
    (Kind.BITS, 1): "<B", (Kind.BITS, 2): "<H", (Kind.BITS, 4): "<I", (Kind.BITS, 8): "<Q",
    (Kind.REAL, 4): "<f", (Kind.REAL, 8): "<d", (Kind.TIME, 8): "<q",
}  # fmt: skip
CANONICAL_NAN = {4: bytes.fromhex("0000c07f"), 8: bytes.fromhex("000000000000f87f")}
REFERENCE = struct.Struct("<Q")


class Trapped(Exception):
    """The program trapped at this site."""

    def __init__(self, trap: int) -> None:
        super().__init__(trap)
        self.trap = trap


class Places:
    """Closures on places, for the body of one POU."""

    def __init__(self, memory: bytearray, frame_offset: int, evaluate: Callable[[Expr], Read]) -> None:
        self.memory = memory
        self.frame_offset = frame_offset
        self.evaluate = evaluate

    def reference(self, place: Place) -> Reference:
        """The reference to a place, as an in-out slot holds it: byte offset, and bit number above it."""
        start = self._start(place)
        steps = [
            (self.evaluate(index.value), index.low, index.high, index.stride, index.trap) for index in place.indices
        ]
        if not steps:
            return start

        def indexed(instance: int) -> int:
            at = start(instance)
            for value, low, high, stride, trap in steps:
                number = value(instance)
                assert isinstance(number, int)
                if not low <= number <= high:
                    raise Trapped(trap)
                at += (number - low) * stride
            return at

        return indexed

    def _start(self, place: Place) -> Reference:
        offset, bit = place.offset, (place.bit or 0) << 32
        if place.slot is not None:
            return self._through(place.slot, offset, place.null_trap)
        match place.base:
            case Base.IMAGE:
                fixed = offset | bit
                return lambda instance: fixed
            case Base.FRAME:
                fixed = (self.frame_offset + offset) | bit
                return lambda instance: fixed
        return lambda instance: (instance + offset) | bit

    def _through(self, slot: Place, offset: int, trap: int) -> Reference:
        where, memory, unpack = self.address(slot), self.memory, REFERENCE.unpack_from

        def follow(instance: int) -> int:
            reference: int = unpack(memory, where(instance))[0]
            if reference == 0:
                raise Trapped(trap)
            return reference + offset

        return follow

    def address(self, place: Place) -> Address:
        """The byte offset of a place."""
        reference = self.reference(place)
        if place.bit is None and place.slot is None:
            return reference
        return lambda instance: reference(instance) & 0xFFFF_FFFF

    def _in_bits(self, place: Place) -> bool:
        return place.type.kind is Kind.BOOL and (place.bit is not None or place.slot is not None)

    def read(self, place: Place) -> Read:
        memory, type = self.memory, place.type
        if self._in_bits(place):
            reference = self.reference(place)

            def read_bit(instance: int) -> Value:
                at = reference(instance)
                return memory[at & 0xFFFF_FFFF] >> (at >> 32) & 1

            return read_bit
        where = self.address(place)
        if isinstance(type, Elementary):
            unpack = struct.Struct(FORMATS[type.kind, type.size]).unpack_from
            return lambda instance: unpack(memory, where(instance))[0]
        if isinstance(type, StringType):
            capacity = type.capacity

            def read_string(instance: int) -> Value:
                at = where(instance)
                length = min(memory[at] | memory[at + 1] << 8, capacity)
                return bytes(memory[at + 2 : at + 2 + length])

            return read_string
        size = type.size

        def read_bytes(instance: int) -> Value:
            at = where(instance)
            return bytes(memory[at : at + size])

        return read_bytes

    def write(self, place: Place) -> Write:
        memory, type = self.memory, place.type
        if self._in_bits(place):
            reference = self.reference(place)

            def write_bit(instance: int, value: Value) -> None:
                at = reference(instance)
                byte, mask = at & 0xFFFF_FFFF, 1 << (at >> 32)
                memory[byte] = memory[byte] | mask if value else memory[byte] & ~mask

            return write_bit
        where = self.address(place)
        if isinstance(type, StringType):
            capacity = type.capacity

            def write_string(instance: int, value: Value) -> None:
                assert isinstance(value, bytes)
                at, text = where(instance), value[:capacity]
                memory[at : at + 2] = len(text).to_bytes(2, "little")
                memory[at + 2 : at + 2 + len(text)] = text

            return write_string
        if not isinstance(type, Elementary):

            def write_bytes(instance: int, value: Value) -> None:
                assert isinstance(value, bytes)
                at = where(instance)
                memory[at : at + len(value)] = value

            return write_bytes
        pack = struct.Struct(FORMATS[type.kind, type.size]).pack_into
        if type.kind is not Kind.REAL:
            return lambda instance, value: pack(memory, where(instance), value)
        canonical, size = CANONICAL_NAN[type.size], type.size

        def write_real(instance: int, value: Value) -> None:
            at = where(instance)
            if math.isnan(value):  # type: ignore[arg-type]
                memory[at : at + size] = canonical
            else:
                pack(memory, at, value)

        return write_real
