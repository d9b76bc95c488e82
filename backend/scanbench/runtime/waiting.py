"""What a run comes back for by itself: what is due, conditions, statements; and what is sampled meanwhile."""

from operator import is_

from scanbench.check.typed.condition import Condition
from scanbench.engines.engine import Engine
from scanbench.engines.sample import Sampling
from scanbench.program.program import Program
from scanbench.runtime.agenda import NOTHING, Agenda, Waits
from scanbench.runtime.command import View


class Waiting:
    """What the PLC waits for, and which engine was told."""

    def __init__(self, agenda: Agenda | None) -> None:
        self.agenda = agenda
        self.until: tuple[Condition, ...] = ()
        """A live run comes back after each scan after which one of them holds. Made for the program that is live: after a change of
        the program whoever set it has to make it again (`Timeline.submit` does). It stays in force through time travel."""
        self.samplings: tuple[Sampling, ...] = ()
        """What is sampled, but not while a program runs that they were not made for. A scan of the past that is run again
        has its rows already, so it gets none."""
        self._sampled: tuple[Engine | None, tuple[Sampling, ...]] = None, ()
        self._stops = _Stops()

    def waits(self, view: View) -> Waits:
        """What the agenda waits for."""
        return NOTHING if self.agenda is None else self.agenda.waits(view)

    def conditions(self, waits: Waits) -> tuple[Condition, ...]:
        """All conditions for which a live run comes back."""
        return (*self.until, *waits.conditions)

    def tell(self, engine: Engine, program: Program, conditions: tuple[Condition, ...]) -> None:
        """This engine is to run the program: for these conditions it comes back, and it samples."""
        self._stops.set(engine, conditions)
        self._sample(engine, tuple(each for each in self.samplings if each.program is program))

    def _sample(self, engine: Engine, samplings: tuple[Sampling, ...]) -> None:
        """This engine samples, and no other does; told only when that changes, as it costs something."""
        before, given = self._sampled
        if before is not None and before is not engine and given:
            before.sample()
        if given != samplings or (samplings and before is not engine):
            engine.sample(*samplings)
        self._sampled = engine, samplings


class _Stops:
    """Which engine was given which conditions last: giving them costs something, so it is done only when they change."""

    def __init__(self) -> None:
        self._engine: Engine | None = None
        self._conditions: tuple[Condition, ...] = ()

    def set(self, engine: Engine, conditions: tuple[Condition, ...]) -> None:
        """This engine is to have these from now on, and no other has any."""
        if self._engine is not None and self._engine is not engine and self._conditions:
            self._engine.stop_when(None)
            self._conditions = ()
        same = len(conditions) == len(self._conditions) and all(map(is_, conditions, self._conditions))
        self._engine = engine
        if not same:
            self._conditions = conditions
            engine.stop_when(None, *conditions)


def held(engine: Engine, waits: Waits) -> frozenset[str]:
    """The texts of the conditions that hold now."""
    return frozenset(each.text for each in waits.conditions if engine.holds(each))
