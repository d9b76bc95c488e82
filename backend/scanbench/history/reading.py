"""A run file that is looked at, over and over: opened once, followed as it grows, never written.

Questions about the past go to its `timeline`, which stands at the last scan that is over; see `recording/timeline.py`.
"""

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from operator import attrgetter
from pathlib import Path
from types import TracebackType
from typing import Self

from scanbench.recording.blocks import Codec, KeptProgram
from scanbench.recording.format import RunFileError
from scanbench.recording.recording import Recording, Replaced
from scanbench.recording.replay import replay
from scanbench.recording.smaller import Standing
from scanbench.recording.thinning import Checkpoint
from scanbench.recording.timeline import NOT_AS_RECORDED, KeptPrograms, ProgramsOf, Timeline, open_at
from scanbench.runtime.command import Entry, Refusal, Swapped
from scanbench.runtime.inside import Diverged
from scanbench.runtime.programs import NoProgram, Programs
from scanbench.runtime.resource import Resource

TextsOf = Callable[[KeptProgram], Mapping[str, str]]
"""The source files of a program, by name."""


class NoReading(Exception):
    """That cannot be told of this run file; the message says why, and what to do. `near` was perhaps meant."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.near = near


class Reading:
    """A run file, opened when it is first followed."""

    def __init__(self, path: Path, programs_of: ProgramsOf, codec: Codec, texts_of: TextsOf | None = None) -> None:
        self.path = path
        self._programs_of, self._codec, self._texts_of = programs_of, codec, texts_of
        self._kept: dict[int, KeptProgram] = {}
        """All that was ever seen, also in a file that was replaced since."""
        self._programs: Programs | None = None
        self._texts: dict[int, Mapping[str, str]] = {}
        self._recording: Recording | None = None
        self._entries: list[Entry] = []
        self._timeline: Timeline | None = None
        self._until = -1
        self._trapped = False

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Lets go of the file."""
        if self._recording is not None:
            self._recording.close()
        self._recording, self._timeline = None, None

    def follow(self, until: int | None = None) -> Timeline:
        """The run with the scans in front of `until`, or with all that its file knows of. `NoReading` when that cannot be."""
        name = self.path.name
        try:
            try:
                new = self._read_on()
            except Replaced:
                self.close()
                new = self._read_on()
            assert self._recording is not None
            end = self._recording.last_scan if until is None else until
            if self._timeline is None or end > self._until or (new and new[0].scan <= self._until):
                self._stand(self._recording, end)
        except OSError as error:
            self.close()
            raise NoReading(f"{name} cannot be read: {error.strerror or error}") from error
        except (RunFileError, NoProgram) as error:
            self.close()
            raise NoReading(str(error)) from error
        except (Diverged, *NOT_AS_RECORDED) as error:
            self.close()
            raise NoReading(f"{name} cannot be replayed: {error}") from error
        return self.timeline

    @property
    def timeline(self) -> Timeline:
        """As it was followed last."""
        if self._timeline is None:
            raise RuntimeError("a run file is followed before it is looked at")
        return self._timeline

    @property
    def first(self) -> int:
        """The first scan that is kept."""
        return self.timeline.recording.first_scan

    @property
    def end(self) -> int:
        """The scan in front of which it ends."""
        return self._until

    @property
    def trapped(self) -> bool:
        """Whether a run-time error ended its last scan, and keeps the program stopped."""
        return self._trapped

    @property
    def entries(self) -> Sequence[Entry]:
        """The journal, up to the end."""
        return self.timeline.live_journal

    def goto(self, scan: int, count: int = 0) -> None:
        """Stands in front of a scan, or at a statement inside of it; `NoReading` when that cannot be."""
        refusal = self.timeline.goto(scan, count)
        if isinstance(refusal, Refusal):
            raise NoReading(refusal.message)

    def versions(self) -> list[int]:
        """The program that runs in front of each entry, and behind the last one."""
        version, begun = self.timeline.recording.checkpoints[0].version, self.timeline.recording.checkpoints[0].entries
        found = []
        for index, entry in enumerate(self.entries):
            found.append(version)
            if index >= begun and isinstance(entry.plan.effect, Swapped):
                version = entry.plan.effect.version
        return [*found, version]

    def text(self, version: int, file: str, line: int) -> str:
        """A line of a program's source, trimmed; empty where it has none."""
        kept = self._kept.get(version)
        if kept is None or self._texts_of is None:
            return ""
        if version not in self._texts:
            self._texts[version] = self._texts_of(kept)
        lines = self._texts[version].get(file, "").splitlines()
        return lines[line - 1].strip() if 0 < line <= len(lines) else ""

    def copy(self, to: Path, entries: int, scan: int, by: str) -> None:
        """A new run file that ends in front of `scan`, with so many entries of the journal; `OSError`. It is followed anew
        before it is looked at again."""
        recording = self.timeline.recording
        before = [each for each in recording.checkpoints if each.scan <= scan and each.entries <= entries]
        try:
            resource = self._at(recording, before[-1], self._entries[:entries], scan)
        except (Diverged, *NOT_AS_RECORDED) as error:
            raise NoReading(f"{self.path.name} cannot be replayed: {error}") from error
        self._timeline = None
        failed: list[Exception] = []
        standing = Standing(scan, entries, resource.version, resource.state)
        recording.copy(to, standing, by, lambda error: failed.append(error) if error is not None else None)
        recording.wait()
        if failed:
            raise failed[0]

    def _read_on(self) -> list[Entry]:
        if self._recording is None:
            self._recording = Recording.open(self.path, self._codec, read_only=True)
            self._entries, self._timeline = self._recording.take_entries(), None
            new = self._entries
        else:
            new = self._recording.read_on()
            self._entries += new
        programs = self._recording.programs
        if any(self._kept.get(version, kept) != kept for version, kept in programs.items()):
            self._programs = None  # another run of this name, with another program of this number
            self._texts.clear()
        self._kept.update(programs)
        if self._programs is None:
            self._programs = self._programs_of(self._kept)
        return new

    def _stand(self, recording: Recording, end: int) -> None:
        checkpoint = recording.before(end)
        if checkpoint is None:
            raise NoReading(f"scan {end} is not kept any more: the run begins with scan {recording.first_scan}")
        entries = self._entries[: bisect_right(self._entries, end, key=attrgetter("scan"))]
        resource = self._at(recording, checkpoint, entries, end)
        assert isinstance(resource.programs, KeptPrograms)
        programs = resource.programs
        self._trapped = resource.header.halted_by_trap
        self._timeline, self._until = Timeline(recording, resource, programs), resource.header.scan

    def _at(self, recording: Recording, checkpoint: Checkpoint, entries: Sequence[Entry], scan: int) -> Resource:
        """In front of a scan, when these entries are all that was entered."""
        assert self._programs is not None
        resource = open_at(recording, KeptPrograms(recording, self._programs), checkpoint, entries)
        replay(resource, entries[checkpoint.entries :], scan)
        return resource
