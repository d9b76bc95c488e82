"""The part of the store that keeps the traces of each instance."""

from collections.abc import Mapping

from sqlalchemy import delete, insert, select

from scanbench.store.connected import Repository, the_instance
from scanbench.store.records import Json
from scanbench.store.tables import Trace


class Traces(Repository):
    """Traces, as plain data: what they mean is the tap's affair."""

    def all(self, instance: int) -> dict[int, Json]:
        """The traces of an instance, by number."""
        with self._database.reading() as session:
            the_instance(session, instance)
            found = select(Trace).where(Trace.instance_id == instance).order_by(Trace.number)
            return {entry.number: entry.content for entry in session.scalars(found)}

    def keep(self, instance: int, contents: Mapping[int, Json]) -> None:
        """These take the place of all that were kept."""
        with self._database.writing() as session:
            the_instance(session, instance, lock=True)
            session.execute(delete(Trace).where(Trace.instance_id == instance))
            if contents:
                made = [
                    {"instance_id": instance, "number": number, "content": each} for number, each in contents.items()
                ]
                session.execute(insert(Trace), made)
