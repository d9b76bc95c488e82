"""Finds out how programs reacted to errors: one job process for all PLCs, ended when nothing was asked for a while."""

import asyncio
from pathlib import Path

from scanbench.faults.reaction.reaction import Reaction
from scanbench.jobs.client import ANSWER_S, DIED, SLOW, Job, answered
from scanbench.wire import jobs as job_protocol

IDLE_S = 60.0
"""So long without a question, and the process ends."""


class Reactions:
    """Answers one question after the other, in the order in which they came."""

    def __init__(self, cache: Path, answer_s: float = ANSWER_S) -> None:
        self._cache, self._answer_s = cache, answer_s
        self._job: Job | None = None
        self._answers: dict[int, asyncio.Future[job_protocol.Reacted]] = {}
        self._next_ref = 1
        self._answered = 0
        self._idle: asyncio.TimerHandle | None = None
        self._closing: set[asyncio.Task[None]] = set()

    async def find(self, run: Path, error: str, scan: int, end: int, window: int) -> Reaction | str:
        """The reaction to an error that was raised before `scan`, or why it cannot be said."""
        if self._job is None:
            self._job = Job(self._cache, self._on_message, self._on_end)
        if self._idle is not None:
            self._idle.cancel()
        ref, self._next_ref = self._next_ref, self._next_ref + 1
        future: asyncio.Future[job_protocol.Reacted] = asyncio.get_running_loop().create_future()
        self._answers[ref] = future
        job = self._job
        job.ask(job_protocol.FindReaction(ref, str(run), error, scan, end, window))
        try:
            answer = await answered(future, self._answer_s, lambda: self._answered)
        except TimeoutError:
            self._answers.pop(ref, None)
            self._end(job)  # what else it was asked is told that it died
            return SLOW
        return answer.message if answer.reaction is None else answer.reaction

    async def close(self) -> None:
        """Ends the process; what is still asked is not answered any more."""
        if self._idle is not None:
            self._idle.cancel()
        job, self._job = self._job, None
        if job is not None:
            await job.end()
        await asyncio.gather(*self._closing, return_exceptions=True)
        self._give_up()

    def _on_message(self, message: object) -> None:
        if isinstance(message, job_protocol.Reacted):
            self._answer(message)
        if not self._answers:
            self._idle = asyncio.get_running_loop().call_later(IDLE_S, self._rest)

    def _answer(self, reacted: job_protocol.Reacted) -> None:
        self._answered += 1
        future = self._answers.pop(reacted.ref, None)
        if future is not None and not future.done():
            future.set_result(reacted)

    def _rest(self) -> None:
        job, self._job = self._job, None
        if job is not None:
            self._end(job)

    def _end(self, job: Job) -> None:
        task = asyncio.get_running_loop().create_task(job.end())
        self._closing.add(task)
        task.add_done_callback(self._closing.discard)

    def _on_end(self, job: Job) -> None:
        """It died: whoever still waits learns it. One that was ended because it rested was not asked any more."""
        if job is not self._job:
            return
        self._job = None
        self._give_up()

    def _give_up(self) -> None:
        for ref in list(self._answers):
            self._answer(job_protocol.Reacted(ref, None, DIED))
