"""Force and Release: values that hold after input refresh and before output, whatever the program writes.

A force is a patch of the force table in the image header (`engines/engine.py` applies it), one entry a byte; forces of
bits in one byte share an entry.
"""

import struct
from collections.abc import Mapping
from dataclasses import dataclass

from scanbench.check.layout import Layout
from scanbench.check.types import Elementary
from scanbench.runtime.command import Command, Entry, Patch, Plan, Refusal, Restarted, Swapped, View
from scanbench.runtime.journal import Fold
from scanbench.runtime.rights import Right, may
from scanbench.runtime.target import find, writable_target

_ENTRY = struct.Struct("<IBBH")
_COUNT = struct.Struct("<I")


@dataclass(frozen=True, slots=True)
class Force(Command):
    """Holds a variable or address at a value."""

    path: str
    value: str

    def plan(self, view: View) -> Plan | Refusal:
        """The new force table, and the value at once, so that a paused PLC shows it."""
        patch = self.bits(view)
        if isinstance(patch, Refusal):
            return patch
        table = read_table(view.memory)
        hold(table, patch)
        if len(table) > Layout.FORCE_LIMIT:
            return Refusal(f"no room for more forces: at most {Layout.FORCE_LIMIT} bytes. Release some first")
        symbol = find(view, self.path)
        shown = self.path if isinstance(symbol, Refusal) else symbol.path
        return Plan((*table_patches(view, table), patch), f"{shown} forced to {self.value.strip()}")

    def bits(self, view: View) -> Patch | Refusal:
        """Which bits of this image it holds, at which values."""
        target = writable_target(view, self.path, Right.FORCE)
        if isinstance(target, Refusal):
            return target
        if not isinstance(target.type, Elementary):
            return Refusal(f"{target.symbol.path} is a {target.type.name}: only values of up to 8 bytes can be forced")
        return target.patch(self.value)


@dataclass(frozen=True, slots=True)
class Release(Command):
    """Ends the force of one path, or of all with None. The value stays until something writes it."""

    path: str | None

    def plan(self, view: View) -> Plan | Refusal:
        """The force table without these bits."""
        refused = may(view.header.mode, Right.FORCE, self.path or "")
        if refused is not None:
            return refused
        forces = view.derived(FORCED)
        if self.path is None:
            count = len(forces)
            return Plan(table_patches(view, {}), f"{count} force{'s' * (count != 1)} released")
        symbol = find(view, self.path)
        if isinstance(symbol, Refusal):
            return symbol
        place = symbol.locate(view.memory)
        table = read_table(view.memory)
        held = False
        if place is not None:
            offset, bit = place
            for index in range(offset, offset + (1 if bit is not None else symbol.type.size)):
                mask, value = table.pop(index, (0, 0))
                keep = mask & ~(0xFF if bit is None else 1 << bit)
                held = held or keep != mask
                if keep:
                    table[index] = (keep, value & keep)
        if not held:
            return Refusal(f"{symbol.path} is not forced", tuple(forces))
        return Plan(table_patches(view, table), f"{symbol.path} released")


def read_table(memory: bytearray | bytes | memoryview) -> dict[int, tuple[int, int]]:
    """Offset -> (mask, value) of every entry in use."""
    count = _COUNT.unpack_from(memory, Layout.FORCE_COUNT)[0]
    table = {}
    for index in range(count):
        offset, mask, value, _ = _ENTRY.unpack_from(memory, Layout.FORCES + _ENTRY.size * index)
        table[offset] = (mask, value)
    return table


def hold(table: dict[int, tuple[int, int]], patch: Patch) -> None:
    """Adds the bits of a patch to a force table."""
    for index, (mask, value) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
        old_mask, old_value = table.get(index, (0, 0))
        table[index] = (old_mask | mask, old_value & ~mask | value & mask)


def table_patches(view: View, table: dict[int, tuple[int, int]]) -> tuple[Patch, ...]:
    """Patches that make this the force table; rows that fall free are cleared, so that equal forces give equal images."""
    rows = b"".join(_ENTRY.pack(offset, mask, value, 0) for offset, (mask, value) in sorted(table.items()))
    rows = rows.ljust(view.header.force_count * _ENTRY.size, b"\0")
    return (Patch.whole(Layout.FORCE_COUNT, _COUNT.pack(len(table))), Patch.whole(Layout.FORCES, rows))


def _step(held: Mapping[str, Force], entry: Entry) -> Mapping[str, Force]:
    command, effect = entry.command, entry.plan.effect
    if isinstance(effect, Restarted) and effect.kind != "warm":
        return {}
    if isinstance(command, Force):
        return {**held, _key(command.path): command}
    gone: tuple[str, ...] = ()
    if isinstance(effect, Swapped):
        gone = effect.released
    elif isinstance(command, Release):
        if command.path is None:
            return {}
        gone = (command.path,)
    keys = {_key(path) for path in gone}
    return {key: force for key, force in held.items() if key not in keys} if keys else held


def _key(path: str) -> str:
    return path.strip().upper()


FORCED: Fold[Mapping[str, Force]] = Fold({}, _step)
"""The forces that hold, by path in upper case."""
