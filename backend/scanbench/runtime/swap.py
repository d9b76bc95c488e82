"""What the memory is when a new program takes over."""

from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.runtime.header import Header, Mode, fresh_image
from scanbench.runtime.migrate_image import Change, migrate
from scanbench.runtime.restart import restarted

_U64 = (1 << 64) - 1


def swapped(
    old: Program, memory: bytes | bytearray | memoryview, new: Program, fresh: bool
) -> tuple[bytearray, Change]:
    """The image of `new` after the image of `old`; `fresh` as in `Swapped`. Time goes on, however long a scan is now."""
    image = fresh_image(new, Mode.MONITOR)
    change = migrate(old, memory, new, image)
    header = Header(image)
    origin = header.origin_ns + header.scan * (old.interval_ns - new.interval_ns)
    image[Layout.ORIGIN : Layout.ORIGIN + 8] = (origin & _U64).to_bytes(8, "little")
    return (restarted(new, image, "warm") if fresh else image), change
