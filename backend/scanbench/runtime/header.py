"""The header of an image, by name: virtual time, mode, force table. See `program/layout.py`."""

import struct
from enum import IntEnum, IntFlag

from scanbench.program.layout import Layout
from scanbench.program.program import Program

_I64 = struct.Struct("<q")
_U64 = struct.Struct("<Q")
_U32 = struct.Struct("<I")


DEFAULT_EPOCH = 946_684_800_000_000_000
"""2000-01-01T00:00:00Z: what the clock of a PLC shows in scan 0 unless somebody sets it, so that equal runs are equal."""


class Mode(IntEnum):
    """Operating mode of the PLC, as in `Layout.MODE`."""

    PROGRAM = 0
    MONITOR = 1
    RUN = 2


class Halt(IntFlag):
    """Why the program is kept stopped, as in `Layout.FATAL`; 0 is: it is not."""

    NONE = 0
    FATAL_ERROR = 1
    TRAP = 2


class Header:
    """Reads, and for the resource alone writes, the header of one image."""

    def __init__(self, memory: bytearray | bytes | memoryview) -> None:
        self._memory = memory

    @property
    def scan(self) -> int:
        """Number of the scan that runs next (or runs)."""
        return int(_U64.unpack_from(self._memory, Layout.SCAN)[0])

    @property
    def clock_ns(self) -> int:
        """Virtual time of the last scan."""
        return int(_I64.unpack_from(self._memory, Layout.CLOCK)[0])

    @property
    def origin_ns(self) -> int:
        """Virtual time of scan 0, had all scans been as long as they are now."""
        return int(_I64.unpack_from(self._memory, Layout.ORIGIN)[0])

    def next_clock_ns(self, interval_ns: int) -> int:
        """Virtual time of the scan that runs next."""
        return _clock(self._memory, self.scan, interval_ns)

    @property
    def epoch_ns(self) -> int:
        """What the PLC's clock showed at virtual time 0."""
        return int(_I64.unpack_from(self._memory, Layout.EPOCH)[0])

    @property
    def started(self) -> int:
        """Number of the first scan since the program last started."""
        return int(_U64.unpack_from(self._memory, Layout.STARTED)[0])

    @property
    def mode(self) -> Mode:
        """Operating mode."""
        return Mode(self._memory[Layout.MODE])

    @property
    def halt(self) -> Halt:
        """What keeps the program stopped."""
        return Halt(self._memory[Layout.FATAL])

    @property
    def halted_by_trap(self) -> bool:
        """Whether a trap keeps the program stopped."""
        return bool(self.halt & Halt.TRAP)

    @property
    def force_count(self) -> int:
        """Entries in use of the force table."""
        return int(_U32.unpack_from(self._memory, Layout.FORCE_COUNT)[0])

    @property
    def runnable(self) -> bool:
        """Whether the mode and the errors let the program run."""
        return self.mode is not Mode.PROGRAM and not self.halt


def fresh_image(program: Program, mode: Mode) -> bytearray:
    """The image of a new run in this mode."""
    memory = bytearray(program.layout.size)
    memory[: len(program.initial_image)] = program.initial_image
    memory[Layout.MODE] = mode
    _I64.pack_into(memory, Layout.EPOCH, DEFAULT_EPOCH)
    return memory


def pass_time(memory: bytearray, scans: int, interval_ns: int) -> None:
    """Scans in which the program does not run: only virtual time goes on."""
    scan = _U64.unpack_from(memory, Layout.SCAN)[0] + scans
    _U64.pack_into(memory, Layout.SCAN, scan)
    _I64.pack_into(memory, Layout.CLOCK, _clock(memory, scan - 1, interval_ns))


def _clock(memory: bytearray | bytes | memoryview, scan: int, interval_ns: int) -> int:
    """As the engines compute it."""
    return int(_I64.unpack_from(memory, Layout.ORIGIN)[0] + scan * interval_ns & (1 << 63) - 1)
