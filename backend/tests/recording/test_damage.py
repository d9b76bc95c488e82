"""Run files that were damaged anywhere: nothing crashes, and a file that lost scans is never said to be whole."""

import random
from collections import Counter
from pathlib import Path

import pytest

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.recording.format import RunFileError
from scanbench.recording.reader import Unreadable
from scanbench.recording.replay_file import Replayed, replay_file
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount
from tests.recording.recorded import spare
from tests.recording.variants import records, write


def replayed(path: Path) -> Replayed:
    programs = spare(ReferenceEngine)
    return replay_file(path, lambda kept: programs, ENTRIES)


def damaged(data: bytes, seed: int) -> tuple[str, bytes]:
    """The same file with one accident: bits, stretches that are gone, zero, of something else, or there twice; an end that is
    missing; blocks of 512 bytes that a disk mixed up."""
    chance = random.Random(seed)
    at, size = chance.randrange(len(data)), chance.choice((1, 4, 60, 512))
    kind = chance.choice(("bit", "gone", "zero", "noise", "twice", "end", "mixed"))
    before, stretch, after = data[:at], data[at : at + size], data[at + size :]
    if kind == "bit":
        return kind, before + bytes((data[at] ^ 1 << chance.randrange(8),)) + data[at + 1 :]
    if kind == "gone":
        return kind, before + after
    if kind == "zero":
        return kind, before + bytes(len(stretch)) + after
    if kind == "noise":
        return kind, before + chance.randbytes(len(stretch)) + after
    if kind == "twice":
        return kind, before + stretch + stretch + after
    if kind == "end":
        return kind, before
    one, other = (512 * chance.randrange(max(1, len(data) // 512)) for _ in range(2))
    made = bytearray(data)
    made[one : one + 512], made[other : other + 512] = data[other : other + 512], data[one : one + 512]
    return kind, bytes(made)


def test_a_file_that_lost_scans_is_never_said_to_be_whole(tmp_path: Path) -> None:
    path = write(tmp_path / "run", records(tmp_path))
    data, whole = path.read_bytes(), replayed(path)
    assert (whole.lost, whole.damage) == (False, "")
    outcomes = Counter[str]()
    for seed in range(amount(2000, 120)):
        kind, changed = damaged(data, seed)
        path.write_bytes(changed)
        try:
            found = replayed(path)
        except (RunFileError, Unreadable):
            outcomes["refused"] += 1
            continue
        except BaseException as error:
            pytest.fail(f"seed {seed}, {kind}: {error!r}")
        if changed == data or (found.scan, found.hash, found.entries) == (whole.scan, whole.hash, whole.entries):
            outcomes["whole"] += 1
            continue
        outcomes["less"] += 1
        torn_off = kind == "end"  # as after a kill: what was written last is not there, and that is no damage
        assert found.scan <= whole.scan, f"seed {seed}, {kind}"
        assert found.lost or found.damage or torn_off, f"seed {seed}, {kind}: {found}"
    assert min(outcomes[each] for each in ("refused", "less")) > 5, outcomes
