"""When a look at the past of one person ends."""

import asyncio
from dataclasses import dataclass, field

import pytest

from scanbench.runtime.clock import wall_time
from scanbench.server.looks import Looks
from scanbench.store.records import InstanceRow, NotFound


@dataclass
class Plc:
    row: InstanceRow
    users: list[str] = field(default_factory=list)

    @property
    def id(self) -> int:
        return self.row.id


def plc(id: int, look: bool = True, users: tuple[str, ...] = ()) -> Plc:
    return Plc(InstanceRow(id, 1, f"line {id}", wall_time(), look=look), list(users))


class Ending:
    """What was ended, and an event for it."""

    def __init__(self) -> None:
        self.ended: list[int] = []
        self.told = asyncio.Event()

    async def end(self, id: int) -> None:
        self.ended.append(id)
        self.told.set()
        if len(self.ended) > 1:
            raise NotFound("somebody was faster")


def test_a_look_that_everybody_left_ends_and_nothing_else() -> None:
    async def scene() -> list[int]:
        ending = Ending()
        looks = Looks(ending.end, 0)
        looks.left(plc(1, look=False))
        looks.left(plc(2, users=("Ada",)))  # Grace went, Ada is there
        looks.left(plc(3))
        await ending.told.wait()
        ending.told.clear()
        looks.left(plc(4))  # ended by hand meanwhile
        await ending.told.wait()
        return ending.ended

    assert asyncio.run(scene()) == [3, 4]


@pytest.mark.parametrize("comes", [True, False])
def test_a_look_waits_for_who_comes_back(comes: bool) -> None:
    async def scene() -> list[int]:
        ending, mine, last = Ending(), plc(1), plc(2)
        looks = Looks(ending.end, 0)
        looks.left(mine)
        if comes:
            looks.came(mine)
        looks.left(last)
        while 2 not in ending.ended:
            await ending.told.wait()
            ending.told.clear()
        await looks.close()
        return ending.ended

    assert asyncio.run(scene()) == ([2] if comes else [1, 2])
