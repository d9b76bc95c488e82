"""Records that somebody kept in a project: of traces, of verifications. Their large parts are in files next to the database."""

from typing import Literal

from sqlalchemy import delete, select

from scanbench.runtime.clock import wall_time
from scanbench.store.connected import Repository, check, the_project
from scanbench.store.records import Json, KeptRow, NotFound
from scanbench.store.tables import AUTHOR, NAME, Base, TraceRecord, VerificationRecord

What = Literal["trace", "verification"]
_TABLES: dict[What, type[TraceRecord] | type[VerificationRecord]] = {
    "trace": TraceRecord, "verification": VerificationRecord,
}  # fmt: skip


class KeptRecords(Repository):
    """What they mean is not the store's affair."""

    def all(self, what: What, project: int) -> list[KeptRow]:
        """The records of a project, the newest first."""
        table = _TABLES[what]
        with self._database.reading() as session:
            the_project(session, project)
            found = select(table).where(table.project_id == project).order_by(table.id.desc())
            return [_row(each) for each in session.scalars(found)]

    def get(self, what: What, record: int) -> KeptRow:
        """One record."""
        with self._database.reading() as session:
            found = session.get(_TABLES[what], record)
            if found is None:
                raise NotFound(f"there is no {what} record {record}")
            return _row(found)

    def keep(self, what: What, project: int, *, name: str, instance: str, content: Json, by: str) -> KeptRow:
        """Keeps what is known of a record; its file is for the caller to write."""
        check("the name", name, NAME)
        with self._database.writing() as session:
            the_project(session, project)
            made = _TABLES[what](
                project_id=project, name=name, instance=instance[:NAME], content=dict(content), by=by[:AUTHOR],
                at=wall_time(),
            )  # fmt: skip
            session.add(made)
            session.flush()
            return _row(made)

    def forget(self, what: What, record: int) -> None:
        """Forgets a record."""
        table = _TABLES[what]
        with self._database.writing() as session:
            gone = delete(table).where(table.id == record).returning(table.id)
            if session.scalars(gone).first() is None:
                raise NotFound(f"there is no {what} record {record}")


def _row(row: Base) -> KeptRow:
    assert isinstance(row, TraceRecord | VerificationRecord)
    return KeptRow(row.id, row.project_id, row.name, row.instance, row.content, row.by, row.at)
