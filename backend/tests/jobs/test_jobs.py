"""Job processes from the parent: one that says nothing, one that dies, one for the questions of all."""

import asyncio
import os
import signal
from pathlib import Path

import pytest

from scanbench.jobs import client
from scanbench.jobs.client import DIED, SLOW, Gone, Job, SharedJob
from scanbench.wire.host import Sources
from scanbench.wire.jobs import FindReaction, JobDone, Reacted, RunSweep
from scanbench.wire.refused import Refused


def question(path: Path) -> client.Make:
    return lambda ref: FindReaction(ref, str(path / "none.run"), "battery-error", 1, 2, 1)


async def ignored(part: object) -> None:
    pass


async def silent(job: client.Job) -> None:
    """Its process is there, and stopped: it says nothing from now on."""
    await job._begun.wait()
    (pid,) = job.pids
    os.kill(pid, signal.SIGSTOP)


def test_a_process_that_says_nothing_is_ended(tmp_path: Path) -> None:
    async def story() -> None:
        ended = asyncio.Event()
        job = Job(tmp_path, ended.set)
        await silent(job)
        with pytest.raises(Gone, match=SLOW[:20]):
            await job.ask(question(tmp_path), Reacted, seconds=0.0)
        await ended.wait()
        assert job.gone
        with pytest.raises(Gone, match=DIED):
            await job.ask(question(tmp_path), Reacted)
        long = Job(tmp_path)  # one that tells how far it is may take its time, and is a fault when it does not
        await silent(long)
        with pytest.raises(Gone, match=DIED):
            await long.ask(lambda ref: RunSweep(ref, Sources("", {}, 1, 1), (), (), 1, ()), JobDone, 0.0, ignored)
        await long.end()

    asyncio.run(story())


def test_a_question_that_is_open_when_it_is_killed(tmp_path: Path) -> None:
    async def story() -> None:
        job = Job(tmp_path)
        with pytest.raises(Refused, match=r"^none\.run"):
            await job.ask(question(tmp_path), Reacted)
        process = job._process
        assert process is not None
        os.kill(process.pid, signal.SIGSTOP)
        asking = asyncio.ensure_future(job.ask(question(tmp_path), Reacted))
        await asyncio.sleep(0)
        os.kill(process.pid, signal.SIGKILL)
        with pytest.raises(Gone, match=DIED):
            await asking
        await job.end()

    asyncio.run(story())


def test_one_for_all_is_started_again_when_it_rests_or_dies(tmp_path: Path) -> None:
    async def story() -> None:
        shared = SharedJob(tmp_path, idle_s=0.0)
        seen = []
        for _ in range(3):
            asking = [asyncio.ensure_future(shared.ask(question(tmp_path), Reacted)) for _ in range(2)]
            for found in await asyncio.gather(*asking, return_exceptions=True):
                assert isinstance(found, Refused)
                assert found.message.startswith("none.run")
            job = shared._job
            assert job is not None
            seen.append(job)
            await asyncio.wait((job._task,))  # it rests at once
        assert len(set(map(id, seen))) == 3
        await shared.close()
        with pytest.raises(Gone):  # nothing is started any more
            await shared.ask(question(tmp_path), Reacted)
        assert shared._job is seen[-1]

    asyncio.run(story())
