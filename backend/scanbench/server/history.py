"""Questions about the past of runs: asked here, answered in job processes, so that no PLC waits for them."""

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, replace
from pathlib import Path

from scanbench.history.contract import Changes, RerunChange, Writer
from scanbench.jobs.client import ANSWER_S, DIED, SLOW, WORK_S, Job, answered
from scanbench.runtime.clock import fresh_token
from scanbench.session.session import Session
from scanbench.store.records import NotFound
from scanbench.wire.events import Comparison, Event, Rerun
from scanbench.wire.refused import Refused
from scanbench.wire.verification import (
    NOW,
    ChangesFound,
    CompareRuns,
    FindChanges,
    FindWriter,
    PastAt,
    RerunDone,
    RerunRun,
    RunsCompared,
    WriterFound,
)

IDLE_S = 120.0
"""So long without a question, and the process that answers them ends."""
COMPARISONS = 20
"""Of an instance, that are kept."""
MOST = 3
"""Comparisons and replays at a time."""
Open = Callable[[Session, str, Path, str], Awaitable[Session]]
"""Makes an instance of a run file: origin, name, file, author."""


@dataclass
class _Comparison:
    session: Session
    changed: Comparison
    job: Job | None


@dataclass
class _Rerun:
    session: Session
    changed: Rerun
    job: Job
    file: Path
    ended: bool = False


class RunHistory:
    """What was asked of the past of all PLCs of a server."""

    def __init__(self, runs: Path, cache: Path, open: Open, answer_s: float = ANSWER_S) -> None:
        self._answer_s, self._answered = answer_s, 0
        self._runs, self._cache, self._open = runs, cache, open
        self._asking: Job | None = None
        self._answers: dict[int, asyncio.Future[object]] = {}
        self._idle: asyncio.TimerHandle | None = None
        self._next = 1
        self._comparisons: dict[int, _Comparison] = {}
        self._reruns: dict[int, _Rerun] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    async def close(self) -> None:
        """Ends every process."""
        if self._idle is not None:
            self._idle.cancel()
        jobs = [
            self._asking,
            *(each.job for each in self._comparisons.values()),
            *(each.job for each in self._reruns.values()),
        ]
        await asyncio.gather(*(job.end() for job in jobs if job is not None))
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def forget_instance(self, instance: int) -> None:
        """Ends what was asked of an instance that goes."""
        for id, each in list(self._comparisons.items()):
            if instance in (each.changed.a, each.changed.b):
                await self.forget(id)
        for id, rerun in list(self._reruns.items()):
            if rerun.session.id == instance:
                rerun.ended = True
                await self._over(id)

    # ---- questions ------------------------------------------------------------------------------------------------

    async def last_writer(self, session: Session, path: str, scan: int | None) -> Writer:
        """Who last wrote a variable before `scan` began, or before what is shown now."""
        state, live, run = session.state, _until(session), str(session.instance.run_file)
        wanted = (state.scan if state.past_by else NOW) if scan is None else scan
        found = await self._ask(lambda ref: FindWriter(ref, run, path.strip(), wanted, live))
        assert isinstance(found, WriterFound)
        if found.writer is None:
            raise Refused(found.message, found.near)
        return found.writer

    async def changes(self, session: Session, first: int, last: int, other: Session | None) -> Changes:
        """What is another at the beginning of `last` than at that of `first`."""
        live = _until(session)
        live_other = 0 if other is None else _until(other)
        run, second = str(session.instance.run_file), "" if other is None else str(other.instance.run_file)
        found = await self._ask(lambda ref: FindChanges(ref, run, first, last, live, second, live_other))
        assert isinstance(found, ChangesFound)
        if found.changes is None:
            raise Refused(found.message)
        return found.changes

    async def _ask(self, make: Callable[[int], object]) -> object:
        if self._asking is None:
            self._asking = Job(self._cache, self._on_answer, self._on_asking_end)
        job = self._asking
        if self._idle is not None:
            self._idle.cancel()
            self._idle = None
        ref = self._number()
        future = self._answers[ref] = asyncio.get_running_loop().create_future()
        job.ask(make(ref))
        try:
            answer = await answered(future, self._answer_s, lambda: self._answered)
        except TimeoutError:
            self._answers.pop(ref, None)
            self._do(job.end())  # what else it was asked is told that it died
            raise Refused(SLOW) from None
        if isinstance(answer, str):
            raise Refused(answer)
        return answer

    def _on_answer(self, message: object) -> None:
        self._answered += 1
        future = self._answers.pop(getattr(message, "ref", 0), None)
        if future is not None and not future.done():
            future.set_result(message)
        if not self._answers and self._idle is None:
            self._idle = asyncio.get_running_loop().call_later(IDLE_S, self._rest)

    def _rest(self) -> None:
        job, self._asking, self._idle = self._asking, None, None
        if job is not None:
            self._do(job.end())

    def _on_asking_end(self, job: Job) -> None:
        if job is not self._asking:
            return
        self._asking = None
        answers, self._answers = self._answers, {}
        for future in answers.values():
            if not future.done():
                future.set_result(DIED)

    # ---- two runs -------------------------------------------------------------------------------------------------

    def comparisons(self, session: Session) -> list[Comparison]:
        """Those of an instance's run with others, the newest first."""
        return [each.changed for each in reversed(self._comparisons.values()) if each.session is session]

    def compare(self, a: Session, b: Session, author: str) -> Comparison:
        """Compares two runs, scan by scan."""
        if a is b:
            raise Refused("a run is the same as itself: choose another instance")
        self._refuse_more()
        mine = [id for id, each in self._comparisons.items() if each.session is a and each.job is None]
        for id in mine[: max(0, len(mine) - COMPARISONS + 1)]:
            del self._comparisons[id]
        id = self._number()
        changed = Comparison(id, a.id, b.id, author)
        job = Job(
            self._cache, lambda message: self._on_compared(id, message), lambda _job: self._on_compare_end(id), WORK_S
        )
        self._comparisons[id] = _Comparison(a, changed, job)
        job.ask(CompareRuns(id, str(a.instance.run_file), str(b.instance.run_file), _until(a), _until(b)))
        return changed

    async def forget(self, id: int) -> None:
        """Cancels one, or forgets what came of it."""
        comparison = self._comparisons.pop(id, None)
        if comparison is None:
            raise NotFound(f"there is no comparison {id}: it was forgotten, or the server has started anew")
        if comparison.job is not None:
            await comparison.job.end()
            comparison.session.tell(replace(comparison.changed, message="cancelled"))

    def _on_compared(self, id: int, message: object) -> None:
        comparison = self._comparisons.get(id)
        if comparison is None:
            return
        match message:
            case PastAt():
                changed = replace(comparison.changed, done=message.done, of=message.of)
            case RunsCompared():
                done = comparison.changed.of if message.divergence is not None else comparison.changed.done
                changed = replace(comparison.changed, done=done, result=message.divergence, message=message.message)
                job, comparison.job = comparison.job, None
                if job is not None:
                    self._do(job.end())
            case _:
                return
        comparison.changed = changed
        comparison.session.tell(changed)

    def _on_compare_end(self, id: int) -> None:
        comparison = self._comparisons.get(id)
        if comparison is not None and comparison.job is not None:
            comparison.job = None
            comparison.changed = replace(comparison.changed, message=DIED)
            comparison.session.tell(comparison.changed)

    # ---- what if --------------------------------------------------------------------------------------------------

    async def rerun(self, session: Session, change: RerunChange, name: str, author: str) -> Rerun:
        """The run once more with one error another, as a new instance in the end."""
        self._refuse_more()
        id = self._number()
        changed = Rerun(id, author, name)
        file = self._runs / f"rerun-{fresh_token()}"
        job = Job(self._cache, lambda message: self._on_rerun(id, message), lambda _job: self._on_rerun_end(id), WORK_S)
        self._reruns[id] = _Rerun(session, changed, job, file)
        job.ask(RerunRun(id, str(session.instance.run_file), str(file), change, _until(session), author))
        return changed

    async def cancel_rerun(self, id: int) -> None:
        """Gives a replay up."""
        rerun = self._reruns.get(id)
        if rerun is None or rerun.ended:
            raise NotFound("this replay is over already")
        rerun.ended = True
        self._tell(rerun, message="cancelled")
        await self._over(id)

    def _on_rerun(self, id: int, message: object) -> None:
        rerun = self._reruns.get(id)
        if rerun is None or rerun.ended:
            return
        match message:
            case PastAt():
                self._tell(rerun, done=message.done, of=message.of)
            case RerunDone():
                rerun.ended = True
                self._do(self._landed(id, rerun, message))

    async def _landed(self, id: int, rerun: _Rerun, done: RerunDone) -> None:
        if not done.ok:
            self._tell(rerun, message=done.message)
        else:
            try:
                made = await self._open(rerun.session, rerun.changed.name, rerun.file, rerun.changed.by)
                self._tell(rerun, done=rerun.changed.of, instance=made.id, refused=done.refused)
            except Exception as error:  # whatever it is, somebody waits for it
                self._tell(rerun, message=f"the replay cannot be opened: {error}")
        await self._over(id)

    def _on_rerun_end(self, id: int) -> None:
        rerun = self._reruns.get(id)
        if rerun is not None and not rerun.ended:
            rerun.ended = True
            self._tell(rerun, message=DIED)
            self._do(self._over(id))

    async def _over(self, id: int) -> None:
        rerun = self._reruns.pop(id, None)
        if rerun is not None:
            await rerun.job.end()
            await asyncio.to_thread(rerun.file.unlink, True)

    def _tell(self, rerun: _Rerun, **changes: object) -> None:
        rerun.changed = replace(rerun.changed, **changes)  # type: ignore[arg-type]  # names and types are its own
        told: Event = rerun.changed
        rerun.session.tell(told)

    # ---- all of them ----------------------------------------------------------------------------------------------

    def _refuse_more(self) -> None:
        running = sum(each.job is not None for each in self._comparisons.values()) + len(self._reruns)
        if running >= MOST:
            raise Refused(f"{running} comparisons and replays go on already: wait for one, or cancel it")

    def _number(self) -> int:
        number, self._next = self._next, self._next + 1
        return number

    def _do(self, work: Awaitable[None]) -> None:
        async def done() -> None:
            await work

        task = asyncio.get_running_loop().create_task(done())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)


def _until(session: Session) -> int:
    """Scans before this one are over; 0 where nobody knows but the run file."""
    state = session.state
    return max(state.scan, state.live_scan) if session.instance.on else 0
