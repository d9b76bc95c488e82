"""The contract of who enters commands by itself, when their time comes: faults with a shape.

The resource asks in the seam of a run, and journals what is entered; a replay re-enters that and never asks.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from scanbench.check.typed.condition import Condition
from scanbench.engines.observe import Observed
from scanbench.runtime.command import Command, Refusal, View
from scanbench.runtime.inside import Insider
from scanbench.runtime.programs import Loaded


@dataclass(frozen=True, slots=True)
class Waits:
    """What the run has to come back for."""

    scan: int | None = None
    """Something is due before this one, which is to come."""
    conditions: tuple[Condition, ...] = ()
    sites: frozenset[int] = frozenset()
    """Statements (`symbols.sites`): while there are any, the run comes back after every scan."""
    observed: Callable[[Loaded], Observed] | None = None
    """Makes code of a program that notes the statements it reaches, on its memory; where there are `sites`."""
    inside: Insider | None = None
    """Who enters something inside of the scan that is next: that one runs alone, in the debug flavour."""


@dataclass(frozen=True, slots=True)
class Met:
    """What came true in the scan that just ended."""

    conditions: frozenset[str] = frozenset()
    """Their texts."""
    sites: frozenset[int] = frozenset()


NOTHING = Waits()
NONE_MET = Met()


class Agenda(Protocol):
    """All that it knows is in the journal of the view."""

    def due(self, view: View, met: Met) -> Command | None:
        """What is to be entered in this seam; asked again after each entry, until there is nothing more."""

    def refused(self, command: Command, refusal: Refusal) -> Command:
        """What is entered instead of a command that was refused: it must not be refused, nor the same be due again."""

    def waits(self, view: View) -> Waits:
        """What it waits for, when nothing is due."""
