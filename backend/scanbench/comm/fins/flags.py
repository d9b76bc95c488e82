"""The flags of errors that every answer tells of. (W342, section 5-1-3.)"""

from collections.abc import Sequence
from dataclasses import replace

from scanbench.comm.door import Done, Door, Read
from scanbench.comm.fins.codes import FATAL, NONFATAL
from scanbench.faults.device_shapes import DeviceErrors
from scanbench.plcmodel.model import Model
from scanbench.runtime.command import Command
from scanbench.wire.memory import AreaSpan

FLAGS = (AreaSpan("A", 2 * 401, 4),)
"""A401, fatal errors; A402, non-fatal ones."""


def has_flags(model: Model) -> bool:
    """Whether the model has an auxiliary area: CS, CJ and CP."""
    return any(area.name == "A" and area.words > 402 for area in model.areas)


class Flagged:
    """A door that notices the flags: read together with what a request reads, or afterwards where it reads nothing."""

    def __init__(self, door: Door) -> None:
        self._door = door
        self._also = FLAGS if has_flags(door.model) else ()
        self._bits: int | None = None if self._also else 0

    @property
    def author(self) -> str:
        """See `Door`."""
        return self._door.author

    @property
    def model(self) -> Model:
        """See `Door`."""
        return self._door.model

    async def read(self, spans: Sequence[AreaSpan], also: Sequence[AreaSpan] = ()) -> Read:
        """See `Door`."""
        read = await self._door.read(spans, (*also, *self._also))
        if not self._also:
            return read
        data = read.data[-1]
        self._bits = (any(data[:2]) and FATAL) | (any(data[2:]) and NONFATAL)
        return replace(read, data=read.data[:-1])

    def noted(self, spans: Sequence[AreaSpan]) -> None:
        """See `Door`."""
        self._door.noted(spans)

    async def device(self) -> DeviceErrors:
        """See `Door`."""
        return await self._door.device()

    async def submit(self, command: Command) -> Done:
        """See `Door`."""
        done = await self._door.submit(command)
        self._bits = None if self._also else 0
        return done

    async def bits(self) -> int:
        """The bits of an end code that say that there are errors."""
        if self._bits is None:
            await self.read(())
        return self._bits or 0
