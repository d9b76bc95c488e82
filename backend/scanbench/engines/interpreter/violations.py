"""The list of subrange violations in the image, see `Layout.violations`."""

import struct
from collections.abc import Callable

from scanbench.program.calling import callers
from scanbench.program.layout import Layout
from scanbench.program.program import Program

Record = Callable[[int, int, int, int, int], None]
"""Takes the site, the offset of the instance that runs, the value, what an entry says more (`Layout.VIOLATION_BOUND`), and where the
caller of what runs is noted (`Pou.called_at`)."""

COUNT = struct.Struct("<I")
SCAN = struct.Struct("<Q")
ENTRY = struct.Struct("<IIQQQQQ")
LARGEST = (1 << 32) - 1
WORD = (1 << 64) - 1


PATH = struct.Struct(f"<{Layout.PATH_LIMIT}Q")


def _paths(memory: bytearray, program: Program) -> Callable[[int], bytes]:
    """Gives the calls that lead to what runs, whose caller is noted at an offset."""
    noted = callers(program)

    def path_at(called: int) -> bytes:
        found: list[int] = []
        while called and len(found) < Layout.PATH_LIMIT:
            (call,) = SCAN.unpack_from(memory, called)
            number = call & LARGEST
            if not 1 <= number <= len(noted):  # a text that people typed calls, too
                break
            found.append(call)
            called = noted[number - 1]
        return PATH.pack(*found, *[0] * (Layout.PATH_LIMIT - len(found)))

    return path_at


def recorder(memory: bytearray, program: Program) -> Record:
    """What writes down a violation in this image."""
    violations, paths, path_at = program.layout.violations, program.layout.paths, _paths(memory, program)
    used_at, dropped_at, entries_at = violations, violations + COUNT.size, violations + 2 * COUNT.size

    def count(at: int) -> None:
        (times,) = COUNT.unpack_from(memory, at)
        COUNT.pack_into(memory, at, min(times + 1, LARGEST))

    def find(site: int, instance: int, bound: int, path: bytes) -> tuple[int, int]:
        """How many entries there are, and where the one is that has happened before, or 0."""
        used = min(COUNT.unpack_from(memory, used_at)[0], Layout.VIOLATION_LIMIT)
        for number in range(used):
            at = entries_at + number * Layout.VIOLATION_BYTES
            entry = ENTRY.unpack_from(memory, at)
            same = (entry[0], entry[2], entry[6] & Layout.VIOLATION_BOUND) == (site, instance, bound)
            begin = paths + number * PATH.size
            if same and (not paths or memory[begin : begin + PATH.size] == path):
                return used, at
        return used, 0

    def record(site: int, instance: int, value: int, more: int, called: int) -> None:
        memory[Layout.SUBRANGE_ERROR] = 1
        count(Layout.SUBRANGE_COUNT)
        (scan,) = SCAN.unpack_from(memory, Layout.SCAN)
        path = path_at(called)
        used, at = find(site, instance, more & Layout.VIOLATION_BOUND, path)
        if at:
            _, times, _, _, first, _, _ = ENTRY.unpack_from(memory, at)
            ENTRY.pack_into(memory, at, site, min(times + 1, LARGEST), instance, value & WORD, first, scan, more)
        elif used < Layout.VIOLATION_LIMIT:
            at = entries_at + used * Layout.VIOLATION_BYTES
            ENTRY.pack_into(memory, at, site, 1, instance, value & WORD, scan, scan, more)
            COUNT.pack_into(memory, used_at, used + 1)
            if paths:
                memory[paths + used * PATH.size : paths + (used + 1) * PATH.size] = path
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
