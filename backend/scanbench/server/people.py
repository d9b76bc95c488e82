"""Who is at a project, and where: in which file, at which line, with what selected. Everybody else there is told. Of all this only
the colours of people are kept."""

import asyncio
import logging
from collections.abc import Callable, Collection
from dataclasses import replace

from scanbench.store.people import COLOURS
from scanbench.store.records import NotFound, StoreError
from scanbench.wire.events import Subscriber
from scanbench.wire.together import PeopleChanged, Person

log = logging.getLogger("scanbench")
Colour = Callable[[int, str, Collection[int]], int]
"""The colour of somebody at a project, and for who is new one that nobody there has: of the store."""


class People:
    """Those who are connected to any PLC of a project."""

    def __init__(self, colour: Colour) -> None:
        self._kept_colour = colour
        self._here: dict[int, tuple[int, Subscriber, Person]] = {}
        self._last = 0

    async def colour(self, project: int, name: str) -> int:
        """Somebody's colour at a project: the same whenever they come, and after a restart of the server."""
        taken = {person.colour for of, _, person in self._here.values() if of == project and person.name != name}
        try:
            return await asyncio.to_thread(self._kept_colour, project, name, taken)
        except (NotFound, StoreError) as error:
            log.error("the colour of %s is not known: %s", name, error)
            return next((each for each in range(COLOURS) if each not in taken), 0)

    def come(self, project: int, instance: int, who: Subscriber, colour: int) -> int:
        """Somebody is here from now on; the number to move and leave with."""
        self._last += 1
        user = who.user
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

    def _tell(self, project: int) -> None:
        here = [(who, person) for of, who, person in self._here.values() if of == project]
        people = tuple(person for _, person in here)
        for who, person in here:
            who.on_event(PeopleChanged(person.id, people))
