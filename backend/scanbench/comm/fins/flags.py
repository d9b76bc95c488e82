"""The flags of errors that every answer tells of. (W342, section 5-1-3.)"""

from scanbench.comm.door import Door
from scanbench.comm.fins.codes import FATAL, NONFATAL
from scanbench.plcmodel.model import Model
from scanbench.wire.memory import AreaSpan

FLAGS = (AreaSpan("A", 2 * 401, 4),)
"""A401, fatal errors; A402, non-fatal ones."""


def has_flags(model: Model) -> bool:
    """Whether the model has an auxiliary area: CS, CJ and CP."""
    return any(area.name == "A" and area.words > 402 for area in model.areas)


async def flags(door: Door) -> int:
    """The bits of an end code that say that there are errors."""
    if not has_flags(door.model):
        return 0
    (data,) = (await door.read(FLAGS, asked=False)).data
    return (any(data[:2]) and FATAL) | (any(data[2:]) and NONFATAL)
