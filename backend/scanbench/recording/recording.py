"""A recorded run: what happens is written to its run file, in the thread that runs the scans.

Whatever waits for a disk or takes long is done in a thread of the recording's own: syncs, smaller files (`smaller.py`)
and copies. That thread is given what the file was at one moment, and hands back what it made; only the thread that runs
the scans changes anything here.
"""

import os
from bisect import bisect_right
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from operator import attrgetter
from pathlib import Path
from types import TracebackType
from typing import ClassVar, Self

from scanbench.program.program import Program
from scanbench.public import Public, iso
from scanbench.recording.appending import Appender
from scanbench.recording.block import NUMBERED
from scanbench.recording.blocks import (
    About,
    Codec,
    Contents,
    KeptProgram,
    Misplaced,
    Reader,
    delta,
    keyframe,
    read_contents,
    read_state,
)
from scanbench.recording.fingerprints import program_digest
from scanbench.recording.flaws import flaws
from scanbench.recording.format import Block, Kind, RunFile, RunFileError
from scanbench.recording.gaps import LostScans, gap_between
from scanbench.recording.smaller import (
    Bounds,
    Ending,
    Seen,
    Smaller,
    make_smaller,
    part_of,
    refuse_existing,
    write_copy,
)
from scanbench.recording.thinning import Checkpoint
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Entry
from scanbench.runtime.header import Mode, fresh_image

DEFAULT_LIMIT = 64 << 20
DELTAS = 63
"""Between two keyframes."""


@dataclass(frozen=True, slots=True)
class RecordingInfo(Public):
    """What a run file holds and what it cost; 0 where nothing was thinned or dropped, texts empty where all is well."""

    PUBLIC: ClassVar = "TimelineInfo"

    first_scan: int
    """The earliest scan that can be gone back to."""
    bytes: int
    limit_bytes: int
    thinned_before: int
    """Before this scan checkpoints were thinned: going there takes longer."""
    dropped_before: int
    """Scans before this are gone for good."""
    damage: str
    """What was found damaged when the file was opened, and what was recovered."""
    recording: str
    """Why nothing is recorded now (disk full, say)."""
    lost: tuple[LostScans, ...] = ()
    """Scans in the middle that the damaged file lost."""


@dataclass(slots=True)
class _Key:
    """The last keyframe, which deltas refer to."""

    block: Block
    version: int
    state: bytes
    entries: int
    """Before it."""
    deltas: int = 0


@dataclass(frozen=True, slots=True)
class Trim:
    """Entries went from the front of the journal: of those before `cut` only `kept` are left."""

    kept: tuple[int, ...]
    cut: int


@dataclass(slots=True)
class _Thinning:
    """A smaller file that is being made. It stays here until it has taken the place of the old one."""

    made: Smaller | None = None
    done: bool = False


class Replaced(RunFileError):
    """The file that is read was replaced, usually by a smaller one, or deleted: open it again."""


class Recording:
    """A run file in use; the `Recorder` of a resource. All in the thread that runs the scans."""

    def __init__(
        self, file: RunFile, codec: Codec, found: Contents, limit: int, damage: str = "", ends_early: bool = False
    ) -> None:
        self._codec = codec
        self.about = found.about
        self.programs: Mapping[int, KeptProgram] = found.programs
        self.checkpoints = found.checkpoints
        """In order of their scans."""
        self.driven = found.driven
        """How the PLC is driven, as `drive` was told last."""
        self.gaps = found.gaps
        """Where it lost what was entered, in order."""
        self.damage, self.ends_early = damage, ends_early
        """What was found damaged; whether that is its end, and more than the last write."""
        self.lost = ends_early or bool(found.gaps)
        """Whether scans or commands are lost that it held."""
        self.damaged = self.lost or file.mended is not None or file.damage is not None
        """Whether there is any damage. A file that ends in the middle of a block may have been cut off: nobody knows what came after."""
        self.marked = file.marked is not None
        """Whether what was read ends with the mark of its last scan: not where it was cut off, nor where its writer was ended."""
        self._repeat: list[tuple[Kind, bytes]] = []
        """Written once more after the next state, so that no damaged block costs the whole run."""
        self._programs, self._read = found.programs, found.entries
        self._writer = Appender(file, codec, len(found.entries), found.last_scan)
        self._key: _Key | None = None
        self.bounds = Bounds(limit)
        self._thinning: _Thinning | None = None
        self._reader: Reader | None = None
        """Of a file that is only read."""

    @classmethod
    def begin(
        cls, path: Path, program: Program, version: int, sources: bytes, codec: Codec, by: str, limit: int = DEFAULT_LIMIT
    ) -> "Recording":  # fmt: skip
        """A new run of a program from a cold start. `FileExistsError` when there is a file of this name; `OSError`.

        The file has its name when it is one that can be gone on with: whoever is killed before leaves none.
        """
        refuse_existing(path)
        file = RunFile.create(part_of(path))
        recording = cls(file, codec, Contents(About.of(program, by)), limit)
        try:
            file.append(Kind.ABOUT, 0, recording.about.packed())
            recording._repeat.append((Kind.ABOUT, recording.about.packed()))
            recording.program(version, sources, program_digest(program))
            state = bytes(fresh_image(program, Mode.MONITOR)[: program.layout.state_size])
            recording._keep(0, version, state)
            os.replace(file.path, path)
        except OSError:
            recording.close()
            file.path.unlink(missing_ok=True)
            raise
        file.path = path
        return recording

    @classmethod
    def open(cls, path: Path, codec: Codec, limit: int = DEFAULT_LIMIT, read_only: bool = False) -> "Recording":
        """A run file as it was left, with a program and a checkpoint at least; `RunFileError` when it is none.

        What is damaged is moved aside, and `damage` says so.
        """
        file = RunFile.open(path, read_only)
        try:
            reader = read_contents(file, codec)
            found, damage = reader.found, file.damage
            text = flaws(file, found, read_only)
            if not read_only and damage is not None:
                file.damage = None
        except BaseException:
            file.close()
            raise
        recording = cls(file, codec, found, limit, text, damage is not None and not damage.torn)
        recording._reader = reader if read_only else None
        if file.mended is not None:
            recording._repeat = _needed(recording.about, recording.programs)
        return recording

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Writes what is owed, finishes what its thread was given, and closes the file."""
        with suppress(OSError):
            self._writer.pay()
        self._writer.worker.close()
        with suppress(OSError):
            os.fdatasync(self._writer.file.fd)
        if self._thinning is not None and self._thinning.made is not None:
            self._thinning.made.rewritten.abandon()
        self._writer.file.close()

    def wait(self) -> None:
        """Until its thread has done all that it was given."""
        self._writer.worker.wait()

    @property
    def path(self) -> Path:
        """Where the file is."""
        return self._writer.file.path

    @property
    def info(self) -> RecordingInfo:
        """What people are shown."""
        return RecordingInfo(
            self.first_scan, self._writer.file.end, self.bounds.limit, self.about.thinned_before, self.about.dropped_before,
            self.damage, self.trouble, tuple(each.public for each in self.gaps),
        )  # fmt: skip

    @property
    def last_scan(self) -> int:
        """The last scan that the file knew of when it was opened, or that was noted since."""
        return self._writer.last_scan

    @property
    def trouble(self) -> str:
        """Why nothing is recorded now; empty while all is well."""
        return self._writer.trouble

    @property
    def first_scan(self) -> int:
        """The earliest scan that can be gone back to."""
        return self.checkpoints[0].scan

    def why_lost(self, now: int, scan: int) -> str:
        """See `Recorder`."""
        gap = gap_between(self.gaps, now, scan)
        return str(gap) if gap is not None else ""

    @property
    def grown(self) -> int:
        """Bytes written since the last checkpoint."""
        return self._writer.file.end - self.checkpoints[-1].block.end

    @property
    def entries_since(self) -> int:
        """Entries written since the last checkpoint."""
        return self._writer.entries - self.checkpoints[-1].entries

    def take_entries(self) -> list[Entry]:
        """The journal as it was when the file was opened; it is handed over."""
        entries, self._read = self._read, []
        return entries

    # ---- writing --------------------------------------------------------------------------------------------------

    def program(self, version: int, sources: bytes, digest: str) -> None:
        """Keeps a program, before anything refers to it."""
        program = KeptProgram(version, sources, digest)
        packed = program.packed()
        self._writer.append(Kind.PROGRAM, 0, packed)
        self._programs[version] = program
        self._repeat.append((Kind.PROGRAM, packed))

    def entry(self, entry: Entry, must: bool = False) -> None:
        """Keeps an entry; see `Recorder`."""
        self._writer.entry(entry, must)

    def drive(self, scan: int, driven: bytes) -> None:
        """Keeps how the PLC is driven from `scan` on: a run that is gone on with goes on like that. `OSError`."""
        self._writer.append(Kind.MARK, scan, driven)
        self.driven = driven

    def checkpoint(self, scan: int, version: int, state: bytes) -> bool:
        """Keeps the state before `scan`; false when it cannot be written now."""
        try:
            self._keep(scan, version, state)
        except OSError:
            return False
        return True

    def note(self, scan: int) -> None:
        """Marks the last known scan, so that a run goes on there even when nobody remembers it."""
        self._writer.mark(scan)

    def _keep(self, scan: int, version: int, state: bytes) -> None:
        key = self._key
        fits = key is not None and key.version == version and len(key.state) == len(state) and key.deltas < DELTAS
        entries = self._writer.entries
        if key is None or not fits or self.bounds.far(self._writer.file.end - key.block.end, entries - key.entries):
            block = self._writer.append(Kind.KEYFRAME, scan, keyframe(version, state))
            self._key = key = _Key(block, version, state, entries)
        else:
            block = self._writer.append(Kind.DELTA, scan, delta(state, key.state), key.block.crc)
            key.deltas = DELTAS if block.length > key.block.length // 2 else key.deltas + 1
        self.checkpoints.append(Checkpoint(scan, entries, version, block, key.block))
        if self._writer.file.format >= NUMBERED:
            for kind, payload in self._repeat:
                self._writer.append(kind, 0, payload)
        self._repeat.clear()

    # ---- reading --------------------------------------------------------------------------------------------------

    def read_on(self) -> list[Entry]:
        """Reads what somebody else has appended since the file was opened to be read only, or since this was called last:
        `programs`, `checkpoints` and `last_scan` have it then; the new entries.

        A block that is not whole yet is read by a later call; until then `damage` describes it. `Replaced` when this is not the
        file of its name any more: nothing will ever be appended to it. `RunFileError` when it cannot be understood.
        """
        file, reader = self._writer.file, self._reader
        if reader is None:
            raise RuntimeError("this recording writes its file")
        here = os.fstat(file.fd)
        try:
            there = file.path.stat()
        except FileNotFoundError as error:
            raise Replaced(f"{file.path.name} is gone: its run was deleted, or moved away") from error
        if not os.path.samestat(here, there):
            raise Replaced(f"{file.path.name} was made smaller, or put in place again: open it again")
        if here.st_size < file.end:
            raise RunFileError(f"{file.path.name} was cut off at byte {here.st_size} while it was read")
        try:
            entries = reader.read_on()
        except Misplaced as error:
            raise Replaced(str(error)) from error
        self._writer.entries += len(entries)
        self._writer.last_scan = reader.found.last_scan
        self.damage = flaws(file, reader.found, read_only=True)
        self.ends_early = file.damage is not None and not file.damage.torn
        self.lost = self.ends_early or bool(self.gaps)
        self.damaged = self.lost or file.mended is not None or file.damage is not None
        self.marked = file.marked is not None
        return entries

    def before(self, scan: int) -> Checkpoint | None:
        """The last checkpoint at or before a scan."""
        index = bisect_right(self.checkpoints, scan, key=attrgetter("scan"))
        return self.checkpoints[index - 1] if index else None

    def state(self, checkpoint: Checkpoint, size: int) -> bytes:
        """The state of `size` bytes that a checkpoint holds; `RunFileError` when it holds something else."""
        return read_state(self._writer.file, checkpoint, size)

    def copy(self, path: Path, ending: Ending, by: str, on_done: Callable[[Exception | None], None]) -> None:
        """Writes a new run file that ends at the seam `ending`, in the recording's thread, which then calls `on_done`.

        `OSError` at once when that is plainly impossible.
        """
        self._writer.pay()
        refuse_existing(path)
        seen = replace(self._seen(), about=replace(self.about, created=iso(wall_time()), by=by, marks=True))

        def write() -> None:
            failed: Exception | None = None
            try:
                write_copy(seen, path, ending)
            except Exception as error:  # whatever it is, somebody waits for it
                failed = error
            on_done(failed)

        self._writer.worker.give(write)

    def _seen(self) -> Seen:
        file, gaps = self._writer.file, tuple(self.gaps)
        return Seen(file, file.end, self.about, tuple(self.checkpoints), self._writer.entries, gaps)

    # ---- bounds ---------------------------------------------------------------------------------------------------

    def tidy(self) -> Trim | None:
        """Begins to make a file smaller that is over its bounds, and puts it in the place of the old one when it is ready.

        What became of the entries, if any went.
        """
        thinning = self._thinning
        if thinning is None:
            if self.bounds.over(self._writer.file.end, self._writer.entries):
                self._thin()
            return None
        if not thinning.done:
            return None
        try:
            return self._replace(thinning.made) if thinning.made is not None else None
        finally:
            self.bounds.tried(self._writer.file.end, self._writer.entries)
            self._thinning = None

    def _thin(self) -> None:
        self._thinning = thinning = _Thinning()
        seen, limit = self._seen(), self.bounds.limit

        def make() -> None:
            try:
                thinning.made = make_smaller(seen, limit, self._codec)
            finally:
                thinning.done = True

        self._writer.worker.give(make)

    def _replace(self, made: Smaller) -> Trim | None:
        """The smaller file takes the place of the old one. Where that fails nothing is lost, and it is tried again later."""
        old, new, key = self._writer.file, made.rewritten.file, self._key
        gone = made.cut - len(made.roots)
        try:
            made.rewritten.follow(old.end)
            new.place = old.place
            checkpoints = [
                replace(each, block=block, base=base, entries=each.entries - gone)
                for each in self.checkpoints
                if (block := made.rewritten.moved(each.block)) and (base := made.rewritten.moved(each.base))
            ]
            moved = made.rewritten.moved(key.block) if key is not None else None
            if self.driven:  # it may have been said before the cut
                new.append(Kind.MARK, self.last_scan, self.driven)
            new.mark(self.last_scan)
            os.replace(new.path, old.path)
        except OSError:
            made.rewritten.abandon()
            return None
        new.path = old.path
        self.checkpoints[:] = checkpoints
        first = checkpoints[0]
        left = [replace(each, entries=each.entries - gone) for each in self.gaps if each.entries >= made.cut]
        self.gaps[:] = [each for each in left if each.until > first.scan or each.entries > first.entries]
        self._key = (
            replace(key, block=moved, entries=key.entries - gone) if key is not None and moved is not None else None
        )
        self._writer.entries -= gone
        self._writer.file, self.about = new, made.about
        self._repeat = _needed(self.about, self.programs)
        self._writer.worker.give(old.close)
        self._writer.worker.sync_soon()
        return Trim(made.roots, made.cut) if made.cut else None


def _needed(about: About, programs: Mapping[int, KeptProgram]) -> list[tuple[Kind, bytes]]:
    """What all the rest of a file needs."""
    return [(Kind.ABOUT, about.packed()), *((Kind.PROGRAM, each.packed()) for each in programs.values())]
