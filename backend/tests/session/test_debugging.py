"""The parent's half of breakpoints: who has which, what is kept, and what a new host is told."""

import asyncio
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import TypeVar

from scanbench.debug.breakpoint import Breakpoint, Verdict
from scanbench.session.debugging import Debugging
from scanbench.store.records import Json
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import events
from scanbench.wire.debugging import BreakpointsAre, DebugRequest, SetBreakpoints
from scanbench.wire.refused import Refused

A = TypeVar("A")


class Host:
    """Verifies everything, while it is there."""

    def __init__(self) -> None:
        self.told: list[SetBreakpoints] = []
        self.away = False

    async def ask(self, make: Callable[[int], DebugRequest], answer: type[A]) -> A:
        if self.away:
            raise Refused("the PLC is off: switch it on first")
        request = make(7)
        assert isinstance(request, SetBreakpoints)
        self.told.append(request)
        found = BreakpointsAre(7, tuple(Verdict(each, True, "", each.line) for each in request.breakpoints))
        assert isinstance(found, answer)
        return found


class Bench:
    def __init__(self, kept: Sequence[Json] = ()) -> None:
        self.host = Host()
        self.published: list[events.Event] = []
        self.kept: list[Sequence[Json]] = []
        self.debugging = Debugging(self.host.ask, self.published.append, self.kept.append, kept)

    def set(self, *lines: int, group: str = "", file: str = "Main.st", author: str = "Ann") -> list[Verdict]:
        wanted = [Breakpoint(0, "line", author, group=group, file=file, line=line) for line in lines]
        return list(asyncio.run(self.debugging.set_breakpoints(group, "line", file, wanted)))


def test_the_same_breakpoint_keeps_its_number_and_its_author() -> None:
    bench = Bench()
    first = bench.set(3, 5)
    again = bench.set(5, 9, author="Bob")
    assert [each.breakpoint.id for each in again] == [first[1].breakpoint.id, 3]
    assert [each.breakpoint.author for each in again] == ["Ann", "Bob"]
    assert [each.breakpoint.line for each in bench.debugging.verdicts] == [5, 9]


def test_a_group_and_a_file_are_replaced_alone() -> None:
    bench = Bench()
    bench.set(3)
    bench.set(4, file="Belt.st")
    bench.set(8, group="vscode")
    bench.set(7)
    assert {(each.breakpoint.file, each.breakpoint.line) for each in bench.debugging.verdicts} == {
        ("Main.st", 7), ("Belt.st", 4), ("Main.st", 8),
    }  # fmt: skip
    asyncio.run(bench.debugging.forget_group("vscode"))
    assert all(each.breakpoint.group == "" for each in bench.debugging.verdicts)
    assert [[each["line"] for each in kept] for kept in bench.kept] == [[3], [3, 4], [4, 7]]  # the shared ones alone


def test_what_is_set_while_the_plc_is_away_is_told_to_the_next_host() -> None:
    bench = Bench([asdict(Breakpoint(4, "line", "Ann", file="Main.st", line=2))])
    bench.host.away = True
    (verdict,) = bench.set(6, file="Belt.st")
    assert not verdict.verified
    assert "switch it on" in verdict.message
    assert verdict.breakpoint.id == 5
    bench.host.away = False
    asyncio.run(bench.debugging.resend())
    (told,) = bench.host.told
    assert [(each.id, each.line) for each in told.breakpoints] == [(4, 2), (5, 6)]
    assert all(each.verified for each in bench.debugging.verdicts)


def test_a_breakpoint_that_cannot_be_read_is_kept_as_it_is_and_keeps_its_number() -> None:
    newer: Json = {"id": 8, "kind": "of a newer version", "author": "Ann"}
    bench = Bench([newer, asdict(Breakpoint(4, "line", "Ann", file="Main.st", line=2)), {"of": "a newer version"}])
    assert [each.breakpoint.id for each in bench.debugging.verdicts] == [4]
    (verdict,) = bench.set(3)
    assert verdict.breakpoint.id == 9
    bench.set()
    first, last = bench.kept
    assert first == [asdict(verdict.breakpoint), newer, {"of": "a newer version"}]
    assert last == [newer, {"of": "a newer version"}]


def test_counts_of_the_host_are_told_to_everybody() -> None:
    bench = Bench()
    (verdict,) = bench.set(3)
    bench.debugging.on_message(BreakpointsAre(None, (Verdict(verdict.breakpoint, True, "", 3, hits=12),)))
    last = bench.published[-1]
    assert isinstance(last, events.BreakpointsChanged)
    assert [each.hits for each in last.verdicts] == [12]
    bench.debugging.on_message(debug_protocol.LogpointSaid(1, "speed is 3", 44, "Main.st", 3))
    assert isinstance(bench.published[-1], events.LogpointSaid)
