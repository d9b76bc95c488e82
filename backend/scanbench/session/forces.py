"""The forces of one PLC, as its host told of them last."""

from collections.abc import Callable

from scanbench.runtime.forces import ForcedValue
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

    def on_message(self, message: object) -> bool:
        """What the host says; whether it was about forces."""
        if not isinstance(message, ForcesAre):
            return False
        self._take(message.forces)
        return True

    def _take(self, forces: tuple[ForcedValue, ...]) -> None:
        self.all = forces
        self._publish(events.ForcesChanged(forces))
