"""A damaged write of a client, which later short blocks repeat: the run is copied, made smaller and opened again."""

from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.recording.block import SHORT
from scanbench.recording.format import RunFile, RunFileError
from scanbench.recording.gaps import LostScans
from scanbench.recording.replay_file import replay_file
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.forces import Force
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount, nightly
from tests.recording.damage import accident, left_of, whole
from tests.recording.recorded import advance, begun, of_file, resumed, spare, tidy


def clients_write(timeline: Timeline, times: int) -> None:
    """Two of them in turn; the first write of each after a state is whole."""
    for _ in range(times):
        for place, author in ((200, "Modbus 10.0.0.1"), (300, "Modbus 10.0.0.2")):
            write = AreaWrite("D", place, (timeline.live_scan + 1).to_bytes(2, "little"))
            assert isinstance(timeline.submit(WriteAreas(author, (write,))), Entry)
        advance(timeline, 1)


def keep_state(timeline: Timeline) -> None:
    assert timeline.recording.checkpoint(timeline.live_scan, timeline.resource.version, timeline.resource.state)


def damaged(path: Path, before: bool) -> None:
    """A run whose first write of the first client after the second state is damaged; `before`: with writes before that state."""
    timeline = begun(path)
    if before:
        clients_write(timeline, 4)
    advance(timeline, 2)
    keep_state(timeline)
    second = timeline.live_scan
    clients_write(timeline, 10)
    keep_state(timeline)
    assert isinstance(timeline.submit(Force("Ada", "Main.other", "7")), Entry)
    clients_write(timeline, 10)
    timeline.close()
    file = RunFile.open(path, read_only=True)
    blocks = list(file.scan_blocks())
    file.close()
    hit = next(each for each in blocks if each.slot == 1 and each.scan == second)
    assert sum(each.packing == SHORT for each in blocks) >= 36
    data = bytearray(path.read_bytes())
    data[hit.payload_offset] ^= 4
    path.write_bytes(data)


@pytest.mark.parametrize("before", [False, True])
def test_a_copy_can_be_opened(before: bool, tmp_path: Path) -> None:
    damaged(tmp_path / "run", before)
    timeline = resumed(tmp_path / "run")
    state, journal, lost = timeline.resource.state, tuple(timeline.live_journal), timeline.recording.info.lost
    assert len(lost) == 1
    assert "is damaged at byte" in timeline.recording.info.damage
    assert "more place" not in timeline.recording.info.damage
    refused: list[Refusal | None] = []
    timeline.copy(tmp_path / "copy", None, "Bob", refused.append)
    timeline.recording.wait()
    timeline.close()
    assert refused == [None]
    copy = resumed(tmp_path / "copy")
    assert (copy.resource.state, tuple(copy.live_journal), copy.recording.info.lost) == (state, journal, lost)
    copy.close()
    assert replay_file(tmp_path / "copy", of_file, ENTRIES).lost


@pytest.mark.parametrize("before", [False, True])
def test_the_file_is_made_smaller(before: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of what is dropped the force stays, and nothing else."""
    damaged(tmp_path / "run", before)
    monkeypatch.setattr("scanbench.recording.smaller.ENTRY_LIMIT", 40)
    monkeypatch.setattr("scanbench.recording.recording.DELTAS", 1)
    timeline = resumed(tmp_path / "run")
    keep_state(timeline)
    clients_write(timeline, 20)
    timeline.recording.bounds.tried(0, 0)
    tidy(timeline)
    assert timeline.recording.about.dropped_before
    clients_write(timeline, 2)
    state, journal = timeline.resource.state, tuple(timeline.live_journal)
    assert [each.command for each in journal if isinstance(each.command, Force)] == [journal[0].command]
    timeline.close()
    again = resumed(tmp_path / "run")
    assert (again.resource.state, tuple(again.live_journal)) == (state, journal)
    again.close()


# ---- damage anywhere ----------------------------------------------------------------------------------------------------


def opened(path: Path) -> Timeline:
    """With programs that are made once."""
    programs = spare(ReferenceEngine)
    return Timeline.resume(path, lambda kept: programs, ENTRIES)


@dataclass(frozen=True)
class Shown:
    """What has to be the same in a copy, and when it is opened again."""

    scan: int
    state: bytes
    journal: tuple[Entry, ...]
    lost: tuple[LostScans, ...]

    @staticmethod
    def of(timeline: Timeline, begin: int) -> "Shown":
        """Not what is lost before the scan `begin`: a copy does not tell it where no earlier scan can be gone to."""
        lost = tuple(each for each in timeline.recording.info.lost if each.until > begin)
        return Shown(timeline.live_scan, timeline.resource.state, tuple(timeline.live_journal), lost)


@nightly
def test_a_damaged_run_is_copied_made_smaller_and_opened_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also, what an accident cannot have cost is there and as it was."""
    monkeypatch.setattr("scanbench.recording.smaller.ENTRY_LIMIT", 60)
    monkeypatch.setattr("scanbench.recording.recording.DELTAS", 3)
    file, outcomes = whole(clients=True), Counter[str]()
    for seed in range(amount(2000, 25)):
        done, folder = accident(file.data, seed), tmp_path / str(seed)
        folder.mkdir()
        (folder / "run").write_bytes(done.data)
        left = left_of(file, done)
        try:
            timeline = opened(folder / "run")
        except RunFileError as error:
            if left is not None:
                pytest.fail(f"seed {seed}, {done.kind} at {done.hit}: {error}")
            outcomes["refused"] += 1
            continue
        try:
            if left is not None:
                for scan in sorted(left.scans)[::40]:
                    assert timeline.goto(scan) is None
                    assert timeline.resource.state == file.states[scan], f"scan {scan} is different"
                timeline.return_live()
            outcomes["smaller" if _copied_and_smaller(timeline, folder) else "as large"] += 1
        except Exception as error:
            raise AssertionError(f"seed {seed}, {done.kind} at {done.hit}: {error!r}") from error
    assert outcomes["smaller"] > amount(1000, 5), outcomes


def _copied_and_smaller(timeline: Timeline, folder: Path) -> bool:
    """Whether its front was dropped."""
    before = Shown.of(timeline, 0)
    refused: list[Refusal | None] = []
    timeline.copy(folder / "copy", None, "Bob", refused.append)
    timeline.recording.wait()
    assert refused == [None]
    timeline.recording.bounds.tried(0, 0)
    tidy(timeline)
    smaller = timeline.recording.about.dropped_before > 0
    cuts = any(each.whole for each in timeline.recording.checkpoints[1:])
    assert smaller or len(timeline.live_journal) <= 60 or not cuts
    clients_write(timeline, 2)
    after = Shown.of(timeline, 0)
    timeline.close()
    for name, expected in (("copy", before), ("run", after)):
        again = opened(folder / name)
        begin = again.recording.first_scan
        found = Shown.of(again, begin)
        again.close()
        lost = tuple(each for each in expected.lost if each.until > begin)
        assert found == replace(expected, lost=lost), f"{name} is different"
    return smaller
