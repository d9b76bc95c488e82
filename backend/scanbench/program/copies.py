"""What in-outs are bound to: what the slots in an image lead to, through the copies of blocks that take their in-outs by value."""

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from scanbench.program.types import BOOL, SLOT_BYTES, ArrayType, Record, Type, actual_of

BYTE_OFFSET, BIT_SHIFT, BITS = 0xFFFF_FFFF, 32, 7
DEEPEST = 256
"""Blocks that pass an in-out on to each other; an image from a file may hold a circle."""

Image = bytes | bytearray | memoryview
Spot = tuple[int, int | None]
"""A place of the image: byte offset, and the bit of that byte for a BOOL that is one."""


@dataclass(frozen=True, slots=True)
class Copy:
    """The own variable of an in-out by value, in one instance: bytes of the image, and the slot that says what was passed."""

    start: int
    end: int
    slot: int
    boolean: bool
    """A BOOL: what was passed for it may be a bit of something."""


@dataclass(frozen=True, slots=True)
class Copies:
    """All of a program, by where they begin."""

    all: tuple[Copy, ...] = ()

    def at(self, offset: int) -> Copy | None:
        """The one that holds this byte."""
        index = bisect_right(self.all, offset, key=lambda each: each.start) - 1
        return self.all[index] if index >= 0 and offset < self.all[index].end else None

    def actual(self, memory: Image, offset: int, bit: int | None) -> Spot | None:
        """The variable that this byte, or bit, is a copy of in the end; it itself where it is no copy. None where the block
        was never called, or is not connected any more."""
        return [*self.chain(memory, offset, bit)][-1] if self.all else (offset, bit)

    def source(self, memory: Image, offset: int) -> int:
        """The byte that this one is a copy of in the end, as far as blocks are connected."""
        known = [each[0] for each in self.chain(memory, offset, None) if each is not None] if self.all else []
        return known[-1] if known else offset

    def chain(self, memory: Image, offset: int, bit: int | None) -> Iterator[Spot | None]:
        """It, and what it is a copy of, and so on up to the variable itself; ends with None where a block is not connected."""
        yield offset, bit
        for _ in range(DEEPEST):
            copy = self.at(offset)
            if copy is None:
                return
            slot = int.from_bytes(memory[copy.slot : copy.slot + SLOT_BYTES], "little")
            place = referred(slot)
            if place is None:
                break
            if copy.boolean:
                bit = place[1]
            offset = place[0] + offset - copy.start
            yield offset, bit
        yield None


NO_COPIES = Copies()


def makes_copies(block: Record) -> bool:
    """Whether the body of a block copies in-outs by value, in and back."""
    return any(each.copied for each in block.members.values())


def referred(slot: int) -> tuple[int, int] | None:
    """Byte offset and bit that a slot refers to; None for what refers to nothing."""
    offset = slot & BYTE_OFFSET
    return None if offset == 0 or slot >> BIT_SHIFT > BITS else (offset, slot >> BIT_SHIFT)


def copies_of(records: Iterable[tuple[Record, int]]) -> Copies:
    """The copies in these records, each with where it begins in the image."""
    found = [copy for record, offset in records for copy in _of_record(record, offset)]
    return Copies(tuple(sorted(found, key=lambda each: each.start)))


def _of_record(record: Record, offset: int) -> Iterator[Copy]:
    for member in record.members.values():
        start = offset + member.offset
        if member.copied:
            slot = offset + actual_of(record, member).offset
            yield Copy(start, start + member.type.size, slot, member.type == BOOL)
        elif not member.located and not member.bound:
            yield from _of_type(member.type, start)


def _of_type(type: Type, offset: int) -> Iterator[Copy]:
    if not has_copies(type):
        return
    if isinstance(type, Record):
        yield from _of_record(type, offset)
    elif isinstance(type, ArrayType):
        for number in range(type.count):
            yield from _of_type(type.element, offset + number * type.element.size)


def has_copies(type: Type) -> bool:
    """Whether an instance of a block is in it that takes an in-out by value."""
    if isinstance(type, ArrayType):
        return has_copies(type.element)
    if isinstance(type, Record):
        return any(each.copied or (not each.bound and has_copies(each.type)) for each in type.members.values())
    return False
