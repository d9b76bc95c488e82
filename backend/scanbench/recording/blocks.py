"""What the blocks of a run file mean (`format.py` has their bytes), and how they are read.

ABOUT      first: JSON of `About`
PROGRAM    u32 version, digest (64 characters), the sources as they were given; before whatever needs the program
           (both are there twice, the second time after the next state, so that no damaged block costs the whole run)
ENTRY      an entry of the journal, as the codec packs it; in a short block as `alike.py` does
KEYFRAME   u32 program version, the state before `scan`; the entries before it in the file are in it
DELTA      the same, xor the state of the last keyframe before it, whose checksum is in the head of the block
MARK       nothing: only its scan, the last that is known to have been reached; or how the PLC is driven from there on (its
           speed, whether it is paused, ...), as its keeper gave it

Entries before the first keyframe are what is left of a part that was dropped: nobody can go back there, but forces
and errors that still hold were entered there.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace
from datetime import datetime
from pathlib import Path
from struct import Struct
from typing import NoReturn, Protocol

import numpy as np

from scanbench.program.program import Program
from scanbench.public import iso
from scanbench.recording.alike import Slots, is_brief
from scanbench.recording.block import NUMBERED
from scanbench.recording.fingerprints import libm_fingerprint, model_fingerprint
from scanbench.recording.format import Block, Damage, Damaged, Kind, RunFile, RunFileError
from scanbench.recording.gaps import Gap
from scanbench.recording.in_order import in_order
from scanbench.recording.thinning import Checkpoint
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Command, Entry, Plan, Swapped
from scanbench.runtime.header import Header
from scanbench.runtime.journal import AnyFold
from scanbench.typed import BadValue, make_kept

_VERSION = Struct("<I")
_DIGEST = 64
_HEADER = 64
"""Bytes of a state in which its scan is."""
_ABOUT_MOST = _DRIVEN_MOST = 1 << 16
_IN_MEMORY = 1 << 9
"""Bytes that a brief entry is counted for: in the file it has much fewer."""
_UNPACKED = 1 << 28
"""Bytes of all programs and entries together: they are in memory as long as the run is open."""


class Misplaced(RunFileError):
    """A file that is followed has to be opened again."""


class Codec(Protocol):
    """Entries as bytes, and what they add up to: who knows all commands gives it."""

    @property
    def folds(self) -> Sequence[AnyFold]:
        """What is to come out the same when the front of a journal is dropped."""

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
    roots: int = 0
    """So many entries of the scans that were dropped are left, before the first state: later ones depend on them."""
    marks: bool = False
    """Whether its writer leaves the mark of the last scan at its end; earlier versions did not always."""

    @staticmethod
    def of(program: Program, by: str) -> "About":
        """A run that begins now."""
        model = program.layout.model
        created = iso(wall_time())
        return About(
            model.name, model_fingerprint(model), libm_fingerprint(), program.interval_ns, created, by, marks=True
        )

    def packed(self) -> bytes:
        """As the first block has it."""
        return json.dumps(asdict(self)).encode()


@dataclass(frozen=True, slots=True)
class KeptProgram:
    """A program as the run file has it. `sources` is whatever its keeper makes the program of."""

    version: int
    sources: bytes
    digest: str

    def packed(self) -> bytes:
        """As a block has it."""
        return _VERSION.pack(self.version) + self.digest.encode() + self.sources


@dataclass(slots=True)
class Contents:
    """What a run file holds, but for the states, which stay where they are."""

    about: About
    programs: dict[int, KeptProgram] = field(default_factory=dict)
    checkpoints: list[Checkpoint] = field(default_factory=list)
    entries: list[Entry] = field(default_factory=list)
    last_scan: int = 0
    driven: bytes = b""
    """How the PLC was driven last; empty where the file does not say."""
    gaps: list[Gap] = field(default_factory=list)
    """Where the file lost what was entered."""


def keyframe(version: int, state: bytes) -> bytes:
    """A whole state as a block has it."""
    return _VERSION.pack(version) + state


def delta(state: bytes, base: bytes) -> bytes:
    """A state as a block has it that refers to a whole one."""
    return np.bitwise_xor(np.frombuffer(state, np.uint8), np.frombuffer(base, np.uint8)).tobytes()


def read_state(file: RunFile, checkpoint: Checkpoint, size: int) -> bytes:
    """The state of `size` bytes that a checkpoint holds; `RunFileError` when it holds something else."""
    base = file.payload(checkpoint.base, _VERSION.size + size)[_VERSION.size :]
    other = base if checkpoint.whole else file.payload(checkpoint.block, size)
    for block, state in ((checkpoint.base, base), (checkpoint.block, other)):
        if len(state) != size:
            raise file.unreadable(block, f"it holds {len(state)} bytes, and the image of its program has {size}")
    state = base if checkpoint.whole else delta(other, base)
    _check_header(file, checkpoint, state)
    return state


def _check_header(file: RunFile, checkpoint: Checkpoint, state: bytes) -> None:
    """Refuses a block whose state has a different scan than the block: a replay to the scan of the block might never end."""
    header = Header(state)
    if header.scan != checkpoint.scan:
        raise file.unreadable(
            checkpoint.block, f"it is kept at scan {checkpoint.scan}, and holds the state of scan {header.scan}"
        )
    try:
        _ = header.mode
    except ValueError as error:
        raise file.unreadable(checkpoint.block, str(error)) from error


def _check_last(file: RunFile, checkpoint: Checkpoint) -> None:
    """The same of the last state, of which only the first bytes are read. Those before it are of earlier scans."""
    base = file.beginning(checkpoint.base, _VERSION.size + _HEADER)[_VERSION.size :]
    other = base if checkpoint.whole else file.beginning(checkpoint.block, _HEADER)
    if min(len(base), len(other)) == _HEADER:  # what is too short is refused when it is used
        _check_header(file, checkpoint, base if checkpoint.whole else delta(other, base))


def read_contents(file: RunFile, codec: Codec) -> "Reader":
    """Reads it, and goes on after damage where that is possible; `RunFileError` when that does not leave enough, or cannot be
    understood."""
    reader: Reader | None = None
    for block in file.scan_blocks():
        if reader is not None:
            reader.take(block)
        elif block.kind is Kind.ABOUT:
            reader = Reader(file, codec, _read_about(file, block))
        else:
            break
    damage = file.damage
    if damage is not None and damage.after and file.format >= NUMBERED:
        reader = _read_on_after(file, codec, damage)
    if reader is None:
        raise Damaged(f"{file.path.name} is damaged at its beginning: nothing of the run can be recovered")
    reader.finish()
    if file.mended is not None:
        file.mended = replace(file.mended, unread=frozenset(reader.unread))
    if not reader.found.programs or not reader.found.checkpoints:
        raise Damaged(f"{file.path.name} is damaged before its first checkpoint: nothing of the run can be recovered")
    _check_last(file, reader.found.checkpoints[-1])
    return reader


def about_of(path: Path) -> About | None:
    """What a run file begins with; of a whole file no more is read. None where that is damaged. `RunFileError`; `OSError`."""
    file = RunFile.open(path, read_only=True)
    try:
        first = next(file.scan_blocks(), None)
        return _read_about(file, first) if first is not None and first.kind is Kind.ABOUT else None
    finally:
        file.close()


def _read_on_after(file: RunFile, codec: Codec, damage: Damage) -> "Reader | None":
    """All good blocks, before the damage and after it."""
    blocks = in_order([*file.walk(damage.offset), *damage.after])
    about = next((each for each in blocks if each.kind is Kind.ABOUT), None)
    if about is None:
        return None
    reader = Reader(file, codec, _read_about(file, about), damaged=True)
    for block in blocks:
        reader.take(block)
    file.go_on_with(blocks)
    return reader


def entry_of(file: RunFile, block: Block, codec: Codec, slots: Slots) -> Entry:
    """The entry that a block holds; `RunFileError`. Those before it were read with the same slots."""
    return _entry_in(file, block, file.payload(block), codec, slots) or _unknown(file, block)


def _entry_in(file: RunFile, block: Block, data: bytes, codec: Codec, slots: Slots) -> Entry | None:
    """None where it repeats one that is not known."""
    try:
        if is_brief(block):
            return slots.read(block, data)
        entry = codec.unpack(data)
    except Exception as error:
        raise file.unreadable(block, str(error)) from error
    if block.slot:
        slots.put(block.slot, entry)
    return entry


def _unknown(file: RunFile, block: Block) -> NoReturn:
    raise file.unreadable(block, "the command that it repeats is not before it")


@dataclass(frozen=True, slots=True)
class _Loss:
    """Entries are missing: what was known before them."""

    scan: int
    block: Block
    """The last one before them."""
    entries: int
    driven: bytes


class Reader:
    """Takes one block after the other."""

    def __init__(self, file: RunFile, codec: Codec, about: About, damaged: bool = False) -> None:
        self.found = Contents(about)
        self.unread: set[int] = set()
        """Offsets of the entries that are lost though their blocks are good."""
        self._file, self._codec = file, codec
        self._damaged = damaged
        """Blocks may be missing."""
        self._entries = 0
        self._next: int | None = None
        """The number that the next block has if no entry is missing, once there is a state."""
        self._loss: _Loss | None = None
        self._last: Block | None = None
        self._base: Block | None = None
        self._version = self._scan = 0
        self._left = _UNPACKED
        self._slots = Slots()

    def read_on(self) -> list[Entry]:
        """Takes the blocks that were appended since; the entries among them. `Misplaced` where it has to be read again from
        its beginning, as something is missing in the middle."""
        self.found.entries = []
        for block in self._file.scan_blocks():
            self.take(block)
        damage = self._file.damage
        more = damage is not None and any(each.kind in (Kind.KEYFRAME, Kind.DELTA) for each in damage.after)
        if self._loss is not None or (more and self._file.format >= NUMBERED):
            raise Misplaced(f"{self._file.path.name} was damaged while it was read: open it again")
        return self.found.entries

    def take(self, block: Block) -> None:
        """The next block."""
        found = self.found
        match block.kind:
            case Kind.PROGRAM:
                program = self._program(block)
                found.programs.setdefault(program.version, program)
                self._last = block
                return
            case Kind.ABOUT if self._file.format >= NUMBERED:
                self._last = block
                return
        self._count(block)
        match block.kind:
            case Kind.ENTRY:
                entry = self._entry(block)
                if entry is not None:
                    found.entries.append(entry)
                    self._entries += 1
                else:
                    self.unread.add(block.offset)
            case Kind.KEYFRAME:
                self._keyframe(block)
            case Kind.DELTA if self._base is not None and block.base in (self._base.crc, 0):
                self._checkpoint(block, self._base)
            case Kind.DELTA if self._damaged:
                pass  # its keyframe is gone
            case Kind.MARK:
                if block.length:
                    found.driven = self._file.payload(block, _DRIVEN_MOST)
            case _:
                raise self._file.unreadable(block, "nothing of this kind can be here")
        if block.scan < self._scan:
            raise self._file.unreadable(block, f"it is of scan {block.scan}, after one of scan {self._scan}")
        self._scan = found.last_scan = block.scan
        self._last = block

    def finish(self) -> None:
        """All blocks were taken. Where entries are missing, and no state comes after them, the run ends before them."""
        found, loss = self.found, self._loss
        if loss is not None:
            del found.entries[loss.entries :]
            self._entries = loss.entries
            found.last_scan, found.driven = loss.scan, loss.driven
            self._file.end_before_loss(loss.block)
            self._loss = None
        if not found.checkpoints or self._file.format < NUMBERED:
            return
        while found.gaps and found.gaps[0].first <= found.checkpoints[0].scan < found.gaps[0].until:
            del found.checkpoints[0]  # nothing is known of any scan that follows it
        first, begin = found.checkpoints[0], found.about.dropped_before
        if first.scan > begin and not (found.gaps and found.gaps[0].first <= begin):
            found.gaps.insert(0, Gap(begin, first.scan, first.entries, first.version))
        elif first.entries < found.about.roots:
            found.gaps.insert(0, Gap(first.scan, first.scan, first.entries, first.version))

    def _count(self, block: Block) -> None:
        """Whether an entry is missing before this block."""
        if self._file.format < NUMBERED or self._next is None:
            return
        if block.entries < self._next:
            raise self._file.unreadable(block, f"it is entry {block.entries}, after {self._next} of them")
        if block.entries > self._next:
            self._miss()
        self._next = block.entries_after

    def _miss(self) -> None:
        """From here on the state is not known."""
        self._slots.clear()
        if self._loss is None and self._last is not None:
            self._loss = _Loss(self._scan, self._last, self._entries, self.found.driven)

    def _keyframe(self, block: Block) -> None:
        head = self._file.beginning(block, _VERSION.size)
        if len(head) < _VERSION.size:
            raise self._file.unreadable(block, "it is too short")
        (version,) = _VERSION.unpack(head)
        if self._damaged and version not in self.found.programs:
            self._base = None
            self._miss()
            return
        self._version = version
        self._need(block, version)
        self._base = block
        self._checkpoint(block, block)

    def _checkpoint(self, block: Block, base: Block) -> None:
        found, loss = self.found, self._loss
        if loss is not None:
            found.gaps.append(Gap(loss.scan, block.scan, self._entries, self._version))
            self._loss = None
            while found.checkpoints and found.checkpoints[-1].scan == block.scan:
                del found.checkpoints[-1]  # nobody could tell it from the one after the gap
        if self._next is None:
            self._next = block.entries_after
        found.checkpoints.append(Checkpoint(block.scan, self._entries, self._version, block, base))

    def _need(self, block: Block, version: object) -> None:
        if not isinstance(version, int) or version not in self.found.programs:
            raise self._file.unreadable(block, f"it needs program version {version}, which is not before it")

    def _payload(self, block: Block) -> bytes:
        payload = self._file.payload(block)
        self._left -= _IN_MEMORY if is_brief(block) else len(payload)
        if self._left < 0:
            raise self._file.unreadable(block, f"programs and commands of more than {_UNPACKED >> 20} MiB are too many")
        return payload

    def _program(self, block: Block) -> KeptProgram:
        payload = self._payload(block)
        begin = _VERSION.size + _DIGEST
        if len(payload) < begin:
            raise self._file.unreadable(block, "it is too short")
        (version,) = _VERSION.unpack_from(payload)
        return KeptProgram(version, payload[begin:], payload[_VERSION.size : begin].decode("ascii", "replace"))

    def _entry(self, block: Block) -> Entry | None:
        """None where it is lost, as the one is that it repeats."""
        entry = _entry_in(self._file, block, self._payload(block), self._codec, self._slots)
        if entry is None:
            if not self._damaged:
                _unknown(self._file, block)
            self._miss()
            return None
        kinds = (int, datetime, Command, Plan)
        if not all(map(isinstance, (entry.scan, entry.at, entry.command, entry.plan), kinds)):
            raise self._file.unreadable(block, "it is no entry of a journal")
        if entry.scan != block.scan:
            raise self._file.unreadable(block, f"it is of scan {entry.scan}, and is kept at scan {block.scan}")
        if isinstance(entry.plan.effect, Swapped):
            if self._damaged and entry.plan.effect.version not in self.found.programs:
                self._miss()  # the program that follows is gone
            else:
                self._need(block, entry.plan.effect.version)
        return entry


def _read_about(file: RunFile, block: Block) -> About:
    try:
        told: object = json.loads(file.payload(block, _ABOUT_MOST))
        if not isinstance(told, dict):
            raise BadValue("it is no object")
        return make_kept(About, told)
    except (ValueError, RecursionError) as error:
        raise RunFileError(f"{file.path.name} does not say what was recorded: {error}") from error
