"""What a client of a controller does for a verification: it says what there is to read, and reads it again and again."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol
from urllib.parse import urlsplit

FASTEST_MS, SLOWEST_MS = 10, 60_000
"""Bounds of the time from one sample to the next."""
MOST = 999
"""Variables that are read: as many as a log has columns, with that of the time."""
PROTOCOLS = ("opc.tcp", "fins", "fins+tcp")


class Unreachable(Exception):
    """The controller does not answer, or refuses; the message says what, and what to do. `for_good`: the next try is no better."""

    def __init__(self, message: str, for_good: bool = False) -> None:
        super().__init__(message)
        self.message, self.for_good = message, for_good


@dataclass(frozen=True, slots=True)
class Connection:
    """A controller, and what is wanted of it."""

    address: str
    """opc.tcp://HOST:PORT/..., fins://HOST:PORT (UDP), or fins+tcp://HOST:PORT"""
    interval_ms: int = 100
    """From one sample to the next."""
    nodes: tuple[str, ...] = ()
    """Ids of the nodes that are read; none: all that the server shows. By FINS addresses, `level=D100:INT`."""
    user: str = ""
    password: str = field(default="", repr=False)

    @property
    def protocol(self) -> str:
        """`Unreachable` where the address names none."""
        protocol, separator, _ = self.address.partition("://")
        try:
            parts = urlsplit(self.address)
            host, _ = parts.hostname, parts.port
        except ValueError:
            host = None
        if not separator or protocol.lower() not in PROTOCOLS or not host:
            raise Unreachable(
                f"`{self.address}` is no address of a controller: write opc.tcp://HOST:4840 (OPC UA), fins://HOST:9600 (FINS by UDP) or fins+tcp://HOST:9600",
                for_good=True,
            )
        return protocol.lower()

    @property
    def by_fins(self) -> bool:
        """Whether it tells no names. `Unreachable`."""
        return self.protocol.startswith("fins")


@dataclass(frozen=True, slots=True)
class Found:
    """What a controller has to read."""

    columns: tuple[str, ...]
    """A name for each variable, none twice."""
    left_out: tuple[str, ...] = ()
    """What there is besides, and is not read: a sentence for each."""


class Source(Protocol):
    """A connection that is open. Everything raises `Unreachable`."""

    async def find(self) -> Found:
        """What there is to read. Asked once, before anything is read."""

    async def read(self, wanted: Sequence[int]) -> Sequence[str]:
        """The values of these columns now, as the cells of a log; an empty one: there is no value."""

    async def close(self) -> None:
        """Leaves the controller; raises nothing."""
