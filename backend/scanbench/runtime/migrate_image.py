"""A new program on a running PLC: what the old image hands over to the new one.

Areas stay as they are; a variable is kept when the new program has one of the same path and type. Constants take the
new value, and so does the number of an instance's class. References count bytes in the old layout, so each is led to
the variable of the same path, or to nothing; in-out slots start unconnected, as the next call binds them.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar

from scanbench.check.declare.classes import TYPE_NUMBER
from scanbench.program.copies import BYTE_OFFSET
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.program.strings import characters, stored
from scanbench.program.types import (
    ArrayType,
    Elementary,
    Enumeration,
    Kind,
    Member,
    Record,
    Reference,
    Section,
    StringType,
    Subrange,
    Type,
)
from scanbench.public import Public
from scanbench.runtime.counted_variables import Counted, counted
from scanbench.symbols.names import names_of
from scanbench.symbols.symbols import UnknownPath, resolve

_HEADER = (
    (Layout.CLOCK, 8), (Layout.SCAN, 8), (Layout.BUDGET_LIMIT, 8), (Layout.MODE, 2), (Layout.EPOCH, 8), (Layout.STARTED, 8),
    (Layout.ORIGIN, 8), (Layout.STARTED_AT, 8),
)  # fmt: skip

NEW, REMOVED = "new", "removed"


@dataclass(frozen=True, slots=True)
class Lost(Public):
    """A variable whose value does not go over."""

    PUBLIC: ClassVar = "LostVariable"

    path: str
    reason: str
    """`NEW`, `REMOVED`, or in what the new one differs: it begins with its initial value."""


@dataclass(slots=True)
class Change:
    """What became, or would become, of the variables."""

    kept: int = 0
    """Values that go over, one by one: of each member of an instance, also of those that the compiler made."""
    lost: list[Lost] = field(default_factory=list)
    counted: Counted = field(default_factory=Counted)
    """In numbers for people."""

    @property
    def forgotten(self) -> list[Lost]:
        """What has a value now and begins again."""
        return [each for each in self.lost if each.reason not in (NEW, REMOVED)]

    def paths(self, reason: str) -> list[str]:
        """What is lost for this reason."""
        return [each.path for each in self.lost if each.reason == reason]


def changes(old: Program, new: Program) -> Change:
    """What would become of the variables, whatever values they have: before anybody agrees to it."""
    memory = bytearray(old.layout.size)
    memory[: len(old.initial_image)] = old.initial_image
    return migrate(old, memory, new, bytearray(new.layout.size))


def migrate(old: Program, old_memory: bytes | bytearray | memoryview, new: Program, new_memory: bytearray) -> Change:
    """Fills `new_memory`, a fresh image of `new`, from the running image of `old`."""
    change = Change()
    for offset, size in _HEADER:
        new_memory[offset : offset + size] = old_memory[offset : offset + size]
    for area in new.layout.model.areas:
        was = old.layout.model.area(area.name)
        if was is not None:
            start, target, size = old.layout.areas[area.name], new.layout.areas[area.name], min(area.size, was.size)
            new_memory[target : target + size] = old_memory[start : start + size]
    carrier = _Carrier(old, old_memory, new, new_memory, change)
    if new.layout.globals is not None and old.layout.globals is not None:
        carrier.record("", old.layout.globals, 0, new.layout.globals, 0)
    _events(old, old_memory, new, new_memory)
    before = {instance.name.upper(): instance for instance in old.instances}
    made = {
        instance.name.upper() for instance in (*new.common, *new.life)
    }  # from the model: nobody wants to read of it
    for instance in new.instances:
        name = instance.name.upper()
        carrier.change = Change() if name in made else change
        known = before.pop(name, None)
        if known is None:
            carrier.change.lost.append(Lost(instance.name, NEW))
        else:
            carrier.record(instance.name, known.pou.instance, known.offset, instance.pou.instance, instance.offset)
    hidden = {instance.name.upper() for instance in (*old.common, *old.life)}
    change.lost += [Lost(each.name, REMOVED) for name, each in before.items() if name not in hidden]
    forgotten = [each.path for each in change.forgotten]
    change.counted = counted(old, new, forgotten, change.paths(NEW), change.paths(REMOVED))
    return change


def _events(old: Program, old_memory: bytes | bytearray | memoryview, new: Program, new_memory: bytearray) -> None:
    """An event that holds on is no new one."""
    flags = {task.name.upper(): task.previous for task in old.tasks if task.previous}
    for task in new.tasks:
        was = flags.get(task.name.upper())
        if task.previous is not None and was is not None:
            new_memory[task.previous.offset] = old_memory[was.offset]


class _Carrier:
    def __init__(
        self,
        old_program: Program,
        old: bytes | bytearray | memoryview,
        new_program: Program,
        new: bytearray,
        change: Change,
    ) -> None:
        self._old_program, self._new_program = old_program, new_program
        self._old, self._new, self.change = old, new, change

    def record(self, path: str, old: Record, old_offset: int, new: Record, new_offset: int) -> None:
        """The members of an instance, a structure, or the globals."""
        prefix = f"{path}." if path else ""
        for name, member in new.members.items():
            if not _carried(member):
                continue
            here = prefix + member.name
            was = old.members.get(name)
            reason = _reason(was)
            if was is None or reason:
                if not member.hidden:
                    self.change.lost.append(Lost(here, reason))
            elif member.type == was.type and (member.bit is not None or was.bit is not None):
                self._bit(old_offset + was.offset, was.bit or 0, new_offset + member.offset, member.bit or 0)
            else:
                self._value(here, was.type, old_offset + was.offset, member.type, new_offset + member.offset)
        self.change.lost += [
            Lost(prefix + was.name, REMOVED)
            for name, was in old.members.items()
            if name not in new.members and _carried(was) and not was.hidden
        ]

    def _value(self, path: str, old: Type, old_offset: int, new: Type, new_offset: int) -> None:
        if isinstance(new, Reference):
            self._reference(path, old, old_offset, new, new_offset)
        elif isinstance(new, Record) and isinstance(old, Record) and old.kind is new.kind and old.name == new.name:
            self.record(path, old, old_offset, new, new_offset)
        elif isinstance(new, ArrayType) and isinstance(old, ArrayType) and old.bounds == new.bounds:
            plain = isinstance(new.element, Elementary | StringType) and not isinstance(new.element, Reference)
            if plain and new.element == old.element:
                self._copy(old_offset, new_offset, new.size)
            elif plain and not (_same_numbers(old.element, new.element) or _same_text(old.element, new.element)):
                self._lose_type(path, old, new)
            else:
                for index, shown in enumerate(_indices(new)):
                    self._value(
                        f"{path}[{shown}]", old.element, old_offset + index * old.element.size,
                        new.element, new_offset + index * new.element.size,
                    )  # fmt: skip
        elif isinstance(new, Elementary | StringType) and (new == old or _same_numbers(old, new)):
            self._copy(old_offset, new_offset, new.size)
        elif isinstance(new, StringType) and isinstance(old, StringType) and _same_text(old, new):
            text = stored(new, characters(old, bytes(self._old[old_offset : old_offset + old.size])))
            self._new[new_offset : new_offset + len(text)] = text
            self.change.kept += 1
        else:
            self._lose_type(path, old, new)

    def _lose_type(self, path: str, old: Type, new: Type) -> None:
        same = old.name == new.name
        reason = f"{new.name} is declared otherwise" if same else f"type changed from {old.name} to {new.name}"
        self.change.lost.append(Lost(path, reason))

    def _reference(self, path: str, old: Type, old_offset: int, new: Reference, new_offset: int) -> None:
        """Leads it to the variable that has the path of the old one."""
        value = int.from_bytes(self._old[old_offset : old_offset + new.size], "little")
        if not isinstance(old, Reference) or old.name != new.name:
            self._lose_type(path, old, new)
            return
        found = value if value == 0 else self._moved(value & BYTE_OFFSET, old)
        if found is None:
            self.change.lost.append(Lost(path, "what it referred to is no more: NULL"))
            return
        self._new[new_offset : new_offset + new.size] = (value & ~BYTE_OFFSET | found).to_bytes(new.size, "little")
        self.change.kept += 1

    def _moved(self, offset: int, reference: Reference) -> int | None:
        """Where in the new image that is what the old one has at this byte; None when it is no more."""
        area = self._old_program.layout.area_at(offset)
        if area is not None:
            return self._new_program.layout.areas[area[0].name] + area[1]
        parts = tuple(names_of(self._old_program).starting(offset))
        # a pointer takes any address, also that of bytes which it sees as something else
        for part in (
            *(each for each in parts if _refers_to(reference, each.type)),
            *(parts if reference.pointer else ()),
        ):
            try:
                there = resolve(self._new_program, part.name)
            except UnknownPath:
                continue
            if there.type.name == part.type.name and not there.slots:
                return there.offset
        return None

    def _bit(self, old_offset: int, old_bit: int, new_offset: int, new_bit: int) -> None:
        """A BOOL that shares its byte with others, before or after."""
        value = self._old[old_offset] >> old_bit & 1
        self._new[new_offset] = self._new[new_offset] & ~(1 << new_bit) | value << new_bit
        self.change.kept += 1

    def _copy(self, old_offset: int, new_offset: int, size: int) -> None:
        self._new[new_offset : new_offset + size] = self._old[old_offset : old_offset + size]
        self.change.kept += 1


def _carried(member: Member) -> bool:
    """Whether the variable has a value of its own that can go over."""
    if member.located or member.constant or member.incomplete or member.name == TYPE_NUMBER or not member.storage:
        return False
    return member.section not in (Section.IN_OUT, Section.EXTERNAL)


def _reason(was: Member | None) -> str:
    """Why a variable cannot take the value of this one; '' when it can, as far as the types fit."""
    if was is None:
        return NEW
    if was.located:
        return f"was at {was.address} before"
    if was.constant:
        return "was a constant before"
    return "" if _carried(was) else f"was in {was.section.value} before"


def _indices(array: ArrayType) -> Iterator[str]:
    """The indices of its elements, in their order in memory."""
    for number in range(array.count):
        parts = []
        for low, high in reversed(array.bounds):
            number, at = divmod(number, high - low + 1)
            parts.append(str(low + at))
        yield ",".join(reversed(parts))


def _refers_to(reference: Reference, type: Type) -> bool:
    """Whether a variable of this type can be what the reference means, and not merely what begins at the same byte."""
    target = reference.target
    if isinstance(target, Record) and target.kind in (Kind.BLOCK, Kind.INTERFACE):
        return type.kind is Kind.BLOCK
    return target is not None and type.name == target.name


def _same_text(old: Type, new: Type) -> bool:
    """Strings of one capacity, which a different dialect stores differently."""
    return isinstance(old, StringType) and isinstance(new, StringType) and old.name == new.name


def _same_numbers(old: Type, new: Type) -> bool:
    """An enumeration that got more values at its end, a subrange with other bounds: the numbers mean the same."""
    if not isinstance(old, Enumeration | Subrange) or not isinstance(new, Enumeration | Subrange):
        return False
    if (old.name, old.kind, old.size) != (new.name, new.kind, new.size):
        return False
    if not isinstance(old, Enumeration) or not isinstance(new, Enumeration):
        return True
    return all(new.number(name) in (number, None) for name, number in old.values)
