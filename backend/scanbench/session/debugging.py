"""Debugging at one PLC, seen from the parent: the breakpoints that people want, and what the host says of them."""

import logging
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from typing import Protocol, TypeVar

from scanbench.debug.bound_to import Bound
from scanbench.debug.breakpoint import Breakpoint, Verdict
from scanbench.debug.flow_shown import FlowAsked, Flows
from scanbench.store.records import Json
from scanbench.typed import BadValue, make_kept
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import events
from scanbench.wire import host as protocol
from scanbench.wire.debugging import BreakpointsAre, Coverage, CoverageIs, DebugRequest
from scanbench.wire.refused import Refused

log = logging.getLogger("scanbench")
SHARED = ""
"""The group of what all browsers at a PLC share."""
NOT_YET = "the PLC is not there: the breakpoint is set when it is"
A = TypeVar("A")


class Ask(Protocol):
    """Asks the host; see `Session.debug`."""

    async def __call__(self, make: Callable[[int], DebugRequest], answer: type[A], /) -> A: ...


class Debugging:
    """Keeps what has to be told to the next host, when this one dies or is switched off."""

    def __init__(
        self, ask: Ask, publish: Callable[[events.Event], None], keep: Callable[[Sequence[Json]], None],
        kept: Sequence[Json],
    ) -> None:  # fmt: skip
        """`keep` keeps those of the shared list, `kept` is what it was given in an earlier life of the server. What cannot be
        read is kept again as it is, and its number is not given out, so that the version that made it finds it."""
        self._ask, self._publish, self._keep = ask, publish, keep
        read = [(each, breakpoint_of(each)) for each in kept]
        self._unread = [content for content, found in read if found is None]
        self._verdicts = {found.id: Verdict(found, False, NOT_YET) for _, found in read if found is not None}
        self._next = max([*self._verdicts, *map(_id_of, self._unread)], default=0) + 1
        self._coverage: Coverage | None = None

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """All breakpoints of the PLC, in the order in which they were made."""
        return tuple(self._verdicts[id] for id in sorted(self._verdicts))

    @property
    def coverage(self) -> Coverage | None:
        """What was reached, as it was told last; None before the first time."""
        return self._coverage

    async def set_breakpoints(
        self, group: str, kind: str | None, file: str | None, wanted: Sequence[Breakpoint]
    ) -> tuple[Verdict, ...]:
        """These, in place of those that the group has of this kind and file (None is any); what became of each, in order.

        Of a breakpoint with id 0 the id is found: that of the same one before, so that its count goes on, or a new one.
        """
        named = self.named(group, kind, file, wanted)
        for gone in self._of(group, kind, file):
            self._verdicts.pop(gone.id, None)
        for each in named:
            self._verdicts[each.id] = Verdict(each, False, NOT_YET)
        try:
            told = await self._ask(
                lambda ref: debug_protocol.SetBreakpoints(ref, group, kind, file, tuple(named)), BreakpointsAre
            )
            known = {each.breakpoint.id: each for each in told.verdicts if each.breakpoint.id in self._verdicts}
            self._verdicts |= known
        except Refused as why:
            self._verdicts |= {each.id: Verdict(each, False, why.message) for each in named}
        if group == SHARED:
            shared = [asdict(each.breakpoint) for each in self.verdicts if each.breakpoint.group == SHARED]
            self._keep([*shared, *self._unread])
        self._publish(events.BreakpointsChanged(self.verdicts))
        return tuple(self._verdicts.get(each.id) or Verdict(each, False, "taken away meanwhile") for each in named)

    async def forget_group(self, group: str) -> None:
        """The debug session of this group is gone."""
        if any(each.breakpoint.group == group for each in self.verdicts):
            await self.set_breakpoints(group, None, None, ())

    def named(
        self, group: str, kind: str | None, file: str | None, wanted: Sequence[Breakpoint]
    ) -> list[Breakpoint]:  # fmt: skip
        """These with the ids that `set_breakpoints` would give them: a halt may come before it has answered."""
        before = self._of(group, kind, file)
        return [self._named(each, before) for each in wanted]

    def _of(self, group: str, kind: str | None, file: str | None) -> list[Breakpoint]:
        return [each.breakpoint for each in self.verdicts if each.breakpoint.is_of(group, kind, file)]

    def _named(self, wanted: Breakpoint, before: list[Breakpoint]) -> Breakpoint:
        if wanted.id:
            return wanted
        same = next((each for each in before if replace(each, id=0, author=wanted.author) == wanted), None)
        if same is not None:
            before.remove(same)
            return same
        id, self._next = self._next, self._next + 1
        return replace(wanted, id=id)

    # ---- coverage and bindings ------------------------------------------------------------------------------------

    async def cover(self, on: bool, reset: bool, author: str) -> protocol.Ack:
        """Notes which statements are reached from now on, or no longer."""
        return await self._ask(lambda ref: debug_protocol.SetCoverage(ref, on, reset, author), protocol.Ack)

    async def reached(self) -> Coverage:
        """What was reached so far; `Refused` says why nobody knows."""
        return (await self._ask(debug_protocol.WantCoverage, CoverageIs)).coverage

    async def binding(self, path: str) -> Bound:
        """What an in-out is bound to; `Refused` when there is none of this path."""
        return (await self._ask(lambda ref: debug_protocol.WantBinding(ref, path), debug_protocol.BindingIs)).bound

    async def flow(self, asked: FlowAsked) -> Flows:
        """What the code of an instance saw; `Refused` where there is no such instance."""
        return (await self._ask(lambda ref: debug_protocol.WantFlow(ref, asked), debug_protocol.FlowIs)).flows

    # ---- from the host --------------------------------------------------------------------------------------------

    async def resend(self) -> None:
        """Tells a new host process what the last one knew."""
        groups: dict[str, list[Breakpoint]] = {}
        for each in self.verdicts:
            groups.setdefault(each.breakpoint.group, []).append(each.breakpoint)
        for group, wanted in groups.items():
            await self.set_breakpoints(group, None, None, wanted)

    def on_message(self, message: object) -> bool:
        """What the host says by itself; whether it was about debugging."""
        match message:
            case BreakpointsAre():
                found = {each.breakpoint.id: each for each in message.verdicts}
                self._verdicts = {id: found.get(id, each) for id, each in self._verdicts.items()}
                self._publish(events.BreakpointsChanged(self.verdicts))
            case debug_protocol.LogpointSaid():
                self._publish(events.LogpointSaid(message))
            case CoverageIs():
                self._coverage = message.coverage
                self._publish(message.coverage)
            case _:
                return False
        return True


def breakpoint_of(kept: Json) -> Breakpoint | None:
    """A breakpoint as the store has it; None if a different version of Scanbench stored something that this one does not know."""
    try:
        return make_kept(Breakpoint, kept)
    except BadValue as error:
        log.error("a breakpoint that another version of Scanbench kept is left out: %s", error)
        return None


def _id_of(unread: Json) -> int:
    id = unread.get("id")
    return id if isinstance(id, int) else 0
