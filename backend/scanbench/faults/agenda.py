"""What comes by itself in a run: armed errors and disturbances."""

from scanbench.engines.observe import MakeObserved
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.faults.schedule import Schedule
from scanbench.runtime.joined import Joined


def agenda_of_faults(observed: MakeObserved) -> Joined:
    """Of one PLC; `observed` makes the flavour that notes what statements read and write."""
    return Joined(Schedule(observed), DisturbanceSchedule())
