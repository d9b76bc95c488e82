"""The points of a run's timeline, as its host has told of them."""

from collections.abc import Sequence

from scanbench.debug.halt import Halt
from scanbench.host.marks import LIMIT, LONGEST
from scanbench.recording.recording import RecordingInfo
from scanbench.wire.events import TimelineChanged
from scanbench.wire.host import RunMark, RunMarks


class Marks:
    """The marks of one run, as far as the host has told."""

    def __init__(self) -> None:
        self._marks: list[RunMark] = []
        self._info = RecordingInfo(0, 0, 0, 0, 0, "", "")

    def take(self, told: RunMarks) -> TimelineChanged:
        """What the host tells; the event for everybody."""
        if told.fresh:
            self._marks.clear()
        self._info = told.info
        self._marks += told.marks
        del self._marks[:-LIMIT]
        return TimelineChanged(told.info, told.marks, told.fresh)

    def add(self, marks: Sequence[RunMark]) -> TimelineChanged:
        """Marks of new entries; the event for everybody."""
        return self.take(RunMarks(self._info, tuple(marks), fresh=False))

    def halted(self, halt: Halt) -> TimelineChanged:
        """A mark where a debugger halted the PLC, though the journal knows nothing of it."""
        mark = RunMark(halt.scan, "halt", halt.by or "PLC", f"halted: {halt.text}"[:LONGEST])
        return self.take(RunMarks(self._info, (mark,), fresh=False))

    @property
    def all(self) -> TimelineChanged:
        """Everything, for somebody who comes."""
        return TimelineChanged(self._info, tuple(self._marks), True)
