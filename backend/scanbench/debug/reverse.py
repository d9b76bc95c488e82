"""Back to where something happened last: from the newest checkpoint's stretch of the run to the oldest."""

from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.breakpoints import Breakpoints
from scanbench.debug.halt import Found
from scanbench.debug.listener import Listener, Position
from scanbench.debug.placed import error_names
from scanbench.debug.probing import notes_of
from scanbench.engines.debug import Listen
from scanbench.engines.engine import Reason
from scanbench.engines.probe import BadProbe, MakeProbed, ProbedEngine
from scanbench.recording.gaps import gap_before
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.programs import Loaded

Raised = Callable[[Entry], tuple[str, ...]]
"""The errors that an entry of the journal raises."""
_WORTH = 256
"""Scans for which code with probes is worth making."""
_TRIES = 4
"""Scans in which a probe was reached in vain, before all are looked at statement by statement: ..."""
_LOOK, _WIDER = 1_000, 8
"""... so many from the end, and then so many times more."""


@dataclass(frozen=True, slots=True)
class Noted:
    """A place, and what was there."""

    position: Position
    found: Found
    writer: int | None = None
    """Of an access the site of the statement that made it: it may have begun before the position, and called others."""


class Noting(Listener):
    """Halts nowhere: notes the last place where it would have halted."""

    noted: Noted | None = None
    before: Position = (1 << 62, 0)
    """What is there and after it does not count."""

    def _tell(self, in_scan: bool = False) -> None:
        """Nobody need be told that a scan begins, where accesses are all that is looked for and stay where they are."""
        if self._only_accesses:
            self._resource.listening.listen(Listen(bytes=self._watching.bytes))
        else:
            super()._tell(in_scan)

    @property
    def _only_accesses(self) -> bool:
        others = self._at or self._scans or self._violations or self._watching.moving or self.passed.end is not None
        return not others and self.pending is None

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        if super().statement(site, count, depth):
            if self.found is None:
                return True  # the end of what was run
            self._note(count, self.found, None)
        return False

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""
        self._site = site
        super().access(site, count, offset, size, written)

    def _touched(self, count: int, found: Found) -> None:
        self._note(count, found, self._site)

    def _note(self, count: int, found: Found, writer: int | None) -> None:
        here = self._resource.header.scan, count
        if here < self.before:
            self.noted = Noted(here, found, writer)


class _Begins:
    """Notes when a statement began last, up to a position of the scan."""

    def __init__(self, upto: int, end: int | None) -> None:
        self._upto, self._end = upto, end
        self.count = upto

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        if self._end is not None and count >= self._end:
            return True
        if count <= self._upto:
            self.count = count
        return False

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""

    def entered(self) -> None:
        """See `Onlooker`."""


class Search:
    """The last position before one where any of some breakpoints would have halted."""

    def __init__(
        self, timeline: Timeline, breakpoints: Breakpoints, wanted: Sequence[Breakpoint], here: Position,
        prober: MakeProbed | None, raised: Raised, first: int = 0,
    ) -> None:  # fmt: skip
        """Scans before `first` are not looked at."""
        self._timeline, self._breakpoints, self._wanted, self._here = timeline, breakpoints, wanted, here
        self._prober, self._raised, self._first = prober, raised, first
        self._probed: dict[Loaded, ProbedEngine | None] = {}
        self._silent: set[Loaded] = set()
        """Programs of which no statement can be one that is looked for."""
        self._sound, self._flaw = False, ""
        """Whether any program has a meaning for them; why one has not."""
        self._entered = {each.scan for each in timeline.live_journal if each.step}

    def run(self) -> Noted | Refusal | None:
        """Where, and what; None: nowhere."""
        recorded = self._recorded()
        found = self._search(recorded.position[0] if recorded is not None else self._first)
        if found is None and recorded is None:
            return Refusal(self._flaw) if self._flaw and not self._sound else None
        if isinstance(found, Refusal) or recorded is None:
            return found
        return max((each for each in (found, recorded) if each is not None), key=lambda each: each.position)

    def _recorded(self) -> Noted | None:
        """What the journal and the calendar say: errors that were raised, scans."""
        best: Noted | None = None
        for one in self._wanted:
            if not one.enabled:
                continue
            found = Found("scan", f"scan {one.scan}", one.author, (one.id,))
            places = [((one.scan, 1), found)] if one.kind == "scan" else []
            if one.kind == "error":
                names = error_names(one)
                places = [
                    ((each.scan, max(1, each.step)), Found("error", f"{error} was raised", one.author, (one.id,)))
                    for each in self._timeline.live_journal
                    for error in self._raised(each)
                    if not names or error in names
                ]
            for position, found in places:
                after = position[0] >= self._first
                if after and position < self._here and (best is None or position > best.position):
                    best = Noted(position, found)
        return best

    def _search(self, first: int) -> Noted | Refusal | None:
        """The last place since scan `first`."""
        checkpoints, (scan, count) = self._timeline.recording.checkpoints, self._here
        if count:
            found = self._last(range(scan, scan + 1))
            if found is not None:
                return found
        until = scan
        for checkpoint in reversed(checkpoints[: bisect_left(checkpoints, until, key=attrgetter("scan"))]):
            if until <= first:
                break
            found = self._in_stretch(range(max(first, checkpoint.scan), until))
            if found is not None:
                return found
            until = checkpoint.scan
        return None

    def _in_stretch(self, scans: range) -> Noted | Refusal | None:
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
        look = _LOOK
        while len(scans) > look:
            found = self._last(range(scans.stop - look, scans.stop))
            if found is not None:
                return found
            scans, look = range(scans.start, scans.stop - look), look * _WIDER
        return self._last(scans)

    def _last_reached(self, scans: range) -> Refusal | int | None:
        """The last of these scans in which it may be; -1 when that cannot be told."""
        timeline, resource = self._timeline, self._timeline.resource
        refusal = timeline.goto(scans.start)
        if refusal is not None:
            return refusal
        found = [each for each in self._entered if each in scans]
        with resource.listening.instead(None):
            while True:
                loaded = resource.loaded
                engine = self._engine(loaded)
                if engine is None and loaded not in self._silent:
                    return -1
                usual = loaded.engine
                if engine is not None:
                    engine.forget()
                    loaded.engine = engine
                try:
                    stop = timeline.go_on(scans.stop)
                finally:
                    loaded.engine = usual
                found += [each for each in engine.reached if each is not None] if engine is not None else []
                if stop.reason is not Reason.INTERRUPTED:
                    return max(found, default=None)

    def _engine(self, loaded: Loaded) -> ProbedEngine | None:
        if loaded not in self._probed:
            placing = self._breakpoints.placing(loaded)
            placed = [placing.place(each, 0) for each in self._wanted]
            probes, made = notes_of(placed, placing), None
            if probes == () and all(each.active and each.symbol is not None for each in placed):
                self._silent.add(loaded)
            if probes and self._prober is not None:
                try:
                    made = self._prober(loaded.statements, loaded.memory, probes)
                except BadProbe:
                    made = None
            self._probed[loaded] = made
        return self._probed[loaded]

    def _last(self, scans: range) -> Noted | Refusal | None:
        """The last place in these scans, statement by statement."""
        timeline, wanted = self._timeline, self._wanted
        refusal = timeline.goto(scans.start)
        if refusal is not None:
            return refusal
        resource, live, noted = timeline.resource, timeline.live_inside, None
        with resource.listening.instead(None):
            while True:
                placing = self._breakpoints.placing(resource.loaded)
                placed = [placing.place(each, scans.start) for each in wanted]
                sound = any(not each.flaw for each in placed)
                self._sound, self._flaw = self._sound or sound, self._flaw or placed[0].flaw
                noting = Noting(resource, placing, placed, None)
                resource.listening.attach(noting)
                noting.before = self._here
                if live is not None:
                    noting.passed.end = timeline.live_scan, live.count
                noting.begin()
                stop = timeline.go_on(scans.stop)
                noted = noting.noted or noted
                if stop.reason is not Reason.INTERRUPTED:
                    return noted


def search(
    timeline: Timeline, breakpoints: Breakpoints, here: Position, author: str, path: str, prober: MakeProbed | None,
    raised: Raised,
) -> Found | Refusal:  # fmt: skip
    """Shows the last position before `here` where a breakpoint would have halted, or the statement that wrote `path`."""
    wanted = _wanted(breakpoints, author, path)
    if not any(each.enabled for each in wanted):
        return Refusal("there is no breakpoint to go back to: set one, or name a variable whose last write is wanted")
    gap = gap_before(timeline.recording.gaps, here[0])
    first = gap.until if gap is not None else 0
    noted = Search(timeline, breakpoints, wanted, here, prober, raised, first).run()
    if isinstance(noted, Refusal):
        return noted
    if noted is None and gap is not None:
        return Refusal(f"that did not happen since scan {first}, and whether it did before is not known: {gap}")
    if noted is None:
        return Refusal(f"that did not happen since scan {timeline.recording.first_scan}, the first one that is kept")
    return timeline.goto(*position_before(timeline, noted)) or noted.found


def position_before(timeline: Timeline, noted: Noted) -> Position:
    """The position before a statement that made an access."""
    scan, count = noted.position
    if noted.writer is None or timeline.goto(scan, 1) is not None:
        return noted.position
    resource, live = timeline.resource, timeline.live_inside
    begins = _Begins(count, live.count if live is not None and timeline.live_scan == scan else None)
    listen = Listen(frozenset((noted.writer,)), count=live.count if live is not None else 0)
    with resource.listening.instead(begins, listen):
        while timeline.go_on(scan + 1).reason is Reason.INTERRUPTED:
            pass
    return scan, begins.count


def _wanted(breakpoints: Breakpoints, author: str, path: str) -> list[Breakpoint]:
    if path:
        return [Breakpoint(0, "data", author, path=path, access="write")]
    return [replace(each.breakpoint, hits="") for each in breakpoints.placed if each.halts]
