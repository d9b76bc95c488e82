"""The servers of the communication unit of a PLC, as they are set and as people see them."""

from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.comm.desk import ClientSeen, FrameSeen
from scanbench.comm.modbus.wires import PlantWanted
from scanbench.comm.mqtt.settings import MqttWanted
from scanbench.faults.line_faults import LineFault, ServerKind
from scanbench.public import Public


@dataclass(frozen=True, slots=True)
class ServerWanted(Public):
    """A server as somebody sets it."""

    PUBLIC: ClassVar = "CommunicationServerSettings"
    GIVEN: ClassVar = True

    on: bool = False
    host: str = "127.0.0.1"
    """The address it listens on: a loopback address of its own for each PLC (127.0.0.11), or one of the machine's."""
    port: int = 0
    """0: one that is free."""
    access: Literal["read", "write"] = "read"
    """What clients may do."""
    node: int = 1
    """The node number of the PLC; of FINS only."""
    anonymous_writes: bool = False
    """Who gives no name may write, too, where clients may write; of OPC UA only."""
    error_bits: bool = True
    """Each end code says that the PLC has errors (0040, 0080), as at the device; of FINS only. Some clients take that for a failure."""


@dataclass(frozen=True, slots=True)
class ServerSeen(Public):
    """A server as it is."""

    PUBLIC: ClassVar = "CommunicationServer"

    kind: ServerKind
    settings: ServerWanted
    listening: bool
    address: str
    """What to type into a client: `127.0.0.1:9600`, `opc.tcp://127.0.0.1:4840`; empty while it does not listen."""
    trouble: str
    """Why it does not listen although it is on."""
    fault: LineFault
    """What is wrong with the line, because somebody wanted it so."""
    per_second: float
    """Requests, lately."""
    clients: tuple[ClientSeen, ...]
    frames: tuple[FrameSeen, ...]
    """The last ones, the oldest first."""


@dataclass(frozen=True, slots=True)
class PlantSeen(Public):
    """A plant that is a server of Modbus TCP, as it is."""

    PUBLIC: ClassVar = "CommunicationPlant"

    settings: PlantWanted
    fault: LineFault
    """What is wrong with the line to it, because somebody wanted it so."""
    answers: bool
    trouble: str
    """Why it does not answer although it is on, or why its values are not entered."""
    exchanges: int
    """Since it was switched on."""
    took_ms: float
    """The last exchange."""
    per_second: float
    """Requests, lately."""
    frames: tuple[FrameSeen, ...]
    """The last ones, the oldest first."""


@dataclass(frozen=True, slots=True)
class MqttSeen(Public):
    """What is published by MQTT."""

    PUBLIC: ClassVar = "CommunicationMqtt"

    settings: MqttWanted
    password: bool
    """One is kept."""
    identity: bool
    """A certificate of the client is kept."""
    connected: bool
    trouble: str
    """Why nothing is published although it is on, or which of the variables are not."""
    published: int
    """Messages, since it was switched on."""
    per_second: float
    """Messages, lately."""
    frames: tuple[FrameSeen, ...]
    """The last messages, the oldest first."""


@dataclass(frozen=True, slots=True)
class ErrorReader(Public):
    """A word of error memory that clients have read since their server was switched on."""

    PUBLIC: ClassVar = "ErrorMemoryReader"

    word: str
    """In the vendor's notation."""
    clients: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class CommunicationSeen(Public):
    """The communication unit of a PLC."""

    PUBLIC: ClassVar = "Communication"

    servers: tuple[ServerSeen, ...]
    """Those that the model can have."""
    error_readers: tuple[ErrorReader, ...]
    plant: PlantSeen
    mqtt: MqttSeen
    own_map: bool
    """The project has a map of Modbus of its own: `modbus.csv`."""
    map_trouble: str
    """Why that cannot be used; no register means anything then."""
