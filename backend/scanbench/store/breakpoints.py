"""The part of the store that keeps the breakpoints that everybody at an instance shares."""

from collections.abc import Mapping, Sequence

from sqlalchemy import delete, insert, select

from scanbench.store.connected import Repository, the_instance
from scanbench.store.tables import Breakpoint


class Breakpoints(Repository):
    """Breakpoints, as plain data: what they mean is the debugger's affair."""

    def all(self, instance: int) -> list[Mapping[str, object]]:
        """Those of an instance, in their order."""
        with self._database.reading() as session:
            the_instance(session, instance)
            found = select(Breakpoint).where(Breakpoint.instance_id == instance).order_by(Breakpoint.number)
            return [entry.content for entry in session.scalars(found)]

    def keep(self, instance: int, contents: Sequence[Mapping[str, object]]) -> None:
        """These take the place of all that were kept."""
        with self._database.writing() as session:
            the_instance(session, instance, lock=True)
            session.execute(delete(Breakpoint).where(Breakpoint.instance_id == instance))
            if contents:
                rows = [
                    {"instance_id": instance, "number": number, "content": each} for number, each in enumerate(contents)
                ]
                session.execute(insert(Breakpoint), rows)
