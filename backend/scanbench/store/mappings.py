"""Mappings of trace files to a project's variables, saved under a name."""

from sqlalchemy import delete, select

from scanbench.runtime.clock import wall_time
from scanbench.store.connected import Repository, check, the_project
from scanbench.store.records import Json, MappingRow, NotFound
from scanbench.store.tables import AUTHOR, NAME, TraceMap


class Mappings(Repository):
    """As plain data: what they mean is verification's affair."""

    def all(self, project: int) -> list[MappingRow]:
        """Those of a project, by name."""
        with self._database.reading() as session:
            the_project(session, project)
            found = select(TraceMap).where(TraceMap.project_id == project).order_by(TraceMap.name)
            return list(map(_row, session.scalars(found)))

    def save(self, project: int, name: str, content: Json, by: str) -> MappingRow:
        """Saves one; it replaces that of the same name."""
        check("the name", name, NAME)
        with self._database.writing() as session:
            the_project(session, project)
            same = (TraceMap.project_id == project) & (TraceMap.name == name)
            made = session.scalars(select(TraceMap).where(same).with_for_update()).first()
            if made is None:
                made = TraceMap(project_id=project, name=name)
                session.add(made)
            made.content, made.by, made.at = dict(content), by[:AUTHOR], wall_time()
            session.flush()
            return _row(made)

    def delete(self, mapping: int) -> None:
        """Forgets one."""
        with self._database.writing() as session:
            gone = delete(TraceMap).where(TraceMap.id == mapping).returning(TraceMap.id)
            if session.scalars(gone).first() is None:
                raise NotFound(f"there is no mapping {mapping}")


def _row(row: TraceMap) -> MappingRow:
    return MappingRow(row.id, row.project_id, row.name, row.content, row.by)
