"""Who is at a server of the communication unit, what was asked lately, and what was refused."""

import asyncio
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import ClassVar

from scanbench.comm.door import Door
from scanbench.faults.line_faults import NO_FAULT, LineFault
from scanbench.public import Moment, Public
from scanbench.runtime.clock import monotonic_ns, wall_time

UNANSWERED = "done, without an answer: the fault of the line that was chosen here"
"""What became of a request whose answer is kept from the client."""
ELSEWHERE = "the fault of the line that was chosen here: the PLC has a different node number"
"""Why the request of a client reaches nobody: it may well have asked right."""
FRAMES_KEPT = 50
CLIENTS_KEPT = 64
_WINDOW_NS = 2_000_000_000
_SECOND_NS = 1_000_000_000
_HEX_SHOWN = 48
"""Bytes of a frame that are shown."""


@dataclass(frozen=True, slots=True)
class FrameSeen(Public):
    """A request, and how it was answered."""

    PUBLIC: ClassVar = "CommunicationFrame"

    number: int
    """Counts the requests of a server, from 1."""
    at: Moment
    client: str
    text: str
    """Decoded: `memory area read D100, 3`."""
    outcome: str
    """Empty where it was done and answered; else why not, with the code of the protocol."""
    request: str
    """Bytes in hexadecimal, as many as there is room for."""
    answer: str


@dataclass(frozen=True, slots=True)
class ClientSeen(Public):
    """A client of a server."""

    PUBLIC: ClassVar = "CommunicationClient"

    name: str
    """As commands have it for their author."""
    since: Moment
    requests: int
    refused: int
    last_refused: str
    """Empty: nothing was."""


class LineCut(ConnectionError):
    """The connection ends, without an answer."""


@dataclass(slots=True)
class _Client:
    seen: ClientSeen
    times: int = 1
    """Connections that have this name: some clients do not say which node they are."""


@dataclass(slots=True)
class Desk:
    """Of one server. `make_door` gives a client its door, by name; `on_clients` is called when one comes or goes."""

    make_door: Callable[[str], Door]
    on_clients: Callable[[], None]
    read_only: bool
    fault: LineFault = NO_FAULT
    _clients: dict[str, _Client] = field(default_factory=dict)
    _frames: deque[FrameSeen] = field(default_factory=lambda: deque(maxlen=FRAMES_KEPT))
    _noted: int = 0
    _answered: deque[int] = field(default_factory=lambda: deque(maxlen=1 << 14))

    @property
    def clients(self) -> tuple[ClientSeen, ...]:
        """Who is there, the first first."""
        return tuple(each.seen for each in self._clients.values())

    @property
    def frames(self) -> tuple[FrameSeen, ...]:
        """The last requests, the oldest first."""
        return tuple(self._frames)

    @property
    def per_second(self) -> float:
        """Requests a second, lately."""
        begin = monotonic_ns() - _WINDOW_NS
        while self._answered and self._answered[0] < begin:
            self._answered.popleft()
        return len(self._answered) * _SECOND_NS / _WINDOW_NS

    def before_request(self) -> None:
        """`LineCut` where the line is: then it is not done."""
        if self.fault.kind == "cut":
            raise LineCut

    @property
    def elsewhere(self) -> bool:
        """The PLC is not at the node at which clients look for it."""
        return self.fault.kind == "node"

    async def on_the_way(self, answer: bytes) -> bytes:
        """What comes to the client of an answer, when it comes; empty: nothing."""
        if self.fault.kind == "late":
            await asyncio.sleep(self.fault.late_ms / 1000)
        return b"" if self.fault.kind == "silent" else answer

    def arrive(self, name: str) -> bool:
        """A client is there; false where there is no room for one more."""
        known = self._clients.get(name)
        if known is not None:
            known.times += 1
            return True
        if len(self._clients) >= CLIENTS_KEPT:
            return False
        self._clients[name] = _Client(ClientSeen(name, wall_time(), 0, 0, ""))
        self.on_clients()
        return True

    def leave(self, name: str) -> None:
        """A client is gone."""
        known = self._clients.get(name)
        if known is None:
            return
        known.times -= 1
        if not known.times:
            del self._clients[name]
            self.on_clients()

    def leave_all(self) -> None:
        """The server is closed: nobody is there any more."""
        if self._clients:
            self._clients.clear()
            self.on_clients()

    def note(self, name: str, text: str, outcome: str, request: bytes, answer: bytes) -> None:
        """A request was answered; `outcome` is empty where it was done."""
        self._answered.append(monotonic_ns())
        self._noted += 1
        told = outcome or (UNANSWERED if self.fault.kind == "silent" else "")
        self._frames.append(FrameSeen(self._noted, wall_time(), name, text, told, _shown(request), _shown(answer)))
        client = self._clients.get(name)
        if client is None:
            return
        seen = client.seen
        client.seen = replace(
            seen, requests=seen.requests + 1, refused=seen.refused + bool(outcome),
            last_refused=f"{text}: {outcome}" if outcome else seen.last_refused,
        )  # fmt: skip


def _shown(data: bytes) -> str:
    return data[:_HEX_SHOWN].hex(" ") + (" ..." if len(data) > _HEX_SHOWN else "")
