"""The list of subrange violations in the image, see `Layout.violations`."""

import struct
from collections.abc import Callable

from scanbench.program.layout import Layout

Record = Callable[[int, int, int, int], None]
"""Takes the site, the offset of the instance that runs, the value, and what an entry says more (`Layout.VIOLATION_BOUND`)."""

COUNT = struct.Struct("<I")
SCAN = struct.Struct("<Q")
ENTRY = struct.Struct("<IIQQQQQ")
LARGEST = (1 << 32) - 1
WORD = (1 << 64) - 1


def recorder(memory: bytearray, violations: int) -> Record:
    """What writes down a violation in this image, whose list begins at `violations`."""
    used_at, dropped_at, entries_at = violations, violations + COUNT.size, violations + 2 * COUNT.size

    def count(at: int) -> None:
        (times,) = COUNT.unpack_from(memory, at)
        COUNT.pack_into(memory, at, min(times + 1, LARGEST))

    def find(site: int, instance: int, bound: int) -> tuple[int, int]:
        """How many entries there are, and where the one is that has happened before, or 0."""
        used = min(COUNT.unpack_from(memory, used_at)[0], Layout.VIOLATION_LIMIT)
        for number in range(used):
            at = entries_at + number * Layout.VIOLATION_BYTES
            entry = ENTRY.unpack_from(memory, at)
            if (entry[0], entry[2], entry[6] & Layout.VIOLATION_BOUND) == (site, instance, bound):
                return used, at
        return used, 0

    def record(site: int, instance: int, value: int, more: int) -> None:
        memory[Layout.SUBRANGE_ERROR] = 1
        count(Layout.SUBRANGE_COUNT)
        (scan,) = SCAN.unpack_from(memory, Layout.SCAN)
        used, at = find(site, instance, more & Layout.VIOLATION_BOUND)
        if at:
            _, times, _, _, first, _, _ = ENTRY.unpack_from(memory, at)
            ENTRY.pack_into(memory, at, site, min(times + 1, LARGEST), instance, value & WORD, first, scan, more)
        elif used < Layout.VIOLATION_LIMIT:
            at = entries_at + used * Layout.VIOLATION_BYTES
            ENTRY.pack_into(memory, at, site, 1, instance, value & WORD, scan, scan, more)
            COUNT.pack_into(memory, used_at, used + 1)
        else:
            count(dropped_at)

    return record


def in_65_bits(value: int, signed: bool) -> tuple[int, int]:
    """What an entry keeps of a number of 128 bits: the nearest one that has room, and what it says of it."""
    near = min(max(value, -WORD - 1 if signed else 0), WORD)
    flags = (
        1 << Layout.VIOLATION_WIDE | (near < 0) << Layout.VIOLATION_SIGN | (near != value) << Layout.VIOLATION_BEYOND
    )
    return near, flags
