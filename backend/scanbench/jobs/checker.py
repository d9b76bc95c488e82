"""Checking projects: in a process of its own, so that a long check never delays live values."""

import asyncio
import logging
from collections.abc import Mapping
from functools import partial
from pathlib import Path

from scanbench.host.zygote import CHECK
from scanbench.jobs.client import Gone, SharedJob, Slow
from scanbench.plcmodel.model import Model
from scanbench.wire.events import CheckOutcome
from scanbench.wire.host import Sources
from scanbench.wire.jobs import Check, Checked, KeepProgram
from scanbench.wire.refused import Unavailable

log = logging.getLogger("scanbench")
INTERVAL_NS = 10_000_000
"""The interval of a scan if no CONFIGURATION has one."""


class Checker:
    """Checks sources, one project after the other. A process that died or does not answer is replaced."""

    def __init__(self, cache: Path | None = None, deadline_s: float = 60.0) -> None:
        """`cache` is a directory where accepted programs are kept, for hosts to start with."""
        self._job = SharedJob(cache, None, CHECK)
        self._turn = asyncio.Lock()
        self.deadline_s = deadline_s

    @property
    def pids(self) -> tuple[int, ...]:
        """The process that checks; none before the first check."""
        return self._job.pids

    async def check(self, sources: Mapping[str, str], model: Model, numbers: bool = False) -> CheckOutcome:
        """All problems of these sources, and what they declare; with `numbers` those that the program raises errors with.
        `Unavailable` when the process does not answer."""
        wanted = Sources(model.name, dict(sources), INTERVAL_NS, 0)
        async with self._turn:  # a program that its process dies of is nobody else's trouble
            return await self._checked(wanted, numbers)

    async def _checked(self, wanted: Sources, numbers: bool) -> CheckOutcome:
        for _ in range(2):
            try:
                question = partial(Check, sources=wanted, numbers=numbers)
                return (await self._job.ask(question, Checked, self.deadline_s)).outcome
            except Slow as error:
                raise Unavailable(
                    f"the process that checks programs has not answered within {self.deadline_s:g} s, and was started again: "
                    "nothing was checked; try again"
                ) from error
            except Gone as error:
                if self._job.closed:
                    raise Unavailable("nothing was checked: the server ends") from error
                log.warning("the process that checks programs died: another one is started")  # for want of memory, say
        raise Unavailable("the process that checks programs died twice: nothing was checked")

    async def warm(self, model: Model) -> None:
        """Starts the process, and reads the standard library in it, before somebody waits for it."""
        await self.check({"warm.st": "PROGRAM warm\nEND_PROGRAM\n"}, model)

    def keep(self, sources: Sources) -> None:
        """Keeps the program of an accepted build, some time soon; hosts check for themselves what is not kept."""
        self._job.tell(KeepProgram(sources))

    async def close(self) -> None:
        """Ends the process, whatever it does."""
        await self._job.close()
