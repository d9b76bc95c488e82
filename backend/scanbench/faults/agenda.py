"""What comes by itself in a run: armed errors, disturbances, ends of communications instructions, and faults of lines that come and go."""

from scanbench.engines.observe import MakeObserved
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.faults.line_faults import Lines
from scanbench.faults.network_agenda import Network
from scanbench.faults.schedule import Schedule
from scanbench.runtime.joined import Joined


def agenda_of_faults(observed: MakeObserved) -> Joined:
    """Of one PLC; `observed` makes the flavour that notes what statements read and write."""
    return Joined(Schedule(observed), DisturbanceSchedule(), Network(), Lines())
