"""The parent's half of traces: what is kept of them."""

import asyncio
from collections.abc import Callable, Mapping
from typing import TypeVar

from scanbench.session.tracing import Tracing
from scanbench.store.records import Json
from scanbench.taps.trace import TraceDefinition
from scanbench.wire.host import Ack

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
    made = asyncio.run(tracing.define(None, TraceDefinition("U", ("Main.m",)), "Ann", True))
    assert made.id == 6
    asyncio.run(tracing.delete(1, "Ann"))
    asyncio.run(tracing.delete(6, "Ann"))
    assert [sorted(each) for each in kept] == [[1, 5, 6], [5, 6], [5]]
    assert all(each[5] == NEWER for each in kept)
    assert [each.id for each in tracing.traces] == []
