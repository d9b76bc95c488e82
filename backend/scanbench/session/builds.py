"""Checking and building projects: in a process of its own, so that a long check never delays live values."""

import asyncio
import ctypes
import multiprocessing
import signal
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

from scanbench.check.build import PouInfo, check_sources
from scanbench.plcmodel.model import Model
from scanbench.problems import Problem, Severity
from scanbench.store.records import ProjectRow

INTERVAL_NS = 10_000_000
"""A scan where no CONFIGURATION says another."""


@dataclass(frozen=True, slots=True)
class CheckOutcome:
    """What a check found."""

    problems: tuple[Problem, ...]
    pous: tuple[PouInfo, ...]

    @property
    def errors(self) -> int:
        """How many problems stand in the way of a program."""
        return sum(problem.severity is Severity.ERROR for problem in self.problems)


@dataclass(frozen=True, slots=True)
class BuildOutcome:
    """What became of a build, and the project after it."""

    ok: bool
    message: str
    found: CheckOutcome
    project: ProjectRow


class Checker:
    """Checks sources in a child process."""

    def __init__(self) -> None:
        self._pool = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), initializer=_prepare)

    async def check(self, sources: Mapping[str, str], model: Model) -> CheckOutcome:
        """All problems of these sources, and what they declare."""
        loop = asyncio.get_running_loop()
        return await loop.run_in_executor(self._pool, _check, dict(sources), model)

    async def warm(self, model: Model) -> None:
        """Starts the process, and reads the standard library in it, before somebody waits for it."""
        await self.check({"warm.st": "PROGRAM warm\nEND_PROGRAM\n"}, model)

    async def close(self) -> None:
        """Ends the process."""
        await asyncio.to_thread(self._pool.shutdown, cancel_futures=True)


def _check(sources: dict[str, str], model: Model) -> CheckOutcome:
    checked = check_sources(sources, model, INTERVAL_NS)
    return CheckOutcome(checked.problems, checked.pous)


def _prepare() -> None:
    """The checker ends with its parent, and leaves Ctrl-C to it."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
