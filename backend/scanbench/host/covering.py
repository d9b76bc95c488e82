"""Coverage in the process of a PLC: what was reached since somebody wanted to know."""

from collections.abc import Callable

from scanbench.debug.debugger import Debugger
from scanbench.engines.observe import Seen
from scanbench.recording.timeline import Timeline
from scanbench.taps.coverage import CoverageTap
from scanbench.wire.debugging import Coverage, CoverageIs
from scanbench.wire.host import Sources


class Covering:
    """Keeps what was reached when it is switched off; it goes on when it is switched on again."""

    def __init__(self, timeline: Timeline, sources: Callable[[int], Sources]) -> None:
        self._timeline, self._sources = timeline, sources
        self._tap: CoverageTap | None = None
        self._on = False
        self._noted = 0
        self.more = False
        """Whether more was reached since it was told last."""

    def set(self, debugger: Debugger, on: bool, reset: bool) -> None:
        """Notes from now on, or no longer."""
        if reset or (on and self._tap is None):
            sites = debugger.breakpoints.placing(self._timeline.live).sites
            self._tap = CoverageTap(sites, self._texts(), self._timeline.live_scan)
        resource = self._timeline.resource
        if not on:
            resource.listening.look()
        elif not self._on or reset:
            self._noted = self._timeline.live_scan
        self._on = debugger.covering = on
        resource.listening.tell_seen(self._note if on else None)
        self.more = True

    def moved(self, debugger: Debugger) -> None:
        """Adapts to a new program after a program change."""
        if self._tap is not None and not self._timeline.past:
            sites = debugger.breakpoints.placing(self._timeline.live).sites
            self._tap.change(sites, self._texts())
            self.more = True

    def answer(self, ref: int | None) -> CoverageIs:
        """What was reached so far."""
        self.more = False
        tap = self._tap
        if tap is None:
            return CoverageIs(ref, Coverage(False, self._timeline.live_scan, 0, ()))
        return CoverageIs(ref, Coverage(self._on, tap.since_scan, tap.scans, tap.files))

    def _note(self, seen: Seen) -> None:
        if self._tap is None or self._timeline.past:
            return
        scan = self._timeline.live_scan
        scans, self._noted = max(0, scan - self._noted), scan
        self.more = self._tap.note(seen, scans) or self.more

    def _texts(self) -> dict[str, str]:
        return dict(self._sources(self._timeline.live.version).files)
