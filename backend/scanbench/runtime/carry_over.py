"""A new program on a running PLC: what the old image hands over to the new one.

Areas stay as they are; a variable is kept when the new program has one of the same path and type. Constants take the
new value; in-out slots and references start unconnected, as they count in the old layout.
"""

from dataclasses import dataclass

from scanbench.check.layout import Layout
from scanbench.check.program import Program
from scanbench.check.types import (
    ArrayType,
    Elementary,
    Enumeration,
    Record,
    Reference,
    Section,
    StringType,
    Subrange,
    Type,
)

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
    carrier = _Carrier(old_memory, new_memory, report)
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
    def __init__(self, old: bytearray, new: bytearray, report: CarryOver) -> None:
        self._old, self._new, self._report = old, new, report

    def record(self, old: Record, old_offset: int, new: Record, new_offset: int) -> None:
        for name, member in new.members.items():
            if member.located or member.constant or member.hidden:
                continue
            if member.section in (Section.IN_OUT, Section.EXTERNAL):
                continue
            was = old.members.get(name)
            if was is None or was.located or was.constant or was.section is Section.IN_OUT or not member.storage:
                self._report.lost += 1
                continue
            self._value(was.type, old_offset + was.offset, member.type, new_offset + member.offset)

    def _value(self, old: Type, old_offset: int, new: Type, new_offset: int) -> None:
        if isinstance(new, Reference):
            self._report.lost += 1
        elif isinstance(new, Record) and isinstance(old, Record) and old.kind is new.kind and old.name == new.name:
            self.record(old, old_offset, new, new_offset)
        elif isinstance(new, ArrayType) and isinstance(old, ArrayType) and old.bounds == new.bounds:
            if isinstance(new.element, Elementary | StringType) and new.element == old.element:
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

    def _copy(self, old_offset: int, new_offset: int, size: int) -> None:
        self._new[new_offset : new_offset + size] = self._old[old_offset : old_offset + size]
        self._report.kept += 1


def _same_numbers(old: Type, new: Type) -> bool:
    """An enumeration that got more values, a subrange with other bounds: the numbers mean the same."""
    return (
        isinstance(old, Enumeration | Subrange)
        and isinstance(new, Enumeration | Subrange)
        and (old.name, old.kind, old.size) == (new.name, new.kind, new.size)
    )
