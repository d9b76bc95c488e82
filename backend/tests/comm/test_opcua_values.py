"""Values of OPC UA: of whom they are told, and what a PLC is asked for that was away."""

import asyncio
from collections.abc import Sequence
from typing import Any, cast

from asyncua import ua
from asyncua.server.address_space import AttributeValue

from scanbench.comm.opcua.forms import form_of
from scanbench.comm.opcua.ids import own
from scanbench.comm.opcua.link import Link, NotThere
from scanbench.comm.opcua.space import Space, Variable
from scanbench.comm.opcua.values import Values, bad
from scanbench.program.types import ELEMENTARY
from scanbench.wire.variables import VariablesAre


class Away:
    """A link to a PLC that is away at the request `fails`."""

    def __init__(self, fails: int) -> None:
        self.asked: list[int] = []
        self.fails = fails

    async def read(self, paths: Sequence[str]) -> VariablesAre:
        self.asked.append(len(paths))
        if len(self.asked) == self.fails:
            raise NotThere("the PLC is switched off")
        return VariablesAre(0, 1, 0, "RUN", False, 0, bytes([1]) * len(paths), bytes(2 * len(paths)), "")


def variable(number: int) -> Variable:
    form = form_of(ELEMENTARY["INT"])
    assert form is not None
    waiting = AttributeValue(bad(ua.StatusCodes.BadWaitingForInitialData))
    return Variable(own(f"Main.n{number}"), f"Main.n{number}", "INT", form, waiting, True)


def test_a_plc_that_was_away_is_asked_in_small_pieces_again() -> None:
    link = Away(fails=4)
    wanted = [variable(number) for number in range(100)]

    async def story() -> None:
        values = Values(cast(Link, link), Space())
        values.on_program(1)
        for _ in range(3):
            await values.now(wanted)

    asyncio.run(story())
    assert link.asked == [50, 50, 100, 100, 50, 50, 100]


def test_a_subscriber_that_fails_ends_nothing_for_the_others() -> None:
    told: list[Any] = []

    async def fail(_handle: int, _value: ua.DataValue) -> None:
        raise TypeError

    async def tell(_handle: int, value: ua.DataValue) -> None:
        told.append(value.Value)

    async def story() -> None:
        found = variable(1)
        found.attribute.datachange_callbacks.update({1: fail, 2: tell})
        values = Values(cast(Link, Away(fails=0)), Space())
        await values.give(found, b"\1\0", ua.DataValue(ua.Variant(1, ua.VariantType.Int16)))

    asyncio.run(story())
    assert told == [ua.Variant(1, ua.VariantType.Int16)]
