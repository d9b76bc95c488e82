"""The parent's half of traces: what is kept of them."""

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeVar

import pytest

from scanbench.session.tracing import Tracing
from scanbench.store.records import Json
from scanbench.taps.trace import TraceDefinition
from scanbench.wire.host import Ack
from scanbench.wire.refused import Refused
from scanbench.wire.traces import DefineTrace

A = TypeVar("A")
NEWER: Json = {"definition": {"of": "a newer version"}}
OLD: Json = {"definition": {"name": "T", "signals": ["Main.n"]}}


async def accept(make: Callable[[int], object], answer: type[A]) -> A:
    accepted = Ack(7, True, "", 1)
    assert isinstance(accepted, answer)
    return accepted


def test_a_trace_that_cannot_be_read_is_kept_as_it_is_and_keeps_its_number() -> None:
    kept: list[Mapping[int, Json]] = []
    tracing = Tracing(accept, lambda _: None, kept.append, {1: OLD, 5: NEWER})
    made = asyncio.run(tracing.make(TraceDefinition("U", ("Main.m",)), "Ann", True))
    assert made.id == 6
    asyncio.run(tracing.delete(1, "Ann"))
    asyncio.run(tracing.delete(6, "Ann"))
    assert [sorted(each) for each in kept] == [[1, 5, 6], [5, 6], [5]]
    assert all(each[5] == NEWER for each in kept)
    assert [each.id for each in tracing.traces] == []


def test_of_changes_at_the_same_time_each_one_counts() -> None:
    """Two people, or one who is quick: the host has not answered the first change when the second is asked for."""
    asked: list[DefineTrace] = []

    async def host(make: Callable[[int], object], answer: type[A]) -> A:
        message = make(7)
        assert isinstance(message, DefineTrace)
        asked.append(message)
        await asyncio.sleep(0)
        accepted = Ack(7, message.definition.every != 5, "no", 1)
        assert isinstance(accepted, answer)
        return accepted

    async def both() -> None:
        tracing = Tracing(host, lambda _: None, lambda _: None, {1: OLD})
        changes = (
            tracing.change(1, lambda now: replace(now, every=5), "Ann", True),
            tracing.change(1, lambda now: replace(now, scans=400), "Ann", True),
            tracing.change(1, lambda now: replace(now, signals=(*now.signals, "Main.m")), "Bob", False),
        )
        running = [asyncio.create_task(each) for each in changes]
        with pytest.raises(Refused):
            await running[0]
        await asyncio.gather(*running[1:])
        made = tracing.trace(1).definition
        assert (made.every, made.scans, made.signals) == (1, 400, ("Main.n", "Main.m"))

    asyncio.run(both())
    assert [(each.definition.scans, each.definition.signals) for each in asked] == [
        (30_000, ("Main.n",)), (400, ("Main.n",)), (400, ("Main.n", "Main.m")),
    ]  # fmt: skip


def test_a_change_made_while_a_new_host_is_told_is_not_taken_back() -> None:
    there: dict[int, TraceDefinition] = {}

    async def host(make: Callable[[int], object], answer: type[A]) -> A:
        message = make(7)
        assert isinstance(message, DefineTrace)
        await asyncio.sleep(0)
        there[message.id] = message.definition
        return await accept(make, answer)

    async def both() -> None:
        tracing = Tracing(host, lambda _: None, lambda _: None, {1: OLD, 2: OLD})
        told = asyncio.create_task(tracing.resend())
        await asyncio.sleep(0)
        await tracing.change(2, lambda now: replace(now, scans=400), "Ann", True)
        await told
        assert there[2] == tracing.trace(2).definition
        assert there[2].scans == 400

    asyncio.run(both())
