"""Checking and building projects: in a process of its own, so that a long check never delays live values."""

import asyncio
import multiprocessing
import os
import signal
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from scanbench.check.build import PouInfo
from scanbench.check.incremental import Checks
from scanbench.check.program import CheckSite
from scanbench.engines.cache import BlobCache
from scanbench.engines.lifeline import end_with_parent
from scanbench.plcmodel.model import Model
from scanbench.problems import Problem, Severity
from scanbench.session.known import keep, key_of
from scanbench.session.protocol import Previewed, Sources
from scanbench.store.records import ProjectRow

INTERVAL_NS = 10_000_000
"""A scan where no CONFIGURATION says another."""
_NICENESS = 10
_checks = Checks(limit=4)
"""In the child process: what it checked last."""


@dataclass(frozen=True, slots=True)
class CheckOutcome:
    """What a check found."""

    problems: tuple[Problem, ...]
    pous: tuple[PouInfo, ...]
    checks: tuple[CheckSite, ...] = ()
    """Subrange checks that the compiler embedded, or proved needless; none while there are errors."""

    @property
    def errors(self) -> int:
        """How many problems stand in the way of a program."""
        return sum(problem.severity is Severity.ERROR for problem in self.problems)


@dataclass(frozen=True, slots=True)
class Change:
    """What a swap does to the variables of one running PLC."""

    instance: int
    name: str
    previewed: Previewed


@dataclass(frozen=True, slots=True)
class BuildOutcome:
    """What became of a build, and the project after it."""

    ok: bool
    message: str
    found: CheckOutcome
    project: ProjectRow
    changes: tuple[Change, ...] = ()
    needs_agreement: bool = False
    """Nothing was swapped yet: variables would begin anew."""


class Checker:
    """Checks sources in a child process."""

    def __init__(self, cache: Path | None = None) -> None:
        """`cache` is a directory where accepted programs are kept, for hosts to start with."""
        self._cache = cache
        self._pool = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), initializer=_prepare)

    async def check(self, sources: Mapping[str, str], model: Model) -> CheckOutcome:
        """All problems of these sources, and what they declare."""
        loop = asyncio.get_running_loop()
        return await loop.run_in_executor(self._pool, _check, dict(sources), model)

    async def warm(self, model: Model) -> None:
        """Starts the process, and reads the standard library in it, before somebody waits for it."""
        await self.check({"warm.st": "PROGRAM warm\nEND_PROGRAM\n"}, model)

    def keep(self, sources: Sources, model: Model) -> None:
        """Keeps the program of an accepted build, some time soon."""
        if self._cache is not None:
            self._pool.submit(_keep, sources, model, BlobCache(self._cache))

    async def close(self) -> None:
        """Ends the process."""
        await asyncio.to_thread(self._pool.shutdown, cancel_futures=True)


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
