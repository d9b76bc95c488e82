"""The process that checks programs: frozen, killed, ended."""

import asyncio
import os
import signal
from collections.abc import Awaitable, Callable
from typing import TypeVar

import pytest

from scanbench.jobs.checker import Checker
from scanbench.jobs.client import Gone, Make, SharedJob
from scanbench.wire.events import CheckOutcome
from scanbench.wire.jobs import Check, Checked
from scanbench.wire.refused import Unavailable
from tests.host.test_zygote import runs, until
from tests.runtime.bench import model

A = TypeVar("A")
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


class Dying(SharedJob):
    """A process that dies of one program, with all questions that it was asked."""

    def __init__(self) -> None:
        super().__init__(None)
        self._asked: list[tuple[Check, asyncio.Future[CheckOutcome]]] = []

    async def ask(self, make: Make, answer: type[A], seconds: float = 0.0) -> A:
        """Answers in a moment."""
        question = make(1)
        assert isinstance(question, Check)
        loop = asyncio.get_running_loop()
        future: asyncio.Future[CheckOutcome] = loop.create_future()
        self._asked.append((question, future))
        loop.call_soon(self._serve)
        found = Checked(1, await future)
        assert isinstance(found, answer)
        return found

    def _serve(self) -> None:
        if not self._asked:
            return
        question, future = self._asked.pop(0)
        if "poison.st" not in question.sources.files:
            future.set_result(CheckOutcome((), (), ()))
            return
        for _, each in [(question, future), *self._asked]:
            each.set_exception(Gone("it died"))
        self._asked.clear()


def test_a_program_that_the_process_dies_of_takes_no_other_check_along() -> None:
    async def story() -> None:
        checker = Checker()
        checker._job = Dying()
        fatal, fine = await asyncio.gather(
            checker.check({"poison.st": ""}, PLC), checker.check(FILES, PLC), return_exceptions=True
        )
        assert isinstance(fatal, Unavailable)
        assert isinstance(fine, CheckOutcome)

    asyncio.run(story())
