"""What became of a command, as an end code."""

from scanbench.comm.door import Door
from scanbench.comm.fins.codes import End, Refused
from scanbench.faults.clear import WILL_NOT_CLEAR
from scanbench.runtime.command import Command
from scanbench.runtime.write_areas import READ_ONLY

_SAID = ((READ_ONLY, End.READ_ONLY), (WILL_NOT_CLEAR, End.NOT_CLEARED))


async def enter(door: Door, command: Command, otherwise: End = End.CANNOT_CHANGE) -> None:
    """Enters it; `Refused` with the end code of the refusal, or `otherwise`."""
    done = await door.submit(command)
    if not done.ok:
        raise Refused(next((end for text, end in _SAID if text in done.message), otherwise))
