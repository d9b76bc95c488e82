"""Answers of the REST API: the communication unit. Made by `python -m tests.client_shapes`; do not edit."""

from typing import Literal, NotRequired, TypedDict


class CommunicationServerSettings(TypedDict):
    """A server as somebody sets it."""

    on: NotRequired[bool]
    host: NotRequired[str]
    """The address it listens on: a loopback address of its own for each PLC (127.0.0.11), or one of the machine's."""
    port: NotRequired[int]
    """0: one that is free."""
    access: NotRequired[Literal["read", "write"]]
    """What clients may do."""
    node: NotRequired[int]
    """The node number of the PLC; of FINS only."""
    anonymous_writes: NotRequired[bool]
    """Who gives no name may write, too, where clients may write; of OPC UA only."""
    error_bits: NotRequired[bool]
    """Each end code says that the PLC has errors (0040, 0080), as at the device; of FINS only. Some clients take that for a failure."""


class CommunicationFault(TypedDict):
    """What is wrong with a line."""

    kind: NotRequired[Literal["none", "silent", "late", "cut", "refused", "node"]]
    """silent: the PLC does what it was asked, and no answer comes, so that clients run into their time limit. late: each answer comes `late_ms` later. cut: connections end at the next request, before it is done. refused: nobody can connect. node: the PLC has a different node number than its clients believe, so that their requests reach nobody."""
    late_ms: NotRequired[int]
    scans: NotRequired[int | None]
    """It is there for so many scans; None: until somebody mends the line."""
    period: NotRequired[int | None]
    """With `scans`: it comes again every so many scans, until somebody mends the line; None: it comes once."""


class CommunicationClient(TypedDict):
    """A client of a server."""

    name: str
    """As commands have it for their author."""
    since: str
    requests: int
    refused: int
    last_refused: str
    """Empty: nothing was."""


class CommunicationFrame(TypedDict):
    """A request, and how it was answered."""

    number: int
    """Counts the requests of a server, from 1."""
    at: str
    client: str
    text: str
    """Decoded: `memory area read D100, 3`."""
    outcome: str
    """Empty where it was done and answered; else why not, with the code of the protocol."""
    request: str
    """Bytes in hexadecimal, as many as there is room for."""
    answer: str


class CommunicationServer(TypedDict):
    """A server as it is."""

    kind: Literal["fins", "slmp", "modbus", "opcua"]
    settings: CommunicationServerSettings
    listening: bool
    address: str
    """What to type into a client: `127.0.0.1:9600`, `opc.tcp://127.0.0.1:4840`; empty while it does not listen."""
    trouble: str
    """Why it does not listen although it is on."""
    fault: CommunicationFault
    """What is wrong with the line, because somebody wanted it so."""
    per_second: float
    """Requests, lately."""
    clients: list[CommunicationClient]
    frames: list[CommunicationFrame]
    """The last ones, the oldest first."""


class ErrorMemoryReader(TypedDict):
    """A word of error memory that clients have read since their server was switched on."""

    word: str
    """In the vendor's notation."""
    clients: list[str]


class PlantRange(TypedDict):
    """Coils or registers of the plant that follow each other, and the memory of the PLC that they are wired to."""

    group: Literal["coil", "discrete input", "input register", "holding register"]
    first: int
    """Counted from 0."""
    count: int
    address: str
    """Of the first one, in the PLC: a bit for coils and discrete inputs, else a word."""
    to: NotRequired[Literal["plc", "plant"]]
    """Who gets the value. Discrete inputs and input registers can only go to the PLC."""


class PlantSettings(TypedDict):
    """A plant that is a server of Modbus TCP, as somebody sets it."""

    on: NotRequired[bool]
    host: NotRequired[str]
    """Where the plant is: an address, or the name of a machine."""
    port: NotRequired[int]
    unit: NotRequired[int]
    every_ms: NotRequired[int]
    """How often values are exchanged."""
    lost: NotRequired[Literal["keep", "clear"]]
    """What inputs do while the plant does not answer: they keep the last value, or are 0."""
    answers: NotRequired[str]
    """A bit of the PLC that is on while the plant answers; empty: none."""
    ranges: NotRequired[list[PlantRange]]


class CommunicationPlant(TypedDict):
    """A plant that is a server of Modbus TCP, as it is."""

    settings: PlantSettings
    fault: CommunicationFault
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
    frames: list[CommunicationFrame]
    """The last ones, the oldest first."""


class MqttSettings(TypedDict):
    """Variables that are published, and the broker that gets them."""

    on: bool
    host: str
    """Where the broker is: an address, or the name of a machine."""
    port: int
    sparkplug: bool
    """As an edge node of Sparkplug B; else each variable is a topic with JSON."""
    prefix: str
    """Topics begin with it; of Sparkplug B it is the group."""
    every_ms: int
    """How often variables are read; those that changed are published."""
    variables: list[str]
    """Paths and addresses: `Main.level`, `D100`."""
    user: str
    """That the broker knows; empty: it asks for none."""
    tls: bool
    """What is said is encrypted, and the broker shows a certificate that is for `host`."""
    ca: str
    """The certificate of who signed that of the broker, in PEM; empty: one of those that the machine trusts."""


class CommunicationMqtt(TypedDict):
    """What is published by MQTT."""

    settings: MqttSettings
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
    frames: list[CommunicationFrame]
    """The last messages, the oldest first."""


class Communication(TypedDict):
    """The communication unit of a PLC."""

    servers: list[CommunicationServer]
    """Those that the model can have."""
    error_readers: list[ErrorMemoryReader]
    plant: CommunicationPlant
    mqtt: CommunicationMqtt
    own_map: bool
    """The project has a map of Modbus of its own: `modbus.csv`."""
    map_trouble: str
    """Why that cannot be used; no register means anything then."""


class MqttSettingsGiven(TypedDict):
    """The same with what proves who we are, which is kept beside the token of the server and never told again."""

    on: NotRequired[bool]
    host: NotRequired[str]
    port: NotRequired[int]
    sparkplug: NotRequired[bool]
    prefix: NotRequired[str]
    every_ms: NotRequired[int]
    variables: NotRequired[list[str]]
    user: NotRequired[str]
    tls: NotRequired[bool]
    ca: NotRequired[str]
    password: NotRequired[str | None]
    """Of the user; None: the one that is kept, which is forgotten when the broker becomes another one; empty: none."""
    identity: NotRequired[str | None]
    """A certificate of the client and its key, both in PEM, the key without a password; None and empty as with the password."""
