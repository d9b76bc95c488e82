"""The traces of one PLC, seen from the parent: what people want recorded, and what the host says of it."""

import asyncio
import logging
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from typing import Protocol, TypeVar

from scanbench.store.records import Json, NotFound
from scanbench.taps.trace import TraceDefinition
from scanbench.taps.trace_buffer import Samples
from scanbench.typed import BadValue, make_kept
from scanbench.wire import events
from scanbench.wire import host as protocol
from scanbench.wire.refused import Refused, Unavailable
from scanbench.wire.traces import DefineTrace, DriveTrace, ReadTrace, TraceRead, TracesAre, TraceStatus

log = logging.getLogger("scanbench")
A = TypeVar("A")


class Ask(Protocol):
    """Asks the host; see `Instance.ask`."""

    async def __call__(self, make: Callable[[int], object], answer: type[A], /) -> A: ...


@dataclass(frozen=True, slots=True)
class WantedTrace:
    """What the next host is told, when this one dies or is switched off."""

    definition: TraceDefinition
    by: str = ""
    on: bool = False


class Tracing:
    """Every change is asked of the host; what it accepted is kept."""

    def __init__(
        self, ask: Ask, publish: Callable[[events.Event], None], keep: Callable[[Mapping[int, Json]], None],
        kept: Mapping[int, Json],
    ) -> None:  # fmt: skip
        """`kept` is what an earlier life of the server gave to `keep`. What cannot be read is kept again as it is, and its
        number is not given out, so that the version that made it finds it."""
        self._ask, self._publish, self._keep = ask, publish, keep
        self._wanted = {number: wanted for number, each in kept.items() if (wanted := _read(each)) is not None}
        self._unread = {number: each for number, each in kept.items() if number not in self._wanted}
        self._told: dict[int, TraceStatus] = {}
        self._next = max(kept, default=0) + 1
        self._one_by_one = asyncio.Lock()
        """Held by each change until the host has answered, so that the next one begins with what this one made."""

    @property
    def traces(self) -> tuple[TraceStatus, ...]:
        """All traces, in the order in which they were made; also of a PLC that is off."""
        return tuple(self.trace(number) for number in sorted(self._wanted))

    def trace(self, number: int) -> TraceStatus:
        """One trace; `NotFound`."""
        wanted = self._wanted.get(number)
        if wanted is None:
            raise NotFound(f"there is no trace {number}")
        return self._told.get(number) or TraceStatus(
            number, wanted.definition, wanted.by, "stopped", (), 0, None, 0, 0, 0, 0, 0, 0, "the PLC is not there"
        )

    async def make(self, definition: TraceDefinition, author: str, start: bool) -> TraceStatus:
        """A new trace; `Refused` says why it cannot be."""
        async with self._one_by_one:
            id = max(self._next, max(self._wanted, default=0) + 1)
            await self._define(id, definition, author, start)
            self._next = id + 1
            return self.trace(id)

    async def change(
        self, number: int, changed: Callable[[TraceDefinition], TraceDefinition], author: str, start: bool
    ) -> TraceStatus:
        """`changed` makes the new definition of a trace out of what everybody made of it until now."""
        async with self._one_by_one:
            self.trace(number)
            await self._define(number, changed(self._wanted[number].definition), author, start)
            return self.trace(number)

    async def _define(self, id: int, definition: TraceDefinition, author: str, start: bool) -> None:
        before = self._wanted.get(id)
        self._wanted[id] = WantedTrace(definition, author, start or (before is not None and before.on))
        try:
            await self._accepted(lambda ref: DefineTrace(ref, id, definition, author, start))
        except BaseException:
            if before is None:
                self._wanted.pop(id, None)
            else:
                self._wanted[id] = before
            raise
        self._changed()

    async def drive(self, number: int, action: str, author: str) -> TraceStatus:
        """`start` (or arm again) or `stop`."""
        async with self._one_by_one:
            self.trace(number)
            await self._accepted(lambda ref: DriveTrace(ref, number, action, author))
            self._wanted[number] = replace(self._wanted[number], on=action == "start")
            self._changed()
            return self.trace(number)

    async def delete(self, number: int, author: str) -> None:
        """Forgets a trace with what it recorded; also while the PLC is off."""
        async with self._one_by_one:
            self.trace(number)
            with suppress(Refused, Unavailable):  # it is not there, which is what was wanted
                await self._accepted(lambda ref: DriveTrace(ref, number, "delete", author))
            self._wanted.pop(number, None)
            self._told.pop(number, None)
            self._changed()

    async def read(self, number: int, first: int, last: int | None, points: int | None) -> bytes:
        """Packed samples; see `TraceBuffer.read`."""
        return (await self._read(number, lambda ref: ReadTrace(ref, number, first, last, points))).data

    async def pages(self, number: int, first: int, last: int | None) -> AsyncIterator[tuple[TraceStatus, Samples]]:
        """All samples of these scans, the newest first, as the oldest are forgotten first while they are read; one page at
        least, with what it is of. `Refused` if a different buffer is shown than for the page before."""
        generation: int | None = None
        while True:
            answer = await self._read(number, lambda ref, end=last: ReadTrace(ref, number, first, end, None, page=True))  # type: ignore[misc]
            status, (samples, _, _) = answer.status, Samples.unpack(answer.data)
            assert status is not None
            if generation not in (None, status.generation):
                raise Refused(f"the trace {status.definition.name} has begun again meanwhile: stop it, then try again")
            generation = status.generation
            yield status, samples
            if not len(samples) or samples.scans[0] <= max(first, status.first):
                return
            last = int(samples.scans[0]) - 1

    async def _read(self, number: int, make: Callable[[int], object]) -> TraceRead:
        self.trace(number)
        answer = await self._ask(make, TraceRead)
        if answer.message:
            raise Refused(answer.message)
        return answer

    async def resend(self) -> None:
        """Tells a new host what there is; what cannot be any more says so in its note."""
        async with self._one_by_one:  # else a change made meanwhile would be taken back by what was wanted before
            self._told.clear()
            for number, wanted in self._wanted.items():
                try:
                    await self._accepted(lambda ref, n=number, w=wanted: DefineTrace(ref, n, w.definition, w.by, w.on))  # type: ignore[misc]
                except Refused as error:
                    note = f"it cannot be recorded: {error.message}"
                    self._told[number] = replace(self.trace(number), note=note)
                except Unavailable:
                    return
        self._publish(events.TracesChanged(self.traces))

    def on_message(self, message: object) -> bool:
        """What the host says; whether it was about traces."""
        if not isinstance(message, TracesAre):
            return False
        self._told |= {each.id: each for each in message.traces if each.id in self._wanted}
        self._publish(events.TracesChanged(self.traces))
        return True

    async def _accepted(self, make: Callable[[int], object]) -> None:
        answer = await self._ask(make, protocol.Ack)
        if not answer.ok:
            raise Refused(answer.message, answer.near)

    def _changed(self) -> None:
        self._keep({**self._unread, **{number: _json(wanted) for number, wanted in self._wanted.items()}})
        self._publish(events.TracesChanged(self.traces))


def _json(wanted: WantedTrace) -> Json:
    return asdict(wanted)


def _read(content: Json) -> WantedTrace | None:
    try:
        return make_kept(WantedTrace, content)
    except BadValue as error:
        log.error("a trace that another version of Scanbench kept is left out: %s", error)
        return None
