"""Which memory of a model each coil and register of Modbus means: a table that is shown, and exported.

Errors are in input registers and discrete inputs, which no function of Modbus can write.
"""

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

from scanbench.plcmodel.model import Model
from scanbench.public import Public

Group = Literal["coil", "discrete input", "input register", "holding register"]
GROUPS: tuple[Group, ...] = ("coil", "discrete input", "input register", "holding register")
_ADDRESSES = 1 << 16


@dataclass(frozen=True, slots=True)
class Mapped(Public):
    """`count` coils or registers from `first` on, counted from 0."""

    PUBLIC: ClassVar = "ModbusRange"

    group: Group
    first: int
    count: int
    area: str
    """The memory area."""
    word: int
    """In which the first one lies, counted within the area; a coil or discrete input is bit 0 of it."""
    width: int = 1
    """Registers of a value: the one with the high word comes first."""
    begins: str = ""
    """The vendor's address of the first one, and of the last one."""
    ends: str = ""


@dataclass(frozen=True, slots=True)
class Wanted:
    """A part of a table, before it is known how much memory there is."""

    group: Group
    area: str
    first: int = 0
    word: int = 0
    most: int = _ADDRESSES
    width: int = 1


_OMRON = (
    Wanted("coil", "CIO"), Wanted("discrete input", "A"), Wanted("input register", "A"), Wanted("holding register", "D"),
)  # fmt: skip
_WITHOUT_A = (
    Wanted("coil", "CIO"), Wanted("discrete input", "CIO"), Wanted("input register", "CIO"), Wanted("holding register", "D"),
)  # fmt: skip
_MELSEC = (
    Wanted("coil", "Y"), Wanted("discrete input", "X"), Wanted("input register", "SD"), Wanted("holding register", "D"),
)  # fmt: skip
_GENERIC = (  # as OpenPLC v3 has it, so that its scenes and manuals fit (read from its source)
    Wanted("coil", "Q"), Wanted("discrete input", "I"), Wanted("input register", "I"),
    Wanted("holding register", "Q", most=1024), Wanted("holding register", "M", 1024, most=1024),
    Wanted("holding register", "M", 2048, most=2048, width=2), Wanted("holding register", "M", 4096, most=4096, width=4),
)  # fmt: skip


def default(model: Model) -> tuple[Mapped, ...]:
    """The table of a model; of one that is missing it is empty."""
    return tuple(_mapped(model, wanted) for wanted in _wanted(model) if model.area(wanted.area) is not None)


def _wanted(model: Model) -> Sequence[Wanted]:
    names = {area.name for area in model.areas}
    if {"CIO", "D"} <= names:
        return _OMRON if "A" in names else _WITHOUT_A
    return _MELSEC if "SD" in names else _GENERIC


def _mapped(model: Model, wanted: Wanted) -> Mapped:
    area = model.area(wanted.area)
    assert area is not None
    bits = wanted.group in ("coil", "discrete input")
    words = area.words - wanted.word
    count = min(16 * words if bits else words, wanted.most, _ADDRESSES - wanted.first)
    made = Mapped(wanted.group, wanted.first, count, area.name, wanted.word, wanted.width)
    begins, ends = begins_and_ends(model, made)
    return replace(made, begins=begins, ends=ends)


def begins_and_ends(model: Model, range: Mapped) -> tuple[str, str]:
    """The vendor's addresses of the first one and the last one."""
    area = model.area(range.area)
    assert area is not None
    bits = range.group in ("coil", "discrete input")
    if bits or area.unit == "bit":
        last = 16 * range.word + (range.count if bits else 16 * range.count) - 1
        return model.format(area, 2 * range.word, 0, 1), model.format(area, last // 8, last % 8, 1)
    first = 2 * range.word
    return model.format(area, first, None, 16), model.format(area, first + 2 * range.count - 2, None, 16)


def as_csv(table: Sequence[Mapped]) -> str:
    """The table as a spreadsheet opens it."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(("group", "first", "last", "from", "to", "registers of a value"))
    for each in table:
        writer.writerow((each.group, each.first, each.first + each.count - 1, each.begins, each.ends, each.width))
    return text.getvalue()


@dataclass(frozen=True, slots=True)
class Part:
    """Coils or registers that follow each other in one range."""

    range: Mapped
    first: int
    """Counted within the range."""
    count: int


def parts(table: Sequence[Mapped], group: Group, first: int, count: int) -> Iterator[Part] | None:
    """What so many of a group are; None where one of them means nothing."""
    found: list[Part] = []
    at, end = first, first + count
    while at < end:
        range_ = next(
            (each for each in table if each.group == group and each.first <= at < each.first + each.count), None
        )
        if range_ is None:
            return None
        size = min(end, range_.first + range_.count) - at
        found.append(Part(range_, at - range_.first, size))
        at += size
    return iter(found)


def words_of(part: Part) -> list[int]:
    """The word of each register, within its area: of wide values the one with the high word is first."""
    width = part.range.width
    numbers = range(part.first, part.first + part.count)
    return [part.range.word + at - at % width + (width - 1 - at % width) for at in numbers]
