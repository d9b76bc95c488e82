"""What was entered in a recorded run, entered again at its scans while the run goes on from the middle in some other way."""

from collections.abc import Sequence

from scanbench.faults.disturb.disturb import is_disturbance
from scanbench.history.renumbered import Numbers, refused
from scanbench.history.rerun_plan import Given, comes_by_itself, number_of
from scanbench.recording.reader import RunReader
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Refusal


def given_after(reader: RunReader, scan: int) -> list[Given]:
    """What people and clients entered after this scan; what the PLC enters by itself comes again by itself, and disturbances are left
    out."""
    return [
        Given(each.scan, each.command, number_of(each))
        for each in reader.entries
        if each.scan > scan and not comes_by_itself(each.command) and not is_disturbance(each.command)
    ]


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
