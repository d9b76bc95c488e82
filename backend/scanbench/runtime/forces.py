"""Force and Release: values that hold after input refresh and before output, whatever the program writes.

A force is a patch of the force table in the image header (`engines/engine.py` applies it), one entry a byte; forces of
bits in one byte share an entry.
"""

import struct
from collections.abc import Sequence
from dataclasses import dataclass

from scanbench.check.layout import Layout
from scanbench.check.types import Elementary
from scanbench.runtime.command import Command, Entry, Patch, Plan, Refusal, View
from scanbench.runtime.header import Mode
from scanbench.runtime.program_change import ProgramChange
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
        target = writable_target(view, self.path, "force")
        if isinstance(target, Refusal):
            return target
        if not isinstance(target.type, Elementary):
            return Refusal(f"{target.symbol.path} is a {target.type.name}: only values of up to 8 bytes can be forced")
        patch = target.patch(self.value)
        if not isinstance(patch, Patch):
            return patch
        table = read_table(view.memory)
        for index, (mask, value) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
            old_mask, old_value = table.get(index, (0, 0))
            table[index] = (old_mask | mask, old_value & ~mask | value & mask)
        if len(table) > Layout.FORCE_LIMIT:
            return Refusal(f"no room for more forces: at most {Layout.FORCE_LIMIT} bytes. Release some first")
        return Plan((*table_patches(view, table), patch), f"{target.symbol.path} forced to {self.value.strip()}")


@dataclass(frozen=True, slots=True)
class Release(Command):
    """Ends the force of one path, or of all with None. The value stays until something writes it."""

    path: str | None

    def plan(self, view: View) -> Plan | Refusal:
        """The force table without these bits."""
        if view.header.mode is Mode.RUN:
            return Refusal("in RUN mode forces cannot be changed: change to MONITOR first")
        if self.path is None:
            count = len(forced(view.entries))
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
            return Refusal(f"{symbol.path} is not forced", tuple(forced(view.entries)))
        return Plan(table_patches(view, table), f"{symbol.path} released")


def read_table(memory: bytearray | bytes | memoryview) -> dict[int, tuple[int, int]]:
    """Offset -> (mask, value) of every entry in use."""
    count = _COUNT.unpack_from(memory, Layout.FORCE_COUNT)[0]
    table = {}
    for index in range(count):
        offset, mask, value, _ = _ENTRY.unpack_from(memory, Layout.FORCES + _ENTRY.size * index)
        table[offset] = (mask, value)
    return table


def table_patches(view: View, table: dict[int, tuple[int, int]]) -> tuple[Patch, ...]:
    """Patches that make this the force table; rows that fall free are cleared, so that equal forces give equal images."""
    rows = b"".join(_ENTRY.pack(offset, mask, value, 0) for offset, (mask, value) in sorted(table.items()))
    rows = rows.ljust(view.header.force_count * _ENTRY.size, b"\0")
    return (Patch.whole(Layout.FORCE_COUNT, _COUNT.pack(len(table))), Patch.whole(Layout.FORCES, rows))


def forced(entries: Sequence[Entry]) -> dict[str, Force]:
    """The forces that hold after these entries, by path in upper case."""
    held: dict[str, Force] = {}
    for entry in entries:
        command = entry.command
        if isinstance(command, Force):
            held[command.path.strip().upper()] = command
        elif isinstance(command, ProgramChange):
            held.clear()  # those that fit the new program follow in the journal
        elif isinstance(command, Release):
            if command.path is None:
                held.clear()
            else:
                held.pop(command.path.strip().upper(), None)
    return held
