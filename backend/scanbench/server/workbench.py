"""Everything a server has: models, projects, and a session for every instance."""

import asyncio
import logging
import os
import shutil
from collections.abc import Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path

from scanbench import __version__
from scanbench.host.load import Loads
from scanbench.host.run_files import discard, discard_all, fresh_path, run_path, sources_and_damage, sweep
from scanbench.host.zygote import zygote
from scanbench.jobs.checker import Checker
from scanbench.jobs.client import SharedJob
from scanbench.plcmodel.load import load_all, model_directory
from scanbench.plcmodel.model import Model
from scanbench.recording.reader import Unreadable
from scanbench.runtime.clock import monotonic_ns
from scanbench.server.campaigns import Campaigns
from scanbench.server.communication import Communication
from scanbench.server.history import RunHistory
from scanbench.server.looks import Looks
from scanbench.server.missing import stand_in, why_missing
from scanbench.server.people import People
from scanbench.server.projects import Projects
from scanbench.server.repositories import Repositories
from scanbench.server.samples import samples
from scanbench.server.states import States
from scanbench.server.sweeps import Sweeps
from scanbench.server.test_records import Records
from scanbench.server.trace_records import TraceRecords
from scanbench.server.uploads import TraceFiles
from scanbench.server.verifications import Verifications
from scanbench.server.watch_lists import WatchLists
from scanbench.server.write_behind import LOG_KEPT, WriteBehind, line_of, row_of
from scanbench.session.instance import Remembered
from scanbench.session.log import LOG_LINES
from scanbench.session.session import Session
from scanbench.store.records import InstanceRow, Limits, NotFound, ProjectRow
from scanbench.store.store import Store
from scanbench.wire.events import InstanceDeleted
from scanbench.wire.host import Driven
from scanbench.wire.log import LogPage
from scanbench.wire.refused import Refused, Unavailable

log = logging.getLogger("scanbench")
_LOOK_NS = 2_000_000_000


class Workbench:
    """Starts and ends with the server."""

    def __init__(self, store: Store, data: Path) -> None:
        """`data` is a directory: runs are recorded in `runs`, programs and their code are kept in `cache`."""
        self._store, self._cache, self._runs = store, data / "cache", data / "runs"
        self._runs.mkdir(parents=True, exist_ok=True)
        models, self._model_problems = load_all(model_directory())
        for problem in self._model_problems:
            log.error("%s", problem)
        self.models: Mapping[str, Model] = {model.name: model for model in models}
        self._checker = Checker(self._cache)
        self._write_behind = WriteBehind(store)
        self._sessions: dict[int, Session] = {}
        self._loads, self._looked_at = Loads(), 0
        self._warming: asyncio.Task[None] | None = None
        self.projects = Projects(store, self.models, self._checker, self._sessions_of)
        self.people = People(store.people.colour)
        self.looks = Looks(self.delete_instance)
        self.repositories = Repositories(store, data / "projects")
        self._reactions = SharedJob(self._cache)
        self.records = Records(store, self._write_behind, f"Scanbench {__version__}")
        self.communication = Communication(store, data, self.projects.modbus_map)
        self.watch_lists = WatchLists(store, self._sessions_of)
        self.states = States(store, data / "states")
        self.trace_records = TraceRecords(store, data / "traces", self._cache)
        self.verifications = Verifications(store, data / "verifications", self._cache)
        self.trace_files = TraceFiles(store, data / "imports", self._cache)
        self.history = RunHistory(self._runs, self._cache, self._open_rerun)
        self.campaigns = Campaigns(self._runs, self._cache, self._open_rerun)
        self.sweeps = Sweeps(
            store, self.states, self._cache, self._sessions_of, self.projects.built, self._open_state
        )  # fmt: skip

    async def start(self) -> None:
        """Opens what the store holds, or the samples on the first start, and runs every instance."""
        self._write_behind.start()
        await asyncio.to_thread(sweep, self._runs)
        await asyncio.to_thread(zygote().start)
        await asyncio.to_thread(self.states.tidy)
        await asyncio.to_thread(self.trace_records.tidy)
        await asyncio.to_thread(self.verifications.tidy)
        await asyncio.to_thread(self.trace_files.tidy)
        await self.sweeps.start()
        if not await self.projects.all():
            await self._first_start()
        for instance in await asyncio.to_thread(self._store.instances.all):
            try:
                session = await self._open(instance)
            except Refused as error:  # the others must not suffer
                log.error("%s", error)
            else:
                self.looks.left(session)
        await self.verifications.take_up(self._sessions)
        await self.campaigns.take_up(self._sessions)
        await self.history.take_up(self._sessions)
        if self.models:
            self._warming = asyncio.get_running_loop().create_task(self._warm())

    async def _warm(self) -> None:
        """Has the checker ready before somebody edits what runs."""
        with suppress(Unavailable):
            await self._checker.warm(next(iter(self.models.values())))
        for project in {session.project_id for session in self.sessions}:
            with suppress(NotFound, Refused, Unavailable):
                await self.projects.check(project, {})

    async def close(self) -> None:
        """Ends every PLC, and writes what is still to be written. Each process has a grace period, then it is killed: so this ends."""
        if self._warming is not None:
            self._warming.cancel()
            await asyncio.gather(self._warming, return_exceptions=True)
        await self.communication.close()
        await self.looks.close()
        await self.sweeps.close()
        await self.trace_records.close()
        await self.verifications.close()
        await self.history.close()
        await self.campaigns.close()
        await asyncio.gather(
            *(session.stop() for session in self._sessions.values()),
            self._checker.close(),
            asyncio.to_thread(zygote().close),  # a process that is on its way does not come any more
        )
        await self._reactions.close()
        await self.projects.drafts.end()
        await self._write_behind.close()

    async def delete_project(self, id: int) -> None:
        """Deletes a project that no PLC runs, with its sweeps and states."""
        await self.projects.refuse_running(id)
        await self.sweeps.forget_project(id)
        await self.projects.delete(id)
        await self.repositories.forget(id)

    # ---- instances ------------------------------------------------------------------------------------------------

    @property
    def sessions(self) -> list[Session]:
        """Every session, in the order in which the instances were made."""
        return [self._sessions[id] for id in sorted(self._sessions)]

    async def look(self) -> None:
        """Has every session's `load` at most two seconds old."""
        now = monotonic_ns()
        if now < self._looked_at + _LOOK_NS:
            return
        self._looked_at = now
        pids = [session.state.pid for session in self.sessions]
        await asyncio.to_thread(self._loads.look, [pid for pid in pids if pid is not None])

    async def log_page(self, session: Session, first: int | None, count: int, kind: str | None) -> LogPage:
        """Lines of the event log of a PLC; all that happened until now is in it."""
        await self._write_behind.flush()
        begin, total, lines = await asyncio.to_thread(self._store.log.page, session.id, first, count, kind)
        return LogPage(begin, total, LOG_KEPT, tuple(map(line_of, lines)))

    def session(self, id: int) -> Session:
        """The session of an instance."""
        session = self._sessions.get(id)
        if session is None:
            raise NotFound(f"there is no instance {id}")
        return session

    async def create_instance(self, project_id: int, name: str) -> Session:
        """A new PLC that runs a project's last accepted build."""
        project = await self.projects.get(project_id)
        self.projects.model(project.model)
        if await self.projects.built(project_id) is None:
            outcome = await self.projects.build(project_id, "server")
            if not outcome.ok:
                raise Refused(f"{project.name} has no program that could run: {outcome.message}")
        row = await asyncio.to_thread(self._store.instances.create, project_id, name)
        await asyncio.to_thread(discard, run_path(self._runs, row.id))
        return await self._open(row)

    async def branch(self, id: int, name: str, scan: int | None, author: str, look: bool = False) -> Session:
        """A new PLC that begins as this one was before `scan`, or is now; its past is the same. `look`: it ends when nobody is there
        any more."""
        origin = self.session(id)
        row = await asyncio.to_thread(self._store.instances.create, origin.project_id, name, look)
        try:
            await self._copied(origin, run_path(self._runs, row.id), scan, author)
        except BaseException:
            await asyncio.to_thread(self._store.instances.delete, row.id)
            await asyncio.to_thread(discard_all, self._runs, row.id)
            raise
        session = await self._open(row, paused=scan is not None)
        session.log.add(author, f"branched from {origin.name} {'now' if scan is None else f'at scan {scan}'}")
        self.looks.left(session)
        return session

    async def export(self, id: int, scan: int | None, author: str) -> Path:
        """A file with the run of this PLC, for the caller to delete; it ends before `scan`, or now."""
        session = self.session(id)
        path = fresh_path(self._runs, "export")
        try:
            await self._copied(session, path, scan, author)
        except BaseException:
            await asyncio.to_thread(discard, path)
            raise
        return path

    @staticmethod
    async def _copied(session: Session, path: Path, scan: int | None, author: str) -> None:
        """Of a PLC without a process the file as it is: also of one that failed, when it is wanted most."""
        if session.instance.on or scan is not None:
            await session.copy(path, scan, author)
            return
        try:
            await asyncio.to_thread(shutil.copyfile, session.instance.run_file, path)
        except OSError as error:
            raise Refused(f"the run of {session.name} cannot be copied: {error.strerror}") from error

    async def bring_in(self, path: Path, name: str, author: str) -> tuple[Session, str]:
        """A new PLC that goes on with a run from elsewhere; its sources become a project of that name. And what is damaged
        in the file: as much of it as is not, is gone on with.

        Takes the file over.
        """
        project: ProjectRow | None = None
        try:
            sources, damage = await asyncio.to_thread(sources_and_damage, path, self.models)
            damage = damage.replace(path.name, "the file").replace(". The damaged rest was left as it was", "")
            project = await self.projects.from_sources(name, sources, author)
            row = await asyncio.to_thread(self._store.instances.create, project.id, name)
            await asyncio.to_thread(os.replace, path, run_path(self._runs, row.id))
        except BaseException as error:
            await asyncio.to_thread(discard, path)
            if project is not None:
                await self.projects.delete(project.id)
            if isinstance(error, Unreadable | OSError):
                raise Refused(str(error).replace(path.name, "the file")) from error
            raise
        session = await self._open(row, paused=True)
        session.log.add(author, f"the run was imported{'; ' * bool(damage)}{damage}")
        return session, damage

    async def _open_rerun(self, origin: Session, name: str, path: Path, author: str) -> Session:
        """A new paused PLC that goes on where a replay with a change has ended."""
        return await self._open_state(origin.project_id, path, name, author)

    async def _open_state(self, project: int, path: Path, name: str, author: str) -> Session:
        """A new paused PLC of a project that goes on where a state was kept."""
        row = await asyncio.to_thread(self._store.instances.create, project, name)
        try:
            await asyncio.to_thread(shutil.copyfile, path, run_path(self._runs, row.id))
        except BaseException as error:
            await asyncio.to_thread(self._store.instances.delete, row.id)
            await asyncio.to_thread(discard_all, self._runs, row.id)
            if isinstance(error, OSError):
                raise Refused(f"the state cannot be copied: {error.strerror}") from error
            raise
        session = await self._open(row, paused=True)
        session.log.add(author, "begun from a kept state")
        return session

    def fresh_path(self) -> Path:
        """Where an upload may be written."""
        return fresh_path(self._runs, "import")

    async def change_instance(
        self, id: int, author: str, name: str | None, powered: bool | None, limits: Limits | None
    ) -> Session:
        """A new name, new limits, on or off."""
        session = self.session(id)
        if powered and session.instance.why_not:
            raise Refused(session.instance.why_not)
        change = partial(self._store.instances.change, id, name=name, powered=powered, limits=limits)
        await session.change(await asyncio.to_thread(change), author)
        return session

    async def delete_instance(self, id: int, author: str = "") -> None:
        """Ends a PLC and forgets it, its history too. Who is at it is told that `author` did."""
        session = self._sessions.pop(id, None)
        if session is None:
            raise NotFound(f"there is no instance {id}")
        session.tell(InstanceDeleted(author))
        await self.communication.forget(id)
        await self.verifications.forget_instance(id)
        await self.history.forget_instance(id)
        await self.campaigns.forget_instance(id)
        await session.stop()
        await self._write_behind.flush()
        await asyncio.to_thread(self._store.instances.delete, id)
        await asyncio.to_thread(discard_all, self._runs, id)

    async def _open(self, row: InstanceRow, paused: bool = False) -> Session:
        project = await self.projects.get(row.project)
        sources = await self.projects.built(project.id)
        if sources is None:
            raise Refused(f"instance {row.name}: {project.name} has no accepted build")
        model, why_not = self.models.get(project.model), ""
        if model is None:
            model = stand_in(project.model)
            why_not = why_missing(project.model, model_directory(), self._model_problems)
            log.error("%s: %s", row.name, why_not)
        rows = [row_of(model, each) for each in await asyncio.to_thread(self._store.errors.history, row.id)]
        lines = [line_of(each) for each in await asyncio.to_thread(self._store.log.last, row.id, LOG_LINES)]
        memory = Remembered(row.name, sources, run_path(self._runs, row.id), row.limits)
        if paused:
            memory.driven = Driven(paused=True)
        breakpoints = await asyncio.to_thread(self._store.breakpoints.all, row.id)
        traces = await asyncio.to_thread(self._store.traces.all, row.id)
        session = Session(
            row, model, memory, self._write_behind, rows, lines, self._loads, self._reactions, breakpoints, self._cache, traces,
            why_not,
        )  # fmt: skip
        self._sessions[row.id] = session
        await self.sweeps.show([session])
        await self.communication.begin(session)
        if row.powered:
            session.instance.start()
        return session

    def _sessions_of(self, project_id: int) -> list[Session]:
        return [session for session in self.sessions if session.project_id == project_id]

    async def _first_start(self) -> None:
        """The samples, each on an instance of its own."""
        for number, sample in enumerate(samples(), 1):
            if sample.model not in self.models:
                log.error("sample %s needs model %s, which could not be loaded", sample.name, sample.model)
                continue
            project = await self.projects.create(sample.name, sample.model, sample.watch)
            for path, text in sample.files.items():
                await self.projects.save(project.id, path, text, 0, "sample")
            outcome = await self.projects.build(project.id, "sample")
            if not outcome.ok:
                log.error("sample %s: %s", sample.name, outcome.message)
            else:
                await asyncio.to_thread(self._store.instances.create, project.id, f"line-{number}")
