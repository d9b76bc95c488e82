"""Who is at a project, and where: in which file, at which line, with what selected. Everybody else there is told; nothing of it is kept."""

from dataclasses import replace

from scanbench.wire.events import Subscriber
from scanbench.wire.together import PeopleChanged, Person

COLOURS = 8


class People:
    """Those who are connected to any PLC of a project."""

    def __init__(self) -> None:
        self._here: dict[int, tuple[int, Subscriber, Person]] = {}
        self._last = 0

    def come(self, project: int, instance: int, who: Subscriber) -> int:
        """Somebody is here from now on; the number to move and leave with."""
        self._last += 1
        user = who.user
        colour = self._colour(project, user.name)
        self._here[self._last] = (project, who, Person(self._last, user.name, user.initials, colour, instance))
        self._tell(project)
        return self._last

    def move(
        self, id: int, file: str | None, line: int | None, anchor: str | None = None, head: str | None = None
    ) -> None:
        """They look at a different place."""
        if id in self._here:
            project, who, person = self._here[id]
            self._here[id] = (project, who, replace(person, file=file, line=line, anchor=anchor, head=head))
            self._tell(project)

    def leave(self, id: int) -> None:
        """They are gone."""
        if id in self._here:
            self._tell(self._here.pop(id)[0])

    def _colour(self, project: int, name: str) -> int:
        """That of their other windows, else the first that nobody has."""
        taken = {person.name: person.colour for of, _, person in self._here.values() if of == project}
        free = (colour for colour in range(COLOURS) if colour not in taken.values())
        return taken[name] if name in taken else next(free, len(taken) % COLOURS)

    def _tell(self, project: int) -> None:
        here = [(who, person) for of, who, person in self._here.values() if of == project]
        people = tuple(person for _, person in here)
        for who, person in here:
            who.on_event(PeopleChanged(person.id, people))
