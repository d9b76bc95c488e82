"""Projects: files, checks, builds. A build with errors is refused, and every PLC goes on with the program it has."""

import asyncio
from collections.abc import Callable, Mapping, Sequence

from scanbench.comm.modbus.map_file import MAP_FILE, read_map
from scanbench.jobs.checker import INTERVAL_NS, Checker
from scanbench.plcmodel.hardware import HARDWARE_FILE
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import USER_ERRORS
from scanbench.server.archive import Archive, notes_file, pack
from scanbench.server.completed import completed
from scanbench.server.drafts import Drafts
from scanbench.server.operator_panels import PANEL_ENDING, is_panel_file, refuse_broken
from scanbench.server.project_files import is_beside, is_project_file
from scanbench.server.samples import templates
from scanbench.session.session import Session
from scanbench.store.records import BuildInfo, FileInfo, FileRow, NotFound, ProjectRow
from scanbench.store.store import Store
from scanbench.syntax.language_file import LANGUAGE_FILE, STRICT, language_text
from scanbench.syntax.parse_file import ENDINGS
from scanbench.syntax.plcopen.write import Form, Written, write_project
from scanbench.syntax.requirements import REQUIREMENTS
from scanbench.wire.events import BuildOutcome, Change, CheckOutcome, FileDeleted, FileSaved
from scanbench.wire.host import Preview, Previewed, Sources
from scanbench.wire.refused import Refused, Unavailable


class Projects:
    """The projects of a server. `sessions_of` gives the PLCs that run a project's program."""

    def __init__(
        self, store: Store, models: Mapping[str, Model], checker: Checker, sessions_of: Callable[[int], list[Session]]
    ) -> None:
        self._store, self._models, self._checker, self._sessions_of = store, models, checker, sessions_of
        self._building: dict[int, asyncio.Lock] = {}
        self.drafts = Drafts(store)
        """The files as people edit them."""

    async def all(self) -> list[ProjectRow]:
        """Every project."""
        return await asyncio.to_thread(self._store.projects.all)

    async def get(self, id: int) -> ProjectRow:
        """The project of this number."""
        return await asyncio.to_thread(self._store.projects.get, id)

    async def create(self, name: str, model: str, watch: Sequence[str] = ()) -> ProjectRow:
        """An empty project on a model."""
        self.model(model)
        return await asyncio.to_thread(self._store.projects.create, name, model, watch)

    async def from_template(self, name: str, model: str, template: str, author: str) -> ProjectRow:
        """A project with the files of a template or sample, which are not built yet."""
        known = {each.id: each for each in templates()}
        chosen = known.get(template)
        if chosen is None:
            raise Refused(f"there is no template {template}", tuple(known))
        project = await self.create(name, model, chosen.watch)
        for path, text in chosen.files.items():
            await asyncio.to_thread(self._store.files.save, project.id, path, text, 0, author)
        return project

    async def delete(self, id: int) -> None:
        """Deletes a project that no PLC runs (`refuse_running`)."""
        await self.refuse_running(id)
        await asyncio.to_thread(self._store.projects.delete, id)
        self.drafts.forget(id)

    async def refuse_running(self, id: int) -> None:
        """A project that a PLC runs cannot be deleted."""
        project = await self.get(id)
        if running := self._sessions_of(id):
            raise Refused(f"{project.name} runs on {', '.join(each.name for each in running)}: delete that first")

    def model(self, name: str) -> Model:
        """The model of this name."""
        model = self._models.get(name)
        if model is None:
            raise Refused(f"there is no model {name} on this server", tuple(self._models))
        return model

    # ---- files ----------------------------------------------------------------------------------------------------

    async def files(self, id: int) -> list[FileInfo]:
        """The files of a project."""
        return await asyncio.to_thread(self._store.files.all, id)

    async def file(self, id: int, path: str) -> FileRow:
        """One file."""
        return await asyncio.to_thread(self._store.files.get, id, path)

    async def save(self, id: int, path: str, text: str, version: int, author: str, draft: str | None = None) -> FileRow:
        """Saves what was edited from `version` on; `store.records.Conflict` when somebody else was first.

        A text that is not of the `draft` of the file was made elsewhere: its change is made in the draft as well.
        """
        _check_path(path)
        if is_beside(path):
            self._refuse_broken((await self.get(id)).model, path, text)
        file = await self.drafts.save(id, path, text, version, author, draft)
        for session in self._sessions_of(id):
            session.tell(FileSaved(author, file.path, file.version, file.saved))
        return file

    def _refuse_broken(self, model: str, path: str, text: str) -> None:
        """Of what no program has, and nobody would see otherwise."""
        if is_panel_file(path):
            refuse_broken(path, text)
        elif model in self._models:
            read_map(self._models[model], text)

    async def delete_file(self, id: int, path: str, author: str) -> None:
        """Deletes a file."""
        await asyncio.to_thread(self._store.files.delete, id, path)
        self.drafts.forget(id, path)
        for session in self._sessions_of(id):
            session.tell(FileDeleted(author, path))

    async def modbus_map(self, id: int) -> str | None:
        """The project's own map of Modbus; None where it has none."""
        try:
            return (await self.file(id, MAP_FILE)).text
        except NotFound:
            return None

    async def sources(self, id: int) -> dict[str, str]:
        """Path -> text of all program files, and of the project's own errors."""
        files = await asyncio.to_thread(self._store.files.sources, id)
        return {path: text for path, text in files.items() if not is_beside(path)}

    # ---- check and build ------------------------------------------------------------------------------------------

    async def check(self, id: int, edited: Mapping[str, str], numbers: bool = False) -> CheckOutcome:
        """Checks the project with texts that are not saved yet; with `numbers` those that its program raises errors with."""
        project = await self.get(id)
        sources = await self.sources(id) | dict(edited)
        return await self._checker.check(sources, self.model(project.model), numbers)

    async def declared(self, sources: Sources) -> CheckOutcome:
        """What sources declare that were built before."""
        return await self._checker.check(sources.files, self.model(sources.model))

    async def versions(self, id: int) -> list[BuildInfo]:
        """Every build that was accepted, the last one first."""
        return await asyncio.to_thread(self._store.builds.all, id)

    async def describe(self, id: int, version: int, label: str | None, message: str | None) -> BuildInfo:
        """Gives a version a label or a message; an empty one takes it away."""
        return await asyncio.to_thread(self._store.builds.describe, id, version, label, message)

    async def built(self, id: int, version: int | None = None) -> Sources | None:
        """A build that was accepted: the last one, or that of a `version`."""
        project = await self.get(id)
        build = await asyncio.to_thread(self._store.builds.get, id, version)
        return None if build is None else Sources(project.model, build.sources, INTERVAL_NS, build.version)

    async def build(
        self, id: int, author: str, agreed: bool = True, instances: Sequence[int] | None = None, message: str = ""
    ) -> BuildOutcome:
        """Builds what is saved, and swaps it into the project's PLCs, or those named, each in its seam. One at a time.

        Not `agreed`: where variables of a running PLC would begin again, or one cannot be changed, it only says so.
        """
        async with self._building.setdefault(id, asyncio.Lock()):
            outcome = await self._build(id, author, agreed, instances, message)
        if not outcome.needs_agreement:
            for session in self._sessions_of(id):
                session.told_built(author, outcome)
        return outcome

    async def from_sources(self, name: str, sources: Sources, author: str) -> ProjectRow:
        """A project with these files, as if they had been built as this version."""
        for path in sources.files:
            _check_path(path)
        project = await self.create(name, sources.model)
        for path, text in sources.files.items():
            await asyncio.to_thread(self._store.files.save, project.id, path, text, 0, author)
        await asyncio.to_thread(self._store.builds.accept, project.id, sources.files, author, sources.version)
        return await self.get(project.id)

    async def pack(self, id: int) -> tuple[str, bytes]:
        """A project as one file, and its name."""
        project, files = await self.get(id), await asyncio.to_thread(self._store.files.sources, id)
        return project.name, await asyncio.to_thread(pack, project.name, project.model, project.watch, files)

    async def written(self, id: int, form: Form) -> tuple[str, Written]:
        """The program of a project as a PLCopen file, and its name."""
        project, files = await self.get(id), await asyncio.to_thread(self._store.files.sources, id)
        return project.name, await asyncio.to_thread(write_project, project.name, files, form)

    async def from_archive(self, name: str, model: str, archive: Archive, author: str) -> ProjectRow:
        """A project with the files of an archive, which are not built yet."""
        guessed = {} if archive.dialect == STRICT else {LANGUAGE_FILE: language_text(archive.dialect)}
        programs = await asyncio.to_thread(completed, {**guessed, **archive.files}, archive.twincat)
        texts = programs | archive.panels | notes_file(archive)
        for path in texts:
            _check_path(path)
        for path, text in archive.panels.items():
            self._refuse_broken(model, path, text)
        project = await self.create(name, model, archive.watch)
        for path, text in texts.items():
            await asyncio.to_thread(self._store.files.save, project.id, path, text, 0, author)
        return project

    async def _build(
        self, id: int, author: str, agreed: bool, instances: Sequence[int] | None, message: str
    ) -> BuildOutcome:
        project = await self.get(id)
        sources = await self.sources(id)
        found = await self._checker.check(sources, self.model(project.model))
        if found.errors:
            count = f"{found.errors} error{'s' * (found.errors != 1)}"
            first = next(problem for problem in found.problems if problem.severity == "error")
            return BuildOutcome(False, f"{count}, nothing was changed: {first}", found, project)
        sessions = [
            session
            for session in self._sessions_of(id)
            if session.state.state != "off" and (instances is None or session.id in instances)
        ]
        if await self._runs_already(project, sources, sessions):
            said = f"nothing to build: version {project.version} is what is saved"
            return BuildOutcome(True, "; ".join([said, *await self._not_built(id)]), found, project)
        build = Sources(project.model, sources, INTERVAL_NS, project.version + 1)
        self._checker.keep(build)
        changes = await self._changes(sessions, build)
        question = _question(changes)
        if question and not agreed:
            return BuildOutcome(False, question, found, project, changes, needs_agreement=True)
        refused = {change.instance: change.previewed.refusal for change in changes if change.previewed.refusal}
        lines = [f"{session.name} not changed: {refused[session.id]}" for session in sessions if session.id in refused]
        if sessions and len(refused) == len(sessions):
            return BuildOutcome(False, "; ".join(["nothing was changed", *lines]), found, project, changes)
        await asyncio.to_thread(self._store.builds.accept, id, sources, author, None, message)
        willing = [session for session in sessions if session.id not in refused]
        acks = await asyncio.gather(*(session.build(build, author) for session in willing))
        done = [f"{session.name}: {ack.message}" for session, ack in zip(willing, acks, strict=True)]
        said = "; ".join([f"version {build.version} built", *done, *lines, *await self._not_built(id)])
        return BuildOutcome(all(ack.ok for ack in acks), said, found, await self.get(id), changes)

    async def _not_built(self, id: int) -> list[str]:
        """Says which files have a text that somebody edited and nobody saved: a build takes what is saved."""
        unsaved = await self.drafts.unsaved(id)
        return [f"not built, as nobody saved it: what was edited in {', '.join(unsaved)}"] if unsaved else []

    async def _runs_already(self, project: ProjectRow, sources: Mapping[str, str], sessions: Sequence[Session]) -> bool:
        """Whether a build would change nothing; one that stopped by an error is begun again by a build."""
        if await asyncio.to_thread(self._store.builds.last, project.id) != sources:
            return False
        return all(
            session.state.version == project.version
            and session.state.state in ("running", "paused", "stopped", "no_space")
            for session in sessions
        )

    @staticmethod
    async def _changes(sessions: Sequence[Session], build: Sources) -> tuple[Change, ...]:
        """What the build would do to each PLC; one that cannot answer now says so when it is changed."""

        async def change(session: Session) -> Change | None:
            try:
                preview = await session.instance.ask(lambda ref: Preview(ref, build), Previewed, takes_long=True)
                return Change(session.id, session.name, preview)
            except Unavailable:
                return None

        found = await asyncio.gather(*map(change, sessions))
        return tuple(each for each in found if each is not None)


def _question(changes: Sequence[Change]) -> str:
    """What has to be agreed to before anything is changed; empty when nothing has."""
    lost = sum(change.previewed.counted.reinitialised for change in changes)
    refused = [change.name for change in changes if change.previewed.refusal]
    parts = [f"{lost} variable{'s' * (lost != 1)} would begin again"] if lost else []
    parts += [f"{', '.join(refused)} cannot be changed now"] if refused else []
    return f"{'; '.join(parts)}: nothing was changed yet" if parts else ""


_LONGEST_PATH = 200


def _check_path(path: str) -> None:
    parts = path.split("/")
    if len(path) > _LONGEST_PATH:
        raise Refused(
            f"the name of a file has at most {_LONGEST_PATH} characters, with its folders; this one has {len(path)}"
        )
    odd = any(part.strip(". ") == "" or part.rstrip(". ").lower() == ".git" for part in parts)
    if not is_project_file(path) or odd:
        raise Refused(
            f"{path!r} cannot be a file of a project: name it like motor.st, or {', '.join(ENDINGS[1:])}, or plant/inputs.csv; "
            f"the project's own errors are in {USER_ERRORS}, what must happen then in {REQUIREMENTS}, its hardware in "
            f"{HARDWARE_FILE}, its dialect in {LANGUAGE_FILE}, what registers of Modbus mean in {MAP_FILE}, operator panels in files like belt{PANEL_ENDING}"
        )
