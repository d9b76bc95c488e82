"""Values for clients: read from the present scan when they ask, and again and again what they have subscribed to."""

import asyncio
import logging
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from typing import cast

from asyncua import ua

from scanbench.comm.opcua.items import Publishing
from scanbench.comm.opcua.link import Link, NotThere
from scanbench.comm.opcua.space import Space, Variable
from scanbench.runtime.clock import wall_time
from scanbench.wire.variables import VariablesAre

log = logging.getLogger("scanbench")
FASTEST_MS, SLOWEST_MS = 50.0, 1000.0
"""Bounds of how often what is subscribed to is read."""
_AT_ONCE = 50
"""Paths that are new to the PLC: each takes it some 40 us."""
_RENEWED_S = 10.0
"""So long a client waits for the nodes of a program that was changed just now."""


class Values:
    """What the PLC has now."""

    def __init__(self, link: Link, space: Space) -> None:
        self._link, self._space = link, space
        self._version = 0
        self._renewed = asyncio.Event()
        self._known: set[str] = set()
        """Paths that the PLC was asked for."""
        self._watched: dict[ua.NodeId, None] = {}
        self._wanted = asyncio.Event()
        self.interval_ms = SLOWEST_MS
        """How often is read what clients have subscribed to: as the fastest of them wants it."""
        self.publishing: Publishing | None = None

    # ---- read once ------------------------------------------------------------------------------------------------

    async def now(self, variables: Sequence[Variable]) -> list[ua.DataValue]:
        """Their values, all of one scan; where the PLC is away bad ones."""
        found = await self._read(variables)
        if isinstance(found, ua.DataValue):
            return [found] * len(variables)
        answer, pieces = found
        at = wall_time()
        return [_shown(each, piece, answer, at) for each, piece in zip(variables, pieces, strict=True)]

    async def _read(
        self, variables: Sequence[Variable]
    ) -> tuple[VariablesAre, list[bytes | None]] | ua.DataValue:  # fmt: skip
        """The answer and the bytes of each; a bad value that holds for all."""
        paths = [each.path for each in variables if each.path]
        while True:
            renewed = self._renewed
            try:
                await self._introduce(paths)
                answer = await self._link.read(paths)
            except NotThere:
                self._known.clear()  # who is there next may know none of them
                return bad(ua.StatusCodes.BadNoCommunication)
            if answer.version == self._version:
                return answer, _pieces(variables, answer)
            try:  # the program was changed, and its nodes are on their way
                async with asyncio.timeout(_RENEWED_S):
                    await renewed.wait()
            except TimeoutError:
                return bad(ua.StatusCodes.BadOutOfService)
            if any(each.path and self._space.variables.get(each.id) is not each for each in variables):
                return bad(ua.StatusCodes.BadNodeIdUnknown)

    async def _introduce(self, paths: Sequence[str]) -> None:
        """Reads paths that are new to the PLC in small pieces first: to find a thousand of them at once would hold up its scans."""
        new = [each for each in paths if each not in self._known]
        if len(new) > _AT_ONCE:
            for at in range(0, len(new), _AT_ONCE):
                await self._link.read(new[at : at + _AT_ONCE])
        self._known.update(new)

    def on_program(self, version: int) -> None:
        """The nodes are those of this version now."""
        self._known.clear()
        self._version = version
        self._renewed.set()
        self._renewed = asyncio.Event()

    # ---- subscriptions --------------------------------------------------------------------------------------------

    def watch(self, ids: Iterable[ua.NodeId]) -> None:
        """From now on these are read again and again, as long as somebody subscribes to them."""
        self._watched.update((each, None) for each in ids)
        self._wanted.set()

    async def go_on(self) -> None:
        """Reads what is subscribed to, for ever."""
        loop = asyncio.get_running_loop()
        due = loop.time()
        while True:
            if not self._watched:
                self._wanted.clear()
                await self._wanted.wait()
                due = loop.time()
            due = max(due + self.interval_ms / 1000, loop.time())
            await asyncio.sleep(due - loop.time())
            found = {id: self._space.variables.get(id) for id in self._watched}
            there = [each for each in found.values() if each is not None and each.watched]
            self._watched = {each.id: None for each in there}
            if there:
                await self.refresh(there)
                if self.publishing is not None:
                    await self.publishing.sampled(loop.time(), self.interval_ms / 1000)

    async def refresh(self, variables: Sequence[Variable]) -> None:
        """Gives their nodes what changed, at once: a client sees all of it as of one scan."""
        found = await self._read(variables)
        at = wall_time()
        for number, each in enumerate(variables):
            if isinstance(found, ua.DataValue):
                await self.give(each, None, found)
                continue
            answer, pieces = found
            piece = pieces[number]
            if each.head is not None or piece is None or piece != each.raw:
                await self.give(each, piece, _shown(each, piece, answer, at))

    async def give(self, variable: Variable, raw: bytes | None, value: ua.DataValue) -> None:
        """Gives a node its value, and tells who has subscribed to it if that is new."""
        attribute, before = variable.attribute, variable.attribute.value
        variable.raw = raw
        if before is not None and before.StatusCode == value.StatusCode and before.Value == value.Value:
            return
        attribute.value = value
        for handle, tell in list(attribute.datachange_callbacks.items()):
            try:
                await tell(handle, value)
            except Exception:  # the others are told, and so is this one of the next value
                log.exception("a subscriber of OPC UA could not be told of %s", variable.path or variable.id.Identifier)


def bad(code: int) -> ua.DataValue:
    """No value, and why."""
    return ua.DataValue(ua.Variant(), ua.StatusCode(ua.UInt32(code)), ServerTimestamp=moment(wall_time()))


def good(value: ua.Variant, at: datetime) -> ua.DataValue:
    """A value, and when it was read."""
    return ua.DataValue(value, SourceTimestamp=moment(at), ServerTimestamp=moment(at))


def moment(at: datetime) -> ua.DateTime:
    """For asyncua, whose own class is only a name."""
    return cast(ua.DateTime, at)


def _pieces(variables: Sequence[Variable], answer: VariablesAre) -> list[bytes | None]:
    """The bytes of each variable; None where there are none."""
    pieces: list[bytes | None] = []
    at = number = 0
    for each in variables:
        if not each.path:
            pieces.append(None)
            continue
        there = answer.there[number]
        number += 1
        pieces.append(answer.data[at : at + each.form.size] if there else None)
        at += each.form.size if there else 0
    return pieces


def _shown(variable: Variable, piece: bytes | None, answer: VariablesAre, at: datetime) -> ua.DataValue:
    if variable.head is not None:
        return good(ua.Variant(variable.head(answer), variable.form.variant), at)
    if piece is None:
        return bad(ua.StatusCodes.BadWaitingForInitialData)
    return good(variable.form.value(piece), at)


def clock_of(answer: VariablesAre) -> datetime:
    """What the PLC's own clock shows."""
    return datetime.fromtimestamp(answer.clock_ns // 1_000_000_000, UTC)
