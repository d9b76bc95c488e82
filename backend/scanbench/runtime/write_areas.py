"""WriteAreas: what a tool at a communication port writes into memory areas, as bytes."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

from scanbench.runtime.command import Category, Command, Patch, Plan, Refusal, View
from scanbench.runtime.forces import forced_table
from scanbench.runtime.target import everywhere

READ_ONLY = "read-only for tools"
"""What a refusal says of memory that no tool may write."""
_SHOWN = 3
"""Addresses that are named, where many are written."""


@dataclass(frozen=True, slots=True)
class AreaWrite:
    """Bytes of an area from `byte` on, as they lie there: words little endian. With `bit` (0 to 7) one bit of that byte, which
    is on where `data` is not 0."""

    area: str
    byte: int
    data: bytes
    bit: int | None = None

    @property
    def mask(self) -> bytes:
        """The bits that are written."""
        return b"\xff" * len(self.data) if self.bit is None else bytes((1 << self.bit,))

    @property
    def bits(self) -> bytes:
        """Their values."""
        if self.bit is None:
            return self.data
        return bytes(((self.data[0] != 0) << self.bit,))


@dataclass(frozen=True, slots=True)
class WriteAreas(Command):
    """All of it, or nothing. As at the device every mode permits it, and a bit that is forced stays as it is."""

    category: ClassVar[Category] = "write"

    writes: tuple[AreaWrite, ...]

    def plan(self, view: View) -> Plan | Refusal:
        """Patches of the bits that change: none where all of it is there already, or is forced."""
        patches: list[Patch] = []
        forced, changes = forced_table(view), Changes(view.memory)
        for write in self.writes:
            place = self._place(view, write)
            if isinstance(place, Refusal):
                return place
            free = bytes(mask & ~forced.get(at, (0, 0))[0] for at, mask in enumerate(write.mask, place))
            patches += changes.write(place, free, write.bits)
        shared = tuple(each for patch in patches for each in everywhere(view, patch))
        return Plan(shared, said(view, self.writes))

    @staticmethod
    def _place(view: View, write: AreaWrite) -> int | Refusal:
        """Where it lies in the image."""
        area = view.model.area(write.area)
        if area is None or write.byte < 0 or write.byte + len(write.data) > area.size:
            return Refusal(f"{write.area}, byte {write.byte}: {view.model.name} has no such memory")
        word = area.protected(write.byte, len(write.data), "tool")
        if word is not None:
            place = view.model.format(area, 2 * word, None, 16)
            return Refusal(f"{place} is {READ_ONLY} on {view.model.name}, as on the device")
        return view.program.layout.areas[area.name] + write.byte


class Changes:
    """Patches of what changes, where each write finds what the ones before it have left."""

    def __init__(self, memory: bytearray | bytes | memoryview) -> None:
        self._memory = memory
        self._bytes: dict[int, int] = {}
        """What the bytes are that were written."""

    def write(self, place: int, mask: bytes, data: bytes) -> Iterator[Patch]:
        """Of the bytes from `place` on those in which something changes, in stretches."""
        begin = None
        for at, (bits, value) in enumerate(zip(mask, data, strict=True)):
            now = self._bytes.get(place + at, self._memory[place + at])
            changes = (now ^ value) & bits
            if changes:
                self._bytes[place + at] = now & ~bits | value & bits
                begin = at if begin is None else begin
            elif begin is not None:
                yield Patch(place + begin, mask[begin:at], data[begin:at])
                begin = None
        if begin is not None:
            yield Patch(place + begin, mask[begin:], data[begin:])


def said(view: View, writes: Sequence[AreaWrite]) -> str:
    """What was written, for people: `D100 := 16#0005`."""
    texts = [_said(view, write) for write in writes[:_SHOWN]]
    more = len(writes) - _SHOWN
    return "; ".join(texts) + (f"; and {more} more" if more > 0 else "")


def _said(view: View, write: AreaWrite) -> str:
    area = view.model.area(write.area)
    assert area is not None
    if write.bit is not None:
        place = view.model.format(area, write.byte, write.bit, 1)
        return f"{place} := {'TRUE' if write.data[0] else 'FALSE'}"
    first = view.model.format(area, write.byte & ~1, None, 16)
    words = (len(write.data) + 1) // 2
    if words == 1:
        return f"{first} := 16#{int.from_bytes(write.data, 'little'):04X}"
    last = view.model.format(area, (write.byte + len(write.data) - 1) & ~1, None, 16)
    return f"{first} to {last} written, {words} words"
