"""A PLC's process that falls silent: it is shown, nothing waits for it, it goes on, and it can always be ended."""

import asyncio
import os
import signal
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from scanbench.runtime.write import Write
from scanbench.session.instance import Instance, Patience, Remembered
from scanbench.store.records import Limits
from scanbench.wire.host import PlcState
from scanbench.wire.refused import Unavailable
from tests.host.test_zygote import PATIENCE_S, runs, sources

QUICK = Patience(look_s=0.1, looks=3, grace_s=0.2)


@dataclass
class Plc:
    """An instance, and what it told of its state."""

    path: Path
    patience: Patience = QUICK
    states: list[PlcState] = field(default_factory=list)
    instance: Instance = field(init=False)

    def __post_init__(self) -> None:
        self._told = asyncio.Event()
        memory = Remembered("line", sources(), self.path / "line.run", Limits())
        self.instance = Instance(memory, self._on_state, lambda _: None, self.path / "cache", self.patience)

    def _on_state(self, state: PlcState) -> None:
        self.states.append(state)
        self._told.set()

    async def until(self, holds: Callable[[PlcState], bool]) -> PlcState:
        async with asyncio.timeout(PATIENCE_S):
            while not holds(self.instance.state):
                self._told.clear()
                await self._told.wait()
        return self.instance.state

    async def running(self) -> int:
        """Its process."""
        self.instance.start()
        state = await self.until(lambda state: state.state == "running")
        assert state.pid is not None
        return state.pid


WRITE = Write("Ada", "Main.n", "7")


def test_a_frozen_process_is_shown_and_goes_on_by_itself(tmp_path: Path) -> None:
    async def story() -> None:
        plc = Plc(tmp_path)
        pid = await plc.running()
        os.kill(pid, signal.SIGSTOP)
        asked = asyncio.ensure_future(plc.instance.submit(WRITE))
        silent = await plc.until(lambda state: state.state == "silent")
        assert "does not answer" in silent.message
        with pytest.raises(Unavailable, match="not been confirmed"):
            await asked
        with pytest.raises(Unavailable, match="nothing was changed"):
            await plc.instance.submit(WRITE)
        os.kill(pid, signal.SIGCONT)
        again = await plc.until(lambda state: state.state == "running")
        assert (again.pid, again.restarts) == (pid, 0)
        while not await _written(plc):  # a loaded machine may take long for an answer
            pass
        await plc.instance.stop()

    asyncio.run(story())


async def _written(plc: Plc) -> bool:
    try:
        return (await plc.instance.submit(WRITE)).ok
    except Unavailable:
        await plc.until(lambda state: state.state == "running")
        return False


def test_a_frozen_process_can_be_ended(tmp_path: Path) -> None:
    async def story() -> int:
        plc = Plc(tmp_path)
        pid = await plc.running()
        os.kill(pid, signal.SIGSTOP)
        await plc.instance.stop()
        assert plc.instance.state.state == "off"
        return pid

    assert not runs(asyncio.run(story()))


def test_an_answer_has_a_deadline_also_where_the_process_lives(tmp_path: Path) -> None:
    async def story() -> None:
        plc = Plc(tmp_path, Patience(answer_s=0.0))
        await plc.running()
        with pytest.raises(Unavailable, match="has not answered this within 0 s"):
            await plc.instance.submit(WRITE)
        await plc.instance.stop()

    asyncio.run(story())
