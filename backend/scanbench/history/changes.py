"""What differs between two moments: variables by their names, addresses where there is no variable."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scanbench.faults.reaction.error_memory import code_bits, kept_bits, log_bits
from scanbench.history.contract import MAX_CHANGES, BetweenEntry, Change, Changes
from scanbench.program.program import Program
from scanbench.program.types import Enumeration, StringType
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.gaps import gap_between
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.command import Entry
from scanbench.runtime.header import Mode, fresh_image
from scanbench.runtime.migrate_image import migrate
from scanbench.symbols.kept import KeptNames
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.values import format_value, python_value

MAX_ENTRIES = 1_000
"""Entries in between that are listed."""
_MOST = 50_000
"""Words of two bytes that are looked at; of more `Changes.at_least` says so."""
Bytes = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Moment:
    """A PLC as it was: the program, and a copy of its state."""

    program: Program
    version: int
    kept: KeptProgram
    """The program as the run has it."""
    state: bytes

    def same_layout(self, other: "Moment") -> bool:
        """Whether the same bytes are at the same places; the statements may still be different."""
        return self.kept.digest == other.kept.digest

    def same_program(self, other: "Moment") -> bool:
        """Whether the same program runs, so that from the same state the same comes."""
        return self.same_layout(other) and self.kept.sources == other.kept.sources


def moment_of(reader: RunReader) -> Moment:
    """The present moment of the reader's timeline."""
    resource = reader.timeline.resource
    kept = reader.timeline.recording.programs[resource.version]
    return Moment(resource.program, resource.version, kept, resource.state)


def find_changes(reader: RunReader, first: int, last: int, other: RunReader | None = None) -> Changes:
    """The values that differ between the beginnings of scan `first` and of scan `last` (of the other run, if there is one).
    `Unreadable` says why they cannot be compared."""
    if other is None and first > last:
        raise Unreadable(f"scan {last} is before scan {first}: name the earlier one first")
    reader.goto(first)
    before = moment_of(reader)
    of = other or reader
    of.goto(last)
    after = moment_of(of)
    same_model(before.program, after.program)
    entries = [] if other is not None else list(_between(reader, first, last))
    note = ""
    gap = gap_between(reader.recording.gaps, first, last) if other is None else None
    if gap is not None:
        note = f"not all that was entered in between is known: {gap}"
    if not before.same_layout(after):
        note += (
            "; " * bool(note)
            + "the program is different: variables are compared by their names, and those that only one of them has are left out"
        )
    if len(entries) > MAX_ENTRIES:
        left = len(entries) - MAX_ENTRIES
        note += "; " * bool(note) + f"{left:,} more entries in between are not listed"
        entries = entries[:MAX_ENTRIES]
    found = Comparer(before, after).changes(before.state, after.state)
    if len(found.changes) < found.count:
        note += "; " * bool(note) + f"the first {len(found.changes):,} variables are listed"
    return Changes(first, last, found.changes, found.count, tuple(entries), note, found.at_least)


def same_model(one: Program, other: Program) -> None:
    """`Unreadable` when they are not on the same model."""
    names = one.layout.model.name, other.layout.model.name
    if names[0] != names[1]:
        raise Unreadable(
            f"one run is of the model {names[0]}, the other of {names[1]}: only runs of one model can be compared"
        )


def entered(entry: Entry) -> str:
    """What somebody entered, for people."""
    return f"{type(entry.command).__name__}: {entry.plan.message}"


def _between(reader: RunReader, first: int, last: int) -> Iterator[BetweenEntry]:
    for each in reader.entries:
        if (each.scan > first or (each.scan == first and each.step)) and (
            each.scan < last or (each.scan == last and not each.step)
        ):
            yield BetweenEntry(each.scan, "", each.command.author, entered(each))


@dataclass(frozen=True, slots=True)
class Differing:
    """Variables that differ."""

    changes: tuple[Change, ...]
    """The first `MAX_CHANGES`."""
    count: int
    at_least: bool
    """There may be more than `count`: not every place was looked at."""


class Comparer:
    """Compares states of two programs, which may be one: in what people count, not in the system's own."""

    def __init__(self, one: Moment, other: Moment) -> None:
        """`one` and `other`: of any moments at which these programs run."""
        self._one, self.same_layout, self.same = one.program, one.same_layout(other), one.same_program(other)
        """`same`: it is one program, so that equal states stay equal."""
        self._mask = _counted(one.program)
        self._names: KeptNames | None = None
        self._here: NDArray[np.intp] | None = None
        self._there: NDArray[np.intp] | None = None
        if not self.same_layout:
            self._here, self._there = _common(one.program, other.program)

    def equal(self, one: bytearray, other: bytearray) -> bool:
        """Whether two whole images are the same to the last byte, of one program, so that what comes of them is the same."""
        size = self._one.layout.state_size
        return self.same and np.array_equal(np.frombuffer(one, np.uint8, size), np.frombuffer(other, np.uint8, size))

    def differ(self, one: bytearray, other: bytearray) -> bool:
        """Whether two whole images differ in anything but what every run has of its own, such as the clock."""
        if not self.same_layout:
            return bool(self._differing(one, other).any())
        mask = self._mask.view(np.uint64)
        here, there = (np.frombuffer(each, np.uint64, len(mask)) for each in (one, other))
        return bool(((here ^ there) & mask).any())

    def changes(self, one: bytes | bytearray, other: bytes | bytearray) -> "Differing":
        """The first variables that differ, in the order of their places, and the number of all of them."""
        halves = self._differing(one, other).view(np.uint16)
        places: list[int] = np.flatnonzero(halves).tolist()
        found = list(self._changed(one, other, halves, places[:_MOST]))
        there = self._moved(one, other)
        made = [_change(each, one, there) for each in found[:MAX_CHANGES]]
        return Differing(tuple(made), len(found), len(places) > _MOST)

    def _changed(
        self, one: bytes | bytearray, other: bytes | bytearray, halves: NDArray[np.uint16], places: list[int]
    ) -> Iterator[Leaf]:  # fmt: skip
        """As they are in the first program."""
        if self._names is None:
            self._names = KeptNames(self._one, inputs=True)
        there, known = self._moved(one, other), set[str]()
        for index in places:
            for leaf in self._names.at(2 * index, int(halves[index])):
                if leaf.name not in known and _is_different(leaf, one, there):
                    known.add(leaf.name)
                    yield leaf

    def _differing(self, one: bytes | bytearray, other: bytes | bytearray) -> Bytes:
        size = len(self._mask)
        here = _padded(one, self._one.layout.state_size, size)
        there = _padded(self._moved(one, other), self._one.layout.state_size, size)
        return (here ^ there) & self._mask

    def _moved(self, one: bytes | bytearray, other: bytes | bytearray) -> bytes | bytearray:
        """The other state where the first program has its variables; what only that has is as it is."""
        if self._here is None:
            return other
        there = np.frombuffer(bytearray(one), np.uint8)
        there[self._here] = np.frombuffer(other, np.uint8)[self._there]
        return there.tobytes()


def _padded(image: bytes | bytearray, used: int, size: int) -> Bytes:
    data = np.zeros(size, np.uint8)
    data[:used] = np.frombuffer(image, np.uint8, used)
    return data


def _counted(program: Program) -> Bytes:
    """The bits that people count: of errors the code word and the log, too."""
    mask = kept_bits(program).view(np.uint8).copy()
    for part in (*code_bits(program), *log_bits(program)):
        mask[part.offset] |= part.mask
    return mask


def _common(one: Program, other: Program) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Where both have the same variables. A change of the program knows what goes where: it carries over images whose bytes
    have numbers, each number in three parts, and once more with all bits turned over."""
    size, state = one.layout.size, other.layout.state_size
    numbers = np.arange(other.layout.size, dtype=np.uint32)
    found, sure = np.zeros(size, np.int64), np.ones(size, bool)
    for shift in (0, 8, 16):
        part = (numbers >> shift & 0xFF).astype(np.uint8)
        straight, turned = _carried(other, part, one), _carried(other, ~part, one)
        sure &= straight == ~turned
        found |= straight.astype(np.int64) << shift
    here = np.flatnonzero(sure & (np.arange(size) < one.layout.state_size) & (found < state))
    return here, found[here].astype(np.intp)


def _carried(old: Program, image: Bytes, new: Program) -> Bytes:
    into = fresh_image(new, Mode.MONITOR)
    migrate(old, image.tobytes(), new, into)
    return np.frombuffer(into, np.uint8)


def _is_different(leaf: Leaf, one: bytes | bytearray, other: bytes | bytearray) -> bool:
    if not isinstance(leaf.type, StringType):
        return True
    return python_value(leaf.type, leaf.cut(one)) != python_value(leaf.type, leaf.cut(other))


def _change(leaf: Leaf, one: bytes | bytearray, other: bytes | bytearray) -> Change:
    type, before, after = leaf.type, leaf.cut(one), leaf.cut(other)
    return Change(
        leaf.name, type.name, type.kind.value, type.size, type.values if isinstance(type, Enumeration) else (),
        before, after, format_value(type, before), format_value(type, after),
    )  # fmt: skip
