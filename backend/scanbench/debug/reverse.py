"""Back to where something happened last: from the newest checkpoint's stretch of the run to the oldest."""

from bisect import bisect_left
from dataclasses import replace
from operator import attrgetter

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.breakpoints import Breakpoints
from scanbench.debug.listener import Found, Listener, Position
from scanbench.engines.engine import Reason
from scanbench.runtime.command import Refusal
from scanbench.runtime.timeline import Timeline


class Noting(Listener):
    """Halts nowhere: notes the last place where it would have halted, of an access the statement that makes it."""

    noted: tuple[Position, Found] | None = None
    before: Position = (1 << 62, 0)
    """What is there and behind it does not count."""

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        if super().statement(site, count, depth):
            if self.found is None:
                return True  # the end of what was run
            self._note(count, self.found)
        return False

    def _touched(self, count: int, found: Found) -> None:
        self._note(count, found)

    def _note(self, count: int, found: Found) -> None:
        here = self._resource.header.scan, count
        if here < self.before:
            self.noted = here, found


def search(
    timeline: Timeline, breakpoints: Breakpoints, here: Position, author: str, path: str
) -> Found | Refusal:  # fmt: skip
    """Shows the last position before `here` where a breakpoint would have halted, or the statement that wrote `path`."""
    wanted = _wanted(breakpoints, author, path)
    if not any(each.enabled for each in wanted):
        return Refusal("there is no breakpoint to go back to: set one, or name a variable whose last write is wanted")
    checkpoints, until = timeline.recording.checkpoints, here[0] + (here[1] > 0)
    for checkpoint in reversed(checkpoints[: bisect_left(checkpoints, until, key=attrgetter("scan"))]):
        noted = _last(timeline, breakpoints, wanted, range(checkpoint.scan, until), here)
        if isinstance(noted, Refusal):
            return noted
        if noted is not None:
            position, found = noted
            return timeline.goto(*position) or found
        until = checkpoint.scan
    return Refusal(f"that did not happen since scan {timeline.recording.first_scan}, the first one that is kept")


def _wanted(breakpoints: Breakpoints, author: str, path: str) -> list[Breakpoint]:
    if path:
        return [Breakpoint(0, "data", author, path=path, access="write")]
    return [replace(each.breakpoint, hits="") for each in breakpoints.placed if each.halts]


def _last(
    timeline: Timeline, breakpoints: Breakpoints, wanted: list[Breakpoint], scans: range, here: Position
) -> tuple[Position, Found] | Refusal | None:  # fmt: skip
    """The last place in these scans."""
    refusal = timeline.goto(scans.start)
    if refusal is not None:
        return refusal
    resource, live, noted = timeline.resource, timeline.live_inside, None
    hook = resource.hook
    try:
        while True:
            placing = breakpoints.placing(resource.loaded)
            placed = [placing.place(each, scans.start) for each in wanted]
            if all(each.flaw for each in placed):
                return Refusal(placed[0].flaw)
            resource.hook = noting = Noting(resource, placing, placed, None)
            noting.before = here
            if live is not None:
                noting.passed.end = timeline.live_scan, live.count
            noting.begin()
            stop = timeline.go_on(scans.stop)
            noted = noting.noted or noted
            if stop.reason is not Reason.KNOCKED:
                return noted
    finally:
        resource.hook = hook
