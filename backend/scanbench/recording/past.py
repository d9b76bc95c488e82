"""Running on in the past: the journal of the live PLC is entered again, as far as that has come."""

from scanbench.engines.engine import Reason, Stop
from scanbench.recording.moment import Moment
from scanbench.runtime.command import Entry
from scanbench.runtime.inside import Diverged, front
from scanbench.runtime.journal import Journal
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import Trapped


def run_on(resource: Resource, live: Moment, until: int) -> Stop:
    """Continues a resource that shows an earlier scan of `live`, up to the seam before scan `until`; see `Timeline.go_on`."""
    loaded = resource.loaded
    while True:
        following = _enter_front(resource, live.journal)
        unfinished = live.inside is not None or (following is not None and isinstance(following.command, Trapped))
        now = resource.header.scan
        if now >= until or (now >= live.scan and not unfinished):
            return Stop(Reason.DONE)
        if resource.loaded is not loaded:
            return Stop(Reason.INTERRUPTED)
        stop = _one_stretch(resource, live.journal, min(until, max(live.scan, now + 1)))
        if stop.reason is Reason.HALTED:
            assert resource.listening.inside is not None
            inside = resource.journal[front(resource.journal, resource.header.scan) :]
            later = sum(each.step > resource.listening.inside.count for each in inside)
            resource.journal = resource.journal.prefix(len(resource.journal) - later)
        if stop.reason in (Reason.HALTED, Reason.INTERRUPTED):
            return stop


def _following(resource: Resource, journal: Journal) -> Entry | None:
    """The first entry that was not entered yet."""
    entered = len(resource.journal)
    return journal[entered] if entered < len(journal) else None


def _enter_front(resource: Resource, journal: Journal) -> Entry | None:
    """Enters what was entered before the scan that is next; what comes after that."""
    now = resource.header.scan
    while (entry := _following(resource, journal)) is not None:
        if resource.begun or entry.scan != now or entry.step or isinstance(entry.command, Trapped):
            break
        resource.reenter(entry)
    return entry


def _one_stretch(resource: Resource, journal: Journal, until: int) -> Stop:
    """To the next entry of the journal, or the end of the scan in which there is one."""
    now = resource.header.scan
    while (entry := _following(resource, journal)) is not None and entry.scan == now and entry.step:
        resource.await_step(entry)
    upto = until if entry is None else min(until, entry.scan)
    if not resource.runnable:
        if resource.header.halted_by_trap:
            raise Diverged(f"the program is stopped in scan {now}, and went on when it was recorded")
        resource.pass_time(upto - now)
        return Stop(Reason.DONE)
    stop = resource.rerun(max(1, upto - now))
    if stop.reason is Reason.TRAP:
        if entry is None or not isinstance(entry.command, Trapped) or entry.scan != resource.header.scan:
            raise Diverged(f"scan {resource.header.scan} ends by a run-time error, and did not when it was recorded")
        resource.reenter(entry)
    return stop
