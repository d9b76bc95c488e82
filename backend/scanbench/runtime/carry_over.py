"""A new program on a running PLC: what the old image hands over to the new one.

Areas stay as they are; a variable is kept when the new program has one of the same path and type. Constants take the
new value, and so does the number of an instance's class. References count bytes in the old layout, so each is led to
the variable of the same path, or to nothing; in-out slots start unconnected, as the next call binds them.
"""

from dataclasses import dataclass

from scanbench.check.classes import TYPE_NUMBER
from scanbench.check.layout import Layout
from scanbench.check.program import Program
from scanbench.check.symbols import UnknownPath, resolve, starting_at
from scanbench.check.types import (
    ArrayType,
    Elementary,
    Enumeration,
    Kind,
    Record,
    Reference,
    Section,
    StringType,
    Subrange,
    Type,
)

_BYTE_OFFSET = 0xFFFF_FFFF
_HEADER = ((Layout.CLOCK, 8), (Layout.SCAN, 8), (Layout.BUDGET_LIMIT, 8), (Layout.MODE, 2))


@dataclass(slots=True)
class CarryOver:
    """How many variables were kept, and how many were not."""

    kept: int = 0
    lost: int = 0

    def __str__(self) -> str:
        new = f", {self.lost} new or changed: initialised" if self.lost else ""
        return f"{self.kept} variables kept{new}"


def carry_over(old: Program, old_memory: bytearray, new: Program, new_memory: bytearray) -> CarryOver:
    """Fills `new_memory`, a fresh image of `new`, from the running image of `old`."""
    report = CarryOver()
    for offset, size in _HEADER:
        new_memory[offset : offset + size] = old_memory[offset : offset + size]
    for area in new.layout.model.areas:
        start = old.layout.areas.get(area.name)
        if start is not None:
            target = new.layout.areas[area.name]
            new_memory[target : target + area.size] = old_memory[start : start + area.size]
    carrier = _Carrier(old, old_memory, new, new_memory, report)
    if new.layout.globals is not None and old.layout.globals is not None:
        carrier.record(old.layout.globals, 0, new.layout.globals, 0)
    flags = {task.name.upper(): task.previous for task in old.tasks if task.previous}
    for task in new.tasks:
        was_event = flags.get(task.name.upper())
        if task.previous is not None and was_event is not None:
            new_memory[task.previous.offset] = old_memory[was_event.offset]  # an event that holds on is no new one
    before = {instance.name.upper(): instance for task in old.tasks for instance in task.programs}
    for task in new.tasks:
        for instance in task.programs:
            if instance.pou.kind != "program":
                continue  # a block that a task runs: it is inside of its program
            was = before.get(instance.name.upper())
            if was is None:
                report.lost += len(instance.pou.instance.members)
            else:
                carrier.record(was.pou.instance, was.offset, instance.pou.instance, instance.offset)
    return report


class _Carrier:
    def __init__(
        self, old_program: Program, old: bytearray, new_program: Program, new: bytearray, report: CarryOver
    ) -> None:
        self._old_program, self._new_program = old_program, new_program
        self._old, self._new, self._report = old, new, report

    def record(self, old: Record, old_offset: int, new: Record, new_offset: int) -> None:
        for name, member in new.members.items():
            if member.located or member.constant or member.incomplete or member.name == TYPE_NUMBER:
                continue
            if member.section in (Section.IN_OUT, Section.EXTERNAL):
                continue
            was = old.members.get(name)
            if was is None or was.located or was.constant or was.section is Section.IN_OUT or not member.storage:
                self._report.lost += 1
                continue
            if member.type == was.type and (member.bit is not None or was.bit is not None):
                self._bit(old_offset + was.offset, was.bit or 0, new_offset + member.offset, member.bit or 0)
            else:
                self._value(was.type, old_offset + was.offset, member.type, new_offset + member.offset)

    def _value(self, old: Type, old_offset: int, new: Type, new_offset: int) -> None:
        if isinstance(new, Reference):
            self._reference(old, old_offset, new, new_offset)
        elif isinstance(new, Record) and isinstance(old, Record) and old.kind is new.kind and old.name == new.name:
            self.record(old, old_offset, new, new_offset)
        elif isinstance(new, ArrayType) and isinstance(old, ArrayType) and old.bounds == new.bounds:
            plain = isinstance(new.element, Elementary | StringType) and not isinstance(new.element, Reference)
            if plain and new.element == old.element:
                self._copy(old_offset, new_offset, new.size)
            else:
                for index in range(new.count):
                    self._value(
                        old.element, old_offset + index * old.element.size,
                        new.element, new_offset + index * new.element.size,
                    )  # fmt: skip
        elif isinstance(new, Elementary | StringType) and (new == old or _same_numbers(old, new)):
            self._copy(old_offset, new_offset, new.size)
        else:
            self._report.lost += 1

    def _reference(self, old: Type, old_offset: int, new: Reference, new_offset: int) -> None:
        """Leads it to the variable that has the path of the old one."""
        value = int.from_bytes(self._old[old_offset : old_offset + new.size], "little")
        if not isinstance(old, Reference) or old.name != new.name:
            self._report.lost += 1
            return
        found = value if value == 0 else self._moved(value & _BYTE_OFFSET, old)
        if found is None:
            self._report.lost += 1
            return
        self._new[new_offset : new_offset + new.size] = (value & ~_BYTE_OFFSET | found).to_bytes(new.size, "little")
        self._report.kept += 1

    def _moved(self, offset: int, reference: Reference) -> int | None:
        """Where in the new image that is what the old one has at this byte; None when it is no more."""
        area = self._old_program.layout.area_at(offset)
        if area is not None:
            return self._new_program.layout.areas[area[0].name] + area[1]
        for symbol in starting_at(self._old_program, offset):
            if not _refers_to(reference, symbol.type):
                continue
            try:
                there = resolve(self._new_program, symbol.path)
            except UnknownPath:
                continue
            if there.type.name == symbol.type.name and not there.slots:
                return there.offset
        return None

    def _bit(self, old_offset: int, old_bit: int, new_offset: int, new_bit: int) -> None:
        """A BOOL that shares its byte with others, before or after."""
        value = self._old[old_offset] >> old_bit & 1
        self._new[new_offset] = self._new[new_offset] & ~(1 << new_bit) | value << new_bit
        self._report.kept += 1

    def _copy(self, old_offset: int, new_offset: int, size: int) -> None:
        self._new[new_offset : new_offset + size] = self._old[old_offset : old_offset + size]
        self._report.kept += 1


def _refers_to(reference: Reference, type: Type) -> bool:
    """Whether a variable of this type can be what the reference means, and not merely what begins at the same byte."""
    target = reference.target
    if isinstance(target, Record) and target.kind in (Kind.BLOCK, Kind.INTERFACE):
        return type.kind is Kind.BLOCK
    return target is not None and type.name == target.name


def _same_numbers(old: Type, new: Type) -> bool:
    """An enumeration that got more values, a subrange with other bounds: the numbers mean the same."""
    return (
        isinstance(old, Enumeration | Subrange)
        and isinstance(new, Enumeration | Subrange)
        and (old.name, old.kind, old.size) == (new.name, new.kind, new.size)
    )
