"""Questions about the past of runs: asked here, answered in job processes, so that no PLC waits for them."""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Coroutine, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from scanbench.history.contract import Changes, RerunChange, Writer
from scanbench.history.whatif.contract import WhatIf, WhatIfWanted
from scanbench.host.run_files import created
from scanbench.jobs.client import FAULT, Make, SharedJob, alone
from scanbench.runtime.clock import fresh_token
from scanbench.server.going import GoingFiles
from scanbench.session.session import Session
from scanbench.store.records import NotFound
from scanbench.wire.comparisons import Comparison, Rerun
from scanbench.wire.refused import Refused
from scanbench.wire.verification import (
    NOW,
    ChangesFound,
    CompareRuns,
    FindChanges,
    FindWriter,
    MakeScenario,
    PastAt,
    RerunDone,
    RerunRun,
    RunsCompared,
    ScenarioMade,
    WriterFound,
)
from scanbench.wire.whatif import RunWhatIf, WhatIfDone

log = logging.getLogger("scanbench")

IDLE_S = 120.0
"""So long without a question, and the process that answers them ends."""
COMPARISONS = 20
"""Of an instance, that are kept."""
RERUNS = 20
"""Of the server, that are known."""
MOST = 3
"""Comparisons and replays at a time."""
Open = Callable[[Session, str, Path, str], Awaitable[Session]]
"""Makes an instance of a run file: origin, name, file, author."""


@dataclass
class _Comparison:
    session: Session
    changed: Comparison
    runs: tuple[Path, Path]
    untils: tuple[int, int]
    """Scans before these are over, as in `_until`."""
    task: "asyncio.Task[None] | None" = None
    waits: bool = False
    """Whether it is done again after a restart of the server, and not begun yet."""

    @property
    def over(self) -> bool:
        return self.task is None or self.task.done()


@dataclass
class _Rerun:
    session: Session
    changed: Rerun
    file: Path
    task: "asyncio.Task[None] | None" = None


class RunHistory:
    """What was asked of the past of all PLCs of a server."""

    def __init__(self, runs: Path, cache: Path, open: Open) -> None:
        self._runs, self._cache, self._open = runs, cache, open
        self._questions = SharedJob(cache, IDLE_S)
        self._next = 1
        self._comparisons: dict[int, _Comparison] = {}
        self._reruns: dict[int, _Rerun] = {}
        self._begun: dict[int, _Rerun] = {}
        """The last replays, those that are over included."""
        self._tasks: set[asyncio.Task[None]] = set()
        self._trying = 0
        """Questions of what if that are under way."""
        self._taking_up = asyncio.Lock()
        self._going = GoingFiles(runs.with_name("comparisons"))

    async def close(self) -> None:
        """Ends every process."""
        tasks = [each.task for each in self._comparisons.values()] + [each.task for each in self._reruns.values()]
        for task in tasks:
            if task is not None:
                task.cancel()
        await self._questions.close()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        await self._going.close()

    async def take_up(self, sessions: Mapping[int, Session]) -> None:
        """The comparisons that were there when the server ended: they are done again, one after the other."""
        for each in await asyncio.to_thread(lambda: list(self._going.all())):
            self._next = max(self._next, each.id + 1)
            was = each.status
            a, b = (sessions.get(id) for id in (was.a, was.b)) if isinstance(was, Comparison) else (None, None)
            if a is None or b is None:
                self._going.forget(each.id)
                continue
            assert isinstance(was, Comparison)
            more = each.more
            runs, untils = (a.instance.run_file, b.instance.run_file), (int(more["until"]), int(more["other_until"]))
            comparison = self._comparisons[each.id] = _Comparison(a, was, runs, untils, waits=True)
            comparison.task = self._do(self._again(comparison, (more["created"], more["other_created"])))

    async def _again(self, comparison: _Comparison, begun: tuple[str, str]) -> None:
        async with self._taking_up:
            comparison.waits = False
            await self._compare(comparison, begun)

    async def forget_instance(self, instance: int) -> None:
        """Ends what was asked of an instance that goes."""
        for id, each in list(self._comparisons.items()):
            if instance in (each.changed.a, each.changed.b):
                await self.forget(id)
        for id, rerun in list(self._reruns.items()):
            if rerun.session.id == instance and self._reruns.pop(id, None) is not None:
                await _cancelled(rerun.task)
        self._begun = {id: each for id, each in self._begun.items() if each.session.id != instance}

    # ---- questions ------------------------------------------------------------------------------------------------

    async def last_writer(self, session: Session, path: str, scan: int | None) -> Writer:
        """Who last wrote a variable before `scan` began, or before what is shown now."""
        state, live, run = session.state, _until(session), str(session.instance.run_file)
        wanted = (state.scan if state.past_by else NOW) if scan is None else scan
        found = await self._questions.ask(lambda ref: FindWriter(ref, run, path.strip(), wanted, live), WriterFound)
        return found.writer

    async def changes(self, session: Session, first: int, last: int, other: Session | None) -> Changes:
        """The values that differ between the beginnings of the scans `first` and `last`."""
        live = _until(session)
        live_other = 0 if other is None else _until(other)
        run, second = str(session.instance.run_file), "" if other is None else str(other.instance.run_file)
        found = await self._questions.ask(
            lambda ref: FindChanges(ref, run, first, last, live, second, live_other), ChangesFound
        )
        return found.changes

    async def scenario(self, session: Session, scan: int | None) -> str:
        """The scenario file of what people did before `scan`, or so far."""
        live, run = _until(session), str(session.instance.run_file)
        wanted = NOW if scan is None else scan
        return (await self._questions.ask(lambda ref: MakeScenario(ref, run, wanted, live), ScenarioMade)).text

    # ---- two runs -------------------------------------------------------------------------------------------------

    def comparisons(self, session: Session) -> list[Comparison]:
        """Those of an instance's run with others, the newest first."""
        return [each.changed for each in reversed(self._comparisons.values()) if each.session is session]

    def comparison(self, id: int) -> Comparison:
        """How far a comparison is, and what came of it."""
        if id not in self._comparisons:
            raise NotFound(f"there is no comparison {id}: it was forgotten")
        return self._comparisons[id].changed

    def compare(self, a: Session, b: Session, author: str) -> Comparison:
        """Compares two runs, scan by scan."""
        if a is b:
            raise Refused("a run is the same as itself: choose a different instance")
        self._refuse_more()
        mine = [id for id, each in self._comparisons.items() if each.session is a and each.over]
        for id in mine[: max(0, len(mine) - COMPARISONS + 1)]:
            del self._comparisons[id]
            self._going.forget(id)
        id = self._number()
        runs, untils = (a.instance.run_file, b.instance.run_file), (_until(a), _until(b))
        comparison = self._comparisons[id] = _Comparison(a, Comparison(id, a.id, b.id, author), runs, untils)
        comparison.task = self._do(self._compare(comparison))
        _tell(comparison)
        return comparison.changed

    async def _compare(self, comparison: _Comparison, begun: tuple[str, str] | None = None) -> None:
        """`begun`: when the runs were begun that it compared before the server started again."""
        (run, other), (until, other_until) = comparison.runs, comparison.untils
        now = await asyncio.to_thread(lambda: (created(run), created(other)))
        if begun is None:
            more = {"until": str(until), "other_until": str(other_until), "created": now[0], "other_created": now[1]}
            self._going.keep(comparison.changed.id, comparison.changed, more)
        elif begun != now:
            _tell(comparison, message="one of the two runs began again since then: compare them again")
            return

        def make(ref: int) -> CompareRuns:
            return CompareRuns(ref, str(run), str(other), until, other_until)

        async def on_part(part: object) -> None:
            if isinstance(part, PastAt):
                _tell(comparison, done=part.done, of=part.of)

        try:
            found = await alone(self._cache, make, RunsCompared, on_part)
            _tell(comparison, done=comparison.changed.of, result=found.divergence)
        except Refused as why:
            _tell(comparison, message=why.message)
        except Exception:
            log.exception("two runs could not be compared")
            _tell(comparison, message=FAULT)

    async def forget(self, id: int) -> None:
        """Cancels one, or forgets what came of it."""
        comparison = self._comparisons.pop(id, None)
        if comparison is None:
            raise NotFound(f"there is no comparison {id}: it was forgotten")
        self._going.forget(id)
        if not comparison.over:
            await _cancelled(comparison.task)
            _tell(comparison, message="cancelled")

    # ---- what if --------------------------------------------------------------------------------------------------

    async def what_if(self, session: Session, wanted: WhatIfWanted) -> WhatIf:
        """Goes on with the run from a scan with other values; the answer comes when all is tried, within seconds."""
        if self._trying >= MOST:
            raise Refused(f"{self._trying} questions of what if are being tried already: wait for one")
        run, until = str(session.instance.run_file), _until(session)

        async def on_part(part: object) -> None:
            """A try is done."""

        self._trying += 1
        try:
            found = await alone(self._cache, lambda ref: RunWhatIf(ref, run, wanted, until), WhatIfDone, on_part)
        finally:
            self._trying -= 1
        return found.found

    async def rerun(self, session: Session, change: RerunChange, name: str, author: str) -> Rerun:
        """Repeats the run with one error changed, and makes a new instance of it."""
        self._refuse_more()
        id = self._number()
        rerun = self._reruns[id] = _Rerun(session, Rerun(id, author, name), self._runs / f"rerun-{fresh_token()}")
        run, until = str(session.instance.run_file), _until(session)
        self._begun = dict([*self._begun.items(), (id, rerun)][-RERUNS:])
        rerun.task = self._do(
            self._rerun(id, rerun, lambda ref: RerunRun(ref, run, str(rerun.file), change, until, author))
        )
        _tell(rerun)
        return rerun.changed

    def rerun_of(self, id: int) -> Rerun:
        """How far a replay is, and what came of it; the last 20 of the server are known."""
        if id not in self._begun:
            raise NotFound(f"there is no replay {id}: it was forgotten, or the server has started again")
        return self._begun[id].changed

    async def cancel_rerun(self, id: int) -> None:
        """Gives a replay up."""
        rerun = self._reruns.pop(id, None)
        if rerun is None:
            raise NotFound("this replay is over already")
        _tell(rerun, message="cancelled")
        await _cancelled(rerun.task)

    async def _rerun(self, id: int, rerun: _Rerun, make: Make) -> None:
        async def on_part(part: object) -> None:
            if isinstance(part, PastAt):
                _tell(rerun, done=part.done, of=part.of)

        try:
            try:
                done = await alone(self._cache, make, RerunDone, on_part)
            finally:
                self._reruns.pop(id, None)  # from now on it cannot be cancelled
            made = await self._opened(rerun)
            _tell(rerun, done=rerun.changed.of, instance=made.id, refused=done.refused)
        except Refused as why:
            _tell(rerun, message=why.message)
        except Exception:
            log.exception("a run could not be made once more")
            _tell(rerun, message=FAULT)
        finally:
            await asyncio.to_thread(rerun.file.unlink, True)

    async def _opened(self, rerun: _Rerun) -> Session:
        try:
            return await self._open(rerun.session, rerun.changed.name, rerun.file, rerun.changed.by)
        except Exception as error:  # whatever it is, somebody waits for it
            raise Refused(f"the replay cannot be opened: {error}") from error

    # ---- all of them ----------------------------------------------------------------------------------------------

    def _refuse_more(self) -> None:
        running = sum(not each.over and not each.waits for each in self._comparisons.values()) + len(self._reruns)
        if running >= MOST:
            raise Refused(f"{running} comparisons and replays go on already: wait for one, or cancel it")

    def _number(self) -> int:
        number, self._next = self._next, self._next + 1
        return number

    def _do(self, work: Coroutine[None, None, None]) -> "asyncio.Task[None]":
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task


def _tell(asked: _Comparison | _Rerun, **changes: object) -> None:
    asked.changed = replace(asked.changed, **changes)  # type: ignore[arg-type]  # names and types are its own
    asked.session.tell(asked.changed)


async def _cancelled(task: "asyncio.Task[None] | None") -> None:
    if task is not None:
        task.cancel()
        await asyncio.wait((task,))


def _until(session: Session) -> int:
    """Scans before this one are over; 0 where nobody knows but the run file."""
    state = session.state
    return max(state.scan, state.live_scan) if session.instance.on else 0
