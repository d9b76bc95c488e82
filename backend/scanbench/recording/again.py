"""One scan that is over, or the part of the next one that has run, again: with somebody listening. What is shown stays."""

from collections.abc import Callable
from dataclasses import replace

from scanbench.engines.debug import NOTHING
from scanbench.engines.engine import Reason
from scanbench.recording.moment import Moment
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Refusal
from scanbench.runtime.inside import HaltAt, OfScan
from scanbench.runtime.resource import Resource


def listen_again(
    timeline: Timeline, scan: int, make: Callable[[Resource], OfScan], begin: Moment | None = None
) -> Refusal | None:  # fmt: skip
    """Runs a scan again with what `make` makes there listening. Of the scan that the PLC runs next it has to halt where that is halted.

    `begin`: the state before the scan, kept by `kept_moment`; without it the nearest checkpoint is where it begins.
    """

    def look() -> None:
        listener = make(timeline.resource)
        with timeline.resource.listening.instead(listener, listener.listen):
            while timeline.go_on(scan + 1).reason is Reason.INTERRUPTED:
                pass
        listener.over()

    return timeline.look_at(scan, look, begin)


def kept_moment(timeline: Timeline) -> Moment:
    """The state of the PLC in this seam."""
    found = Moment.of(timeline.resource)
    return replace(found, journal=found.journal.prefix(len(found.journal)))


def statements_of(timeline: Timeline, scan: int) -> int | Refusal:
    """How many statements ran in a scan of the past."""
    resource, found = timeline.resource, 0

    def look() -> None:
        nonlocal found
        with resource.listening.instead(HaltAt(0), NOTHING):
            while timeline.go_on(scan + 1).reason is Reason.INTERRUPTED:
                pass
            found = resource.loaded.debugged().count

    refusal = timeline.look_at(scan, look)
    return found if refusal is None else refusal
