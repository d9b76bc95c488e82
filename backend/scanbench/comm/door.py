"""What a protocol knows of a PLC: one way to read, one to change. This is the room's contract."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Protocol

from scanbench.faults.device_shapes import DeviceErrors
from scanbench.plcmodel.model import Model
from scanbench.runtime.command import Command
from scanbench.wire.host import Sources
from scanbench.wire.memory import AreaSpan
from scanbench.wire.opcua import RaisedError
from scanbench.wire.variables import VariablesAre, VariablesDescribed


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

    def noted(self, spans: Sequence[AreaSpan]) -> None:
        """The client reads these bytes, in some other way."""

    async def device(self) -> DeviceErrors:
        """What the device itself says of its errors; `Away`."""

    async def submit(self, command: Command) -> Done:
        """Enters a command, which has this door's author; `Away`."""


class Plc(Protocol):
    """One PLC, for a server that shows its program, whoever asks."""

    @property
    def name(self) -> str:
        """As people call it."""

    @property
    def model(self) -> Model:
        """What it is."""

    @property
    def sources(self) -> Sources:
        """What the program is made of that it runs."""

    @property
    def errors(self) -> tuple[RaisedError, ...] | None:
        """Those that were raised, present or not; None while it is not there, so that nobody can tell."""

    def listen(self, changed: Callable[[], None]) -> Callable[[], None]:
        """Has `changed` called whenever program or errors may have changed; what is given back ends that."""

    async def describe(self, paths: tuple[str, ...]) -> VariablesDescribed:
        """What paths mean in the program that runs; `Away`."""

    async def variables(self, paths: tuple[str, ...]) -> VariablesAre:
        """Variables of the program, all of one seam; `Away`."""
