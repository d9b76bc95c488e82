"""The control device: a run file run again, on the code that PLCs run on, with all that was entered."""

from scanbench.engines.engine import Reason, Stop
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.command import Entry
from scanbench.runtime.inside import Diverged
from scanbench.runtime.programs import Loaded
from scanbench.verify.sides import Begin, Side
from scanbench.verify.uses import Recorder


class Control:
    """The control device, always in the seam between two scans. The caller enters what was entered before the next scan."""

    def __init__(self, reader: RunReader) -> None:
        self._reader = reader
        self.side = Side(reader.open_checkpoint(reader.recording.checkpoints[0]))

    @property
    def scan(self) -> int:
        """The scan that is next."""
        return self.side.resource.header.scan

    def loaded(self, version: int) -> Loaded:
        """A program of the run."""
        return self._reader.programs.get(version)

    def goto(self, scan: int) -> None:
        """Before what was entered in a scan."""
        reader, resource = self._reader, self.side.resource
        checkpoint, end = reader.before(scan), reader.front(scan)
        here = checkpoint.scan <= resource.header.scan <= scan and checkpoint.entries <= len(resource.journal) <= end
        if not (here and resource.recorder is reader.recording and resource.listening.inside is None):
            self.side = Side(reader.open_checkpoint(checkpoint))
        reader.replay(self.side.resource, scan, end)

    def enter(self, entry: Entry) -> None:
        """In the seam."""
        self.side.resource.reenter(entry)

    def run(self, recorder: Recorder, begin: Begin) -> int:
        """One scan: its result is that of the code that ran live, what it used is told by the debug flavour. The trap's number,
        or 0."""
        side = self.side
        try:
            if side.waits:  # only the debug flavour can enter anything inside of a scan
                return trap_of(side.run(recorder, recorder.listen))
            stop, live = side.run(None), side.state
            side.restore(begin)
            side.run(recorder, recorder.listen)
        except Diverged as error:
            raise Unreadable(str(error)) from error
        side.memory[: len(live)] = live
        return trap_of(stop)

    def recorded(self) -> bytes | None:
        """The state that the run file holds for this moment, if it differs from the present one; else None."""
        resource = self.side.resource
        state = self._reader.state(resource)
        return None if state == resource.state else state


def trap_of(stop: Stop) -> int:
    """The number of the run-time error that ended it, or 0."""
    return stop.trap if stop.reason is Reason.TRAP else 0
