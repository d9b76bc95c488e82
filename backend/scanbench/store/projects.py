"""Projects, their files, and the builds that were accepted."""

import hashlib
import json
from collections.abc import Mapping, Sequence

from sqlalchemy import delete, insert, select, update
from sqlalchemy.exc import IntegrityError

from scanbench.runtime.clock import wall_time
from scanbench.store import rows
from scanbench.store.connected import Repository, check, the_project
from scanbench.store.drafts import add_parts
from scanbench.store.records import (
    BuildInfo,
    BuildRow,
    Conflict,
    FileInfo,
    FileRow,
    NameTaken,
    NotFound,
    ProjectRow,
)
from scanbench.store.tables import AUTHOR, NAME, PATH, File, ProgramVersion, Project


class Projects(Repository):
    """Projects, by number."""

    def all(self) -> list[ProjectRow]:
        """Every project, by name."""
        with self._database.reading() as session:
            return [rows.project(found) for found in session.scalars(select(Project).order_by(Project.name))]

    def get(self, project: int) -> ProjectRow:
        """One project."""
        with self._database.reading() as session:
            return rows.project(the_project(session, project))

    def create(self, name: str, model: str, watch: Sequence[str] = ()) -> ProjectRow:
        """A new project without files; `watch` is what a fresh watch list begins with."""
        check("the name", name, NAME)
        try:
            with self._database.writing() as session:
                made = Project(name=name, model=model, watch=list(watch), version=0, created=wall_time())
                session.add(made)
                session.flush()
                return rows.project(made)
        except IntegrityError as error:
            raise NameTaken(f"there is a project {name!r} already: choose another name") from error

    def delete(self, project: int) -> None:
        """Deletes it with its files, builds, instances and their histories."""
        with self._database.writing() as session:
            if session.scalars(delete(Project).where(Project.id == project).returning(Project.id)).first() is None:
                raise NotFound(f"there is no project {project}")


class Files(Repository):
    """The files of projects, each with a version that counts its saves."""

    def all(self, project: int) -> list[FileInfo]:
        """The files of a project, by path."""
        with self._database.reading() as session:
            the_project(session, project)
            columns = select(File.path, File.version, File.author, File.saved)
            found = session.execute(columns.where(File.project_id == project).order_by(File.path))
            return [FileInfo(path, version, author, saved) for path, version, author, saved in found]

    def sources(self, project: int) -> dict[str, str]:
        """Path and text of every file of a project, as last saved."""
        with self._database.reading() as session:
            the_project(session, project)
            columns = select(File.path, File.text).where(File.project_id == project).order_by(File.path)
            return {row.path: row.text for row in session.execute(columns)}

    def get(self, project: int, path: str) -> FileRow:
        """One file with its text."""
        with self._database.reading() as session:
            the_project(session, project)
            found = session.get(File, (project, path))
            if found is None:
                raise NotFound(f"there is no file {path!r} in this project")
            return rows.file(found)

    def save(
        self, project: int, path: str, text: str, version: int, author: str, change: tuple[str, bytes] | None = None
    ) -> FileRow:
        """Saves a text that was edited from this `version` (0: a new file). `Conflict` if that is not the last one.

        With it the `change` of its draft is kept, the key of the draft first.
        """
        check("the path", path, PATH)
        check(path, text)
        saved, author = wall_time(), author[:AUTHOR]
        try:
            with self._database.writing() as session:
                the_project(session, project)
                key = {"project_id": project, "path": path, "text": text, "author": author, "saved": saved}
                if version == 0:
                    session.execute(insert(File).values(**key, version=1))
                    return FileRow(path, text, 1, author, saved)
                # One statement looks and writes, so of two savers from the same version exactly one finds its row.
                last = (File.project_id == project) & (File.path == path) & (File.version == version)
                updated = update(File).where(last).values(text=text, author=author, saved=saved, version=version + 1)
                if session.scalars(updated.returning(File.version)).first() is not None:
                    if change is not None:
                        add_parts(session, project, path, change[0], [change[1]])
                    return FileRow(path, text, version + 1, author, saved)
        except IntegrityError:
            pass  # the new file is there already: a conflict like any other
        raise Conflict(path, self._current(project, path))

    def delete(self, project: int, path: str, version: int | None = None) -> None:
        """Deletes a file; with a `version` only if it is still the last one."""
        with self._database.writing() as session:
            the_project(session, project)
            found = session.get(File, (project, path), with_for_update=True)
            if found is None:
                raise NotFound(f"there is no file {path!r} in this project")
            if version not in (None, found.version):
                raise Conflict(path, rows.file(found))
            session.delete(found)

    def _current(self, project: int, path: str) -> FileRow | None:
        with self._database.reading() as session:
            found = session.get(File, (project, path))
            return None if found is None else rows.file(found)


_INFO = (
    ProgramVersion.version,
    ProgramVersion.author,
    ProgramVersion.at,
    ProgramVersion.label,
    ProgramVersion.message,
)


class Builds(Repository):
    """The sources of accepted builds, by version of the project."""

    def accept(
        self, project: int, sources: Mapping[str, str], author: str, version: int | None = None, message: str = ""
    ) -> int:
        """Keeps the sources of a build that was accepted; the project's new version, the next one or the one given."""
        check("the message", message)
        text = json.dumps(sorted(sources.items()), ensure_ascii=False)
        following = Project.version + 1 if version is None else version
        with self._database.writing() as session:
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
                    message=message,
                )
            )
            return version

    def all(self, project: int) -> list[BuildInfo]:
        """Every accepted build of a project, the last one first."""
        with self._database.reading() as session:
            the_project(session, project)
            columns = select(*_INFO).where(ProgramVersion.project_id == project)
            return [BuildInfo(*found) for found in session.execute(columns.order_by(ProgramVersion.version.desc()))]

    def describe(self, project: int, version: int, label: str | None, message: str | None) -> BuildInfo:
        """Gives a version a label or a message; what is None stays as it is."""
        check("the label", label or "none", NAME)
        check("the message", message or "")
        given = {key: value for key, value in (("label", label), ("message", message)) if value is not None}
        with self._database.writing() as session:
            the_project(session, project)
            this = (ProgramVersion.project_id == project) & (ProgramVersion.version == version)
            if given:
                session.execute(update(ProgramVersion).where(this).values(**given))
            found = session.execute(select(*_INFO).where(this)).first()
            if found is None:
                raise NotFound(f"this project has no version {version}")
            return BuildInfo(*found)

    def last(self, project: int) -> dict[str, str] | None:
        """The sources of the last accepted build; None if there was none yet."""
        build = self.get(project)
        return None if build is None else build.sources

    def get(self, project: int, version: int | None = None) -> BuildRow | None:
        """An accepted build: the last one, or that of a `version`."""
        with self._database.reading() as session:
            key = (project, the_project(session, project).version if version is None else version)
            found = session.get(ProgramVersion, key)
            return None if found is None else rows.build(found)
