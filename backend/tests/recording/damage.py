"""A run file with several states, accidents that happen to it, and which of its scans an accident may cost."""

import random
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from scanbench.recording import recording as recordings
from scanbench.recording.format import Block, Kind, RunFile
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry
from scanbench.runtime.write import Write
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from tests.recording.recorded import SECOND, advance, begun, to_program

SCANS = 160
HEAD = 16
"""Bytes of a file before its first block."""
_NEEDED = (Kind.ABOUT, Kind.PROGRAM)


@dataclass(frozen=True)
class Whole:
    """The file as it was written."""

    data: bytes
    blocks: tuple[Block, ...]
    programs: dict[int, int]
    """Of each block with a program, by its offset: the version."""
    states: tuple[bytes, ...]
    """Before each scan."""
    journal: tuple[Entry, ...]


@cache
def whole(clients: bool = False) -> Whole:
    """Commands at odd scans, a state every tenth scan, a second program in the middle; with clients that write again and again,
    so that there are short blocks."""
    with TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr(recordings, "DELTAS", 3)
        path = Path(folder, "run")
        timeline = begun(path)
        states = []
        for scan in range(SCANS):
            if scan % 6 == 3:
                assert isinstance(timeline.submit(Write("Ada", "Main.other", str(scan))), Entry)
            if clients:
                _clients_write(timeline, scan)
            if scan == SCANS // 2:
                assert not to_program(timeline, 2, SECOND)
            if scan % 10 == 0:
                timeline.recording.checkpoint(scan, timeline.resource.version, timeline.resource.state)
            states.append(timeline.resource.state)
            advance(timeline, 1)
        states.append(timeline.resource.state)
        journal = tuple(timeline.live_journal)
        timeline.close()
        file = RunFile.open(path, read_only=True)
        blocks = tuple(file.scan_blocks())
        programs = {each.offset: file.payload(each)[0] for each in blocks if each.kind is Kind.PROGRAM}
        file.close()
        return Whole(path.read_bytes(), blocks, programs, tuple(states), journal)


def _clients_write(timeline: Timeline, scan: int) -> None:
    for number, author in enumerate(("Modbus 10.0.0.1", "Modbus 10.0.0.2", "FINS 192.168.0.7, node 25")):
        if scan % (number + 1) == 0:
            write = AreaWrite("D", 200 + number, (scan + 1).to_bytes(2, "little"))
            assert isinstance(timeline.submit(WriteAreas(author, (write,))), Entry)


@dataclass(frozen=True)
class Accident:
    """What became of the bytes, and where of the original ones something was changed."""

    kind: str
    data: bytes
    hit: tuple[range, ...]


def accident(data: bytes, seed: int) -> Accident:
    """Bits, stretches that are gone, zero, of something else, or there twice; an end that is missing; sectors of 512 bytes that
    a disk mixed up."""
    chance = random.Random(seed)
    at, size = chance.randrange(len(data)), chance.choice((1, 4, 60, 512))
    kind = chance.choice(("bit", "gone", "zero", "noise", "twice", "end", "mixed"))
    before, stretch, after = data[:at], data[at : at + size], data[at + size :]
    hit = (range(at, at + size),)
    if kind == "bit":
        return Accident(
            kind, before + bytes((data[at] ^ 1 << chance.randrange(8),)) + data[at + 1 :], (range(at, at + 1),)
        )
    if kind == "gone":
        return Accident(kind, before + after, hit)
    if kind == "zero":
        return Accident(kind, before + bytes(len(stretch)) + after, hit)
    if kind == "noise":
        return Accident(kind, before + chance.randbytes(len(stretch)) + after, hit)
    if kind == "twice":
        return Accident(kind, before + stretch + stretch + after, (range(at, at + size + 1),))
    if kind == "end":
        return Accident(kind, before, (range(at, len(data)),))
    one, other = (512 * chance.randrange(len(data) // 512) for _ in range(2))
    made = bytearray(data)
    made[one : one + 512], made[other : other + 512] = data[other : other + 512], data[one : one + 512]
    return Accident(kind, bytes(made), (range(one, one + 512), range(other, other + 512)))


@dataclass(frozen=True)
class Left:
    """What has to be left of a file."""

    scans: frozenset[int]
    """All that can be gone to."""
    entries: int
    """So many that lie in no block that was hit."""


def left_of(file: Whole, done: Accident) -> Left | None:
    """What the accident cannot have cost; None where it hit the beginning, or all copies of something that all needs."""
    good = [each for each in file.blocks if not any(_meet(each, hit) for hit in done.hit)]
    if any(hit.start < HEAD for hit in done.hit) or not any(each.kind is Kind.ABOUT for each in good):
        return None
    if {file.programs[each.offset] for each in good if each.kind is Kind.PROGRAM} != set(file.programs.values()):
        return None
    keyframes = {each.crc for each in good if each.kind is Kind.KEYFRAME}
    states = [
        each for each in good if each.kind is Kind.KEYFRAME or (each.kind is Kind.DELTA and each.base in keyframes)
    ]
    if not states:
        return None
    run = [each for each in good if each.kind not in _NEEDED]
    lost = [each for each in file.blocks if each.kind is Kind.ENTRY and each not in good]
    scans = set(range(states[0].scan, max(each.scan for each in run) + 1))
    for entry in lost:
        before = max((each.scan for each in run if each.offset < entry.offset), default=0)
        again = min((each.scan for each in states if each.offset > entry.offset), default=SCANS + 1)
        scans -= set(range(before, again))
    return Left(frozenset(scans), sum(each.kind is Kind.ENTRY for each in good))


def _meet(block: Block, hit: Iterable[int]) -> bool:
    return isinstance(hit, range) and block.offset < hit.stop and hit.start < block.end
