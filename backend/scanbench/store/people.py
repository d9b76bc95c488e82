"""The part of the store that keeps what is known of people: each has a colour at a project, the same for good."""

from collections import Counter
from collections.abc import Collection

from sqlalchemy import select

from scanbench.store.connected import Repository, the_project
from scanbench.store.tables import Person

COLOURS = 8


class People(Repository):
    """People by project and name."""

    def colour(self, project: int, name: str, taken: Collection[int] = ()) -> int:
        """Somebody's colour. Who is new gets the one that the fewest have: not one of those `taken`, while there are others."""
        with self._database.writing() as session:
            the_project(session, project, lock=True)
            known = session.get(Person, (project, name))
            if known is not None:
                return known.colour
            held = Counter(session.scalars(select(Person.colour).where(Person.project_id == project)))
            colour = min(range(COLOURS), key=lambda each: (each in taken, held[each], each))
            session.add(Person(project_id=project, name=name, colour=colour))
            return colour
