"""The layout of the image: which byte means what. Offsets in bytes, little endian.

    0     reserved, so that offset 0 refers to nothing
    8     header (the constants of `Layout`)
    4096  areas of the model, globals, program instances, each aligned to 8
    ...   `state_size`: here the compared, hashed and recorded state ends; frames of temporaries follow
    size

Recursion is refused, so every POU needs exactly one frame, and its place is known: temporaries have offsets like
everything else, and an in-out can refer to one.
"""

from dataclasses import dataclass, field
from typing import ClassVar

from scanbench.check.types import Record
from scanbench.plcmodel.model import Area, Model


@dataclass(slots=True)
class Layout:
    CLOCK: ClassVar[int] = 8
    """i64 virtual time of the current (or last) scan in ns."""
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
    FORCE_LIMIT: ClassVar[int] = 504
    HEADER_SIZE: ClassVar[int] = 4096
    """48 + 504 * 8 = 4080 bytes are in use."""

    model: Model
    areas: dict[str, int] = field(default_factory=dict)
    """Offset of each area of the model."""
    globals: Record | None = None
    """Members with absolute offsets."""
    state_size: int = 0
    size: int = 0

    def area_at(self, offset: int) -> tuple[Area, int] | None:
        """The area that holds this byte of the image, and the byte's number within it."""
        for area in self.model.areas:
            start = self.areas[area.name]
            if start <= offset < start + area.size:
                return area, offset - start
        return None
