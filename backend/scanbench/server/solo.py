"""A PLC without a server: of sources that somebody gives, in a folder of its own that goes away with it."""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from scanbench.host.load import Loads
from scanbench.host.run_files import run_path
from scanbench.host.zygote import zygote
from scanbench.jobs.client import SharedJob
from scanbench.plcmodel.model import Model
from scanbench.runtime.clock import wall_time
from scanbench.session.instance import Remembered
from scanbench.session.keeper import NothingKept
from scanbench.session.session import Session
from scanbench.store.records import InstanceRow
from scanbench.wire.host import Driven, Sources
from scanbench.wire.refused import Refused

_SETTLED = ("paused", "halted", "stopped", "trapped", "fatal")


class Solo:
    """One session, with everything around it. `start`, use, `close`."""

    def __init__(self, session: Session, reactions: SharedJob, close: Callable[[], None]) -> None:
        self.session = session
        self._reactions, self._remove = reactions, close

    @staticmethod
    async def start(name: str, sources: Sources, model: Model, speed: float, cache: Path | None = None) -> "Solo":
        """A PLC that waits before its first scan; `Refused` says why there can be none. What is built for it is kept in
        `cache`; without one it is gone with the PLC."""
        solo = await asyncio.to_thread(Solo._make, name, sources, model, speed, cache)
        try:
            await asyncio.to_thread(zygote().start)
            solo.session.instance.start()
            await solo.settled()
        except BaseException:
            await solo.close()
            raise
        return solo

    @staticmethod
    def _make(name: str, sources: Sources, model: Model, speed: float, cache: Path | None) -> "Solo":
        folder = TemporaryDirectory(prefix="scanbench-")
        data = Path(folder.name)
        cache = cache or data / "cache"
        try:
            row, reactions = InstanceRow(1, 1, name, wall_time()), SharedJob(cache)
            memory = Remembered(name, sources, run_path(data, row.id), row.limits, Driven(speed, paused=True))
            session = Session(
                row, model, memory, NothingKept(), rows=(), lines=(), loads=Loads(), reactions=reactions, breakpoints=(),
                traces={}, cache=cache,
            )  # fmt: skip
        except BaseException:
            folder.cleanup()
            raise
        return Solo(session, reactions, folder.cleanup)

    async def settled(self) -> None:
        """Waits until the PLC is there and does not run; `Refused` when it cannot be there."""
        while self.session.state.state not in _SETTLED:
            if self.session.state.state in ("failed", "no_space"):
                raise Refused(self.session.state.message)
            await asyncio.sleep(0.01)

    async def close(self) -> None:
        """Ends the PLC; nothing is left of it."""
        await self.session.stop()
        await self._reactions.close()
        with suppress(OSError):
            await asyncio.to_thread(self._remove)
