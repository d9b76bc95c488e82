"""What is not told of a run whose file lost commands."""

from pathlib import Path

import pytest

from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.history.bench import Bench
from scanbench.history.campaign.contract import BadCampaign, CampaignWanted
from scanbench.history.campaign.trials import Trials
from scanbench.history.changes import find_changes
from scanbench.history.contract import Divergence, NotCompared
from scanbench.history.divergence import find_divergence
from scanbench.history.scenario_of_run import scenario_of
from scanbench.history.writer import find_writer
from scanbench.recording.format import Kind
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.command import Entry
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.recording.damage import SCANS, whole
from tests.recording.recorded import COUNTER, SECOND, SourcePrograms, advance, begun, of_file
from tests.recording.test_damage import spoilt

GAP = "Scans 40 to 49 are lost; it can be read again from scan 50 on"


def reading(path: Path) -> RunReader:
    reader = RunReader(path, of_file, ENTRIES)
    reader.follow()
    return reader


@pytest.fixture
def damaged(tmp_path: Path) -> Path:
    return spoilt(tmp_path / "run", Kind.ENTRY, 7)


def test_a_writer_before_a_gap_is_not_named(damaged: Path) -> None:
    with reading(damaged) as reader:
        assert find_writer(reader, "Main.other", 39).scan == 39
        with pytest.raises(
            Unreadable, match=f"nobody wrote Main.d since scan 50, and who wrote it before is not known.*{GAP}"
        ):
            find_writer(reader, "Main.d", 55)
        assert find_writer(reader, "Main.other", 55).scan == 51


def test_changes_over_a_gap_say_so(damaged: Path) -> None:
    with reading(damaged) as reader:
        assert GAP in find_changes(reader, 30, 60).note
        assert find_changes(reader, 50, 60).note == ""


def compared(one: Path, other: Path) -> Divergence:
    with reading(one) as a, reading(other) as b:
        return find_divergence(a, b)


def test_runs_are_compared_before_and_after_a_gap_and_that_is_not_all(damaged: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.write_bytes(whole().data)
    found = compared(damaged, other)
    assert (found.scan, found.same, found.compared) == (None, "partly", SCANS - 10)
    assert (found.first, found.last) == (0, SCANS - 1)
    assert f"the same in all {SCANS - 10} scans that could be compared, 0 to {SCANS - 1}" in found.text
    assert f"Not all was compared: the run file is damaged. {GAP}" in found.text
    assert found.left == (NotCompared("", "scans 40 to 49 are lost"),)


@pytest.mark.parametrize("scan", [20, 60])
def test_a_difference_on_either_side_of_a_gap_is_found(damaged: Path, tmp_path: Path, scan: int) -> None:
    other = begun(tmp_path / "other")
    for entry in whole().journal:
        if entry.scan >= SCANS // 2:
            break
        advance(other, entry.scan - other.live_scan)
        value = "1000" if entry.scan > scan else entry.command.value  # type: ignore[attr-defined]
        assert isinstance(other.submit(Write("Ada", "Main.other", value)), Entry)
    advance(other, 2)
    found = compared(damaged, other.recording.path)
    first = next(entry.scan for entry in whole().journal if entry.scan > scan)
    assert (found.scan, found.cause) == (first, "command")
    assert found.marks[0][0] == first
    assert found.marks[-1][1] == found.last
    assert "Not all was compared" in found.text


def test_what_differs_after_a_gap_alone_did_not_begin_so(damaged: Path, tmp_path: Path) -> None:
    other = begun(tmp_path / "other")
    for entry in whole().journal:
        if entry.scan >= SCANS // 2:
            break
        advance(other, entry.scan - other.live_scan)
        value = "7" if entry.scan == 45 else entry.command.value  # type: ignore[attr-defined]
        assert isinstance(other.submit(Write("Ada", "Main.other", value)), Entry)
    found = compared(damaged, other.recording.path)
    assert (found.scan, found.cause) == (50, "")
    assert "they are different where they can be compared again, before scan 50: Main.other is" in found.text


def test_a_campaign_does_not_cross_a_gap(damaged: Path, tmp_path: Path) -> None:
    programs = SourcePrograms({1: COUNTER, 2: SECOND}, NativeEngine)
    bench = Bench(tmp_path, ENTRIES, programs, programs, DisturbanceSchedule)
    with reading(damaged) as reader:
        for first, last, window in ((30, 60, 5), (20, 30, 10), (45, 55, 0)):
            with pytest.raises(BadCampaign, match=GAP):
                Trials(reader, CampaignWanted(count=1, first=first, last=last, window=window), bench)
        Trials(reader, CampaignWanted(count=1, first=20, last=30, window=9), bench)
        Trials(reader, CampaignWanted(count=1, first=50, last=60, window=9), bench)


def test_a_campaign_is_about_one_program(tmp_path: Path) -> None:
    """The second takes over before scan 80."""
    path = tmp_path / "whole"
    path.write_bytes(whole().data)
    programs = SourcePrograms({1: COUNTER, 2: SECOND}, NativeEngine)
    bench = Bench(tmp_path, ENTRIES, programs, programs, DisturbanceSchedule)
    alarms = ("Main.other > 1000",)
    with reading(path) as reader:
        for first, last, window in ((70, 90, 5), (60, 70, 10)):
            with pytest.raises(BadCampaign, match="the program was changed before scan 80"):
                Trials(reader, CampaignWanted(count=1, first=first, last=last, window=window, alarms=alarms), bench)
        for first, last, window in ((60, 70, 9), (80, 90, 5)):
            Trials(reader, CampaignWanted(count=1, first=first, last=last, window=window, alarms=alarms), bench)


def test_a_scenario_does_not_cross_a_gap(damaged: Path) -> None:
    with reading(damaged) as reader:
        assert scenario_of(reader, 39).steps
        with pytest.raises(Unreadable, match=f"not all that was entered before scan 60 is known.*{GAP}"):
            scenario_of(reader, 60)
