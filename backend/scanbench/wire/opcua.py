"""What the server and the process of an OPC UA server say to each other.

Server to process: `OpcUaStart` first, then an `OpcUaProgram`. Process to server: `OpcUaReady` or `OpcUaFailed` first. The process asks with a `ref`
(`ReadVariables`, answered with `VariablesAre`; `OpcUaSubmit`, answered with `OpcUaDone`).
"""

from dataclasses import dataclass
from datetime import datetime

from scanbench.runtime.command import Command
from scanbench.wire.host import Sources
from scanbench.wire.memory import AreaSpan


@dataclass(frozen=True, slots=True)
class OpcUaStart:
    """Listens on an address; with port 0 on one that is free."""

    host: str
    port: int
    plc: str
    """The name of the PLC."""
    model: str
    certificates: str
    """The directory in which the certificate and its key are kept."""
    token: bytes
    """SHA-256 of the token of the server, with which users prove that they may be here."""
    writable: bool
    """Clients may write."""
    anonymous_writes: bool
    """So may who gives no name."""


@dataclass(frozen=True, slots=True)
class OpcUaProgram:
    """What the PLC runs from now on."""

    sources: Sources


@dataclass(frozen=True, slots=True)
class RaisedError:
    """An error that is present, or was."""

    key: str
    """Which one, in the notation of references."""
    name: str
    fatal: bool
    code: str
    """As the model shows it; empty where it has none."""
    details: str
    since: datetime | None
    scan: int | None
    """Before which it was raised, the last time; None: nobody knows."""
    by: str
    present: bool
    until: datetime | None
    acknowledged_by: str
    """Empty: nobody has acknowledged it, the last time that it was raised."""
    remark: str
    """Of who acknowledged it."""


@dataclass(frozen=True, slots=True)
class OpcUaErrors:
    """The errors that are present now, and those that were; `known` is false while the PLC is not there, so that nobody can tell."""

    known: bool
    errors: tuple[RaisedError, ...]


@dataclass(frozen=True, slots=True)
class OpcUaFault:
    """What is wrong with the line to the clients from now on; see `faults.line_faults.LineFault`."""

    kind: str
    late_ms: int


@dataclass(frozen=True, slots=True)
class OpcUaReady:
    """It listens on this port."""

    port: int


@dataclass(frozen=True, slots=True)
class OpcUaFailed:
    """It does not listen, and ends."""

    message: str


@dataclass(frozen=True, slots=True)
class OpcUaClient:
    """A client is there, or gone."""

    name: str
    there: bool


@dataclass(frozen=True, slots=True)
class OpcUaAsked:
    """A client asked something."""

    client: str
    text: str
    outcome: str
    """Empty where it was done."""
    spans: tuple[AreaSpan, ...]
    """Memory that it reads."""


@dataclass(frozen=True, slots=True)
class OpcUaSubmit:
    """A command of a client; answered with `OpcUaDone`."""

    ref: int
    client: str
    command: Command


@dataclass(frozen=True, slots=True)
class OpcUaDone:
    """Answer to `OpcUaSubmit`; `away`: the PLC is not there."""

    ref: int
    ok: bool
    message: str
    away: bool = False
