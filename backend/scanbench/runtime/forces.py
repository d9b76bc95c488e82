"""Force and Release: values that hold after input refresh and before output, whatever the program writes.

A force is a patch of the force table in the image header (each engine applies it in every scan: `engines/native/emit_scan.py`, `engines/interpreter/engine.py`), one entry a byte; forces of
bits in one byte share an entry. Bits that are forced under one path cannot be forced under a second one: `D100` and the variable
there are the same bytes, and whoever releases one of them would release the other.
"""

import struct
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, TypeVar

from scanbench.program.layout import Layout
from scanbench.program.types import Elementary
from scanbench.public import Public
from scanbench.runtime.command import Category, Command, Effect, Entry, Patch, Plan, Refusal, Restarted, Swapped, View
from scanbench.runtime.holds import held, holder
from scanbench.runtime.journal import Fold
from scanbench.runtime.rights import Right, may
from scanbench.runtime.target import Meant, Naming, Target, everywhere, find, meant, writable_target
from scanbench.symbols.symbols import Symbol
from scanbench.symbols.values import format_value

_ENTRY = struct.Struct("<IBBBB")
_COUNT = struct.Struct("<I")
Known = TypeVar("Known")
_SAID = 3
"""Forces that are named, where many are made at once."""


@dataclass(frozen=True, slots=True)
class Force(Naming):
    """Holds a variable or address at a value. A path through an in-out means a variable, as with `Write`: that variable is held,
    even if the block is called with a different one later."""

    category: ClassVar[Category] = "force"

    def plan(self, view: View) -> Plan | Refusal:
        """The new force table, and the value at once, so that a paused PLC shows it."""
        forced = _Forced(view)
        done = self.change(view, forced)
        if isinstance(done, Refusal):
            return done
        return replace(done, patches=(*table_patches(view, forced.table), *done.patches))

    def change(self, view: View, forced: "_Forced") -> Plan | Refusal:
        """Forces it there, and gives the value at once."""
        refusal = self.unsettled(view)
        if refusal is not None:
            return refusal
        target = self._target(view)
        if isinstance(target, Refusal):
            return target
        patch = target.patch(self.value)
        if isinstance(patch, Refusal):
            return patch
        other = forced.other(self, _bits_of(patch))
        if other is not None:
            return Refusal(f"{self.path} is forced already, as {other.path} by {other.author}: release that first")
        number = holder(view.journal, patch)
        if number:
            return Refusal(f"{self.path} is held by disturbance {number}: take that back first")
        before = forced.forces.get(_key(self.path))
        forced.hold(self, patch)
        if len(forced.table) > Layout.FORCE_LIMIT:
            return Refusal(f"no room for more forces: at most {Layout.FORCE_LIMIT} bytes. Release some first")
        value = self.value.strip()
        if before is not None and before.author != self.author:
            said = f"{target.shown} forced to {value}; {before.author} held it at {before.value.strip()}"
            return Plan(everywhere(view, patch), said)
        return Plan(everywhere(view, patch), f"{target.shown} forced to {value}")

    def bits(self, view: View) -> Patch | Refusal:
        """Which bits of this image it holds, at which values."""
        target = self._target(view)
        return target if isinstance(target, Refusal) else target.patch(self.value)

    def _target(self, view: View) -> Target | Refusal:
        target = writable_target(view, self.path, Right.FORCE, self.through)
        if isinstance(target, Refusal) or isinstance(target.type, Elementary):
            return target
        return Refusal(f"{target.shown} is a {target.type.name}: only values of up to 8 bytes can be forced")


class _Forced:
    """The force table and whose its bits are, as they become while changes are planned. Where the forces are is looked up
    once, however many changes there are: a communication partner may send hundreds in one frame, between two scans."""

    def __init__(self, view: View) -> None:
        self.table = read_table(view.memory)
        held: Mapping[str, Force] = view.derived(FORCED)
        self.forces = dict(held)
        self._view = view

    def other(self, force: Force, bits: range) -> Force | None:
        """A force of some of these bits under a different path; None if there is none."""
        mine = _key(force.path)
        keys = (key for bit in bits for key in self._keys.get(bit, ()) if key != mine)
        return next((self.forces[key] for key in keys), None)

    def overlapping(self, bits: range) -> list[Force]:
        """The forces of any of these bits, each once."""
        keys = dict.fromkeys(key for bit in bits for key in self._keys.get(bit, ()))
        return [self.forces[key] for key in keys]

    def exactly(self, bits: range) -> Force | None:
        """The force of these bits and no others."""
        return next((each for each in self.overlapping(bits) if self._bits[_key(each.path)] == bits), None)

    def hold(self, force: Force, patch: Patch) -> None:
        """One more, or a different value."""
        key = _key(force.path)
        self._forget(key)
        self.forces[key] = force
        self._note(key, _bits_of(patch))
        hold(self.table, patch)

    def release(self, key: str, bits: range) -> None:
        """Without these bits, and without what was forced under this path."""
        self._forget(key)
        self.forces.pop(key, None)
        for at, bit in (divmod(each, 8) for each in bits):
            mask, value = self.table.pop(at, (0, 0))
            keep = mask & ~(1 << bit)
            if keep:
                self.table[at] = (keep, value & keep)

    @cached_property
    def through(self) -> Mapping[str, Force]:
        """The last one that was entered for an in-out, by its path."""
        return {_key(each.through): each for each in self.forces.values()}

    @cached_property
    def _bits(self) -> dict[str, range]:
        """Where each of them is now, by its path."""
        found = {key: find(self._view, force.path) for key, force in self.forces.items()}
        return {key: _bits(self._view, each) for key, each in found.items() if not isinstance(each, Refusal)}

    @cached_property
    def _keys(self) -> dict[int, list[str]]:
        """By bit of the image."""
        keys: dict[int, list[str]] = {}
        for key, bits in self._bits.items():
            for bit in bits:
                keys.setdefault(bit, []).append(key)
        return keys

    def _note(self, key: str, bits: range) -> None:
        if "_keys" not in vars(self):
            return
        self._bits[key] = bits
        for bit in bits:
            self._keys.setdefault(bit, []).append(key)

    def _forget(self, key: str) -> None:
        if "_keys" not in vars(self):  # nobody has asked yet
            return
        for bit in self._bits.pop(key, ()):
            self._keys[bit].remove(key)


def _bits_of(patch: Patch) -> range:
    """Counted in bits of the image: of a patch of one bit this one."""
    first = 8 * patch.offset
    if patch.mask[0] == 0xFF:
        return range(first, first + 8 * len(patch.mask))
    bit = first + patch.mask[0].bit_length() - 1
    return range(bit, bit + 1)


def _bits(view: View, symbol: Symbol) -> range:
    """Where it is now, counted in bits of the image."""
    place = symbol.locate(view.memory)
    if place is None:
        return range(0)
    offset, bit = place
    return (
        range(8 * offset, 8 * (offset + symbol.type.size))
        if bit is None
        else range(8 * offset + bit, 8 * offset + bit + 1)
    )


def _not_forced(path: str, bits: range, forced: _Forced) -> Refusal:
    """Nothing is released by the name of something larger or smaller: who forced it goes by the list of forces."""
    others = forced.overlapping(bits)
    if not others:
        return Refusal(f"{path} is not forced", tuple(each.path for each in forced.forces.values()))
    shown = ", ".join(f"{force.path} by {force.author}" for force in others[:3]) + (", ..." if len(others) > 3 else "")
    return Refusal(f"{path} is forced as {shown}: release that", tuple(force.path for force in others))


@dataclass(frozen=True, slots=True)
class Release(Command):
    """Ends the force of one path, or of all with None. The value stays until something writes it."""

    category: ClassVar[Category] = "force"

    path: str | None

    def settled(self, view: View) -> "Release":
        """With the variable that is held: of an in-out the one it is bound to now, else the one it was forced on."""
        return self.among(view, _Forced(view))

    def among(self, view: View, forced: _Forced) -> "Release":
        """The same, of these forces."""
        if self.path is None or _key(self.path) in forced.forces:
            return self
        now = meant(view, self.path, "")
        if isinstance(now, Meant) and _key(now.path) in forced.forces:
            return replace(self, path=now.path)
        once = forced.through.get(_key(self.path))
        if once is not None:
            return replace(self, path=once.path)
        symbol = find(view, self.path)
        same = None if isinstance(symbol, Refusal) else forced.exactly(_bits(view, symbol))
        return self if same is None else replace(self, path=same.path)

    def plan(self, view: View) -> Plan | Refusal:
        """The force table without these bits."""
        if self.path is not None:
            forced = _Forced(view)
            done = self.change(view, forced)
            return done if isinstance(done, Refusal) else replace(done, patches=table_patches(view, forced.table))
        refused = may(view.header.mode, Right.FORCE, "")
        if refused is not None:
            return refused
        count = len(view.derived(FORCED))
        return Plan(table_patches(view, _held_table(view)), f"{count} force{'s' * (count != 1)} released")

    def change(self, view: View, forced: _Forced) -> Plan | Refusal:
        """Releases the one path there."""
        assert self.path is not None, "all are released by `plan`"
        refused = may(view.header.mode, Right.FORCE, self.path)
        if refused is not None:
            return refused
        symbol = find(view, self.path)
        if isinstance(symbol, Refusal):
            return symbol
        bits = _bits(view, symbol)
        if _key(self.path) not in forced.forces:
            return _not_forced(symbol.path, bits, forced)
        forced.release(_key(self.path), bits)
        return Plan((), f"{symbol.path} released")


@dataclass(frozen=True, slots=True)
class ForceSeveral(Command):
    """Forces and releases in one seam, in this order: all of them, or none. To release what is not forced means nothing here."""

    category: ClassVar[Category] = "force"

    changes: tuple[Force | Release, ...]

    def settled(self, view: View) -> Command:
        """Each with the variable that is meant, without releases that mean nothing."""
        return replace(self, changes=tuple(self._meant(view, _Forced(view))))

    def plan(self, view: View) -> Plan | Refusal:
        """The force table after all of them, and the values at once."""
        refused = may(view.header.mode, Right.FORCE)
        if refused is not None:
            return refused
        forced, patches, said = _Forced(view), list[Patch](), list[str]()
        for change in list(self._meant(view, forced)):
            plan = change.change(view, forced)
            if isinstance(plan, Refusal):
                return plan
            said.append(plan.message)
            patches += plan.patches
        if not said:
            return Plan((), "nothing of it was forced")
        more = len(said) - _SAID
        message = "; ".join(said[:_SAID]) + (f"; and {more} more" if more > 0 else "")
        return Plan((*table_patches(view, forced.table), *patches), message)

    def _meant(self, view: View, forced: _Forced) -> Iterator[Force | Release]:
        keys = set(forced.forces)
        for change in self.changes:
            if isinstance(change, Release):  # of what this command forced before, too
                settled: Command = change if _key(change.path or "") in keys else change.among(view, forced)
            else:
                settled = change.settled(view)
            assert isinstance(settled, Force | Release)
            key = _key(settled.path or "")
            if isinstance(settled, Force):
                keys.add(key)
            elif key in keys:
                keys.remove(key)
            else:
                continue
            yield settled


@dataclass(frozen=True, slots=True)
class ForcedValue(Public):
    """A force, and what it did in the scan that ran last: values as text."""

    PUBLIC: ClassVar = "ForceInfo"

    path: str
    through: str
    """The in-out that it was entered for; empty where it was entered for the variable itself."""
    value: str
    author: str
    scan: int
    """Before which scan it was entered."""
    before: str
    """What the variable was when the program was about to begin: from the inputs, or from the scan before."""
    after_program: str
    """What the program made of it."""
    after: str
    """What it is now."""


def forced_values(view: View) -> tuple[ForcedValue, ...]:
    """All forces that hold, in the order in which they were entered."""
    since, notes, found = view.derived(FORCED_SINCE), notes_of(view.memory), []
    for key, force in view.derived(FORCED).items():
        symbol = find(view, force.path)
        place = None if isinstance(symbol, Refusal) else symbol.locate(view.memory)
        if isinstance(symbol, Refusal) or place is None:
            continue
        offset, bit = place
        now = bytes(view.memory[offset : offset + symbol.type.size])
        texts = []
        for which in range(3):
            data = bytes(
                notes.get(at, (byte, byte))[which] if which < 2 else byte for at, byte in enumerate(now, offset)
            )
            texts.append(format_value(symbol.type, data if bit is None else bytes((data[0] >> bit & 1,))))
        found.append(ForcedValue(force.path, force.through, force.value, force.author, since.get(key, 0), *texts))
    return tuple(found)


def read_table(memory: bytearray | bytes | memoryview) -> dict[int, tuple[int, int]]:
    """Offset -> (mask, value) of every entry in use."""
    return {offset: (mask, value) for offset, mask, value, _, _ in _entries(memory)}


def forced_table(view: View) -> dict[int, tuple[int, int]]:
    """As `read_table`, without what is only held (`runtime.holds`)."""
    bits = held(view.journal)
    table = {at: (mask & ~bits.get(at, 0), value) for at, (mask, value) in read_table(view.memory).items()}
    return {at: (mask, value & mask) for at, (mask, value) in table.items() if mask}


def _held_table(view: View) -> dict[int, tuple[int, int]]:
    bits, table = held(view.journal), read_table(view.memory)
    return {at: (table[at][0] & mask, table[at][1] & mask) for at, mask in bits.items() if at in table}


def notes_of(memory: bytearray | bytes | memoryview) -> dict[int, tuple[int, int]]:
    """Offset -> what the byte was before the force, and after the program."""
    return {offset: (before, after) for offset, _, _, before, after in _entries(memory)}


def _entries(memory: bytearray | bytes | memoryview) -> Iterator[tuple[int, int, int, int, int]]:
    count = min(_COUNT.unpack_from(memory, Layout.FORCE_COUNT)[0], Layout.FORCE_LIMIT)
    yield from _ENTRY.iter_unpack(memory[Layout.FORCES : Layout.FORCES + _ENTRY.size * count])


def hold(table: dict[int, tuple[int, int]], patch: Patch) -> None:
    """Adds the bits of a patch to a force table."""
    for index, (mask, value) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
        old_mask, old_value = table.get(index, (0, 0))
        table[index] = (old_mask | mask, old_value & ~mask | value & mask)


def table_patches(view: View, table: dict[int, tuple[int, int]]) -> tuple[Patch, ...]:
    """Patches that make this the force table; rows that fall free are cleared."""
    notes = notes_of(view.memory)
    rows = b"".join(
        _ENTRY.pack(offset, mask, value, *notes.get(offset, 2 * (view.memory[offset],)))
        for offset, (mask, value) in sorted(table.items())
    )
    rows = rows.ljust(view.header.force_count * _ENTRY.size, b"\0")
    return (Patch.whole(Layout.FORCE_COUNT, _COUNT.pack(len(table))), Patch.whole(Layout.FORCES, rows))


def _step(held: Mapping[str, Force], entry: Entry) -> Mapping[str, Force]:
    return _folded(held, entry, lambda force: force)


def _since(known: Mapping[str, int], entry: Entry) -> Mapping[str, int]:
    return _folded(known, entry, lambda _: entry.scan)


def _folded(known: Mapping[str, Known], entry: Entry, told: Callable[[Force], Known]) -> Mapping[str, Known]:
    command = entry.command
    if isinstance(command, ForceSeveral):
        return _after_all(known, command, told) if command.changes else known
    kept = _kept(known, command, entry.plan.effect)
    return {**kept, _key(command.path): told(command)} if isinstance(command, Force) else kept


def _after_all(known: Mapping[str, Known], several: ForceSeveral, told: Callable[[Force], Known]) -> dict[str, Known]:
    """One copy for all of them."""
    made = dict(known)
    for change in several.changes:
        if isinstance(change, Force):
            made[_key(change.path)] = told(change)
        elif change.path is None:
            made.clear()
        else:
            made.pop(_key(change.path), None)
    return made


def _kept(held: Mapping[str, Known], command: Command, effect: Effect | None) -> Mapping[str, Known]:
    """Without what it releases."""
    if isinstance(effect, Restarted) and effect.kind != "warm":
        return {}
    gone: tuple[str, ...] = ()
    if isinstance(effect, Swapped):
        gone = effect.released
    elif isinstance(command, Release):
        if command.path is None:
            return {}
        gone = (command.path,)
    keys = {_key(path) for path in gone}
    return {key: each for key, each in held.items() if key not in keys} if keys else held


def _key(path: str) -> str:
    return path.strip().upper()


FORCED: Fold[Mapping[str, Force]] = Fold({}, _step)
"""The forces that hold, by path in upper case."""

FORCED_SINCE: Fold[Mapping[str, int]] = Fold({}, _since)
"""Before which scan each of them was entered last."""
