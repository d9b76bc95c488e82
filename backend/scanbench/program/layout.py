"""The layout of the image: which byte means what. Offsets in bytes, little endian.

    0     reserved, so that offset 0 refers to nothing
    8     header (the constants of `Layout`)
    4096  areas of the model, globals, program instances, then `violations`, each aligned to 8
    ...   `frames`: frames of temporaries follow, first those whose variables a reference may refer to (`Pou.addressed`)
    ...   `state_size`: here the compared, hashed and recorded state ends; the other frames follow
    ...   who called each POU whose calls are noted (`Pou.called_at`)
    size

Every POU needs exactly one frame, and its place is known, as recursion is refused or its frame is kept meanwhile (`Pou.recursive`):
temporaries have offsets like everything else, and an in-out can refer to one. A reference reaches to `state_size`, so it can refer to a variable of an addressed frame only: it
may outlive the call, and then refers to what the last call left there.
"""

from dataclasses import dataclass, field
from typing import ClassVar

from scanbench.plcmodel.model import Area, Model
from scanbench.program.copies import Copies
from scanbench.program.types import Record

FORCE_BEFORE, FORCE_AFTER_PROGRAM = 6, 7
"""Bytes of a force's entry: what its byte was when the force was applied in phase 2, and in phase 4, of the last scan."""


def align(offset: int) -> int:
    """The next byte from which on anything can be placed."""
    return -(-offset // 8) * 8


@dataclass(slots=True)
class Layout:
    CLOCK: ClassVar[int] = 8
    """i64 virtual time of the current (or last) scan in ns: ORIGIN + SCAN * interval, without its sign bit."""
    SCAN: ClassVar[int] = 16
    """u64 number of the scan that runs, or runs next; scans count from 0."""
    BUDGET: ClassVar[int] = 24
    """i64 loop rounds left in this scan."""
    BUDGET_LIMIT: ClassVar[int] = 32
    """i64 loop rounds a scan may take."""
    MODE: ClassVar[int] = 40
    """u8 0 PROGRAM, 1 MONITOR, 2 RUN."""
    FATAL: ClassVar[int] = 41
    """u8 bits that keep the program stopped: 1 a fatal error, 2 a trap."""
    FORCE_COUNT: ClassVar[int] = 44
    """u32 entries in use of the force table."""
    FORCES: ClassVar[int] = 48
    """The force table: 8 bytes an entry, see engines/engine.py."""
    FORCE_LIMIT: ClassVar[int] = 480
    FORCES_END: ClassVar[int] = 48 + 8 * 480
    EPOCH: ClassVar[int] = 3888
    """i64 ns since 1970: what the PLC's clock showed at virtual time 0. Its clock is EPOCH + CLOCK."""
    STARTED: ClassVar[int] = 3896
    """u64 number of the first scan since the program last started: the scan of the first cycle flag."""
    ASKED_COUNT: ClassVar[int] = 3904
    """u32 what the program asked for in the scan that just ran (FAL and the like), up to `ASKED_LIMIT`."""
    ASKED: ClassVar[int] = 3912
    """Entries of 8 bytes: u8 index into `Model.instructions`, u8 `system_text.Form`, u16 0, u32 number that was passed."""
    ASKED_LIMIT: ClassVar[int] = 16
    INTERVAL: ClassVar[int] = 4040
    """i64 ns: length of a scan in virtual time. The engine writes it in every scan, from the program."""
    ORIGIN: ClassVar[int] = 4048
    """i64 ns: the virtual time that scan 0 would have if all scans had the present interval. It is 0 until a program with
    a different interval takes over; then it is set so that virtual time continues without a jump."""
    STARTED_AT: ClassVar[int] = 4056
    """i64 ns: virtual time of the scan STARTED."""
    DEPTH: ClassVar[int] = 4064
    """u32 calls of interfaces that are open, of those that may come back (`check/recursion.py`). A scan begins with 0."""
    DEPTH_LIMIT: ClassVar[int] = 100
    """Of them."""
    SUBRANGE_ERROR: ClassVar[int] = 4080
    """BOOL `_SubrangeError`: a violation since the program or a tool last cleared it."""
    SUBRANGE_COUNT: ClassVar[int] = 4084
    """u32 `_SubrangeErrorCount`: violations so far, saturating."""
    HEADER_SIZE: ClassVar[int] = 4096

    VIOLATION_LIMIT: ClassVar[int] = 256
    """Entries of the list of violations."""
    VIOLATION_BYTES: ClassVar[int] = 48
    """An entry: u32 site, u32 times (saturating), u64 byte offset of the instance whose body or method has the check
    (0 in a FUNCTION), i64 or u64 last value, u64 first scan, u64 last scan, and a u64 that says more. Entries are (site, instance,
    bound variable) triples, each with its path (`paths`), in the order in which they first happened."""
    VIOLATION_BOUND: ClassVar[int] = (1 << 32) - 1
    """Bits of what says more: byte offset of the variable that was checked by the name of an in-out or through a reference, found through the
    copies of in-outs by value (`Copies.chain`); 0 for a variable that was checked by its own name."""
    VIOLATION_WIDE: ClassVar[int] = 61
    """A bit of it: the value has 65 bits, as what it was before it wrapped has no room in 64."""
    VIOLATION_BEYOND: ClassVar[int] = 62
    """A bit: not even in 65; the value is the nearest number that has."""
    VIOLATION_SIGN: ClassVar[int] = 63
    """A bit: the 65th, the sign."""

    PATH_LIMIT: ClassVar[int] = 8
    """Calls of a path: the innermost ones, of which each is a u64. Bits 0-31 have the number of the call (`Program.calls`, 0: the system called, or
    there is no more), the others the byte offset of the instance that calls (0 in a FUNCTION). Before each call of a POU with a
    `Pou.called_at` the caller writes such a number there. Entries of the list of violations that have different paths are different."""

    model: Model
    areas: dict[str, int] = field(default_factory=dict)
    """Offset of each area of the model."""
    globals: Record | None = None
    """Members with absolute offsets."""
    lists: dict[str, str] = field(default_factory=dict)
    """`LIST.X` of the lists of global variables, in upper case: the name of `x` in `globals`."""
    symbols: Record | None = None
    """Variables that the model gives to every program; located, all of them."""
    frames: int = 0
    state_size: int = 0
    size: int = 0
    violations: int = 0
    """Offset of the list, 0 when the program has no checks: u32 entries in use, u32 violations dropped because the list
    was full (saturating), then the entries."""
    paths: int = 0
    """Offset of the path of each entry; 0 when nothing that is called has checks. It follows the list, as part of the state."""

    copies: Copies = field(default_factory=Copies)
    """The own variables of blocks that take in-outs by value."""

    def area_at(self, offset: int) -> tuple[Area, int] | None:
        """The area that holds this byte of the image, and the byte's number within it."""
        for area in self.model.areas:
            start = self.areas[area.name]
            if start <= offset < start + area.size:
                return area, offset - start
        return None
