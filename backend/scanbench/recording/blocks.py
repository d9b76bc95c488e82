"""What the blocks of a run file mean (`format.py` has their bytes), and how they are read.

ABOUT      first: JSON of `About`
PROGRAM    u32 version, digest (64 characters), the sources as they were given; before whatever needs the program
ENTRY      an entry of the journal, as the codec packs it
KEYFRAME   u32 program version, the state before `scan`; the entries before it in the file are in it
DELTA      the same, xor the state of the last keyframe before it
MARK       nothing: only its scan, the last that is known to have been reached; or how the PLC is driven from there on (its
           speed, whether it is paused, ...), as its keeper gave it

Entries before the first keyframe are what is left of a part that was dropped: nobody can go back there, but forces
and errors that still hold were entered there.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from datetime import datetime
from struct import Struct
from typing import Protocol

import numpy as np

from scanbench.program.program import Program
from scanbench.public import iso
from scanbench.recording.fingerprints import libm_fingerprint, model_fingerprint
from scanbench.recording.format import Block, Damaged, Kind, RunFile, RunFileError
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
_UNPACKED = 1 << 28
"""Bytes of all programs and entries together: they are in memory as long as the run is open."""


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

    @staticmethod
    def of(program: Program, by: str) -> "About":
        """A run that begins now."""
        model = program.layout.model
        return About(
            model.name, model_fingerprint(model), libm_fingerprint(), program.interval_ns, iso(wall_time()), by
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
    """Reads it up to where it is damaged; `RunFileError` when that does not leave enough, or cannot be understood."""
    reader: Reader | None = None
    for block in file.scan_blocks():
        if reader is not None:
            reader.take(block)
        elif block.kind is Kind.ABOUT:
            reader = Reader(file, codec, _read_about(file, block))
        else:
            break
    if reader is None:
        raise Damaged(f"{file.path.name} is damaged at its beginning: nothing of the run can be recovered")
    if not reader.found.programs or not reader.found.checkpoints:
        raise Damaged(f"{file.path.name} is damaged before its first checkpoint: nothing of the run can be recovered")
    _check_last(file, reader.found.checkpoints[-1])
    return reader


class Reader:
    """Takes one block after the other."""

    def __init__(self, file: RunFile, codec: Codec, about: About) -> None:
        self.found = Contents(about)
        self._file, self._codec = file, codec
        self._entries = 0
        self._base: Block | None = None
        self._version = self._scan = 0
        self._left = _UNPACKED

    def read_on(self) -> list[Entry]:
        """Takes the blocks that were appended since; the entries among them."""
        self.found.entries = []
        for block in self._file.scan_blocks():
            self.take(block)
        return self.found.entries

    def take(self, block: Block) -> None:
        """The next block."""
        found = self.found
        match block.kind:
            case Kind.PROGRAM:
                program = self._program(block)
                found.programs[program.version] = program
                return
            case Kind.ENTRY:
                found.entries.append(self._entry(block))
                self._entries += 1
            case Kind.KEYFRAME:
                head = self._file.beginning(block, _VERSION.size)
                if len(head) < _VERSION.size:
                    raise self._file.unreadable(block, "it is too short")
                (self._version,) = _VERSION.unpack(head)
                self._need(block, self._version)
                self._base = block
                self._checkpoint(block, block)
            case Kind.DELTA if self._base is not None:
                self._checkpoint(block, self._base)
            case Kind.MARK:
                if block.length:
                    found.driven = self._file.payload(block, _DRIVEN_MOST)
            case _:
                raise self._file.unreadable(block, "nothing of this kind can be here")
        if block.scan < self._scan:
            raise self._file.unreadable(block, f"it is of scan {block.scan}, after one of scan {self._scan}")
        self._scan = found.last_scan = block.scan

    def _checkpoint(self, block: Block, base: Block) -> None:
        self.found.checkpoints.append(Checkpoint(block.scan, self._entries, self._version, block, base))

    def _need(self, block: Block, version: object) -> None:
        if not isinstance(version, int) or version not in self.found.programs:
            raise self._file.unreadable(block, f"it needs program version {version}, which is not before it")

    def _payload(self, block: Block) -> bytes:
        payload = self._file.payload(block)
        self._left -= len(payload)
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

    def _entry(self, block: Block) -> Entry:
        data = self._payload(block)
        try:
            entry = self._codec.unpack(data)
        except Exception as error:
            raise self._file.unreadable(block, str(error)) from error
        kinds = (int, datetime, Command, Plan)
        if not all(map(isinstance, (entry.scan, entry.at, entry.command, entry.plan), kinds)):
            raise self._file.unreadable(block, "it is no entry of a journal")
        if entry.scan != block.scan:
            raise self._file.unreadable(block, f"it is of scan {entry.scan}, and is kept at scan {block.scan}")
        if isinstance(entry.plan.effect, Swapped):
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
