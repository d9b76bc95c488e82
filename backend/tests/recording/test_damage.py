"""Run files that were damaged anywhere: nothing crashes, a damaged block costs no more than its own scans, and a file that lost
scans is never said to be whole."""

import random
from collections import Counter
from pathlib import Path

import pytest

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.recording import checkpoints
from scanbench.recording.format import Kind, RunFile, RunFileError
from scanbench.recording.reader import RunReader, Unreadable, no_programs
from scanbench.recording.replay_file import Replayed, replay_file
from scanbench.recording.stump import write_stump
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount, nightly
from tests.recording.damage import SCANS, Accident, Left, Whole, accident, left_of, whole
from tests.recording.recorded import advance, of_file, resumed, spare, tidy


def replayed(path: Path) -> Replayed:
    programs = spare(ReferenceEngine)
    return replay_file(path, lambda kept: programs, ENTRIES)


@nightly
def test_a_damaged_block_costs_its_own_scans_only(tmp_path: Path) -> None:
    path, outcomes = tmp_path / "run", Counter[str]()
    path.write_bytes(whole().data)
    right = replayed(path)
    assert (right.lost, right.damage, right.scans) == (False, "", SCANS)
    for seed in range(amount(2000, 100)):
        done = accident(whole().data, seed)
        path.write_bytes(done.data)
        try:
            outcomes[_looked_at(path, whole(), done, right, random.Random(seed))] += 1
        except AssertionError as error:
            raise AssertionError(f"seed {seed}, {done.kind} at {done.hit}: {error}") from error
        except Exception as error:
            pytest.fail(f"seed {seed}, {done.kind} at {done.hit}: {error!r}")
    assert min(outcomes[each] for each in ("refused", "whole", "gap", "short")) > amount(40, 1), outcomes


def _looked_at(path: Path, file: Whole, done: Accident, right: Replayed, chance: random.Random) -> str:
    """How it ended."""
    left = left_of(file, done)
    try:
        found = replayed(path)
    except (RunFileError, Unreadable):
        assert left is None, "there is enough of it left"
        return "refused"
    same = (found.scan, found.hash, found.scans) == (right.scan, right.hash, right.scans)
    if not same:
        assert found.damaged, f"{found} is said to be whole"
        assert found.damage
        assert found.scans < right.scans
    if found.lost:
        assert found.damage
    if left is not None:
        _readable(path, file, left, chance)
    return "whole" if same else "gap" if found.gaps else "short"


def _readable(path: Path, file: Whole, left: Left, chance: random.Random) -> None:
    """All that has to be there can be gone to, and is as it was."""
    programs = spare(ReferenceEngine)
    with RunReader(path, lambda kept: programs, ENTRIES) as reader:
        reader.follow()
        assert len(reader.entries) <= len(file.journal)
        assert set(reader.entries) <= set(file.journal)
        edges = {scan for each in reader.recording.gaps for scan in (each.first - 1, each.until)}
        chosen = {*chance.sample(sorted(left.scans), min(len(left.scans), amount(40, 6))), *(edges & left.scans)}
        for scan in sorted(chosen):
            reader.goto(scan)
            assert reader.timeline.resource.state == file.states[scan], f"scan {scan} is different"
        for each in reader.recording.gaps:
            assert not left.scans & set(range(each.first, each.until)), f"{each} is more than was hit"


# ---- one block --------------------------------------------------------------------------------------------------------


def spoilt(path: Path, kind: Kind, number: int) -> Path:
    """The file with one damaged block."""
    block = [each for each in whole().blocks if each.kind is kind][number]
    data = bytearray(whole().data)
    data[block.payload_offset] ^= 4
    path.write_bytes(data)
    return path


def test_a_run_with_a_gap_is_gone_on_with(tmp_path: Path) -> None:
    path = spoilt(tmp_path / "run", Kind.ENTRY, 7)  # entered before scan 45; the block before is of scan 40
    timeline = resumed(path)
    assert timeline.live_scan == SCANS
    assert timeline.resource.state == whole().states[SCANS]
    (gap,) = timeline.recording.info.lost
    assert (gap.first, gap.until) == (40, 50)
    for scan in (0, 39, 50, 51, SCANS - 1):
        assert timeline.goto(scan) is None
        assert timeline.resource.state == whole().states[scan]
    for scan in (40, 45, 49):
        refusal = timeline.goto(scan)
        assert isinstance(refusal, Refusal)
        assert "Scans 40 to 49 are lost; it can be read again from scan 50 on" in refusal.message
    assert timeline.goto(38) is None
    while timeline.go_on(55).reason is not timeline.go_on(55).reason.DONE:
        pass
    assert timeline.resource.header.scan == 55
    assert timeline.resource.state == whole().states[55]
    timeline.return_live()
    advance(timeline, 3)
    assert isinstance(timeline.submit(Write("Ada", "Main.n", "5")), Entry)
    state = timeline.resource.state
    copied: list[Refusal | None] = []
    timeline.copy(tmp_path / "copy", None, "Bob", copied.append)
    timeline.recording.wait()
    assert copied == [None]
    timeline.close()
    assert replay_file(tmp_path / "copy", of_file, ENTRIES).scans == SCANS + 3 - 10
    again = resumed(path)
    assert again.resource.state == state
    assert [(each.first, each.until) for each in again.recording.info.lost] == [(40, 50)]
    again.close()


def test_a_copy_knows_what_its_original_lost(tmp_path: Path) -> None:
    path = spoilt(tmp_path / "run", Kind.ENTRY, 7)
    with RunReader(path, of_file, ENTRIES) as reader:
        reader.follow()
        reader.copy(tmp_path / "copy", reader.front(120), 120, "Bob")
    replayed = replay_file(tmp_path / "copy", of_file, ENTRIES)
    assert (replayed.lost, replayed.scan, replayed.scans) == (True, 120, 110)
    assert "copy is a copy of a damaged file. Scans 40 to 49 are lost" in replayed.damage


def test_what_is_lost_is_known_when_the_file_gets_smaller(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = spoilt(tmp_path / "run", Kind.ENTRY, 7)  # made before states come more often
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    timeline = resumed(path, limit=60_000)
    chance = random.Random(3)
    while not timeline.recording.info.thinned_before:  # not yet so small that its beginning goes
        assert isinstance(
            timeline.submit(Write("Ada", f"D{chance.randrange(3000)}", f"{chance.randrange(9999)}")), Entry
        )
        timeline.run(1)
        tidy(timeline)
    for closed in (False, True):
        if closed:
            timeline.close()
            timeline = resumed(path, limit=60_000)
        assert [(each.first, each.until) for each in timeline.recording.info.lost] == [(40, 50)]
        for scan in (0, 39, 50, 79, SCANS - 1):
            assert timeline.goto(scan) is None
            assert timeline.resource.state == whole().states[scan]
        timeline.return_live()
    timeline.close()


@pytest.mark.parametrize("kind", [Kind.ABOUT, Kind.PROGRAM, Kind.KEYFRAME, Kind.DELTA])
def test_of_other_blocks_nothing_is_lost(kind: Kind, tmp_path: Path) -> None:
    """There is a second one, or it is calculated again."""
    number = 1 if kind is Kind.KEYFRAME else 0
    found = replayed(spoilt(tmp_path / "run", kind, number))
    assert (found.lost, found.damaged, found.scans) == (False, True, SCANS)
    assert "No scan is lost" in found.damage
    timeline = resumed(tmp_path / "run")
    for scan in (1, 35, 99, SCANS):
        assert timeline.goto(scan) is None
        assert timeline.resource.state == whole().states[scan]
    timeline.close()


def test_of_the_first_state_its_own_scans_are_lost(tmp_path: Path) -> None:
    found = replayed(spoilt(tmp_path / "run", Kind.KEYFRAME, 0))
    assert found.lost
    assert found.first_scan > 0
    assert f"Scans 0 to {found.first_scan - 1} are lost" in found.damage


def test_a_copy_knows_that_the_beginning_of_its_original_is_lost(tmp_path: Path) -> None:
    path = spoilt(tmp_path / "run", Kind.KEYFRAME, 0)
    right = replayed(path)
    with RunReader(path, of_file, ENTRIES) as reader:
        reader.follow()
        reader.copy(tmp_path / "copy", reader.front(120), 120, "Bob")
    found = replay_file(tmp_path / "copy", of_file, ENTRIES)
    assert (found.lost, found.first_scan, found.scan) == (True, right.first_scan, 120)
    assert f"copy is a copy of a damaged file. Scans 0 to {right.first_scan - 1} are lost" in found.damage


def test_a_file_of_format_1_ends_where_it_is_damaged(tmp_path: Path) -> None:
    """Nobody can tell whether entries are missing."""
    golden = Path(__file__).parent / "golden" / "format-1.run"
    data = bytearray(golden.read_bytes())
    data[len(data) // 2] ^= 1
    path = tmp_path / "run"
    path.write_bytes(data)
    with RunReader(path, no_programs, ENTRIES) as reader:
        reader.follow()
        assert reader.recording.lost
        assert "are lost, and with them" in reader.recording.damage
        assert not reader.recording.gaps


def test_a_copy_leaves_out_states_whose_keyframe_is_lost(tmp_path: Path) -> None:
    path = spoilt(tmp_path / "run", Kind.KEYFRAME, 1)
    with RunReader(path, of_file, ENTRIES) as reader:
        reader.follow()
        assert not reader.recording.lost
        reader.copy(tmp_path / "copy", reader.front(120), 120, "Bob")
    replayed = replay_file(tmp_path / "copy", of_file, ENTRIES)
    assert (replayed.lost, replayed.scan, replayed.scans) == (False, 120, 120)


def test_a_file_that_begins_later_knows_when_what_it_kept_of_before_is_lost(tmp_path: Path) -> None:
    path = tmp_path / "run"
    path.write_bytes(whole().data)
    with RunReader(path, of_file, ENTRIES) as reader:
        reader.follow()
        write_stump(reader, tmp_path / "stump", 100, "Bob", ENTRIES, reader.front(101))
    stump = RunFile.open(tmp_path / "stump", read_only=True)
    roots = [block for block in stump.scan_blocks() if block.kind is Kind.ENTRY]
    stump.close()
    assert roots, "nothing is left of before"
    assert not replay_file(tmp_path / "stump", of_file, ENTRIES).lost
    data = bytearray((tmp_path / "stump").read_bytes())
    data[roots[0].payload_offset] ^= 4
    (tmp_path / "stump").write_bytes(data)
    found = replay_file(tmp_path / "stump", of_file, ENTRIES)
    assert found.lost
    assert "Commands that were entered before scan 100 are lost" in found.damage
