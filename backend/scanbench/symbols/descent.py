"""The one way down from a program to a byte of its image: roots, then the members and elements that hold it."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

from scanbench.program.program import Pou, Program
from scanbench.program.types import ArrayType, Member, Record, Section, Type


class Part(NamedTuple):
    """A program instance or global, or a member or element of one."""

    name: str
    """Its path."""
    type: Type
    offset: int
    """In the image."""
    member: Member | None = None
    """What declares it; None for a program instance and an element."""

    @property
    def bit(self) -> int | None:
        """Of its byte, for a located BOOL."""
        return None if self.member is None else self.member.bit

    @property
    def elsewhere(self) -> bool:
        """Whether its value is, or was, somewhere else: in-outs, by reference or by value, and `%I*`."""
        member = self.member
        return member is not None and (member.section is Section.IN_OUT or bool(member.incomplete))


class Descent:
    """Of one program. What is asked for once is known."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._members: dict[Record, tuple[list[int] | None, list[Member]]] = {}

    def root(self, offset: int) -> Part | None:
        """The program instance or global that holds a byte outside of the areas."""
        starts, roots = self._roots
        index = bisect_right(starts, offset) - 1
        if index < 0 or offset >= roots[index].offset + roots[index].type.size:
            return None
        return roots[index]

    def located(self, offset: int) -> list[Part]:
        """The variables that are declared at an address of the model and hold this byte, in the order of declaration."""
        return self._by_byte.get(offset, [])

    def frame(self, offset: int) -> Pou | None:
        """The POU that has its temporaries there."""
        starts, pous = self._frames
        index = bisect_right(starts, offset) - 1
        if index < 0 or offset >= pous[index].frame_offset + pous[index].frame.size:
            return None
        return pous[index]

    def inner(self, part: Part, begin: int, end: int) -> list[Part]:
        """The members or elements of a part that have any of these bytes in them; none of a single value."""
        type, start = part.type, part.offset
        if isinstance(type, Record):
            head = f"{part.name}." if part.name else ""
            return [
                Part(head + each.name, each.type, start + each.offset, each)
                for each in self._between(type, begin - start, end - start)
            ]
        if isinstance(type, ArrayType) and type.element.size:
            step = type.element.size
            numbers = range(max(0, (begin - start) // step), min(type.count, (end - 1 - start) // step + 1))
            return [Part(f"{part.name}[{index_of(type, each)}]", type.element, start + each * step) for each in numbers]
        return []

    def _between(self, record: Record, begin: int, end: int) -> list[Member]:
        if record not in self._members:
            self._members[record] = _ordered(record)
        starts, members = self._members[record]
        if starts is None:
            return [each for each in members if each.offset < end and begin < each.offset + each.storage]
        found = []
        last = bisect_right(starts, begin) - 1
        first = bisect_left(starts, starts[last]) if last >= 0 else 0  # bits of one byte begin together
        for index in range(first, len(members)):
            each = members[index]
            if each.offset >= end:
                break
            if begin < each.offset + each.storage:
                found.append(each)
        return found

    @cached_property
    def _roots(self) -> tuple[list[int], list[Part]]:
        found = [Part(each.name, each.pou.instance, each.offset) for each in self.program.shown]
        found += [each for each in _globals(self.program) if not (each.elsewhere or _is_located(each))]
        found = sorted((each for each in found if each.type.size), key=lambda each: each.offset)
        return [each.offset for each in found], found

    @cached_property
    def _by_byte(self) -> dict[int, list[Part]]:
        found: dict[int, list[Part]] = {}
        barren: set[Type] = set()
        instances = [Part(each.name, each.pou.instance, each.offset) for each in self.program.shown]
        for root in (*instances, *_globals(self.program)):
            for part in _located(root, barren):
                for at in range(part.offset, part.offset + max(1, part.type.size)):
                    found.setdefault(at, []).append(part)
        return found

    @cached_property
    def _frames(self) -> tuple[list[int], list[Pou]]:
        found = sorted((pou for pou in self.program.pous if pou.frame.size), key=lambda pou: pou.frame_offset)
        return [pou.frame_offset for pou in found], found


def index_of(array: ArrayType, number: int) -> str:
    """The index of an element as it is written: `3,1`."""
    numbers = []
    for low, high in reversed(array.bounds):
        number, here = divmod(number, high - low + 1)
        numbers.append(str(low + here))
    return ",".join(reversed(numbers))


def _ordered(record: Record) -> tuple[list[int] | None, list[Member]]:
    """Its members that take room, by where they begin; without these numbers where members share bytes."""
    members = [each for each in record.members.values() if each.storage]
    if record.overlaps:
        return None, members
    members.sort(key=lambda each: each.offset)
    return [each.offset for each in members], members


def _globals(program: Program) -> Iterator[Part]:
    owner = program.layout.globals
    for member in owner.members.values() if owner is not None else ():
        if not member.hidden:
            yield Part(member.name, member.type, member.offset, member)


def _is_located(part: Part) -> bool:
    return part.member is not None and part.member.located


def _located(part: Part, barren: set[Type]) -> Iterator[Part]:
    """The located variables among a part and what is below it. Of an array of blocks, which share them, the first one's."""
    member, type = part.member, part.type
    if member is not None and member.located:
        yield part
        return
    if part.elsewhere or not isinstance(type, ArrayType | Record) or type in barren:
        return
    found = False
    for inner in _first(part):
        for each in _located(inner, barren):
            found = True
            yield each
    if not found:
        barren.add(type)


def _first(part: Part) -> Iterator[Part]:
    """All members, or the first element."""
    type = part.type
    if isinstance(type, ArrayType):
        yield Part(f"{part.name}[{index_of(type, 0)}]", type.element, part.offset)
    elif isinstance(type, Record):
        for each in type.members.values():
            if not each.hidden:
                offset = each.offset if each.located else part.offset + each.offset
                yield Part(f"{part.name}.{each.name}", each.type, offset, each)
