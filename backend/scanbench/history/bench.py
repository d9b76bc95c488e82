"""Goes on with a recorded run from one scan, again and again: campaigns and what if."""

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from hashlib import blake2b
from pathlib import Path

from scanbench.faults.detect import Detection
from scanbench.faults.disturb.disturb import DISTURBED, Calm
from scanbench.history.entered import begun_with
from scanbench.history.places import places
from scanbench.recording.blocks import Codec
from scanbench.recording.format import RunFileError
from scanbench.recording.reader import RunReader, TextsOf, Unreadable
from scanbench.recording.stump import write_stump
from scanbench.recording.timeline import Timeline
from scanbench.runtime.agenda import Agenda
from scanbench.runtime.programs import Programs
from scanbench.runtime.resource import Resource


@dataclass(frozen=True, slots=True)
class Bench:
    """What the runs are made on. The programs have a memory of their own; all runs share it."""

    folder: Path
    """Files in it are left for who wants them."""
    codec: Codec
    runs: Programs
    """For the control device, ..."""
    verifies: Programs
    """... and when that is verified."""
    agenda: Callable[[], Agenda]
    texts_of: TextsOf | None = None

    @property
    def file(self) -> Path:
        """The run file that was gone on with last."""
        return self.folder / "try.run"

    def begin(self, reader: RunReader, scan: int, by: str, disturbed: bool = False) -> None:
        """All that follows goes on from before this scan, as `begun_with` says. What disturbances still do there is taken back, unless
        it is to be `disturbed`. `Unreadable`."""
        self._stump.unlink(missing_ok=True)
        count = begun_with(reader, scan)
        calm = (Calm(by, None),) if not disturbed and DISTURBED.over(reader.entries[:count]) else ()
        write_stump(reader, self._stump, scan, by, self.codec, count, calm)

    def gone_on(self) -> Timeline:
        """The run from there on, once more; whoever takes it closes it. `Unreadable`."""
        shutil.copy(self._stump, self.file)
        try:
            return Timeline.resume(self.file, lambda kept: self.runs, self.codec, 0, Detection(), agenda=self.agenda())
        except RunFileError as error:
            raise Unreadable(f"the run cannot be gone on with: {error}") from error

    @property
    def _stump(self) -> Path:
        return self.folder / "begin.run"


def outputs_of(resource: Resource) -> bytes:
    """A digest of all `%Q`."""
    found = blake2b(digest_size=8)
    for stretch in places(resource.program, "Q"):
        found.update(resource.memory[stretch.start : stretch.stop])
    return found.digest()
