"""How many verifications there can be, and which ones give way; without processes."""

import asyncio
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Literal, cast

import pytest

from scanbench.server import verifications
from scanbench.server.verifications import Verifications
from scanbench.session.session import Session
from scanbench.store.store import Store
from scanbench.verify.contract import Range
from scanbench.wire.events import Event, StateChanged
from scanbench.wire.host import PlcState
from scanbench.wire.refused import Refused
from scanbench.wire.verifying import VerificationStatus, VerifyWish

RUNNING = PlcState("running", "MONITOR", "", scan=150)


class Plc:
    """As much of a session as is needed."""

    id, name = 1, "line"

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.log = self
        self.state = RUNNING
        self.listeners: list[Callable[[Event], None]] = []

    def add(self, _author: str, text: str) -> None:
        self.lines.append(text)

    def tell(self, event: Event) -> None:
        for each in list(self.listeners):
            each(event)

    def listen(self, listener: Callable[[Event], None]) -> None:
        self.listeners.append(listener)

    def ignore(self, listener: Callable[[Event], None]) -> None:
        self.listeners.remove(listener)


class Fake:
    """A verification that does nothing."""

    def __init__(self, id: int, session: Plc, wanted: VerifyWish, *_: object) -> None:
        self.session, self.runs, self.over = session, True, False
        self.state: Literal["done", "verifying"] = "verifying"
        self.status = VerificationStatus(id, 1, "Ada", wanted, "past", "free", title="whole")

    async def begin(self) -> None:
        self.first = self.session.state.scan

    async def release(self) -> None:
        assert self.over
        self.runs = False

    async def end(self) -> None:
        self.runs = False


def test_those_that_are_over_give_way_to_new_ones(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(verifications, "Verification", Fake)
    plc = Plc()
    session = cast(Session, plc)
    all = Verifications(cast(Store, None), tmp_path, tmp_path)
    made = cast(dict[int, Fake], all._all)  # what is in there is no part of its contract

    async def begin() -> int:
        return (await all.begin(session, VerifyWish(Range(), "free", 0), "Ada")).id

    async def run() -> None:
        for _ in range(verifications.MOST):
            await begin()
        with pytest.raises(Refused, match="end one of them first"):
            await begin()
        made[3].over = made[5].over = True
        eleventh = await begin()
        assert [id for id, each in made.items() if not each.runs] == [3]  # its rows are still there
        made[5].over = made[eleventh].over = True
        while len(made) < verifications.MOST_OPEN:
            made[await begin()].over = True
        assert sum(each.runs for each in made.values()) == verifications.MOST
        await begin()
        assert 3 not in made
        assert "verification 3 is forgotten, as others began: whole" in plc.lines

    asyncio.run(run())


def test_a_plc_that_is_starting_is_waited_for(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A branch tells at once that it is there, and a moment later at which scan it is."""
    monkeypatch.setattr(verifications, "Verification", Fake)
    plc = Plc()
    all = Verifications(cast(Store, None), tmp_path, tmp_path)

    async def run() -> None:
        plc.state = replace(RUNNING, state="starting", scan=0)
        begun = asyncio.create_task(all.begin(cast(Session, plc), VerifyWish(Range(), "free", 100, 120), "Ada"))
        await asyncio.sleep(0)
        assert (len(plc.listeners), len(all._all)) == (1, 0)
        plc.state = RUNNING
        plc.tell(StateChanged(RUNNING))
        made = cast(Fake, all._all[(await begun).id])
        assert (made.first, plc.listeners) == (150, [])
        monkeypatch.setattr(verifications, "STARTING_S", 0.0)
        plc.state = replace(RUNNING, state="starting", scan=0)
        with pytest.raises(Refused, match="still starting"):
            await all.begin(cast(Session, plc), VerifyWish(Range(), "free", 100, 120), "Ada")
        assert not plc.listeners

    asyncio.run(run())
