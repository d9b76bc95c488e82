"""A run file that is read: opened once, followed as it grows, never written. Whoever has a question about a run reads it here.

Questions about its past go to its `timeline`, which begins at the last scan that is over; see `recording/timeline.py`.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from operator import attrgetter
from pathlib import Path
from types import TracebackType
from typing import Self

from scanbench.program.layout import Layout
from scanbench.recording.blocks import Codec, KeptProgram
from scanbench.recording.format import RunFileError
from scanbench.recording.gaps import gap_of
from scanbench.recording.programs import KeptPrograms, ProgramsOf
from scanbench.recording.recording import Recording, Replaced
from scanbench.recording.replay import NOT_AS_RECORDED, Diverged, open_at, replay
from scanbench.recording.smaller import Ending
from scanbench.recording.thinning import Checkpoint
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry, Refusal, Swapped
from scanbench.runtime.header import Halt
from scanbench.runtime.programs import LoadedPrograms, NoProgram, Programs
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import Trapped

TextsOf = Callable[[KeptProgram], Mapping[str, str]]
"""The source files of a program, by name."""
_SCAN = attrgetter("scan")


class Unreadable(Exception):
    """That cannot be told of this run; the message says why, and what to do. `near` was perhaps meant."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.near = near


def no_programs(kept: Mapping[int, KeptProgram]) -> Programs:
    """`ProgramsOf` for whoever runs nothing."""
    return LoadedPrograms()


class RunReader:
    """Opens the file at the first `follow`. For one thread only: all PLCs it gives share the memory of their programs."""

    def __init__(
        self, path: Path, programs_of: ProgramsOf, codec: Codec, texts_of: TextsOf | None = None
    ) -> None:  # fmt: skip
        self.path = path
        self._programs_of, self._codec, self._texts_of = programs_of, codec, texts_of
        self.kept: dict[int, KeptProgram] = {}
        """All programs that were ever seen, also in a file that was replaced since."""
        self.entries: Sequence[Entry] = ()
        """The journal, up to the end."""
        self._all: list[Entry] = []
        """All that the file has, which may be further than whoever follows it knows."""
        self._lines: dict[tuple[int, str], list[str]] = {}
        self._recording: Recording | None = None
        self._given: Programs | None = None
        self._programs: KeptPrograms | None = None
        self._timeline: Timeline | None = None
        self._end = -1

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # ---- the file -------------------------------------------------------------------------------------------------

    def follow(self, until: int | None = None) -> bool:
        """Reads what was appended. `until`: the scan up to which the caller knows the run is over; `entries` has those up to it,
        without it those up to the last scan that the file knows. False if the file was opened: the first time, after `close`, and
        when it was replaced; then the caller has to start again. `Unreadable`."""
        try:
            with self.reading():
                new, same = self._read_on()
        except Unreadable:
            self.close()
            raise
        end = self.recording.last_scan if until is None else until
        if not same or end > self._end or (new and new[0].scan <= self._end):
            self._timeline = None
        self._end = max(end, self._end) if same else end
        further = bool(self._all) and self._all[-1].scan > self._end
        self.entries = self._all[: bisect_right(self._all, self._end, key=_SCAN)] if further else self._all
        return same

    def close(self) -> None:
        """Lets go of the file, until it is followed again."""
        if self._recording is not None:
            self._recording.close()
        self._recording, self._programs, self._timeline = None, None, None

    def _read_on(self) -> tuple[list[Entry], bool]:
        """The new entries, and whether it is the same file still."""
        recording, new = self._recording, list[Entry]()
        if recording is not None:
            try:
                new = recording.read_on()
                self._all += new
            except Replaced:
                self.close()
                recording = None
        same = recording is not None
        if recording is None:
            self._recording = recording = Recording.open(self.path, self._codec, read_only=True)
            self._all = new = recording.take_entries()
        found = recording.programs
        if any(self.kept.get(version, kept) != kept for version, kept in found.items()):
            self._given = self._programs = None  # a new run under this name: its program of this number differs
            self._lines.clear()
        self.kept.update(found)
        if self._given is None:
            self._given = self._programs_of(self.kept)
        if self._programs is None:
            self._programs = KeptPrograms(recording, self._given)
        return new, same

    @contextmanager
    def reading(self) -> Iterator[None]:
        """What goes wrong with the file or its programs is `Unreadable`."""
        try:
            yield
        except OSError as error:
            raise Unreadable(f"{self.path.name} cannot be read: {error.strerror or error}") from error
        except (RunFileError, NoProgram) as error:
            raise Unreadable(str(error)) from error

    @contextmanager
    def replaying(self, scan: int) -> Iterator[None]:
        """What goes wrong on the way to a scan too, where the journal is entered again."""
        try:
            with self.reading():
                yield
        except (Diverged, *NOT_AS_RECORDED) as error:
            raise Unreadable(f"{self.path.name} cannot be replayed to scan {scan}: {error}") from error

    @property
    def recording(self) -> Recording:
        """The file as it was followed last."""
        if self._recording is None:
            raise Unreadable(f"{self.path.name} is not open: it could not be read on")
        return self._recording

    # ---- what there is --------------------------------------------------------------------------------------------

    @property
    def first(self) -> int:
        """The first scan that is kept."""
        return self.recording.first_scan

    @property
    def end(self) -> int:
        """The scan before which it ends."""
        return self._end

    @property
    def over(self) -> int:
        """Scans before this one are over. A scan that a run-time error ended is over too, though the time did not advance."""
        return self._end + _trapped(self.entries[self.front(self._end) :])

    def front(self, scan: int) -> int:
        """How many entries were entered before a scan, none of those entered in it among them."""
        return bisect_left(self.entries, scan, key=_SCAN)

    def versions(self) -> list[int]:
        """The program that runs before each entry, and after the last one."""
        first = self.recording.checkpoints[0]
        version, found = first.version, []
        again = {each.entries: each.version for each in self.recording.gaps}
        for index, entry in enumerate(self.entries):
            version = again.get(index, version)
            found.append(version)
            if index >= first.entries and isinstance(entry.plan.effect, Swapped):
                version = entry.plan.effect.version
        return [*found, again.get(len(self.entries), version)]

    def version(self, scan: int) -> int:
        """The program that runs in a scan."""
        return self.versions()[bisect_right(self.entries, scan, key=_SCAN)]

    @property
    def programs(self) -> KeptPrograms:
        """The programs of the run, all on the memory on which it is replayed."""
        if self._programs is None:
            raise Unreadable(f"{self.path.name} is not open: it could not be read on")
        return self._programs

    def lines(self, version: int, file: str) -> list[str]:
        """All lines of a source file; none where they are not known."""
        if (version, file) not in self._lines:
            kept = self.kept.get(version)
            texts = self._texts_of(kept) if self._texts_of is not None and kept is not None else {}
            self._lines[version, file] = texts.get(file, "").splitlines()
        return self._lines[version, file]

    def text(self, version: int, file: str, line: int) -> str:
        """A line of a program's source, trimmed; empty where it has none."""
        lines = self.lines(version, file)
        return lines[line - 1].strip() if 0 < line <= len(lines) else ""

    # ---- running it again -----------------------------------------------------------------------------------------

    def before(self, scan: int, entries: int | None = None) -> Checkpoint:
        """The last checkpoint from which one gets to a scan with so many entries entered; else with none of those that were
        entered in it. `Unreadable`."""
        checkpoints = self.recording.checkpoints
        gap = gap_of(self.recording.gaps, scan)
        if gap is not None:
            raise Unreadable(f"scan {scan} cannot be read: {gap}")
        again = max((each.entries for each in self.recording.gaps if each.until == scan), default=0)
        most = max(self.front(scan), checkpoints[0].entries, again) if entries is None else entries
        for index in range(bisect_right(checkpoints, scan, key=_SCAN) - 1, -1, -1):
            if checkpoints[index].entries <= most:
                return checkpoints[index]
        raise Unreadable(f"scan {scan} is not kept any more: the run begins with scan {self.first}")

    def state(self, resource: Resource) -> bytes | None:
        """The state that the file holds for the moment of a PLC of this run; None if it holds none for it. `Unreadable`."""
        checkpoints, scan, entries = self.recording.checkpoints, resource.header.scan, len(resource.journal)
        for index in range(bisect_right(checkpoints, scan, key=_SCAN) - 1, -1, -1):
            checkpoint = checkpoints[index]
            if checkpoint.scan != scan:
                break
            if checkpoint.entries == entries:
                if checkpoint.version != resource.version:
                    break
                with self.reading():
                    return self.recording.state(checkpoint, resource.program.layout.state_size)
        return None

    def open_checkpoint(self, checkpoint: Checkpoint) -> Resource:
        """A PLC with the state of a checkpoint. `Unreadable`."""
        with self.replaying(checkpoint.scan):
            return open_at(self.recording, self.programs, checkpoint, self.entries)

    def replay(self, resource: Resource, scan: int, entries: int) -> None:
        """Lets a PLC of this run go on to the front of a scan, when so many entries of the journal are all that was entered.
        `Unreadable`."""
        with self.replaying(scan):
            replay(resource, self.entries[len(resource.journal) : entries], scan)

    def at(self, scan: int, entries: int | None = None) -> Resource:
        """A PLC before a scan, when so many entries are all that was entered, else all up to this scan. `Unreadable`."""
        count = bisect_right(self.entries, scan, key=_SCAN) if entries is None else entries
        resource = self.open_checkpoint(self.before(scan, count))
        self.replay(resource, scan, count)
        return resource

    @property
    def timeline(self) -> Timeline:
        """The run as it is at its end; or in its past, where somebody went there. `Unreadable`."""
        if self._timeline is None:
            self._timeline = Timeline(self.recording, self.at(self._end), self.programs)
        return self._timeline

    def goto(self, scan: int, count: int = 0) -> None:
        """Moves the timeline to the seam before a scan, or to a statement inside of it. `Unreadable`."""
        refusal = self.timeline.goto(scan, count)
        if isinstance(refusal, Refusal):
            raise Unreadable(refusal.message)

    def copy(self, to: Path, entries: int, scan: int, by: str) -> None:
        """A new run file that ends before `scan`, with so many entries of the journal. `Unreadable`; `OSError`."""
        resource = self.at(scan, entries)
        self._timeline = None  # it used the same memory
        failed: list[Exception] = []
        ending = Ending(scan, entries, resource.version, resource.state)
        self.recording.copy(to, ending, by, lambda error: failed.append(error) if error is not None else None)
        self.recording.wait()
        if failed:
            raise failed[0]


def _trapped(entries: Sequence[Entry]) -> bool:
    """Whether a run-time error stops the program after these entries, which are all of one scan."""
    trapped = False
    for entry in entries:
        if isinstance(entry.command, Trapped) or entry.plan.starts_fresh:
            trapped = not entry.plan.starts_fresh
            continue
        for patch in entry.plan.patches:
            at = Layout.FATAL - patch.offset
            if 0 <= at < len(patch.mask) and patch.mask[at] & Halt.TRAP:
                trapped = bool(patch.data[at] & Halt.TRAP)
    return trapped
