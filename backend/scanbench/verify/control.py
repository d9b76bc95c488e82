"""The control device: a run file run again, on the code that PLCs run on, with all that was entered."""

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Mapping, Sequence
from operator import attrgetter
from pathlib import Path

from scanbench.engines.engine import Reason, Stop
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.recording.blocks import Codec, KeptProgram
from scanbench.recording.format import RunFileError
from scanbench.recording.recording import Recording, Replaced
from scanbench.recording.replay import replay
from scanbench.recording.thinning import Checkpoint
from scanbench.recording.timeline import NOT_AS_RECORDED, KeptPrograms, open_at
from scanbench.runtime.command import Entry
from scanbench.runtime.header import Halt
from scanbench.runtime.inside import Diverged
from scanbench.runtime.programs import Loaded, NoProgram, Programs
from scanbench.runtime.trap import Trapped
from scanbench.verify.engines import Make
from scanbench.verify.sides import Begin, Shelf, Side
from scanbench.verify.uses import Recorder

TextsOf = Callable[[KeptProgram], Mapping[str, str]]
"""The source files of a program, by name."""


class Unverifiable(Exception):
    """That cannot be verified; the message says why, and what to do."""


class Source:
    """The run file: opened once, read on as it grows, never written."""

    def __init__(self, path: Path, codec: Codec, program_of: Callable[[KeptProgram], Program]) -> None:
        self.path, self._codec, self._make_program = path, codec, program_of
        self._kept: dict[int, KeptProgram] = {}
        self._programs: dict[int, Program] = {}
        self.recording = self._opened()
        self._until: int | None = None

    def _opened(self) -> Recording:
        recording = Recording.open(self.path, self._codec, read_only=True)
        self.entries = recording.take_entries()
        self._kept.update(recording.programs)
        self._note(recording)
        return recording

    def _note(self, recording: Recording) -> None:
        self.marked = {(each.scan, each.entries): each for each in recording.checkpoints}
        """Checkpoints by their scan and the entries in front of them."""

    def close(self) -> None:
        """Lets go of the file."""
        self.recording.close()

    @property
    def first(self) -> int:
        """The first scan that is kept."""
        return self.recording.first_scan

    @property
    def end(self) -> int:
        """Scans in front of this one are over, as far as is known. One that a run-time error ended is, though time stands."""
        end = self.recording.last_scan if self._until is None else self._until
        return end + _trapped(self.of_scan(end))

    def follow(self, until: int) -> bool:
        """Reads on; false when the file is another one now, and whoever stands in it has to begin anew."""
        self._until = until
        try:
            self.entries += self.recording.read_on()
            self._kept.update(self.recording.programs)
            self._note(self.recording)
            return True
        except Replaced:
            before = dict(self._kept)
            self.recording.close()
            self.recording = self._opened()
            for version, kept in before.items():  # another run may have another program of this number
                if self._kept[version] != kept:
                    self._programs.pop(version, None)
            return False

    def program(self, version: int) -> Program:
        """The program of a version."""
        if version not in self._programs:
            if version not in self._kept:
                raise NoProgram(f"there is no program version {version} in {self.path.name}")
            self._programs[version] = self._make_program(self._kept[version])
        return self._programs[version]

    def kept(self, version: int) -> KeptProgram | None:
        """A program as it is in the file."""
        return self._kept.get(version)

    def of_scan(self, scan: int) -> list[Entry]:
        """What was entered in a scan, in front of it and inside of it."""
        begin = bisect_left(self.entries, scan, key=attrgetter("scan"))
        return self.entries[begin : bisect_right(self.entries, scan, lo=begin, key=attrgetter("scan"))]

    def before(self, scan: int) -> Checkpoint:
        """The last checkpoint in front of what was entered in a scan."""
        index = bisect_left(self.entries, scan, key=attrgetter("scan"))
        for checkpoint in reversed(self.recording.checkpoints):
            if checkpoint.scan <= scan and (checkpoint.entries <= index or checkpoint is self.recording.checkpoints[0]):
                return checkpoint
        raise Unverifiable(f"scan {scan} is not kept any more: the run begins with scan {self.first}")


class Control:
    """Stands between two scans; what was entered in front of the next one is entered by whoever runs it."""

    def __init__(self, source: Source, make: Make) -> None:
        self._source = source
        self._programs: Programs = Shelf(source.program, make)
        self.side = self._at(source.recording.checkpoints[0])

    def _at(self, checkpoint: Checkpoint) -> Side:
        source = self._source
        programs = KeptPrograms(source.recording, self._programs)
        return Side(open_at(source.recording, programs, checkpoint, source.entries))

    @property
    def scan(self) -> int:
        """The scan that is next."""
        return self.side.resource.header.scan

    def loaded(self, version: int) -> Loaded:
        """A program of the run."""
        return self._programs.get(version)

    def goto(self, scan: int) -> None:
        """In front of what was entered in a scan."""
        source, resource = self._source, self.side.resource
        checkpoint = source.before(scan)
        end = bisect_left(source.entries, scan, key=attrgetter("scan"))
        here = checkpoint.scan <= resource.header.scan <= scan and len(resource.journal) <= end
        if not (here and resource.recorder is source.recording and resource.listening.inside is None):
            self.side = self._at(checkpoint)
            resource = self.side.resource
        try:
            replay(resource, source.entries[len(resource.journal) : end], scan)
        except (Diverged, *NOT_AS_RECORDED) as error:
            raise Unverifiable(f"{source.path.name} cannot be replayed to scan {scan}: {error}") from error

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
            side.stand(begin)
            side.run(recorder, recorder.listen)
        except Diverged as error:
            raise Unverifiable(str(error)) from error
        side.memory[: len(live)] = live
        return trap_of(stop)

    def recorded(self) -> bytes | None:
        """The state that the run file has of this very moment, if that is another one."""
        resource = self.side.resource
        checkpoint = self._source.marked.get((resource.header.scan, len(resource.journal)))
        if checkpoint is None or checkpoint.version != resource.version:
            return None
        try:
            state = self._source.recording.state(checkpoint, resource.program.layout.state_size)
        except (RunFileError, OSError) as error:
            raise Unverifiable(str(error)) from error
        return None if state == resource.state else state


def _trapped(entries: Sequence[Entry]) -> bool:
    """Whether a run-time error stops the program behind these entries, which are all of one scan."""
    trapped = False
    for entry in entries:
        if isinstance(entry.command, Trapped) or entry.plan.starts_anew:
            trapped = not entry.plan.starts_anew
            continue
        for patch in entry.plan.patches:
            at = Layout.FATAL - patch.offset
            if 0 <= at < len(patch.mask) and patch.mask[at] & Halt.TRAP:
                trapped = bool(patch.data[at] & Halt.TRAP)
    return trapped


def trap_of(stop: Stop) -> int:
    """The number of the run-time error that ended it, or 0."""
    return stop.trap if stop.reason is Reason.TRAP else 0
