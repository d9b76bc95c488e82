"""The store: plain, synchronous methods, each one transaction. Safe to call from several threads and processes."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict

from sqlalchemy import delete, insert, select, update
from sqlalchemy.exc import IntegrityError

from scanbench.runtime.clock import wall_time
from scanbench.store import rows
from scanbench.store.breakpoints import Breakpoints
from scanbench.store.connected import check, the_instance, the_project
from scanbench.store.errors import Errors
from scanbench.store.imported import ImportedRecords
from scanbench.store.kept import KeptRecords
from scanbench.store.mappings import Mappings
from scanbench.store.records import (
    BuildRow,
    Conflict,
    FileInfo,
    FileRow,
    InstanceRow,
    Limits,
    LogRow,
    NameTaken,
    NotFound,
    ProjectRow,
)
from scanbench.store.sweeps import Sweeps
from scanbench.store.tables import AUTHOR, NAME, PATH, File, Instance, Log, ProgramVersion, Project
from scanbench.store.traces import Traces
from scanbench.store.watchlists import WatchLists


class Store(Errors, Sweeps, ImportedRecords, WatchLists, Breakpoints, Traces, KeptRecords, Mappings):
    """A database, with today's tables: here projects, files, builds, instances and their log; `close` it at the end."""

    # ---- projects -----------------------------------------------------------------------------------------------
    def projects(self) -> list[ProjectRow]:
        """Every project, by name."""
        with self._reading() as session:
            return [rows.project(found) for found in session.scalars(select(Project).order_by(Project.name))]

    def project(self, project: int) -> ProjectRow:
        """One project."""
        with self._reading() as session:
            return rows.project(the_project(session, project))

    def create_project(self, name: str, model: str, watch: Sequence[str] = ()) -> ProjectRow:
        """A new project without files; `watch` is what a fresh watch list begins with."""
        check("the name", name, NAME)
        try:
            with self._writing() as session:
                made = Project(name=name, model=model, watch=list(watch), version=0, created=wall_time())
                session.add(made)
                session.flush()
                return rows.project(made)
        except IntegrityError as error:
            raise NameTaken(f"there is a project {name!r} already: choose another name") from error

    def delete_project(self, project: int) -> None:
        """Deletes it with its files, builds, instances and their histories."""
        with self._writing() as session:
            if session.scalars(delete(Project).where(Project.id == project).returning(Project.id)).first() is None:
                raise NotFound(f"there is no project {project}")

    # ---- files --------------------------------------------------------------------------------------------------
    def files(self, project: int) -> list[FileInfo]:
        """The files of a project, by path."""
        with self._reading() as session:
            the_project(session, project)
            columns = select(File.path, File.version, File.author, File.saved)
            found = session.execute(columns.where(File.project_id == project).order_by(File.path))
            return [FileInfo(path, version, author, saved) for path, version, author, saved in found]

    def sources(self, project: int) -> dict[str, str]:
        """Path and text of every file of a project, as last saved."""
        with self._reading() as session:
            the_project(session, project)
            columns = select(File.path, File.text).where(File.project_id == project).order_by(File.path)
            return {row.path: row.text for row in session.execute(columns)}

    def file(self, project: int, path: str) -> FileRow:
        """One file with its text."""
        with self._reading() as session:
            the_project(session, project)
            found = session.get(File, (project, path))
            if found is None:
                raise NotFound(f"there is no file {path!r} in this project")
            return rows.file(found)

    def save_file(self, project: int, path: str, text: str, version: int, author: str) -> FileRow:
        """Saves a text that was edited from this `version` (0: a new file). `Conflict` if that is not the last one."""
        check("the path", path, PATH)
        check(path, text)
        saved, author = wall_time(), author[:AUTHOR]
        try:
            with self._writing() as session:
                the_project(session, project)
                key = {"project_id": project, "path": path, "text": text, "author": author, "saved": saved}
                if version == 0:
                    session.execute(insert(File).values(**key, version=1))
                    return FileRow(path, text, 1, author, saved)
                # One statement looks and writes, so of two savers from the same version exactly one finds its row.
                last = (File.project_id == project) & (File.path == path) & (File.version == version)
                change = update(File).where(last).values(text=text, author=author, saved=saved, version=version + 1)
                if session.scalars(change.returning(File.version)).first() is not None:
                    return FileRow(path, text, version + 1, author, saved)
        except IntegrityError:
            pass  # the new file is there already: a conflict like any other
        raise Conflict(path, self._current(project, path))

    def delete_file(self, project: int, path: str, version: int | None = None) -> None:
        """Deletes a file; with a `version` only if it is still the last one."""
        with self._writing() as session:
            the_project(session, project)
            found = session.get(File, (project, path), with_for_update=True)
            if found is None:
                raise NotFound(f"there is no file {path!r} in this project")
            if version not in (None, found.version):
                raise Conflict(path, rows.file(found))
            session.delete(found)

    def _current(self, project: int, path: str) -> FileRow | None:
        with self._reading() as session:
            found = session.get(File, (project, path))
            return None if found is None else rows.file(found)

    # ---- builds -------------------------------------------------------------------------------------------------
    def accept_build(self, project: int, sources: Mapping[str, str], author: str, version: int | None = None) -> int:
        """Keeps the sources of a build that was accepted; the project's new version, the next one or the one given."""
        text = json.dumps(sorted(sources.items()), ensure_ascii=False)
        following = Project.version + 1 if version is None else version
        with self._writing() as session:
            count = update(Project).where(Project.id == project).values(version=following)
            version = session.scalars(count.returning(Project.version)).first()
            if version is None:
                raise NotFound(f"there is no project {project}")
            session.add(
                ProgramVersion(
                    project_id=project,
                    version=version,
                    sources=dict(sources),
                    hash=hashlib.sha256(text.encode()).hexdigest(),
                    author=author[:AUTHOR],
                    at=wall_time(),
                )
            )
            return version

    def last_build(self, project: int) -> dict[str, str] | None:
        """The sources of the last accepted build; None if there was none yet."""
        build = self.build(project)
        return None if build is None else build.sources

    def build(self, project: int, version: int | None = None) -> BuildRow | None:
        """An accepted build: the last one, or that of a `version`."""
        with self._reading() as session:
            key = (project, the_project(session, project).version if version is None else version)
            found = session.get(ProgramVersion, key)
            return None if found is None else rows.build(found)

    # ---- instances ----------------------------------------------------------------------------------------------
    def instances(self) -> list[InstanceRow]:
        """Every instance, in the order of their making."""
        with self._reading() as session:
            return [rows.instance(found) for found in session.scalars(select(Instance).order_by(Instance.id))]

    def create_instance(self, project: int, name: str) -> InstanceRow:
        """A new virtual PLC for a project."""
        check("the name", name, NAME)
        try:
            with self._writing() as session:
                the_project(session, project)
                made = Instance(project_id=project, name=name, created=wall_time())
                session.add(made)
                session.flush()
                return rows.instance(made)
        except IntegrityError as error:
            raise NameTaken(f"there is an instance {name!r} already: choose another name") from error

    def change_instance(
        self, instance: int, *, name: str | None = None, powered: bool | None = None, limits: Limits | None = None
    ) -> InstanceRow:
        """Changes what is given."""
        if name is not None:
            check("the name", name, NAME)
        try:
            with self._writing() as session:
                row = the_instance(session, instance, lock=True)
                row.name = row.name if name is None else name
                row.powered = row.powered if powered is None else powered
                if limits is not None:
                    row.memory_mib, row.cpu_percent, row.run_mib = (
                        limits.memory_mib, limits.cpu_percent, limits.run_mib
                    )  # fmt: skip
                session.flush()
                return rows.instance(row)
        except IntegrityError as error:
            raise NameTaken(f"there is an instance {name!r} already: choose another name") from error

    def delete_instance(self, instance: int) -> None:
        """Deletes it with its history and log."""
        with self._writing() as session:
            if session.scalars(delete(Instance).where(Instance.id == instance).returning(Instance.id)).first() is None:
                raise NotFound(f"there is no instance {instance}")

    # ---- log ----------------------------------------------------------------------------------------------------
    def log(self, instance: int, limit: int) -> list[LogRow]:
        """The last `limit` lines, oldest first."""
        with self._reading() as session:
            the_instance(session, instance)
            found = select(Log).where(Log.instance_id == instance).order_by(Log.id.desc()).limit(limit)
            return [rows.log(entry) for entry in reversed(session.scalars(found).all())]

    def error_log(self, instance: int, version: int, limit: int) -> list[LogRow]:
        """What was last raised and recovered while this version of the program ran, oldest first."""
        with self._reading() as session:
            the_instance(session, instance)
            of = (Log.instance_id == instance) & (Log.program_version == version) & Log.kind.in_(("error", "recover"))
            found = select(Log).where(of).order_by(Log.id.desc()).limit(limit)
            return [rows.log(entry) for entry in reversed(session.scalars(found).all())]

    def add_log(self, instance: int, lines: Sequence[LogRow], keep: int | None = None) -> None:
        """More lines, in their order; with `keep` only the last so many lines of the instance stay."""
        with self._writing() as session:
            the_instance(session, instance)
            if lines:
                told = [{**asdict(line), "author": line.author[:AUTHOR], "instance_id": instance} for line in lines]
                session.execute(insert(Log), told)
            if keep is not None:
                ids = select(Log.id).where(Log.instance_id == instance).order_by(Log.id.desc())
                last = session.scalars(ids.offset(keep).limit(1)).first()
                if last is not None:
                    session.execute(delete(Log).where(Log.instance_id == instance, Log.id <= last))
