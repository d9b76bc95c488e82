"""Checking and building projects: in a process of its own, so that a long check never delays live values."""

import asyncio
import multiprocessing
import os
import signal
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from pathlib import Path

from scanbench.check.incremental import Checks
from scanbench.engines.cache import BlobCache
from scanbench.engines.lifeline import end_with_parent
from scanbench.host.program_cache import keep, key_of
from scanbench.plcmodel.model import Model
from scanbench.wire.events import CheckOutcome
from scanbench.wire.host import Sources
from scanbench.wire.refused import Unavailable

INTERVAL_NS = 10_000_000
"""A scan where no CONFIGURATION says another."""
_NICENESS = 10
_checks = Checks(limit=4)
"""In the child process: what it checked last."""


class Checker:
    """Checks sources in a child process, one project after the other. A process that died or does not answer is replaced."""

    def __init__(self, cache: Path | None = None, deadline_s: float = 60.0, grace_s: float = 3.0) -> None:
        """`cache` is a directory where accepted programs are kept, for hosts to start with."""
        self._cache, self.deadline_s, self._grace_s = cache, deadline_s, grace_s
        self._pool = _new_pool()
        self._turn = asyncio.Lock()

    @property
    def pids(self) -> tuple[int, ...]:
        """The process that checks; none before the first check."""
        return tuple(self._pool._processes)

    async def check(self, sources: Mapping[str, str], model: Model) -> CheckOutcome:
        """All problems of these sources, and what they declare. `Unavailable` when the process does not answer."""
        async with self._turn:  # so that the deadline is for one check, not for those before it
            try:
                return await self._checked(sources, model)
            except BrokenProcessPool:  # it was killed, for want of memory say
                self._renew()
            try:
                return await self._checked(sources, model)
            except BrokenProcessPool as error:
                self._renew()
                raise Unavailable("the process that checks programs died twice: nothing was checked") from error

    async def _checked(self, sources: Mapping[str, str], model: Model) -> CheckOutcome:
        future = asyncio.wrap_future(self._pool.submit(_check, dict(sources), model))
        try:
            return await asyncio.wait_for(future, self.deadline_s)
        except TimeoutError:
            self._renew()
            raise Unavailable(
                f"the process that checks programs has not answered within {self.deadline_s:g} s, and was started anew: "
                "nothing was checked; try again"
            ) from None

    def _renew(self) -> None:
        """Another process, whatever this one does."""
        pool, self._pool = self._pool, _new_pool()
        _kill(pool)
        pool.shutdown(wait=False, cancel_futures=True)

    async def warm(self, model: Model) -> None:
        """Starts the process, and reads the standard library in it, before somebody waits for it."""
        await self.check({"warm.st": "PROGRAM warm\nEND_PROGRAM\n"}, model)

    def keep(self, sources: Sources, model: Model) -> None:
        """Keeps the program of an accepted build, some time soon."""
        if self._cache is not None:
            with suppress(BrokenProcessPool):  # the next check notices; hosts check for themselves what is not kept
                self._pool.submit(_keep, sources, model, BlobCache(self._cache))

    async def close(self) -> None:
        """Ends the process, whatever it does."""
        ended = asyncio.ensure_future(asyncio.to_thread(self._pool.shutdown, cancel_futures=True))
        try:
            await asyncio.wait_for(asyncio.shield(ended), self._grace_s)
        except TimeoutError:
            _kill(self._pool)
            await ended


def _new_pool() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), initializer=_prepare)


def _kill(pool: ProcessPoolExecutor) -> None:
    for process in list((pool._processes or {}).values()):
        process.kill()


def _check(sources: dict[str, str], model: Model) -> CheckOutcome:
    checked = _checks.diagnose(sources, model, INTERVAL_NS)
    return CheckOutcome(checked.problems, checked.pous, checked.checks)


def _keep(sources: Sources, model: Model, cache: BlobCache) -> None:
    """Writes the program from a copy of this process, so that the next check need not wait."""
    program = _checks.check(sources.files, model, sources.interval_ns).program
    if program is None or os.fork():
        return
    try:
        os.nice(_NICENESS)
        keep(cache, key_of(sources, model), program)
    finally:
        os._exit(0)


def _prepare() -> None:
    """The checker ends with its parent, leaves Ctrl-C to it, and does not ask how copies of it ended."""
    end_with_parent()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
