"""What was entered in a recorded run, entered again at its scans while the run goes on from the middle in some other way."""

from collections.abc import Sequence

from scanbench.faults.disturb.disturb import is_disturbance
from scanbench.history.renumbered import Numbers, refused
from scanbench.history.rerun_plan import Given, comes_by_itself, number_of
from scanbench.recording.reader import RunReader
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry, Refusal


def begun_with(reader: RunReader, scan: int) -> int:
    """How many entries there are before one goes on from this scan in some other way: those of its seam, up to the first disturbance.
    What was entered inside of the scan is none of them."""
    count = reader.front(scan)
    for entry in reader.entries[count:]:
        if entry.scan > scan or entry.step or is_disturbance(entry.command):
            break
        count += 1
    return count


def given_after(reader: RunReader, scan: int, disturbed: bool) -> list[Given]:
    """What people and clients entered after `begun_with`; what the PLC enters by itself comes again by itself. `disturbed`: the
    disturbances, too."""
    return [
        Given(_again_at(each), each.command, number_of(each), bool(each.step) and not is_disturbance(each.command))
        for each in reader.entries[begun_with(reader, scan) :]
        if not comes_by_itself(each.command) and (disturbed or not is_disturbance(each.command))
    ]


def _again_at(entry: Entry) -> int:
    """Before which scan. What is entered inside of a scan is entered before it this time; a disturbance after it, as it does nothing in a
    scan that has begun."""
    return entry.scan + (1 if entry.step and is_disturbance(entry.command) else 0)


class Entering:
    """Of one run."""

    def __init__(self, given: Sequence[Given]) -> None:
        self._waiting, self._numbers = list(enumerate(given)), Numbers()
        self.refused: dict[int, str] = {}
        """The places in the list of what was refused, and why."""

    def following(self, end: int) -> int:
        """The next scan before which anything is entered, at most `end`."""
        return min([end, *(given.scan for _, given in self._waiting[:1])])

    def enter(self, timeline: Timeline) -> None:
        """What is due; a PLC that goes on in some other way may refuse it."""
        while self._waiting and self._waiting[0][1].scan <= timeline.live_scan:
            at, given = self._waiting.pop(0)
            command = self._numbers.renamed(given.command)
            outcome = command if isinstance(command, Refusal) else timeline.submit(command)
            self._numbers.note(given.number, outcome)
            if isinstance(outcome, Refusal):
                self.refused[at] = refused(timeline.live_scan, given.command, outcome)
