"""Test records and histories of all versions: put together from a session and the store; imported ones."""

import asyncio
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import cast

from scanbench.faults.history import ErrorRow, key_for
from scanbench.faults.reaction.reaction import Verdict
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import device_of, model_for
from scanbench.public import Moment, Public
from scanbench.reports.record import (
    RecordAccepted,
    RecordCell,
    RecordHead,
    RecordProblem,
    RecordSweep,
    TestRecord,
    make_record,
)
from scanbench.reports.record_read import from_xml
from scanbench.reports.record_text import Language, RecordLine
from scanbench.runtime.clock import wall_time
from scanbench.server.sweep_rows import merged
from scanbench.server.write_behind import WriteBehind
from scanbench.session.session import Session
from scanbench.store.records import AcceptedRow, BuildRow, CellRow, LogRow, NotFound, RecordInfo, RecordRow, SweepRow
from scanbench.store.store import Store
from scanbench.wire.refused import Refused

LOG_LINES = 2000
"""Of the log in a record, which people read; the record says how many came before."""
SWEEPS = 20
"""Of a record, the newest ones: it is a page to sign, no archive."""
IMPORTED = 500
"""Records from elsewhere that a project keeps; each may be megabytes."""
TOLD = 3
"""Mistakes of a record that are told at once."""


@dataclass(frozen=True, slots=True)
class HistoryVersion(Public):
    """A version of the program that has an error history on a PLC."""

    version: int
    running: bool
    raised: int
    """Errors that were raised on it."""
    at: Moment | None
    """When it was built; None: the project does not know it, as after a run that was imported."""
    author: str


class Records:
    """What was tested, for all PLCs."""

    def __init__(self, store: Store, write_behind: WriteBehind, tool: str) -> None:
        """`tool` is named in what is written."""
        self._store, self._write_behind, self._tool = store, write_behind, tool

    async def versions(self, session: Session) -> list[HistoryVersion]:
        """The versions with a history, the newest first."""
        found = []
        for version in reversed(session.errors.versions):
            rows, _, build = await self._of_version(session, version)
            raised = sum(row.status != "never" for row in rows)
            at, author = (None, "") if build is None else (build.at, build.author)
            found.append(HistoryVersion(version, version == session.errors.version, raised, at, author))
        return found

    async def rows(self, session: Session, version: int | None) -> list[ErrorRow]:
        """The history of a version, or of the one that runs."""
        rows, _, _ = await self._of_version(session, version)
        return rows

    async def of_instance(self, session: Session, version: int | None, by: str, language: Language) -> TestRecord:
        """The record of a version, or of the one that runs."""
        version = session.errors.version if version is None else version
        rows, model, build = await self._of_version(session, version)
        await self._write_behind.flush()

        def make() -> TestRecord:
            project = self._store.projects.get(session.project_id)
            earlier, lines = self._store.log.errors(session.id, version, LOG_LINES)
            swept, accepted = self._sweeps(session, version, model)
            head = RecordHead(
                project.name, model.name, session.name, version, "" if build is None else build.hash, wall_time(), by,
                self._tool,
            )  # fmt: skip
            return make_record(
                head, model, rows, language=language, sweeps=swept,
                accepted=[(key_for(model, one.error), RecordAccepted(one.state, one.reason, one.by, one.at)) for one in accepted],
                log=[*_earlier(earlier, lines), *(RecordLine(line.at, line.scan, line.author, line.text) for line in lines)],
            )  # fmt: skip

        return await asyncio.to_thread(make)

    async def _of_version(self, session: Session, version: int | None) -> tuple[list[ErrorRow], Model, BuildRow | None]:
        if session.instance.why_not:
            raise Refused(f"the error history cannot be read: {session.instance.why_not}")
        wanted = session.errors.version if version is None else version
        # A version that was only swept has nothing but that to tell: it has a record all the same.
        if wanted not in session.errors.versions and not await asyncio.to_thread(self._swept, session, wanted):
            known = ", ".join(map(str, session.errors.versions))
            raise NotFound(f"{session.name} has no error history of version {wanted}; there are {known}")

        def read() -> tuple[list[ErrorRow], Model, BuildRow | None]:
            build = self._store.builds.get(session.project_id, wanted)
            model = self._model(session, wanted, build)
            return session.errors.rows_of(wanted, model), model, build

        return await asyncio.to_thread(read)

    @staticmethod
    def _model(session: Session, version: int, build: BuildRow | None) -> Model:
        """The catalogue that the version had: the project's own errors are part of its sources."""
        if version == session.errors.version or build is None:
            return session.model
        return model_for(device_of(session.model), build.sources)

    def _sweeps(self, session: Session, version: int, model: Model) -> tuple[list[RecordSweep], list[AcceptedRow]]:
        """The sweeps, with one cell for each error and state, and what was accepted of these cells."""
        accepted = self._store.findings.accepted(session.project_id)
        pairs = {(one.error, one.state) for one in accepted}
        found, told = [], set[tuple[str, str]]()
        for sweep in self._swept(session, version)[:SWEEPS]:
            cells = merged(model, self._store.sweeps.cells(sweep.id), pairs)
            told |= {(cell.error, cell.state) for cell in cells}
            made = tuple(_record_cell(model, cell) for cell in cells)
            found.append(
                RecordSweep(
                    sweep.at,
                    sweep.by,
                    sweep.instance,
                    sweep.status,
                    sweep.window,
                    sweep.states,
                    made,
                    tuple(RecordProblem(each.line, each.column, each.message) for each in sweep.problems),
                )
            )
        counts = Counter((key_for(model, error), state) for error, state in told)
        return found, [
            one for one in accepted
            if one.error == key_for(model, one.error)
            or ((one.error, one.state) in told and counts[key_for(model, one.error), one.state] == 1)
        ]  # fmt: skip

    def _swept(self, session: Session, version: int) -> list[SweepRow]:
        """The sweeps of a version on this PLC, the newest first."""
        found = []
        for sweep in self._store.sweeps.all(session.project_id):
            ours = sweep.instance_id == session.id and sweep.model == session.model.name
            if ours and sweep.program_version == version and sweep.done:
                found.append(sweep)
        return found

    # ---- imported -------------------------------------------------------------------------------------------------

    async def imported(self, project: int) -> list[RecordInfo]:
        """The records that were brought into a project, the newest first."""
        return await asyncio.to_thread(self._store.records.all, project)

    async def bring_in(self, project: int, text: str, by: str) -> RecordInfo:
        """Keeps a record from elsewhere; `Refused` says what is wrong with it, and where."""
        if len(await self.imported(project)) >= IMPORTED:
            raise Refused(f"nothing was imported: the project has {IMPORTED} records already, delete one of them first")
        record = await asyncio.to_thread(_read, text)
        return await asyncio.to_thread(self._store.records.add, project, title=record.title[:255], text=text, by=by)

    async def one(self, project: int, id: int) -> tuple[RecordInfo, TestRecord]:
        """A record that was brought in."""
        row = await asyncio.to_thread(self._of_project, project, id)
        return row, await asyncio.to_thread(_read, row.text)

    async def delete(self, project: int, id: int) -> None:
        """Forgets a record that was brought in."""
        await asyncio.to_thread(self._of_project, project, id)
        await asyncio.to_thread(self._store.records.delete, id)

    def _of_project(self, project: int, id: int) -> RecordRow:
        row = self._store.records.get(id)
        if row.project != project:
            raise NotFound(f"there is no record {id} in this project")
        return row


def _read(text: str) -> TestRecord:
    found = from_xml(text)
    if isinstance(found, TestRecord):
        return found
    told: Sequence[str] = [str(problem) for problem in found[:TOLD]]
    more = f"; and {len(found) - TOLD} more" if len(found) > TOLD else ""
    raise Refused(f"this is no test record that can be read, nothing was kept: {'; '.join(told)}{more}")


def _record_cell(model: Model, cell: CellRow) -> RecordCell:
    """The details that it was raised with, beyond those of its row, are named in its note."""
    key, details = key_for(model, cell.error), cell.error.partition(":")[2]
    note = "; ".join(filter(None, ("" if key == cell.error else details, cell.note)))
    return RecordCell(
        key, cell.state, cast(Verdict | None, cell.verdict), cell.first_effect, note, cell.required, cell.unmet, cell.untried
    )  # fmt: skip


def _earlier(count: int, lines: Sequence[LogRow]) -> Iterator[RecordLine]:
    if count:
        said = f"{count:,} earlier lines are not in this record; the event log of the PLC has them"
        yield RecordLine(lines[0].at, lines[0].scan, "server", said)
