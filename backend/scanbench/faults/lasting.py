"""Errors whose cause outlives a restart: a battery is as flat after power was off as before.

A restart leaves no error in the memory. What the simulator raised and whose cause lasts is raised again in the same seam
(`schedule.py` asks for it), whatever the order of the commands there; so the journal and the log show it, and a replay knows it.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from scanbench.faults.arm import ARMED, Lanes
from scanbench.faults.details import Chosen, choose
from scanbench.faults.inject import ACTIVE, Generate, Recover, takes_back
from scanbench.faults.present import NOTHING, Active, Raised
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.command import Entry, Refusal, View
from scanbench.runtime.journal import Fold


@dataclass(frozen=True, slots=True)
class CutOff:
    """What a restart ended."""

    present: Mapping[str, Active]
    lanes: Lanes
    gone: tuple[Raised, ...]
    """Raised at the simulator, cut off by a restart, and neither raised nor recovered since."""


def _step(known: CutOff, entry: Entry) -> CutOff:
    present, lanes, gone = ACTIVE.step(known.present, entry), ARMED.step(known.lanes, entry), known.gone
    command = entry.command
    if entry.plan.starts_fresh:
        # a fault that comes and goes by itself ends with the restart
        passing = [lane for lane in known.lanes.values() if lane.wanted.shape.kind != "stay"]
        before = (each for active in known.present.values() for each in active.raised if each.origin == "simulator")
        gone = (*gone, *(each for each in before if not any(lane.has_raised(each.ref) for lane in passing)))
    elif gone and isinstance(command, Generate):
        gone = tuple(each for each in gone if not _again(each.ref, command))
    elif gone and isinstance(command, Recover):
        gone = tuple(each for each in gone if not takes_back(command, each.ref))
    if present is known.present and lanes is known.lanes and gone is known.gone:
        return known
    return CutOff(present, lanes, gone)


def _again(ref: ErrorRef, command: Generate) -> bool:
    """Whether this error is raised again, in whatever way."""
    if command.replaces is None:
        return any(ref.id == each.id for each in command.errors)
    return ref in command.errors


CUT_OFF: Fold[CutOff] = Fold(CutOff(NOTHING, {}, ()), _step)


def returning(view: View) -> Generate | None:
    """The first error that a restart cut off and whose cause is still there."""
    for raised in view.derived(CUT_OFF).gone:
        error = view.model.error(raised.ref.id)
        chosen = None if error is None else choose(error, dict(raised.ref.details), view.program.layout)
        if not isinstance(chosen, Chosen) or not chosen.lasting:
            continue
        command = Generate(raised.by, (raised.ref,), anyway=True)
        if not isinstance(command.plan(view), Refusal):
            return command
    return None
