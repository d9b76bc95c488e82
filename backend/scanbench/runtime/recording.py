"""A recorded run: what the blocks of a run file mean (`runfile.py` has their bytes).

ABOUT      first: JSON of `About`
PROGRAM    u32 version, digest (64 characters), the sources as they were given; before whatever needs the program
ENTRY      an entry of the journal, as the codec packs it
KEYFRAME   u32 program version, the state before `scan`; the entries in front of it in the file are in it
DELTA      the same, xor the state of the last keyframe before it
MARK       nothing: only its scan, the last that is known to have been reached

Entries in front of the first keyframe are what is left of a part that was dropped: nobody can go back there, but forces
and errors that still hold were entered there.
"""

import errno
import json
import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from struct import Struct
from typing import Protocol

import numpy as np

from scanbench.check.program import Program
from scanbench.runtime.clock import iso, monotonic_ns, wall_time
from scanbench.runtime.command import Entry
from scanbench.runtime.fingerprints import libm_fingerprint, model_fingerprint
from scanbench.runtime.rewriting import Rewritten, copy_range, rewrite
from scanbench.runtime.runfile import Block, Damage, Kind, RunFile, RunFileError
from scanbench.runtime.thinning import Checkpoint, plan_thinning
from scanbench.runtime.write import Write

DEFAULT_LIMIT = 64 << 20
ENTRY_LIMIT = 50_000
"""Entries are in memory too, so that there is a bound of them besides the file's."""
SYNC_NS = 1_000_000_000
DELTAS = 63
"""Between two keyframes."""
_VERSION = Struct("<I")
_DIGEST = 64


class Codec(Protocol):
    """Entries as bytes: who knows all commands gives it."""

    def pack(self, entry: Entry) -> bytes:
        """The bytes of an entry."""

    def unpack(self, data: bytes) -> Entry:
        """The entry again; any exception means that it cannot be read."""


@dataclass(frozen=True, slots=True)
class About:
    """What was recorded, and on what."""

    model: str
    model_fingerprint: str
    libm: str
    interval_ns: int
    created: str
    by: str
    thinned_before: int = 0
    dropped_before: int = 0

    @staticmethod
    def of(program: Program, by: str) -> "About":
        """A run that begins now."""
        model = program.layout.model
        return About(
            model.name, model_fingerprint(model), libm_fingerprint(), program.interval_ns, iso(wall_time()), by
        )


@dataclass(frozen=True, slots=True)
class KeptProgram:
    """A program as the run file has it. `sources` is whatever its keeper makes the program of."""

    version: int
    sources: bytes
    digest: str


@dataclass(frozen=True, slots=True)
class RecordingInfo:
    """What a run file holds and what it cost; 0 where nothing was thinned or dropped, texts empty where all is well."""

    first_scan: int
    bytes: int
    limit_bytes: int
    thinned_before: int
    dropped_before: int
    damage: str
    trouble: str


@dataclass(slots=True)
class _Key:
    """The last keyframe, which deltas refer to."""

    block: Block
    version: int
    state: bytes
    deltas: int = 0


@dataclass(frozen=True, slots=True)
class Trim:
    """Entries went from the front of the journal: of those before `cut` only `kept` are left."""

    kept: tuple[int, ...]
    cut: int


@dataclass(frozen=True, slots=True)
class _Prepared:
    """A smaller file that waits to take the place of the old one."""

    rewritten: Rewritten
    about: About
    heritage: tuple[int, ...]
    cut: int


@dataclass(slots=True)
class _Found:
    """What was read from a file."""

    about: About
    programs: dict[int, KeptProgram] = field(default_factory=dict)
    checkpoints: list[Checkpoint] = field(default_factory=list)
    entries: list[Entry] = field(default_factory=list)
    last_scan: int = 0


class Recording:
    """A run file in use; the `Recorder` of a resource. Everything but `sync` in the thread that runs the scans."""

    def __init__(
        self, file: RunFile, codec: Codec, found: _Found, limit: int, damage: str = "", lost: bool = False
    ) -> None:
        self._file, self._codec, self.limit = file, codec, limit
        self.about = found.about
        self.programs: Mapping[int, KeptProgram] = found.programs
        self.checkpoints = found.checkpoints
        """In order of their scans."""
        self.entries = found.entries
        """The journal as it was read when the file was opened."""
        self.last_scan = found.last_scan
        """The last scan that the file knew of when it was opened, or that was noted since."""
        self.damage, self.lost = damage, lost
        """What was found damaged; whether more than the last write was."""
        self.trouble = ""
        """Why nothing is recorded now."""
        self._programs = found.programs
        self._written = len(found.entries)
        self._owed: list[Entry] = []
        self._key: _Key | None = None
        self._unsynced, self._synced_at = False, 0
        self._prepared: _Prepared | None = None
        self._retired: list[RunFile] = []
        self._enough, self._enough_entries = limit, ENTRY_LIMIT

    @classmethod
    def create(cls, path: Path, about: About, codec: Codec, limit: int = DEFAULT_LIMIT) -> "Recording":
        """A new run file; `FileExistsError` if there is one."""
        file = RunFile.create(path)
        try:
            file.append(Kind.ABOUT, 0, _about_bytes(about))
        except OSError:
            file.close()
            path.unlink()
            raise
        return cls(file, codec, _Found(about), limit)

    @classmethod
    def open(cls, path: Path, codec: Codec, limit: int = DEFAULT_LIMIT, read_only: bool = False) -> "Recording":
        """A run file as it was left. What is damaged is moved aside, and `damage` says so; `RunFileError` when nothing is left."""
        file = RunFile.open(path, read_only)
        try:
            blocks, damage = file.scan_blocks()
            found = _read(file, blocks, codec)
            text = "" if damage is None else _put_aside(file, damage, found.last_scan, read_only)
        except RunFileError:
            file.close()
            raise
        if found.about.libm != libm_fingerprint():
            text += "; " * bool(text) + (
                "recorded on a machine with another mathematical library: results of SIN, EXP and the like may differ "
                "in their last digit, and a replay with them"
            )
        return cls(file, codec, found, limit, text, damage is not None and not damage.torn)

    def close(self) -> None:
        """Writes what is owed, and closes the file."""
        with suppress(OSError):
            self._pay()
            os.fdatasync(self._file.fd)
        for file in (*self._retired, self._file):
            file.close()
        if self._prepared is not None:
            self._prepared.rewritten.abandon()

    def set_limit(self, limit: int) -> None:
        """Another bound for the file."""
        self.limit = self._enough = limit

    @property
    def path(self) -> Path:
        """Where the file is."""
        return self._file.path

    @property
    def info(self) -> RecordingInfo:
        """What people are shown."""
        return RecordingInfo(
            self.first_scan, self._file.end, self.limit, self.about.thinned_before, self.about.dropped_before,
            self.damage, self.trouble,
        )  # fmt: skip

    @property
    def first_scan(self) -> int:
        """The earliest scan that can be gone back to."""
        return self.checkpoints[0].scan if self.checkpoints else 0

    @property
    def grown(self) -> int:
        """Bytes written since the last checkpoint."""
        return self._file.end - (self.checkpoints[-1].block.end if self.checkpoints else 0)

    @property
    def behind(self) -> int:
        """Entries written since the last checkpoint."""
        return self._written - (self.checkpoints[-1].entries if self.checkpoints else 0)

    # ---- writing --------------------------------------------------------------------------------------------------

    def program(self, version: int, sources: bytes, digest: str) -> None:
        """Keeps a program, before anything refers to it."""
        self._pay()
        self._append(Kind.PROGRAM, 0, _VERSION.pack(version) + digest.encode() + sources)
        self._programs[version] = KeptProgram(version, sources, digest)

    def entry(self, entry: Entry, must: bool = False) -> None:
        """Keeps an entry; see `Recorder`."""
        try:
            self._pay()
            self._append(Kind.ENTRY, entry.scan, self._codec.pack(entry))
            self._written += 1
        except OSError:
            if not must:
                raise
            self._owed.append(entry)

    def checkpoint(self, scan: int, version: int, state: bytes) -> bool:
        """Keeps the state before `scan`; false when it cannot be written now."""
        key = self._key
        whole = key is None or key.version != version or len(key.state) != len(state) or key.deltas >= DELTAS
        try:
            self._pay()
            if key is None or whole or self._file.end - key.block.end > self.limit // 16:
                block = self._append(Kind.KEYFRAME, scan, _VERSION.pack(version) + state)
                self._key = key = _Key(block, version, state)
            else:
                block = self._append(Kind.DELTA, scan, _xor(state, key.state))
                key.deltas = DELTAS if block.length > key.block.length // 2 else key.deltas + 1
        except OSError:
            return False
        self.checkpoints.append(Checkpoint(scan, self._written, version, block, key.block))
        return True

    def note(self, scan: int) -> None:
        """Marks the last known scan, so that a run goes on there even when nobody remembers it."""
        if self._owed:
            return
        self.last_scan = scan
        try:
            self._file.mark(scan)
        except OSError as error:
            self._in_trouble(error)

    def _pay(self) -> None:
        """Writes the entries that had to be taken while nothing could be written."""
        while self._owed:
            self._append(Kind.ENTRY, self._owed[0].scan, self._codec.pack(self._owed[0]))
            self._written += 1
            del self._owed[0]

    def _append(self, kind: Kind, scan: int, payload: bytes) -> Block:
        try:
            block = self._file.append(kind, scan, payload)
        except OSError as error:
            self._in_trouble(error)
            raise
        self._unsynced, self.trouble = True, ""
        return block

    def _in_trouble(self, error: OSError) -> None:
        self.trouble = (
            f"{self.path.name} cannot be written: {error.strerror}. The PLC goes on, but commands are refused and "
            "nothing is recorded until there is room: free some space on the disk"
        )

    # ---- reading --------------------------------------------------------------------------------------------------

    def before(self, scan: int) -> Checkpoint | None:
        """The last checkpoint at or before a scan."""
        low, high = 0, len(self.checkpoints)
        while low < high:
            middle = (low + high) // 2
            if self.checkpoints[middle].scan <= scan:
                low = middle + 1
            else:
                high = middle
        return self.checkpoints[low - 1] if low else None

    def state(self, checkpoint: Checkpoint) -> bytes:
        """The state that a checkpoint holds."""
        base = self._file.payload(checkpoint.base)[_VERSION.size :]
        return base if checkpoint.whole else _xor(self._file.payload(checkpoint.block), base)

    def copy(self, path: Path, entries: int, scan: int, version: int, state: bytes, by: str) -> None:
        """A new run file that ends with this state, and has in front of it what led there: `entries` of the journal."""
        self._pay()
        if path.exists():
            raise FileExistsError(errno.EEXIST, "there is a file of this name already", str(path))
        part = path.with_name(path.name + ".part")
        part.unlink(missing_ok=True)

        def keep(block: Block, in_front: int) -> bool:
            if block.kind is Kind.ENTRY:
                return in_front < entries
            return block.kind is Kind.PROGRAM or (block.scan <= scan and in_front <= entries)

        made = rewrite(self._file, part, _about_bytes(replace(self.about, created=iso(wall_time()), by=by)), keep)
        try:
            made.file.append(Kind.KEYFRAME, scan, _VERSION.pack(version) + state)
            os.fsync(made.file.fd)
            os.replace(part, path)
        except OSError:
            made.abandon()
            raise
        made.file.close()

    # ---- bounds ---------------------------------------------------------------------------------------------------

    def sync(self) -> None:
        """To the disk, at most once a second, and smaller when it is over its limit. From a thread that can wait."""
        while self._retired:
            self._retired.pop().close()
        now = monotonic_ns()
        if self._unsynced and now - self._synced_at >= SYNC_NS:
            self._unsynced, self._synced_at = False, now
            try:
                os.fdatasync(self._file.fd)
            except OSError as error:
                self._in_trouble(error)
        if self._prepared is None and (self._file.end > self._enough or self._written > self._enough_entries):
            self._prepared = self._thinned()

    def commit(self) -> Trim | None:
        """Puts the file that `sync` made smaller in the place of the old one. What became of the entries, if any went."""
        made, self._prepared = self._prepared, None
        if made is None:
            return None
        new, shift = made.rewritten.file, made.rewritten.file.end - made.rewritten.upto
        try:
            copy_range(self._file, new, made.rewritten.upto, self._file.end)
            new.mark(self.last_scan)
            os.replace(new.path, self._file.path)
        except OSError as error:
            made.rewritten.abandon()
            self._in_trouble(error)
            return None
        new.path = self._file.path
        self._retired.append(self._file)
        self._file, self.about, self._unsynced = new, made.about, True

        def moved(block: Block) -> Block:
            if block.offset >= made.rewritten.upto:
                return replace(block, offset=block.offset + shift)
            return made.rewritten.blocks[block.offset]

        gone = made.cut - len(made.heritage)
        self.checkpoints[:] = [
            replace(each, block=moved(each.block), base=moved(each.base), entries=each.entries - gone)
            for each in self.checkpoints
            if each.block.offset >= made.rewritten.upto or each.block.offset in made.rewritten.blocks
        ]
        if self._key is not None:
            self._key.block = moved(self._key.block)
        self._written -= gone
        self._enough = max(self.limit, self._file.end + self.limit // 8)
        self._enough_entries = max(ENTRY_LIMIT, self._written + ENTRY_LIMIT // 8)
        return Trim(made.heritage, made.cut) if made.cut else None

    def _thinned(self) -> "_Prepared | None":
        """A smaller file beside this one, made while this one goes on."""
        upto, written = self._file.end, self._written
        checkpoints = [each for each in tuple(self.checkpoints) if each.block.end <= upto]
        excess_entries = written - ENTRY_LIMIT * 3 // 4 if written > ENTRY_LIMIT else 0
        plan = plan_thinning(checkpoints, upto - self.limit * 3 // 4, excess_entries)
        cut, heritage = plan.cut, []

        def keep(block: Block, in_front: int) -> bool:
            if block.offset in plan.dropped:
                return False
            if block.kind is Kind.PROGRAM or cut is None or block.offset >= cut.block.offset:
                return True
            if block.kind is not Kind.ENTRY or isinstance(self._codec.unpack(self._file.payload(block)).command, Write):
                return False
            heritage.append(in_front)
            return True

        about = replace(
            self.about,
            thinned_before=max(self.about.thinned_before, plan.thinned_before),
            dropped_before=cut.scan if cut is not None else self.about.dropped_before,
        )
        path = self.path.with_name(self.path.name + ".part")
        try:
            path.unlink(missing_ok=True)
            rewritten = rewrite(self._file, path, _about_bytes(about), keep, upto)
            os.fdatasync(rewritten.file.fd)
        except OSError:
            self._enough, self._enough_entries = upto + self.limit // 8, written + ENTRY_LIMIT // 8
            return None
        return _Prepared(rewritten, about, tuple(heritage), cut.entries if cut is not None else 0)


def set_aside(path: Path) -> Path:
    """Moves a run file that cannot be used out of the way, and says where to."""
    aside = _aside(path)
    path.rename(aside)
    return aside


def _aside(path: Path) -> Path:
    number = 1
    while (aside := path.with_name(f"{path.name}.damaged-{number}")).exists():
        number += 1
    return aside


def _about_bytes(about: About) -> bytes:
    return json.dumps(asdict(about)).encode()


def _read(file: RunFile, blocks: Sequence[Block], codec: Codec) -> _Found:
    if not blocks or blocks[0].kind is not Kind.ABOUT:
        raise RunFileError(f"{file.path.name} is damaged at its beginning: nothing of the run can be recovered")
    try:
        found = _Found(About(**json.loads(file.payload(blocks[0]))))
    except (ValueError, TypeError) as error:
        raise RunFileError(f"{file.path.name} does not say what was recorded: {error}") from error
    base, version = None, 0
    for block in blocks:
        match block.kind:
            case Kind.PROGRAM:
                payload = file.payload(block)
                (number,) = _VERSION.unpack_from(payload)
                digest = payload[_VERSION.size : _VERSION.size + _DIGEST].decode("ascii", "replace")
                found.programs[number] = KeptProgram(number, payload[_VERSION.size + _DIGEST :], digest)
            case Kind.ENTRY:
                found.entries.append(_entry(file, block, codec))
            case Kind.KEYFRAME:
                (version,) = _VERSION.unpack_from(file.payload(block))
                base = block
                found.checkpoints.append(Checkpoint(block.scan, len(found.entries), version, block, base))
            case Kind.DELTA:
                if base is not None:
                    found.checkpoints.append(Checkpoint(block.scan, len(found.entries), version, block, base))
            case _:
                pass
        found.last_scan = max(found.last_scan, block.scan)
    if not found.checkpoints:
        raise RunFileError(
            f"{file.path.name} is damaged before its first checkpoint: nothing of the run can be recovered"
        )
    return found


def _entry(file: RunFile, block: Block, codec: Codec) -> Entry:
    try:
        return codec.unpack(file.payload(block))
    except Exception as error:
        raise RunFileError(
            f"{file.path.name}: the journal's entry at scan {block.scan} cannot be read by this scanbench ({error}): "
            "open it with the version that wrote it"
        ) from error


def _put_aside(file: RunFile, damage: Damage, last_scan: int, read_only: bool) -> str:
    """Ends the file where the damage begins, and says what that means."""
    name, where = file.path.name, "left as it was"
    if not read_only:
        aside = _aside(file.path)
        file.cut(damage.offset, aside)
        where = f"moved to {aside.name}"
    if damage.torn:
        text = f"{name} ended in the middle of a block, at byte {damage.offset}: its last write did not come to its end"
    else:
        text = f"{name} is damaged at byte {damage.offset}"
    text += f". Everything before it was recovered, up to scan {last_scan}"
    if damage.last_scan > last_scan:
        text += f"; {damage.last_scan - last_scan} scans behind it, up to {damage.last_scan}, are lost"
    return f"{text}. The damaged rest was {where}"


def _xor(state: bytes, other: bytes) -> bytes:
    return np.bitwise_xor(np.frombuffer(state, np.uint8), np.frombuffer(other, np.uint8)).tobytes()
