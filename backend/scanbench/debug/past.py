"""Steps in the past: back to an earlier position, and forward again up to the position of the live PLC."""

from typing import Literal

from scanbench.debug.breakpoints import Breakpoints
from scanbench.debug.goals import Goal
from scanbench.debug.halt import Found
from scanbench.debug.listener import Listener, Position
from scanbench.debug.reverse import Raised, search
from scanbench.engines.engine import Reason
from scanbench.engines.probe import MakeProbed
from scanbench.recording.again import statements_of
from scanbench.recording.gaps import gap_before
from scanbench.recording.timeline import NOT_SHOWN, Timeline
from scanbench.runtime.command import Refusal

_EMPTY = 10_000
"""Scans in which no statement runs that a step back passes over, at most."""


class Past:
    """Moves through earlier scans. The live PLC does not run meanwhile."""

    def __init__(self, timeline: Timeline, breakpoints: Breakpoints) -> None:
        self._timeline, self._breakpoints = timeline, breakpoints
        self.prober: MakeProbed | None = None
        self.raised: Raised = lambda entry: ()
        self._listener: Listener | None = None
        self._goal: Goal | None = None
        self._from: Position = (0, 0)
        """Where the step forward began."""

    # ---- forward --------------------------------------------------------------------------------------------------

    @property
    def moving(self) -> bool:
        """Whether a step forward is under way."""
        return self._goal is not None

    def begin(self, goal: Goal) -> None:
        """A step forward from here."""
        self._goal, self._listener, self._from = goal, None, self.position

    def stop(self) -> None:
        """The step is given up."""
        self._goal = self._listener = None

    def move(self) -> Found | Literal["live"] | None:
        """Continues: gives where it halted, "live" if it reached the position of the live PLC, None if it was interrupted. Where the
        run cannot be repeated it halts where the step began, and says why."""
        try:
            return self._moved()
        except NOT_SHOWN as error:
            text = _not_shown(self._timeline.resource.header.scan, error).message
            begin = self._from
            self.stop()
            return "live" if self._timeline.goto(*begin) is not None else Found("step", text, "")

    def _moved(self) -> Found | Literal["live"] | None:
        timeline, resource, goal = self._timeline, self._timeline.resource, self._goal
        assert goal is not None
        listener = self._listener
        if listener is None or listener.loaded is not resource.loaded:
            listener = self._listener = self._listening(goal)
        inside = resource.listening.inside
        if inside is not None:
            listener.passed.begin = resource.header.scan, inside.count
        with resource.listening.instead(listener):
            listener.begin()
            stop = timeline.go_on(timeline.live_scan + 1)
        if stop.reason is Reason.INTERRUPTED:
            found = listener.after_scan()
            if found is not None:
                self.stop()
            return found
        self.stop()
        if stop.reason is Reason.HALTED and listener.found is not None:
            return listener.found
        return "live"

    def _listening(self, goal: Goal) -> Listener:
        timeline, resource = self._timeline, self._timeline.resource
        placed = self._breakpoints.placed_in(resource.loaded, resource.header.scan)
        listener = Listener(resource, self._breakpoints.placing(resource.loaded), placed, None)
        listener.goal = goal
        live = timeline.live_inside
        if live is not None:
            listener.passed.end = timeline.live_scan, live.count
        return listener

    # ---- back -----------------------------------------------------------------------------------------------------

    @property
    def position(self) -> Position:
        """What is shown."""
        resource = self._timeline.resource
        return resource.header.scan, resource.listening.inside.count if resource.listening.inside is not None else 0

    def back(self, author: str) -> Found | Refusal:
        """To the statement before."""
        before = self._before()
        if isinstance(before, Refusal):
            return before
        refusal = self._timeline.goto(*before)
        return refusal or Found("step", f"step back by {author}", author)

    def _before(self) -> Position | Refusal:
        timeline = self._timeline
        scan, count = self.position
        if count > 1:
            return scan, count - 1
        if timeline.resource.header.halted_by_trap:
            scan += 1  # part of the scan that trapped was run, so that scan is searched too
        gap = gap_before(timeline.recording.gaps, scan)
        begin = gap.until if gap is not None else timeline.recording.first_scan
        first = max(begin, scan - _EMPTY)
        for each in range(scan - 1, first - 1, -1):
            found = statements_of(timeline, each)
            if isinstance(found, Refusal):
                return found
            if found:
                return each, found
        if first > begin:
            return Refusal(f"no statement ran in the last {_EMPTY} scans: go back to an earlier scan")
        if gap is not None:
            return Refusal(f"this is the first statement that is kept after a part that is lost: {gap}")
        return Refusal(f"this is the first statement that is kept: the run begins with scan {first}")

    def reverse(self, author: str, path: str) -> Found | Refusal:
        """To where a breakpoint would have halted last, or to the last write of a variable."""
        timeline, here = self._timeline, self.position if self._timeline.past else None
        found: Found | Refusal
        try:
            found = search(timeline, self._breakpoints, self.position, author, path, self.prober, self.raised)
        except NOT_SHOWN as error:
            found = _not_shown(timeline.resource.header.scan, error)
        if isinstance(found, Refusal):
            if here is not None:
                timeline.goto(*here)
            else:
                timeline.return_live()
        return found


def _not_shown(scan: int, error: BaseException) -> Refusal:
    return Refusal(f"scan {scan} cannot be shown: {error}")
