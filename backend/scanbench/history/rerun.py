"""Repeats a run with one change: an error is raised earlier or later, replaced by a different one, or left out.

The new run file has the original up to the first change. From there on the PLC runs: what somebody entered is entered again as
a command, planned again, at its scan; what the PLC, the program, an armed fault or a disturbance entered by itself may come
again by itself or not.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from scanbench.faults.detect import Detection
from scanbench.history.contract import RerunChange
from scanbench.history.renumbered import Numbers, refused
from scanbench.history.rerun_plan import Given, Planned, planned
from scanbench.recording.blocks import Codec
from scanbench.recording.format import RunFileError
from scanbench.recording.programs import ProgramsOf
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.recording.recording import DEFAULT_LIMIT
from scanbench.recording.timeline import Timeline
from scanbench.runtime.agenda import Agenda
from scanbench.runtime.command import Refusal

_SLICE = 20_000
"""Scans between two words about how far it is."""
_TOLD = 100
"""Refused commands that are listed."""
OnProgress = Callable[[int, int], None]
"""Scans that are done, and of how many; may raise to end it."""


@dataclass(frozen=True, slots=True)
class Rerun:
    """What came of it: the file ends before `scan`."""

    scan: int
    refused: tuple[str, ...]
    """Commands that were not taken this time, and why; and what else is not as it was."""


def rerun(
    reader: RunReader, to: Path, change: RerunChange, author: str, programs_of: ProgramsOf, codec: Codec,
    agenda: Agenda | None = None, on_progress: OnProgress = lambda done, of: None, limit: int = DEFAULT_LIMIT,
) -> Rerun:  # fmt: skip
    """Writes the new run file. `Unreadable` says why there can be none; then there is no file either.

    The reader has been followed. `programs_of` makes programs with a memory of their own.
    """
    plan = planned(reader, change)
    end = reader.end + change.scans_after
    try:
        reader.copy(to, plan.cut, plan.scan, author)
        timeline = Timeline.resume(to, programs_of, codec, 0, Detection(), limit, agenda)
    except FileExistsError as error:
        raise Unreadable(f"{to.name} is there already") from error
    except (OSError, RunFileError) as error:
        to.unlink(missing_ok=True)
        raise Unreadable(f"the new run cannot be begun: {error}") from error
    try:
        refused = _Again(timeline, plan, end, on_progress).run()
        scan = timeline.live_scan
    except BaseException:
        with suppress(OSError):
            timeline.close()
        to.unlink(missing_ok=True)
        raise
    timeline.close()
    return Rerun(scan, refused)


class _Again:
    """The new run, from the change on."""

    def __init__(self, timeline: Timeline, plan: Planned, end: int, on_progress: OnProgress) -> None:
        self._timeline, self._end, self._on_progress = timeline, end, on_progress
        self._waiting = list(plan.given)
        self._first = timeline.live_scan
        self._numbers = Numbers()
        self._refused: list[str] = list(plan.notes)
        self._left = 0

    def run(self) -> tuple[str, ...]:
        """To the end; what was refused on the way."""
        timeline, end = self._timeline, self._end
        while True:
            self._enter_due()
            now = timeline.live_scan
            if now >= end or timeline.resource.header.halted_by_trap:
                break
            following = self._waiting[0].scan if self._waiting else end
            self._advance(min(end, following, now + _SLICE) - now)
            timeline.note()
            self._on_progress(timeline.live_scan - self._first, end - self._first)
        self._on_progress(end - self._first, end - self._first)
        if timeline.live_scan < end:
            left = [each for each in self._waiting if each.scan < end]
            text = f"a run-time error stopped the program in scan {timeline.live_scan}"
            if left:
                text += f": {len(left)} commands that came later were not entered, the first before scan {left[0].scan}"
            self._refused.append(text)
        if self._left:
            self._refused.append(f"{self._left} more commands were refused")
        return tuple(self._refused)

    def _advance(self, scans: int) -> None:
        timeline = self._timeline
        if timeline.resource.runnable:
            timeline.run(scans)
        else:
            timeline.resource.idle(scans)

    def _enter_due(self) -> None:
        while self._waiting and self._waiting[0].scan <= self._timeline.live_scan:
            self._enter(self._waiting.pop(0))

    def _enter(self, given: Given) -> None:
        command = self._numbers.renamed(given.command)
        outcome = command if isinstance(command, Refusal) else self._timeline.submit(command)
        self._numbers.note(given.number, outcome)
        if not isinstance(outcome, Refusal):
            return
        if len(self._refused) >= _TOLD:
            self._left += 1
        else:
            self._refused.append(refused(self._timeline.live_scan, given.command, outcome))
