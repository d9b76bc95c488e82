"""What the bytes are called that a range reads and writes: columns of the table.

Of a function block, function or method the names are those inside of it, so that the rows of several instances share their
columns; everything else has its path or its address.
"""

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from scanbench.program.copies import Image, referred
from scanbench.program.layout import Layout
from scanbench.program.program import Pou, Program
from scanbench.program.types import (
    BOOL,
    SLOT_BYTES,
    ArrayType,
    Elementary,
    Enumeration,
    Member,
    Record,
    Section,
    StringType,
    Type,
)
from scanbench.symbols.named import located
from scanbench.symbols.sites import Sites
from scanbench.symbols.symbols import RAW_TYPES, Symbol, at_offset, instance_at, roots_at
from scanbench.verify.contract import Column
from scanbench.verify.ranges import owner_of

WHOLE = 0xFF
_PARTS = {1: "B", 2: "W", 4: "D"}
_GLOBAL = " (global)"
"""Behind the name of what the POU has a variable of its own for."""


class Leaf(NamedTuple):
    """A single value in the image, and what it is called."""

    name: str
    type: Elementary | StringType
    offset: int
    bit: int | None
    passing: bool = False
    """A temporary of what the range calls: it means nothing behind that call, so no column shows it."""

    @property
    def bits(self) -> int:
        """Those of its byte, where it is a part of one."""
        return WHOLE if self.bit is None else 1 << self.bit

    def cut(self, data: bytes | bytearray, start: int) -> bytes:
        """Its value, in bytes of the image that begin at `start`; of a string also what is behind its end."""
        at = self.offset - start
        if self.bit is not None:
            return bytes((data[at] >> self.bit & 1,))
        return bytes(data[at : at + self.type.size])

    def column(self) -> Column:
        """As the table has it."""
        values = self.type.values if isinstance(self.type, Enumeration) else ()
        return Column(self.name, self.type.name, self.type.kind.value, self.type.size, values)


@dataclass(frozen=True, slots=True)
class Around:
    """Where a pass runs: what its names depend on."""

    pou: Pou | None
    """None: the whole scan."""
    instance: int = 0
    slots: tuple[int, ...] = ()
    """What its in-outs are bound to."""


ANYWHERE = Around(None)


class Namer:
    """Knows the names of one program. What was asked for once is known."""

    def __init__(self, program: Program, sites: Sites) -> None:
        self.program = program
        self._frames = sorted((pou for pou in program.pous if pou.frame.size), key=lambda pou: pou.frame_offset)
        self._mine = sites.bodies
        self._located = _by_byte(program)
        self._known: dict[Around, dict[tuple[int, int, int], tuple[Leaf, ...]]] = {}

    def around(self, pou: Pou | None, instance: int, memory: Image) -> Around:
        """Of a pass that begins now."""
        if pou is None:
            return ANYWHERE
        return Around(pou, instance, tuple(_slot(memory, at) for _, at in _in_outs(pou, instance)))

    def names(self, around: Around) -> "Names":
        """The names of a pass."""
        return Names(self, around, self._known.setdefault(around, {}))

    def find(self, around: Around, offset: int, size: int, bits: int) -> tuple[Leaf, ...]:
        """What these bytes are; nothing for what the compiler keeps there."""
        pou, found = around.pou, list[Leaf]()
        if pou is not None:
            record = owner_of(pou) if pou.kind != "program" else None
            if record is not None and around.instance <= offset < around.instance + record.size:
                _below(record, around.instance, "", offset, size, bits, found)
                return tuple(found)
            if pou.frame_offset <= offset < pou.frame_offset + pou.frame.size:
                _below(pou.frame, pou.frame_offset, "", offset, size, bits, found)
                return tuple(found)
            for (member, _), slot in zip(_in_outs(pou, around.instance), around.slots, strict=True):
                place = referred(slot)
                if place is not None and place[0] <= offset < place[0] + member.type.size:
                    if member.type == BOOL and bits not in (WHOLE, 1 << place[1]):
                        continue
                    if member.type == BOOL:
                        return (Leaf(member.name, BOOL, offset, None if bits == WHOLE else place[1]),)
                    _below(member.type, place[0], member.name, offset, size, bits, found)
                    return tuple(found)
        if offset >= self.program.layout.state_size:
            return self._temporary(offset, size, bits)
        return tuple(self._inside(around, each) for each in self.anywhere(offset, size, bits))

    def _inside(self, around: Around, leaf: Leaf) -> Leaf:
        """A global variable where the POU has one of this name, too."""
        pou = around.pou
        if pou is None or pou.kind == "program":
            return leaf
        record = owner_of(pou)
        if record is not None:
            head = f"{instance_at(self.program, around.instance, record.name)}."
            if leaf.name.startswith(head):  # at an address of its own
                return leaf._replace(name=leaf.name.removeprefix(head))
        first = leaf.name.partition(".")[0].partition("[")[0].upper()
        own = first in pou.frame.members or (record is not None and first in record.members)
        return leaf._replace(name=f"{leaf.name}{_GLOBAL}") if own else leaf

    def _temporary(self, offset: int, size: int, bits: int) -> tuple[Leaf, ...]:
        index = bisect_right(self._frames, offset, key=lambda pou: pou.frame_offset) - 1
        if index < 0:
            return ()
        pou = self._frames[index]
        if pou not in self._mine or offset >= pou.frame_offset + pou.frame.size:
            return ()
        found: list[Leaf] = []
        _below(pou.frame, pou.frame_offset, pou.name, offset, size, bits, found)
        return tuple(each._replace(passing=True) for each in found)

    def anywhere(self, offset: int, size: int, bits: int) -> tuple[Leaf, ...]:
        """By paths and addresses."""
        found: list[Leaf] = []
        area = self.program.layout.area_at(offset)
        if area is None:
            for root in roots_at(self.program, offset):
                _below(root.type, root.offset, root.path, offset, size, bits, found)
                return tuple(found)
            if offset < Layout.HEADER_SIZE or size not in (1, 2, 4, 8):
                return ()
            return (Leaf(at_offset(self.program, offset), RAW_TYPES[8 * size], offset, None),)
        symbols = [each for each in self._located.get(offset, ()) if each.offset + each.type.size >= offset + size]
        for symbol in sorted(symbols, key=lambda each: _fit(each, offset, size, bits)):
            if symbol.bit is not None:
                if bits == 1 << symbol.bit:
                    return (Leaf(symbol.path, BOOL, offset, symbol.bit),)
                continue
            _below(symbol.type, symbol.offset, symbol.path, offset, size, bits, found)
            if found:
                return tuple(found)
        return tuple(self._raw(offset, size, bits))

    def holding(self, offset: int, bits: int) -> Leaf:
        """The whole variable that has these bits of a byte, else the address."""
        found: list[Leaf] = []
        if self.program.layout.area_at(offset) is None:
            for root in roots_at(self.program, offset):
                _below(root.type, root.offset, root.path, offset, 1, WHOLE, found, parts=False)
            if found:
                return found[0]
            return Leaf(at_offset(self.program, offset), RAW_TYPES[8], offset, None)
        for symbol in sorted(self._located.get(offset, ()), key=lambda each: _fit(each, offset, 1, bits)):
            if symbol.bit is None:
                _below(symbol.type, symbol.offset, symbol.path, offset, 1, WHOLE, found, parts=False)
            elif bits == 1 << symbol.bit:
                found.append(Leaf(symbol.path, BOOL, offset, symbol.bit))
            if found:
                return found[0]
        area = self.program.layout.area_at(offset)
        assert area is not None
        even = offset - area[1] % 2
        return next(self._raw(even, 2, WHOLE)) if area[0].unit == "word" else next(self._raw(offset, 1, bits))

    def temporaries(self, pou: Pou) -> tuple[Leaf, ...]:
        """All temporaries of a POU of the user's."""
        found: list[Leaf] = []
        if pou in self._mine and pou.frame.size:
            _below(pou.frame, pou.frame_offset, pou.name, pou.frame_offset, pou.frame.size, WHOLE, found)
        return tuple(found)

    def _raw(self, offset: int, size: int, bits: int) -> Iterator[Leaf]:
        model = self.program.layout.model
        area = self.program.layout.area_at(offset)
        assert area is not None
        if bits != WHOLE:
            bit = bits.bit_length() - 1
            yield Leaf(model.format(area[0], area[1], bit, 1), BOOL, offset, bit)
            return
        step = size if size in (1, 2, 4, 8) else 2
        for at in range(0, size - size % step, step):
            name = model.format(area[0], area[1] + at, None, 8 * step)
            yield Leaf(name, RAW_TYPES[8 * step], offset + at, None)


class Names:
    """The names of one pass."""

    __slots__ = ("_around", "_known", "_namer")

    def __init__(self, namer: Namer, around: Around, known: dict[tuple[int, int, int], tuple[Leaf, ...]]) -> None:
        self._namer, self._around, self._known = namer, around, known

    def of(self, offset: int, size: int, bits: int) -> tuple[Leaf, ...]:
        """What these bytes are."""
        key = offset, size, bits
        found = self._known.get(key)
        if found is None:
            found = self._known[key] = self._namer.find(self._around, offset, size, bits)
        return found


def _in_outs(pou: Pou, instance: int) -> Iterator[tuple[Member, int]]:
    """The in-outs of a POU, and where their slots are."""
    for record, start in ((pou.instance, instance), (pou.frame, pou.frame_offset)):
        for member in record.members.values():
            if member.section is Section.IN_OUT and member.bound and not member.hidden:
                yield member, start + member.offset


def _slot(memory: Image, at: int) -> int:
    return int.from_bytes(memory[at : at + SLOT_BYTES], "little")


def _by_byte(program: Program) -> dict[int, list[Symbol]]:
    """The declared variables of the areas, by each of their bytes."""
    found: dict[int, list[Symbol]] = {}
    for symbol in located(program):
        for at in range(symbol.offset, symbol.offset + max(1, symbol.type.size)):
            found.setdefault(at, []).append(symbol)
    return found


def _fit(symbol: Symbol, offset: int, size: int, bits: int) -> tuple[bool, bool, int]:
    """The variable that was probably meant is the one that is there as a whole."""
    as_bit = symbol.bit is not None
    return as_bit != (bits != WHOLE), symbol.offset != offset, abs(symbol.type.size - size)


def _below(
    type: Type, start: int, name: str, offset: int, size: int, bits: int, found: list[Leaf], parts: bool = True
) -> None:  # fmt: skip
    """The single values in these bytes of a variable that begins at `start`; with `parts`, of one that is only used in part
    that part."""
    if isinstance(type, Record):
        for member in _members(type, start, offset, size):
            inner = f"{name}.{member.name}" if name else member.name
            _below(member.type, start + member.offset, inner, offset, size, bits, found, parts)
    elif isinstance(type, ArrayType):
        step = type.element.size
        if not step:
            return
        first = max(0, (offset - start) // step)
        last = min(type.count - 1, (offset + size - 1 - start) // step)
        for number in range(first, last + 1):
            _below(type.element, start + number * step, name + _index(type, number), offset, size, bits, found, parts)
    elif isinstance(type, Elementary | StringType):
        found.append(_leaf(type, start, name, offset, size, bits) if parts else Leaf(name, type, start, None))


def _members(record: Record, start: int, offset: int, size: int) -> list[Member]:
    """Those with any of the bytes; of members that share them the one that fits best."""
    there = [
        member
        for member in record.members.values()
        if member.storage
        and not (member.hidden or member.bound or member.incomplete)
        and start + member.offset < offset + size
        and offset < start + member.offset + member.storage
    ]
    if record.overlaps and len(there) > 1:
        return [min(there, key=lambda each: (start + each.offset != offset, abs(each.storage - size)))]
    return there


def _index(array: ArrayType, number: int) -> str:
    numbers = []
    for low, high in reversed(array.bounds):
        number, here = divmod(number, high - low + 1)
        numbers.append(str(low + here))
    return f"[{','.join(reversed(numbers))}]"


def _leaf(type: Elementary | StringType, start: int, name: str, offset: int, size: int, bits: int) -> Leaf:
    """The variable, or the part of it that these bytes are."""
    if type == BOOL:
        return Leaf(name, type, start, None)
    if bits != WHOLE:
        bit = bits.bit_length() - 1
        return Leaf(f"{name}.{8 * (offset - start) + bit}", BOOL, offset, bit)
    if offset <= start and start + type.size <= offset + size:
        return Leaf(name, type, start, None)
    at = max(start, offset)
    count = min(start + type.size, offset + size) - at
    if isinstance(type, StringType) or count not in _PARTS or (at - start) % count:
        return Leaf(f"{name} (part)", RAW_TYPES[8], at, None)
    return Leaf(f"{name}.%{_PARTS[count]}{(at - start) // count}", RAW_TYPES[8 * count], at, None)
