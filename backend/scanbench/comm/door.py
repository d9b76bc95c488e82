"""What a protocol knows of a PLC: one way to read, one to change. This is the room's contract."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Protocol

from scanbench.faults.device_shapes import DeviceErrors
from scanbench.plcmodel.model import Model
from scanbench.runtime.command import Command
from scanbench.wire.memory import AreaSpan


class Away(Exception):
    """The PLC is switched off, starting, or silent: the message says which."""


@dataclass(frozen=True, slots=True)
class Read:
    """Bytes of the PLC's memory, all of one seam."""

    scan: int
    mode: str
    """PROGRAM, MONITOR or RUN."""
    stopped: bool
    """A fatal error or a trap keeps the program from running."""
    clock: datetime
    """What the PLC's own clock shows."""
    data: tuple[bytes, ...]
    """Of each span that was asked for."""


@dataclass(frozen=True, slots=True)
class Done:
    """What became of a command."""

    ok: bool
    message: str


class Door(Protocol):
    """One PLC, for one client."""

    @property
    def author(self) -> str:
        """Of its commands: `FINS 192.168.0.7, node 25`."""

    @property
    def model(self) -> Model:
        """The model, as it was when the client came: its memory is the same for every program."""

    async def read(self, spans: Sequence[AreaSpan], also: Sequence[AreaSpan] = ()) -> Read:
        """Bytes of areas that the model has, in these bounds; `Away`. `also`: more of the same scan, after those, that the protocol
        itself wants to know and the client did not ask for."""

    async def device(self) -> DeviceErrors:
        """What the device itself says of its errors; `Away`."""

    async def submit(self, command: Command) -> Done:
        """Enters a command, which has this door's author; `Away`."""
