"""The part of the store that keeps traces: those of each instance, and records that somebody kept."""

from collections.abc import Mapping

from sqlalchemy import delete, insert, select

from scanbench.runtime.clock import wall_time
from scanbench.store import rows
from scanbench.store.connected import Connected, check, the_instance, the_project
from scanbench.store.records import Json, NotFound, TraceRecordRow
from scanbench.store.tables import AUTHOR, NAME, Trace, TraceRecord


class Traces(Connected):
    """Traces, as plain data: what they mean is the tap's affair. The samples of a record lie in a file."""

    def traces(self, instance: int) -> dict[int, Json]:
        """The traces of an instance, by number."""
        with self._reading() as session:
            the_instance(session, instance)
            found = select(Trace).where(Trace.instance_id == instance).order_by(Trace.number)
            return {entry.number: entry.content for entry in session.scalars(found)}

    def keep_traces(self, instance: int, contents: Mapping[int, Json]) -> None:
        """These take the place of all that were kept."""
        with self._writing() as session:
            the_instance(session, instance, lock=True)
            session.execute(delete(Trace).where(Trace.instance_id == instance))
            if contents:
                made = [
                    {"instance_id": instance, "number": number, "content": each} for number, each in contents.items()
                ]
                session.execute(insert(Trace), made)

    def trace_records(self, project: int) -> list[TraceRecordRow]:
        """The kept records of a project, the newest first."""
        with self._reading() as session:
            the_project(session, project)
            found = select(TraceRecord).where(TraceRecord.project_id == project).order_by(TraceRecord.id.desc())
            return [rows.trace_record(each) for each in session.scalars(found)]

    def trace_record(self, record: int) -> TraceRecordRow:
        """One record."""
        with self._reading() as session:
            found = session.get(TraceRecord, record)
            if found is None:
                raise NotFound(f"there is no trace record {record}")
            return rows.trace_record(found)

    def create_trace_record(self, project: int, *, name: str, instance: str, content: Json, by: str) -> TraceRecordRow:
        """Keeps what is known of a record; its samples are for the caller to write."""
        check("the name", name, NAME)
        with self._writing() as session:
            the_project(session, project)
            made = TraceRecord(
                project_id=project, name=name, instance=instance[:NAME], content=dict(content), by=by[:AUTHOR],
                at=wall_time(),
            )  # fmt: skip
            session.add(made)
            session.flush()
            return rows.trace_record(made)

    def delete_trace_record(self, record: int) -> None:
        """Forgets a record."""
        with self._writing() as session:
            gone = delete(TraceRecord).where(TraceRecord.id == record).returning(TraceRecord.id)
            if session.scalars(gone).first() is None:
                raise NotFound(f"there is no trace record {record}")
