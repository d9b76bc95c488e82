"""How long an answer of a job process is waited for."""

import asyncio
from pathlib import Path

import pytest

from scanbench.jobs.client import Job, answered


def test_a_question_behind_others_waits_for_them() -> None:
    async def ask() -> str:
        future: asyncio.Future[str] = asyncio.get_running_loop().create_future()
        before = iter(range(5))  # five looks, and each time another question was answered

        def count() -> int:
            number = next(before, None)
            if number is None:
                future.set_result("found")
                return 0
            return number

        return await answered(future, 0.001, count)

    assert asyncio.run(ask()) == "found"


def test_where_nothing_is_answered_it_ends() -> None:
    async def ask() -> None:
        await answered(asyncio.get_running_loop().create_future(), 0.001, lambda: 7)

    with pytest.raises(TimeoutError):
        asyncio.run(ask())


def test_a_process_that_says_nothing_is_ended(tmp_path: Path) -> None:
    async def story() -> bool:
        ended: asyncio.Future[Job] = asyncio.get_running_loop().create_future()
        job = Job(tmp_path, lambda message: None, ended.set_result, silent_s=0.0)
        found = await ended is job
        await job.end()
        return found

    assert asyncio.run(story())
