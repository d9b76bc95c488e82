"""A PLC that was halted inside of a scan when its process ended, and is to be halted there again."""

from scanbench.debug.debugger import Debugger
from scanbench.engines.debug import Listen
from scanbench.engines.engine import Reason
from scanbench.recording.timeline import Timeline
from scanbench.runtime.inside import HaltAt


def halt_again(debugger: Debugger, timeline: Timeline, count: int, why: str) -> None:
    """From a halt in the seam to the statement of this count. Where the scan does not get so far any more, to the seam after it. Nothing
    else halts it on the way."""
    with timeline.resource.listening.instead(HaltAt(count), Listen(count=count)):
        while timeline.run(1).reason is Reason.INTERRUPTED:
            pass
    debugger.halt_at_start(why)
