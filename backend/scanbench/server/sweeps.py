"""Sweeps of a server: every error alone from named states, each sweep in a job process; what it finds is kept as it comes."""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from scanbench.faults.history import Swept, worst
from scanbench.faults.inject import Generate
from scanbench.faults.reaction.compare import SweepChange, compare
from scanbench.faults.reaction.reaction import FINDINGS, Reaction
from scanbench.faults.reference import parse_reference
from scanbench.jobs.client import WORK_S, Gone, Job, Make
from scanbench.jobs.starting import model_of
from scanbench.plcmodel.user_errors import model_for
from scanbench.reports.reaction_json import from_json
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Refusal
from scanbench.server.kept import unreadable
from scanbench.server.states import NOW, States
from scanbench.server.sweep_rows import VERDICTS, cell_of, outcomes_of, rows_of, rows_planned
from scanbench.session.session import Session
from scanbench.store.records import AcceptedRow, CellRow, NotFound, SweepProblem, SweepRow, SweepStatus
from scanbench.store.store import Store
from scanbench.typed import BadValue
from scanbench.wire.events import SweepChanged
from scanbench.wire.host import Sources
from scanbench.wire.jobs import CellFound, JobDone, RunSweep, StartPoint, SweepPlanned, Trying
from scanbench.wire.refused import Refused

log = logging.getLogger("scanbench")
STOPPED_SERVER = "the server was stopped"
_TOLD_EVERY_NS = 250_000_000

OpenState = Callable[[int, Path, str, str], Awaitable[Session]]
"""(project, run file to copy, name, author): a new paused PLC that goes on with it."""


@dataclass(frozen=True, slots=True)
class Whole:
    """A sweep with its cells, and what was accepted of them by (error, state)."""

    row: SweepRow
    cells: tuple[CellRow, ...]
    accepted: Mapping[tuple[str, str], AcceptedRow]


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two sweeps, and what became of each cell."""

    before: SweepRow
    after: SweepRow
    changes: tuple[SweepChange, ...]


@dataclass(slots=True)
class _Running:
    """A sweep under way."""

    row: SweepRow
    job: Job
    began: int
    spent: float
    """Seconds of earlier times."""
    sources: Sources
    cancelled: str = ""
    task: "asyncio.Task[None] | None" = None
    now: str = ""
    fresh: list[CellRow] = field(default_factory=list)
    planned: SweepPlanned | None = None
    """What it raises, as long as that is not kept."""
    told: int = 0
    """When its progress was last reported to everybody."""

    @property
    def seconds(self) -> float:
        """All the time that it took."""
        return self.spent + (monotonic_ns() - self.began) / 1e9

    def hear(self, part: object) -> bool:
        """What the job says before its end; whether it is time to tell everybody."""
        match part:
            case Trying():
                name = next((each.name for each in self.row.errors if each.id == part.error), part.error)
                self.now = f"{name}, {part.point}"
            case CellFound():
                self.fresh.append(cell_of(part))
            case SweepPlanned():
                self.planned = part
                return True
        if monotonic_ns() - self.told < _TOLD_EVERY_NS:
            return False
        self.told = monotonic_ns()
        return True


class Sweeps:
    """Starts and ends with the server."""

    def __init__(
        self, store: Store, states: States, cache: Path, sessions_of: Callable[[int], list[Session]],
        sources_of: Callable[[int, int], Awaitable[Sources | None]], open_state: OpenState,
    ) -> None:  # fmt: skip
        """`sources_of` gives an accepted build of (project, version)."""
        self._store, self._states, self._cache = store, states, cache
        self._sessions_of, self._sources_of, self._open_state = sessions_of, sources_of, open_state
        self._running: dict[int, _Running] = {}
        self._beginning: dict[int, asyncio.Lock] = {}

    async def start(self) -> None:
        """Sweeps that ran when the server went are interrupted: they can be resumed."""
        await asyncio.to_thread(self._store.sweeps.interrupt, STOPPED_SERVER)

    async def close(self) -> None:
        """Ends what runs; it can be resumed."""
        for running in list(self._running.values()):
            await self._stop(running, STOPPED_SERVER)

    # ---- what there is --------------------------------------------------------------------------------------------

    async def of_project(self, project: int) -> list[SweepRow]:
        """The sweeps of a project, the newest first."""
        return list(map(self._live, await asyncio.to_thread(self._store.sweeps.all, project)))

    async def row(self, id: int) -> SweepRow:
        """A sweep without its cells."""
        return self._live(await asyncio.to_thread(self._store.sweeps.get, id))

    async def whole(self, id: int) -> Whole:
        """A sweep with its cells."""
        row = await self.row(id)
        cells = await asyncio.to_thread(self._store.sweeps.cells, id)
        return Whole(row, tuple(cells), await self._accepted(row.project))

    async def reaction(self, id: int, error: str, state: str) -> Reaction:
        """All that was found out about a cell."""
        told = await asyncio.to_thread(self._store.sweeps.reaction, id, error, state)
        if told is None:
            raise NotFound(f"this sweep knows no reaction to {error} from {state}")
        try:
            return from_json(told)
        except BadValue as why:
            raise unreadable(f"the reaction to {error} from {state}", why) from why

    async def compare(self, before: int, after: int) -> Comparison:
        """What became of the cells from one sweep to the other."""
        first, second = await self.whole(before), await self.whole(after)
        kept = [await asyncio.to_thread(self._store.sweeps.reactions, id) for id in (before, after)]
        old, new = outcomes_of(first.cells, kept[0]), outcomes_of(second.cells, kept[1])
        return Comparison(first.row, second.row, compare(old, new))

    async def found(self, project: int) -> dict[int, dict[str, Swept]]:
        """What the newest sweep of each version of a project's program found out, by version and error."""
        newest: dict[int, SweepRow] = {}
        for row in await self.of_project(project):
            if row.status == "done":
                newest.setdefault(row.program_version, row)
        return {version: worst(await self._verdicts(row.id)) for version, row in newest.items()}

    async def _verdicts(self, id: int) -> list[tuple[str, Swept]]:
        cells = await asyncio.to_thread(self._store.sweeps.cells, id)
        found = ((cell, VERDICTS.get(cell.verdict or "")) for cell in cells)
        return [
            (cell.error, Swept(verdict, cell.first_effect, cell.unmet))
            for cell, verdict in found
            if verdict is not None
        ]

    async def show(self, sessions: Sequence[Session]) -> None:
        """Tells PLCs of one project what its sweeps found out. A look at the past is at a time in which they were not."""
        live = [session for session in sessions if not session.row.look]
        found = await self.found(live[0].project_id) if live else {}
        for session in live:
            session.errors.take_sweeps(found)

    async def _accepted(self, project: int) -> dict[tuple[str, str], AcceptedRow]:
        rows = await asyncio.to_thread(self._store.findings.accepted, project)
        return {(row.error, row.state): row for row in rows}

    def _live(self, row: SweepRow) -> SweepRow:
        """With the time that it took until now."""
        running = self._running.get(row.id)
        return row if running is None else replace(row, seconds=running.seconds)

    # ---- what can be done -----------------------------------------------------------------------------------------

    async def begin(
        self, session: Session, errors: Sequence[str] | None, states: Sequence[int], window: int, author: str
    ) -> SweepRow:
        """Begins a sweep of the program that runs; without states from the present state of the PLC."""
        if session.instance.why_not:
            raise Refused(session.instance.why_not)
        project, sources, model = session.project_id, session.instance.sources, session.model
        swept = rows_of(model, errors)
        async with self._beginning.setdefault(project, asyncio.Lock()):
            self._one_at_a_time(project)
            known = {row.id: row for row in await self._states.of_project(project)}
            for state in states:
                if state not in known:
                    raise Refused(f"there is no state {state} in this project")
            kept = [known[state] for state in dict.fromkeys(states)]
            row = await asyncio.to_thread(
                lambda: self._store.sweeps.create(
                    project, instance_id=session.id, instance=session.name, model=model.name,
                    program_version=sources.version, by=author, window=window,
                    states=tuple(state.name for state in kept) or (NOW,), errors=swept,
                )
            )  # fmt: skip
            try:
                if kept:
                    await self._states.give(row, kept)
                else:
                    await self._states.take(session, self._states.of_sweep(row)[NOW], None, author)
                points = await self._points(row)
            except BaseException:
                await self._states.discard(row)
                await asyncio.to_thread(self._store.sweeps.delete, row.id)
                raise
            self._run(row, points, sources, [], [each.name for each in known.values()])
        names = ", ".join(row.states)
        session.log.add(author, f"sweep begun: {len(swept)} error{'s' * (len(swept) != 1)} from {names}")
        return row

    async def resume(self, id: int) -> SweepRow:
        """Goes on with the cells that are missing."""
        row = await self.row(id)
        async with self._beginning.setdefault(row.project, asyncio.Lock()):
            self._one_at_a_time(row.project)
            if row.done == row.total:
                raise Refused("this sweep is done: nothing is missing")
            sources = await self._sources_of(row.project, row.program_version)
            if sources is None:
                raise Refused(f"version {row.program_version} of the program is not kept any more: begin a new sweep")
            points = await self._points(row)
            known = [each.name for each in await self._states.of_project(row.project)]
            cells = await asyncio.to_thread(self._store.sweeps.cells, id)
            change = partial(self._store.sweeps.change, id, status="running", message="", seconds=row.seconds)
            self._run(await asyncio.to_thread(change), points, sources, cells, known)
        return await self.row(id)

    async def cancel(self, id: int) -> SweepRow:
        """Stops a sweep; one that does not run any more stays as it is."""
        running = self._running.get(id)
        if running is not None:
            await self._stop(running, "")
        return await self.row(id)

    async def delete(self, id: int) -> None:
        """Forgets a sweep."""
        row = await self.cancel(id)
        await asyncio.to_thread(self._store.sweeps.delete, id)
        await self._states.discard(row)
        await self.show(self._sessions_of(row.project))

    async def forget_project(self, project: int) -> None:
        """Ends and forgets the sweeps and states of a project that is about to be deleted."""
        async with self._beginning.setdefault(project, asyncio.Lock()):
            for row in await self.of_project(project):
                await self.delete(row.id)
            for state in await self._states.of_project(project):
                await self._states.delete(state.id)

    async def accept(self, id: int, error: str, state: str, reason: str, author: str) -> AcceptedRow:
        """Accepts a finding of this project, for later sweeps too."""
        whole = await self.whole(id)
        cell = next((each for each in whole.cells if (each.error, each.state) == (error, state)), None)
        if cell is not None and cell.unmet and cell.verdict not in FINDINGS:
            raise Refused(f"what is required of {error} from {state} failed: change the program or required.reactions")
        if cell is None or cell.verdict not in FINDINGS:
            raise Refused(f"{error} from {state} is no finding of this sweep: there is nothing to accept")
        made = await asyncio.to_thread(
            lambda: self._store.findings.accept(
                whole.row.project, error=error, state=state, reason=reason.strip(), by=author
            )
        )
        await self._tell(whole.row, self._now(id), [cell])
        return made

    async def withdraw(self, id: int, error: str, state: str) -> None:
        """The finding counts again."""
        whole = await self.whole(id)
        await asyncio.to_thread(lambda: self._store.findings.withdraw(whole.row.project, error=error, state=state))
        cells = [each for each in whole.cells if (each.error, each.state) == (error, state)]
        await self._tell(whole.row, self._now(id), cells)

    async def open(self, id: int, error: str, state: str, name: str, author: str) -> Session:
        """A new PLC in this state with this error raised, paused."""
        row = await self.row(id)
        points = {point.name: point for point in await self._points(row)}
        sources = await self._sources_of(row.project, row.program_version)
        if state not in points or sources is None:
            raise Refused(f"this sweep cannot be opened at {state}: it has no such state, or its program is gone")
        session = await self._open_state(row.project, Path(points[state].run), name, author)
        if replace(session.instance.sources, version=sources.version) != sources:
            ack = await session.build(sources, author)
            if not ack.ok:
                raise Refused(f"{name} was made, but version {sources.version} does not run on it: {ack.message}")
        ref = parse_reference(session.model, error)
        if isinstance(ref, Refusal):
            raise Refused(ref.message, ref.near)
        ack = await session.submit(Generate(author, (ref,)))
        if not ack.ok:
            raise Refused(f"{name} was made, but {error} could not be raised: {ack.message}", ack.near)
        return session

    # ---- running one ----------------------------------------------------------------------------------------------

    def _one_at_a_time(self, project: int) -> None:
        for running in self._running.values():
            if running.row.project == project:
                raise Refused(f"a sweep of this project runs, begun by {running.row.by}: wait for it, or cancel it")

    async def _points(self, row: SweepRow) -> list[StartPoint]:
        files = self._states.of_sweep(row)
        for name, path in files.items():
            if not await asyncio.to_thread(path.exists):
                raise Refused(f"the state {name} of this sweep is gone: begin a new one")
        return [StartPoint(name, str(path)) for name, path in files.items()]

    def _run(
        self, row: SweepRow, points: Sequence[StartPoint], sources: Sources, done: Sequence[CellRow],
        known: Sequence[str],
    ) -> None:  # fmt: skip
        running = self._running[row.id] = _Running(row, Job(self._cache), monotonic_ns(), row.seconds, sources)
        errors, pairs = tuple(each.id for each in row.errors), tuple((cell.error, cell.state) for cell in done)
        running.task = asyncio.get_running_loop().create_task(
            self._follow(
                running, lambda ref: RunSweep(ref, sources, tuple(points), errors, row.window, pairs, tuple(known))
            )
        )

    async def _stop(self, running: _Running, why: str) -> None:
        running.cancelled = why or "cancelled"
        await running.job.end()
        if running.task is not None:
            await asyncio.gather(running.task, return_exceptions=True)

    async def _follow(self, running: _Running, make: Make) -> None:
        """Keeps and tells what comes, until it is over, however it ends."""
        id = running.row.id
        status: SweepStatus = "failed"
        message = "what it found could not be kept: the server's log says why"
        try:
            status, message = await self._hear(running, make)
        except Exception:
            log.exception("sweep %s could not be kept", id)
        finally:
            seconds = running.seconds
            self._running.pop(id, None)
            await running.job.end()
        with suppress(NotFound):  # deleted meanwhile
            change = partial(self._store.sweeps.change, id, status=status, message=message, seconds=seconds)
            over = await asyncio.to_thread(change)
            # Whoever hears of its end finds what it found out at the errors already.
            await self.show(self._sessions_of(over.project))
            await self._tell(over, "", [])

    async def _hear(self, running: _Running, make: Make) -> tuple[SweepStatus, str]:
        """Takes what the job says to its end; how it ended."""

        async def on_part(part: object) -> None:
            if running.hear(part):
                await self._keep(running)

        status: SweepStatus = "done"
        message = ""
        await self._tell(running.row, "", [])
        try:
            await running.job.ask(make, JobDone, WORK_S, on_part)
        except Gone as why:
            status, message = "interrupted", why.message
        except Refused as why:
            status, message = "failed", why.message
        await self._keep(running)
        if running.cancelled and status != "done":
            stopped = running.cancelled == STOPPED_SERVER
            return ("interrupted", STOPPED_SERVER) if stopped else ("cancelled", "")
        return status, message

    async def _keep(self, running: _Running) -> None:
        planned, running.planned = running.planned, None
        if planned is not None:
            running.row = await asyncio.to_thread(_plan, self._store, running, planned)
        fresh, running.fresh = running.fresh, []
        if fresh:
            await asyncio.to_thread(self._store.sweeps.add_cells, running.row.id, fresh)
        await self._tell(await self.row(running.row.id), running.now, fresh)

    async def _tell(self, row: SweepRow, now: str, cells: Sequence[CellRow]) -> None:
        accepted = await self._accepted(row.project) if cells else {}
        for session in self._sessions_of(row.project):
            session.tell(SweepChanged(row, now, tuple(cells), accepted))

    def _now(self, id: int) -> str:
        """What a sweep tries now."""
        running = self._running.get(id)
        return "" if running is None else running.now


def _plan(store: Store, running: _Running, planned: SweepPlanned) -> SweepRow:
    """Keeps what the sweep raises as its rows."""
    model = model_for(model_of(running.sources), running.sources.files)
    problems = [SweepProblem(each.span.line, each.span.column, each.message) for each in planned.problems]
    return store.sweeps.plan(running.row.id, rows_planned(model, running.row.errors, planned.errors), problems)
