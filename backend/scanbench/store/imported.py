"""The part of the store that keeps test records from elsewhere."""

from sqlalchemy import delete, select

from scanbench.runtime.clock import wall_time
from scanbench.store import rows
from scanbench.store.connected import Repository, check, the_project
from scanbench.store.records import NotFound, RecordInfo, RecordRow
from scanbench.store.tables import AUTHOR, PATH, TestRecord


class ImportedRecords(Repository):
    """Imported test records, as they came."""

    def all(self, project: int) -> list[RecordInfo]:
        """The records of a project, the newest first."""
        with self._database.reading() as session:
            the_project(session, project)
            found = select(TestRecord).where(TestRecord.project_id == project).order_by(TestRecord.id.desc())
            return [rows.record(each) for each in session.scalars(found)]

    def get(self, record: int) -> RecordRow:
        """One record with its text."""
        with self._database.reading() as session:
            found = session.get(TestRecord, record)
            if found is None:
                raise NotFound(f"there is no record {record}")
            return RecordRow(found.id, found.project_id, found.title, found.by, found.at, found.text)

    def add(self, project: int, *, title: str, text: str, by: str) -> RecordInfo:
        """Keeps a record."""
        check("the title", title, PATH)
        check("the record", text)
        with self._database.writing() as session:
            the_project(session, project)
            made = TestRecord(project_id=project, title=title, text=text, by=by[:AUTHOR], at=wall_time())
            session.add(made)
            session.flush()
            return rows.record(made)

    def delete(self, record: int) -> None:
        """Forgets a record."""
        with self._database.writing() as session:
            gone = delete(TestRecord).where(TestRecord.id == record).returning(TestRecord.id)
            if session.scalars(gone).first() is None:
                raise NotFound(f"there is no record {record}")
