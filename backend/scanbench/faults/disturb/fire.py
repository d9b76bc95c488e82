"""What a disturbance does when its time has come: commands, each journaled with all that a replay needs.

What is known of a disturbance after one of these follows from its definition and that one alone, so that a journal may
forget those between.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import ClassVar

from scanbench.faults.disturb.definition import bits_of, single_value
from scanbench.program.layout import Layout
from scanbench.program.types import Elementary, StringType
from scanbench.runtime.command import Category, Command, Freed, Held, Patch, Plan, Refusal, View
from scanbench.runtime.forces import notes_of, read_table, table_patches
from scanbench.runtime.holds import HELD, HeldByte, held, holder
from scanbench.runtime.target import not_called
from scanbench.symbols.symbols import Symbol
from scanbench.symbols.values import format_value


@dataclass(frozen=True, slots=True)
class Firing(Command):
    """Of the disturbance of this number."""

    category: ClassVar[Category] = "disturbance"

    id: int
    time: int
    """How often it was tried, with this one."""
    fired: int
    """How often that changed anything, with this one."""


@dataclass(frozen=True, slots=True)
class Flip(Firing):
    """One bit of a value turns over."""

    path: str
    bit: int

    def plan(self, view: View) -> Plan | Refusal:
        """One bit."""
        symbol = single_value(view, self.path)
        if isinstance(symbol, Refusal):
            return symbol
        place = symbol.locate(view.memory)
        if place is None:
            return Refusal(not_called(view, symbol))
        if self.bit >= bits_of(symbol):
            return Refusal(f"{symbol.path} is {symbol.type.name} now, and has no bit {self.bit}")
        offset, bit = place[0] + self.bit // 8, place[1] if place[1] is not None else self.bit % 8
        if offset >= view.program.layout.frames:
            return Refusal(f"{symbol.path} was given a value that was computed, which is gone between two scans")
        patch = turned_over(view.memory, offset, bit)
        number = holder(view.journal, patch)
        if number:
            return Refusal(f"{symbol.path} is held by disturbance {number}")
        before = bytes(view.memory[place[0] : place[0] + symbol.type.size])
        after = bytearray(before)
        after[self.bit // 8] ^= 1 << bit
        was, now = (_text(symbol, each, place[1]) for each in (before, after))
        return Plan((patch,), f"Memory {symbol.path}, bit {self.bit}: {was} became {now}")


@dataclass(frozen=True, slots=True)
class Hold(Firing):
    """An input, or all of them, stay as they are until they are let go."""

    path: str
    until: int | None
    """Before this scan they are let go; None: when somebody takes the disturbance back."""
    late: bool

    def plan(self, view: View) -> Plan | Refusal:
        """The bits that nobody has forced, in the force table."""
        wanted = _inputs(view) if not self.path.strip() else _bits(view, self.path)
        if isinstance(wanted, Refusal):
            return wanted
        table, other = read_table(view.memory), held(view.journal)
        spots = tuple(_free(view, wanted, {at: mask for at, (mask, _) in table.items()}))
        if not spots:
            by = "held by another disturbance" if any(other.get(at) for at, _ in wanted) else "forced"
            return Refusal(f"{self.path or 'every input'} is {by}")
        for at, mask, value in spots:
            old, data = table.get(at, (0, 0))
            table[at] = (old | mask, data | value)
        if len(table) > Layout.FORCE_LIMIT:
            return Refusal(
                f"no room to hold {len(spots)} bytes in addition to what is forced: at most {Layout.FORCE_LIMIT} bytes. Name a "
                "single input"
            )
        what = f"Input {self.path}" if self.path.strip() else f"All inputs ({len(spots)} bytes)"
        end = "until it is taken back" if self.until is None else f"until scan {self.until}"
        return Plan(
            table_patches(view, table), f"{what} {'late' if self.late else 'stuck'} {end}", Held(self.id, spots)
        )


@dataclass(frozen=True, slots=True)
class Unhold(Firing):
    """What was held has its real value again."""

    def plan(self, view: View) -> Plan | Refusal:
        """The force table without it, and what came meanwhile."""
        return Plan(freed(view, (self.id,)), f"disturbance {self.id}: the real inputs count again", Freed((self.id,)))


@dataclass(frozen=True, slots=True)
class Corrupt(Firing):
    """A bit turns over of what a statement has just written; entered inside of the scan, before the next statement."""

    site: str
    offset: int
    bit: int
    """Of that byte."""
    index: int
    """Which bit of the value that is."""
    name: str
    """Of the value, for people."""

    def plan(self, view: View) -> Plan | Refusal:
        """One bit, of a temporary perhaps."""
        patch = turned_over(view.memory, self.offset, self.bit)
        number = holder(view.journal, patch)
        if number:
            return Refusal(f"{self.name} is held by disturbance {number}")
        return Plan((patch,), f"Result of {self.site}: bit {self.index} of {self.name} turned over")


@dataclass(frozen=True, slots=True)
class Unfired(Firing):
    """Its time had come, and nothing was changed."""

    scan: int
    why: str

    def plan(self, view: View) -> Plan | Refusal:
        """For the log, and so that the next time comes."""
        return Plan((), f"disturbance {self.id} did not come about in scan {self.scan}: {self.why}")


def turned_over(memory: bytes | bytearray | memoryview, offset: int, bit: int) -> Patch:
    """The patch that turns this bit over."""
    return Patch.of_bit(offset, bit, not memory[offset] >> bit & 1)


def freed(view: View, numbers: tuple[int, ...]) -> tuple[Patch, ...]:
    """Patches that let go what is held by these numbers: what came meanwhile counts now."""
    gone = [each for each in view.derived(HELD).values() if each.number in numbers]
    if not gone:
        return ()
    table, notes = read_table(view.memory), notes_of(view.memory)
    for each in gone:
        mask, value = table.pop(each.offset, (0, 0))
        keep = mask & ~each.mask
        if keep:
            table[each.offset] = (keep, value & keep)
    scan = view.header.scan
    real = (_real(each, notes.get(each.offset, (each.value, 0))[0], scan) for each in gone)
    return (*table_patches(view, table), *(each for each in real if each is not None))


def _real(each: HeldByte, before: int, scan: int) -> Patch | None:
    """What the plant made of it in the scan that ran last, unless somebody wrote it later, or made nothing new of it."""
    plant = (before ^ each.value) & each.mask & ~(each.came if each.at >= scan else 0) if scan > each.since else 0
    mask = plant | each.came
    if not mask:
        return None
    return Patch(each.offset, bytes((mask,)), bytes((before & plant | each.real & each.came & ~plant,)))


def _inputs(view: View) -> list[tuple[int, int]]:
    """All that the model calls inputs: offsets, and all bits. Where that is more than can be held, the ones that are on or
    that come first: an input that nobody wires is off."""
    areas = view.program.layout.areas
    maps = (each for each in view.model.iec_maps if each.letter == "I")
    all = [areas[each.area.name] + 2 * each.first + at for each in maps for at in range(2 * each.words)]
    room = Layout.FORCE_LIMIT - len(read_table(view.memory))
    if len(all) > room:
        on = [at for at in all if view.memory[at]][:room]
        all = sorted({*on, *[at for at in all if not view.memory[at]][: room - len(on)]})
    return [(at, 0xFF) for at in all]


def _bits(view: View, path: str) -> list[tuple[int, int]] | Refusal:
    symbol = single_value(view, path)
    if isinstance(symbol, Refusal):
        return symbol
    place = symbol.locate(view.memory)
    if place is None:
        return Refusal(not_called(view, symbol))
    offset, bit = place
    if offset >= view.program.layout.frames:
        return Refusal(f"{symbol.path} was given a value that was computed, which is no input")
    return [(offset, 1 << bit)] if bit is not None else [(at, 0xFF) for at in range(offset, offset + symbol.type.size)]


def _free(view: View, wanted: Iterable[tuple[int, int]], taken: dict[int, int]) -> Iterator[tuple[int, int, int]]:
    for at, mask in wanted:
        free = mask & ~taken.get(at, 0)
        if free:
            yield at, free, view.memory[at] & free


def _text(symbol: Symbol, data: bytes | bytearray, bit: int | None) -> str:
    assert isinstance(symbol.type, Elementary | StringType)
    return format_value(symbol.type, bytes(data) if bit is None else bytes((data[0] >> bit & 1,)))
