"""Back to where something happened last: from the newest checkpoint's stretch of the run to the oldest."""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import replace
from operator import attrgetter

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.breakpoints import Breakpoints
from scanbench.debug.listener import Found, Listener, Position
from scanbench.debug.probing import Prober, notes_of
from scanbench.engines.engine import Reason
from scanbench.engines.probe import BadProbe, ProbedEngine
from scanbench.runtime.command import Refusal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.timeline import Timeline

_WORTH = 256
"""Scans for which code with probes is worth making."""
_TRIES = 16
"""Scans in which a probe was reached in vain, before all are looked at statement by statement."""


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


class Search:
    """The last position before one where any of some breakpoints would have halted."""

    def __init__(
        self, timeline: Timeline, breakpoints: Breakpoints, wanted: Sequence[Breakpoint], here: Position,
        prober: Prober | None,
    ) -> None:  # fmt: skip
        self._timeline, self._breakpoints, self._wanted, self._here = timeline, breakpoints, wanted, here
        self._prober = prober
        self._probed: dict[Loaded, ProbedEngine | None] = {}
        self._entered = {each.scan for each in timeline.live_journal if each.step}

    def run(self) -> tuple[Position, Found] | Refusal | None:
        """Where, and what; None: nowhere."""
        checkpoints, (scan, count) = self._timeline.recording.checkpoints, self._here
        if count:
            found = self._last(range(scan, scan + 1))
            if found is not None:
                return found
        until = scan
        for checkpoint in reversed(checkpoints[: bisect_left(checkpoints, until, key=attrgetter("scan"))]):
            found = self._in_stretch(range(checkpoint.scan, until))
            if found is not None:
                return found
            until = checkpoint.scan
        return None

    def _in_stretch(self, scans: range) -> tuple[Position, Found] | Refusal | None:
        """The last place in these scans: by probes as long as they lead anywhere."""
        for _ in range(_TRIES if self._prober is not None and len(scans) > _WORTH else 0):
            reached = self._last_reached(scans)
            if isinstance(reached, Refusal) or reached is None:
                return reached
            if reached < scans.start:  # no probes can be had
                break
            found = self._last(range(reached, reached + 1))
            if found is not None:
                return found
            scans = range(scans.start, reached)
            if not scans:
                return None
        return self._last(scans)

    def _last_reached(self, scans: range) -> Refusal | int | None:
        """The last of these scans in which it may be; -1 when that cannot be told."""
        timeline, resource = self._timeline, self._timeline.resource
        refusal = timeline.goto(scans.start)
        if refusal is not None:
            return refusal
        hook, resource.hook = resource.hook, None
        found = [each for each in self._entered if each in scans]
        try:
            while True:
                loaded = resource.loaded
                engine = self._engine(loaded)
                if engine is None:
                    return -1
                engine.forget()
                usual, loaded.engine = loaded.engine, engine
                try:
                    stop = timeline.go_on(scans.stop)
                finally:
                    loaded.engine = usual
                found += [each for each in engine.reached if each is not None]
                if stop.reason is not Reason.KNOCKED:
                    return max(found, default=None)
        finally:
            resource.hook = hook

    def _engine(self, loaded: Loaded) -> ProbedEngine | None:
        if loaded not in self._probed:
            placing = self._breakpoints.placing(loaded)
            probes = notes_of([placing.place(each, 0) for each in self._wanted], placing)
            made = None
            if probes is not None and self._prober is not None:
                try:
                    made = self._prober(loaded.statements, loaded.memory, probes)
                except BadProbe:
                    made = None
            self._probed[loaded] = made
        return self._probed[loaded]

    def _last(self, scans: range) -> tuple[Position, Found] | Refusal | None:
        """The last place in these scans, statement by statement."""
        timeline, wanted = self._timeline, self._wanted
        refusal = timeline.goto(scans.start)
        if refusal is not None:
            return refusal
        resource, live, noted = timeline.resource, timeline.live_inside, None
        hook = resource.hook
        try:
            while True:
                placing = self._breakpoints.placing(resource.loaded)
                placed = [placing.place(each, scans.start) for each in wanted]
                if all(each.flaw for each in placed):
                    return Refusal(placed[0].flaw)
                resource.hook = noting = Noting(resource, placing, placed, None)
                noting.before = self._here
                if live is not None:
                    noting.passed.end = timeline.live_scan, live.count
                noting.begin()
                stop = timeline.go_on(scans.stop)
                noted = noting.noted or noted
                if stop.reason is not Reason.KNOCKED:
                    return noted
        finally:
            resource.hook = hook


def search(
    timeline: Timeline, breakpoints: Breakpoints, here: Position, author: str, path: str, prober: Prober | None
) -> Found | Refusal:  # fmt: skip
    """Shows the last position before `here` where a breakpoint would have halted, or the statement that wrote `path`."""
    wanted = _wanted(breakpoints, author, path)
    if not any(each.enabled for each in wanted):
        return Refusal("there is no breakpoint to go back to: set one, or name a variable whose last write is wanted")
    found = Search(timeline, breakpoints, wanted, here, prober).run()
    if isinstance(found, Refusal):
        return found
    if found is None:
        return Refusal(f"that did not happen since scan {timeline.recording.first_scan}, the first one that is kept")
    return timeline.goto(*found[0]) or found[1]


def _wanted(breakpoints: Breakpoints, author: str, path: str) -> list[Breakpoint]:
    if path:
        return [Breakpoint(0, "data", author, path=path, access="write")]
    return [replace(each.breakpoint, hits="") for each in breakpoints.placed if each.halts]
