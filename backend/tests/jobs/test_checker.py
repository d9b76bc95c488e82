"""The process that checks programs: frozen, killed, ended."""

import asyncio
import os
import signal
from collections.abc import Awaitable, Callable

import pytest

from scanbench.jobs.checker import Checker
from scanbench.wire.refused import Unavailable
from tests.host.test_zygote import runs, until
from tests.runtime.bench import model

FILES = {"main.st": "PROGRAM Main\n  x := 1;\nEND_PROGRAM\n"}
PLC = model("CJ1M-CPU63")


def checking(story: Callable[[Checker, int], Awaitable[None]]) -> int:
    """Tells a story of a checker that has checked once; the process that did."""

    async def told() -> int:
        checker = Checker()
        try:
            assert (await checker.check(FILES, PLC)).errors == 1
            (pid,) = checker.pids
            await story(checker, pid)
        finally:
            await checker.close()
        return pid

    return asyncio.run(told())


def test_a_frozen_checker_is_given_up_and_the_next_check_works() -> None:
    async def story(checker: Checker, pid: int) -> None:
        os.kill(pid, signal.SIGSTOP)
        patience, checker.deadline_s = checker.deadline_s, 0.1
        with pytest.raises(Unavailable, match="has not answered"):
            await checker.check(FILES, PLC)
        checker.deadline_s = patience
        assert (await checker.check(FILES, PLC)).errors == 1
        assert checker.pids != (pid,)

    pid = checking(story)
    until(lambda: not runs(pid))


def test_a_killed_checker_is_not_noticed() -> None:
    async def story(checker: Checker, pid: int) -> None:
        os.kill(pid, signal.SIGKILL)
        assert (await checker.check(FILES, PLC)).errors == 1

    checking(story)


def test_a_frozen_checker_can_be_ended() -> None:
    async def story(checker: Checker, pid: int) -> None:
        os.kill(pid, signal.SIGSTOP)

    pid = checking(story)
    until(lambda: not runs(pid))
