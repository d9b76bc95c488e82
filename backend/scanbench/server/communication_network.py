"""The network between the PLCs of this server: what one program asks of another PLC by SEND, RECV and CMND, over FINS.

A PLC is there for others while its FINS server is on, at that server's node; what is asked goes the way of any client, so it is in the
list of frames, has the rights of that server, and meets the faults of its line and of one's own. Nothing comes back from a PLC that is off: then
the instruction ends by its own time.
"""

import asyncio
import logging
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass

from scanbench.comm.desk import Desk, LineCut
from scanbench.comm.fins import ask
from scanbench.comm.fins.areas import swapped
from scanbench.comm.fins.codes import End
from scanbench.comm.fins.frame import parse
from scanbench.comm.fins.service import Answering
from scanbench.faults.network import NO_AREA, NetworkAnswer, NetworkRequest
from scanbench.session.session import Session
from scanbench.wire.refused import Refused, Unavailable

log = logging.getLogger("scanbench")
NOT_ON, NO_NODE, TWICE, NO_ROUTE, RESPONSE_TOO_LONG = 0x0101, 0x0201, 0x0106, 0x0502, 0x110B
"""Completion codes (W342, section 5-1-3; K-H): one's own node is not in the network; nor is the other; two have the same node; another network,
to which there are no routing tables; the response does not fit."""
_READ, _WRITE = 0x0101, 0x0102


@dataclass(frozen=True, slots=True)
class Member:
    """A PLC that has FINS. `desk` is None while its server is off."""

    session: Session
    node: int
    error_bits: bool
    desk: Desk | None

    @property
    def elsewhere(self) -> bool:
        """It is not at its node now."""
        return self.desk is not None and self.desk.elsewhere


class _Silent(Exception):
    """Nothing comes back."""


class PlcNetwork:
    """Of all PLCs of this server."""

    def __init__(self, members: Callable[[], Sequence[Member]]) -> None:
        self._members = members
        self._tasks: set[asyncio.Task[None]] = set()
        self._shown: list[tuple[int, Desk, str]] = []
        self._numbers = 0

    def begin(self, session: Session) -> None:
        """A PLC is there."""
        session.on_network = lambda request, scan: self._ask(session, request, scan)

    def end(self, session: Session) -> None:
        """A PLC is gone: others do not see it as their client any more."""
        session.on_network = None
        gone = [each for each in self._shown if each[0] == session.id]
        self._shown = [each for each in self._shown if each[0] != session.id]
        for _, desk, name in gone:
            desk.leave(name)

    async def close(self) -> None:
        """Nobody is answered any more."""
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    def _ask(self, session: Session, request: NetworkRequest, scan: int) -> None:
        if request.fails:  # it ends by itself
            return
        task = asyncio.get_running_loop().create_task(self._exchange(session, request, scan))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _exchange(self, session: Session, request: NetworkRequest, scan: int) -> None:
        author = f"FINS, node {request.node}"
        try:
            end, data = await self._answer(session, request)
        except (_Silent, LineCut):
            if request.answered:
                return
            end, data = 0, b""
        except Exception:
            log.exception("%s: %s could not be done", session.name, request.instruction)
            return
        with suppress(Refused, Unavailable):
            await session.instance.submit(NetworkAnswer(author, request.port, scan, end, data))

    async def _answer(self, session: Session, request: NetworkRequest) -> tuple[int, bytes]:
        """The completion code, and what is to be written."""
        members = self._members()
        own = next((each for each in members if each.session is session), None)
        if own is None or own.desk is None:
            return NOT_ON, b""
        if request.network:
            return NO_ROUTE, b""
        found = [each for each in members if each.node == request.node and not each.elsewhere]
        there = [each for each in found if each.desk is not None] or found[:1]
        if len(there) != 1:
            return (TWICE if there else NO_NODE), b""
        made = _frame_of(session, request)
        if made is None:
            return NO_AREA, b""
        if not await own.desk.on_the_way(b"\0") or own.desk.fault.kind in ("cut", "node"):
            raise _Silent
        frame = await self._sent(own, there[0], request, *made)
        if not request.answered:
            return 0, b""
        return _result(request, frame[0], frame[1])

    async def _sent(
        self, own: Member, other: Member, request: NetworkRequest, command: int, body: bytes
    ) -> tuple[bytes, bytes]:
        """What was sent, and what came back; empty where no answer is wanted."""
        desk = other.desk
        if desk is None:
            raise _Silent
        self._numbers += 1
        to, source = ask.Address(0, request.node, request.unit), ask.Address(0, own.node)
        frame = ask.request(command, body, to, source, self._numbers, request.answered)
        parsed, name = parse(frame), f"FINS {own.session.name}, node {own.node}"
        assert parsed is not None
        if all(each.name != name for each in desk.clients) and desk.arrive(name):
            self._shown.append((own.session.id, desk, name))
        answered = await Answering(desk, other.error_bits).answer(name, desk.make_door(name), parsed, frame)
        if request.answered and not answered:
            raise _Silent
        return frame, answered


def _frame_of(session: Session, request: NetworkRequest) -> tuple[int, bytes] | None:
    """Command and parameters; None where FINS has no such memory."""
    if request.instruction == "CMND":
        return int.from_bytes(request.data[:2], "big"), request.data[2:]
    area = session.model.area(request.area)
    if area is None:
        return None
    name = area.written if area.first else area.name
    try:
        if request.instruction == "RECV":
            return _READ, ask.read_words(name, area.first + request.word, request.count)
        return _WRITE, ask.write_words(name, area.first + request.word, request.data)
    except ValueError:
        return None


def _result(request: NetworkRequest, frame: bytes, answered: bytes) -> tuple[int, bytes]:
    answer = ask.answer_to(frame, answered)
    if answer.end == End.SERVICE_BUSY:  # it is switched off, or starts
        raise _Silent
    if request.instruction == "CMND":
        response = answered[10:]
        if len(response) > request.count:
            return RESPONSE_TOO_LONG, b""
        return answer.end, swapped(response + b"\0" * (len(response) % 2))
    if answer.end or request.instruction == "SEND":
        return answer.end, b""
    return 0, ask.words_of(answer, request.count)
