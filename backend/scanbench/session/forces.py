"""The forces of one PLC, as its host told of them last."""

from collections.abc import Callable, Mapping, Sequence

from scanbench.runtime.command import Entry
from scanbench.runtime.forces import FORCED, Force, ForcedValue
from scanbench.session.instance import Instance
from scanbench.wire import events
from scanbench.wire.events import Event
from scanbench.wire.host import ForcesAre, WantForces
from scanbench.wire.refused import Unavailable


class Forces:
    """What holds, in the order in which it was made."""

    def __init__(self, instance: Instance, publish: Callable[[Event], None]) -> None:
        self._instance, self._publish = instance, publish
        self.all: tuple[ForcedValue, ...] = ()
        self._held: Mapping[str, Force] = {}
        self._ended: dict[str, events.EndedForce] = {}
        """Since the forces were told last; by path in capital letters."""

    async def now(self) -> tuple[ForcedValue, ...]:
        """The forces, and what they did in the scan that ran last; of a PLC that is not there those that were told last.
        Before that is answered, whatever else holds is told."""
        try:
            return (await self._instance.ask(WantForces, ForcesAre)).forces
        except Unavailable:
            return self.all

    def on_new_run(self) -> None:
        """Those of the run before hold no more."""
        if self.all:
            self._take(())

    def on_entries(self, entries: Sequence[Entry]) -> None:
        """What was entered: the host tells of it before the forces that then hold. Who ended one is told with those."""
        for entry in entries:
            after = FORCED.step(self._held, entry)
            for key in self._held.keys() - after.keys():
                self._ended[key] = events.EndedForce(self._held[key].path, entry.command.author)
            self._held = after

    def on_message(self, message: object) -> bool:
        """What the host says; whether it was about forces."""
        if not isinstance(message, ForcesAre):
            return False
        self._take(message.forces)
        return True

    def _take(self, forces: tuple[ForcedValue, ...]) -> None:
        self.all = forces
        self._held = {each.path.upper(): Force(each.author, each.path, each.value, each.through) for each in forces}
        ended = tuple(each for key, each in self._ended.items() if key not in self._held)
        self._ended = {}
        self._publish(events.ForcesChanged(forces, ended))
