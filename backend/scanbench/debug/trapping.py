"""Breakpoints at run-time errors: the scan is run again up to the statement that traps, and halted before it."""

from scanbench.debug.breakpoints import Breakpoints
from scanbench.debug.halt import Found
from scanbench.debug.listener import Position
from scanbench.engines.debug import NOTHING, Listen
from scanbench.engines.engine import Reason
from scanbench.recording.timeline import Timeline
from scanbench.runtime.inside import HaltAt


class Trapping:
    """Halts once before each trap: going on lets it trap."""

    def __init__(self, timeline: Timeline, breakpoints: Breakpoints) -> None:
        self._timeline, self._breakpoints = timeline, breakpoints
        self._found: Found | None = None
        self._seen: Position | None = None
        """The statement before which it halted before it traps."""

    def take(self) -> Found | None:
        """Why it is halted, where it is so before a trap; once."""
        found, self._found = self._found, None
        return found

    def forget(self) -> None:
        """The scan is over in which it was halted."""
        self._seen = None

    def halts(self) -> bool:
        """Before the statement that traps, if somebody wants that; it is run again up to there."""
        breakpoints = [each for each in self._breakpoints.placed if each.active and each.breakpoint.kind == "trap"]
        resource = self._timeline.resource
        scan = resource.header.scan
        if not breakpoints or (self._seen is not None and self._seen[0] == scan):
            self._seen = None
            return False
        self._timeline.rewind()
        engine = resource.loaded.debugged()
        with resource.listening.instead(HaltAt(0), NOTHING):
            self._run_again()
            count = engine.count
            resource.memory[:] = engine.begin
            if count:
                resource.listening.attach(HaltAt(count), Listen(count=count))
                self._run_again()
        if resource.listening.inside is None:
            return False
        self._seen = scan, count
        placed = breakpoints[0]
        placed.hits += 1
        text = "the statement ends in a run-time error"
        self._found = Found("trap", text, placed.breakpoint.author, (placed.breakpoint.id,))
        return True

    def _run_again(self) -> None:
        while self._timeline.resource.rerun(1).reason is Reason.INTERRUPTED:
            pass
