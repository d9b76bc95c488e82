"""What the memory is when a new program takes over."""

from scanbench.check.layout import Layout
from scanbench.check.program import Program
from scanbench.runtime.carry_over import Change, carry_over
from scanbench.runtime.header import Header, Mode, fresh_image
from scanbench.runtime.restart import go_on


def swapped(
    old: Program, memory: bytes | bytearray | memoryview, new: Program, fresh: bool
) -> tuple[bytearray, Change]:
    """The image of `new` behind the image of `old`. The PLC's clock goes on, however long a scan is now."""
    image, change = fresh_image(new, Mode.MONITOR), Change()
    if fresh:
        go_on(memory, image)
    else:
        change = carry_over(old, memory, new, image)
    header = Header(image)
    epoch = header.epoch_ns + header.scan * (old.interval_ns - new.interval_ns)
    image[Layout.EPOCH : Layout.EPOCH + 8] = epoch.to_bytes(8, "little", signed=True)
    return image, change
