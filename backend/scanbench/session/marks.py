"""The points of a run's timeline: which commands leave one, and the parent's copy of them."""

from collections.abc import Sequence

from scanbench.debug.halt import Halt
from scanbench.faults.arm import Arm, Disarm, Missed
from scanbench.faults.clear import ClearErrorLog
from scanbench.faults.inject import Generate, Recover
from scanbench.runtime.clear_violations import ClearViolations
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.recording import RecordingInfo
from scanbench.runtime.restart import Restart
from scanbench.runtime.trap import Trapped
from scanbench.runtime.write import Write
from scanbench.session.events import TimelineChanged
from scanbench.session.protocol import RunMark, RunMarks
from scanbench.verify.disturb import is_disturbance

LIMIT = 5000
"""Marks that are kept to be shown."""
_KINDS: dict[type, str] = {
    Write: "write", Force: "force", Release: "force", Generate: "error", Recover: "recover", SetMode: "mode",
    ClearErrorLog: "recover", ProgramChange: "build", Trapped: "system", ClearViolations: "run", Restart: "run",
    Arm: "error", Disarm: "recover", Missed: "error",
}  # fmt: skip
_LONGEST = 200


def kind_of(command: Command) -> str:
    """The kind of a line of the log, or of a mark."""
    return "disturbance" if is_disturbance(command) else _KINDS.get(type(command), "system")


def marks_of(entries: Sequence[Entry]) -> tuple[RunMark, ...]:
    """A mark for each entry."""
    return tuple(
        RunMark(entry.scan, kind_of(entry.command), entry.command.author, entry.plan.message[:_LONGEST])
        for entry in entries[-LIMIT:]
    )


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

    def add(self, entries: Sequence[Entry]) -> TimelineChanged:
        """Marks of new entries; the event for everybody."""
        return self.take(RunMarks(self._info, marks_of(entries), fresh=False))

    def halted(self, halt: Halt) -> TimelineChanged:
        """A mark where a debugger halted the PLC, though the journal knows nothing of it."""
        mark = RunMark(halt.scan, "halt", halt.by or "PLC", f"halted: {halt.text}"[:_LONGEST])
        return self.take(RunMarks(self._info, (mark,), fresh=False))

    @property
    def all(self) -> TimelineChanged:
        """Everything, for somebody who comes."""
        return TimelineChanged(self._info, tuple(self._marks), True)
