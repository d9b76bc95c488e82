"""Restart: the program begins again. Scans and virtual time go on, and so does the PLC's clock.

What is retained (warm, power): VAR RETAIN, words of retained areas that the program may write, the device's error log;
while the model's hold bit is on, words of the other areas too. Cold: VAR PERSISTENT alone, as in CODESYS and TwinCAT
(https://content.helpme-codesys.com/en/CODESYS%204/_c4_cmd_reset_cold.html). Input words stay, as the device would read them again at
once. All other words of the system begin again, so no error is present after a restart.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from scanbench.check.declare.classes import TYPE_NUMBER
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.program.types import ArrayType, Kind, Record, Section, Type
from scanbench.runtime.command import Category, Command, Patch, Plan, Refusal, Restarted, RestartKind, View
from scanbench.runtime.forces import read_table
from scanbench.runtime.header import Header, Mode, fresh_image
from scanbench.runtime.modes import held, started
from scanbench.syntax.chart import STEP

Image = bytes | bytearray | memoryview

_MESSAGES: dict[RestartKind, str] = {
    "cold": "cold start: everything but PERSISTENT variables has its initial value",
    "warm": "warm start: what is retained is kept",
    "power": "power off and on: what is retained is kept",
}


@dataclass(frozen=True, slots=True)
class Restart(Command):
    """In every mode. It runs afterwards: in RUN if it was in RUN, else in MONITOR."""

    category: ClassVar[Category] = "run"

    kind: RestartKind

    def plan(self, view: View) -> Plan | Refusal:
        """Nearly all of it is the effect."""
        if self.kind not in _MESSAGES:
            return Refusal(f"{self.kind} is not a kind of restart", tuple(_MESSAGES))
        return Plan(_error_bits_off(view), _MESSAGES[self.kind], Restarted(self.kind))


def _error_bits_off(view: View) -> tuple[Patch, ...]:
    """The bits of device errors in words that are retained, as the program may write them: no error is present any more."""
    bits: dict[int, int] = {}
    for error in view.model.errors():
        for address in () if error.user else (each for detail in error.details for each in detail.addresses):
            place = address.location
            if place is None or place.bit is None or not place.area.retain:
                continue
            if place.area.access(place.word, "program") == "write":
                offset = view.program.layout.areas[place.area.name] + place.byte
                bits[offset] = bits.get(offset, 0) | 1 << place.bit
    return tuple(Patch(offset, bytes((mask,)), bytes(1)) for offset, mask in sorted(bits.items()))


def restarted(program: Program, memory: Image, kind: RestartKind) -> bytearray:
    """The image after a restart of this kind."""
    image = fresh_image(program, Mode.MONITOR)
    go_on(program, memory, image)
    for offset, size in retained(program, memory, kind):
        image[offset : offset + size] = memory[offset : offset + size]
    if kind == "warm":
        image[Layout.FORCE_COUNT : Layout.FORCES_END] = memory[Layout.FORCE_COUNT : Layout.FORCES_END]
        for offset, (mask, value) in read_table(memory).items():
            image[offset] = image[offset] & ~mask | value & mask
    return image


def retained(program: Program, memory: Image, kind: RestartKind = "warm") -> list[tuple[int, int]]:
    """What such a restart keeps of this image: offset and size."""
    if kind == "cold":
        return [*_variables(program, True)]
    return [*_words(program, memory), *_variables(program, False)]


def go_on(program: Program, memory: Image, image: bytearray) -> None:
    """Writes into `image` what every restart keeps: the count of scans, the time, and mode RUN. The next scan is the program's first."""
    for offset in (Layout.CLOCK, Layout.SCAN, Layout.BUDGET_LIMIT, Layout.EPOCH, Layout.ORIGIN):
        image[offset : offset + 8] = memory[offset : offset + 8]
    image[Layout.MODE] = Mode.RUN if Header(memory).mode is Mode.RUN else Mode.MONITOR
    for patch in started(View(program, image)):
        image[patch.offset : patch.offset + 8] = patch.data


def _words(program: Program, memory: Image) -> Iterator[tuple[int, int]]:
    """What is kept of the areas: offset and size."""
    model, areas = program.layout.model, program.layout.areas
    hold = held(View(program, memory))
    for area in model.areas:
        for part in area.ranges if area.retain or hold else ():
            if part.program == "write":
                yield areas[area.name] + 2 * part.first, 2 * (part.last - part.first + 1)
    for each in model.iec_maps:
        if each.letter == "I":
            yield areas[each.area.name] + 2 * each.first, 2 * each.words
    if model.log is not None:
        first, counter = model.log.first, model.log.counter
        yield areas[first.area.name] + first.byte, 2 * model.log.words * model.log.records
        yield areas[counter.area.name] + counter.byte, counter.bits // 8


def _variables(program: Program, cold: bool) -> Iterator[tuple[int, int]]:
    """Where the retained variables lie, or with `cold` the persistent ones: offset and size."""
    if program.layout.globals is not None:
        yield from _members(program.layout.globals, 0, False, cold)
    for instance in program.instances:
        yield from _members(instance.pou.instance, instance.offset, instance.retain and not cold, cold)


def _members(record: Record, offset: int, retained: bool, cold: bool) -> Iterator[tuple[int, int]]:
    """`retained` is what the instance is declared as: it holds for members that say nothing else themselves."""
    for member in record.members.values():
        if member.located or member.constant or member.section in (Section.IN_OUT, Section.EXTERNAL):
            continue
        if member.name != TYPE_NUMBER:
            said = member.retain or member.non_retain
            own = member.persistent if cold else member.retain
            yield from _value(member.type, offset + member.offset, own, own if said else retained, cold)


def _value(type: Type, offset: int, own: bool, retained: bool, cold: bool) -> Iterator[tuple[int, int]]:
    if isinstance(type, Record) and type.kind is Kind.BLOCK:
        # a block inside of a retained one behaves as its own type says (IEC 61131-3, 6.5.6); a step is a part of its chart
        yield from _members(type, offset, retained and (own or type.name == STEP), cold)
    elif isinstance(type, ArrayType) and isinstance(type.element, Record | ArrayType):
        for index in range(type.count):
            yield from _value(type.element, offset + index * type.element.size, own, retained, cold)
    elif retained:
        yield offset, type.size
