"""Numbers as the types of a program hold them."""

import math
import struct

from scanbench.program.types import Elementary


def round_real(value: float, type: Elementary) -> float:
    """To single precision, where the type has that."""
    if type.size != 4 or math.isnan(value) or math.isinf(value):
        return value
    try:
        return float(struct.unpack("<f", struct.pack("<f", value))[0])
    except OverflowError:
        return math.copysign(math.inf, value)
