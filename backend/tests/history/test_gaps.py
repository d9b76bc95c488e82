"""What is not told of a run whose file lost commands."""

from pathlib import Path

import pytest

from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.history.bench import Bench
from scanbench.history.campaign.contract import BadCampaign, CampaignWanted
from scanbench.history.campaign.trials import Trials
from scanbench.history.changes import find_changes
from scanbench.history.divergence import find_divergence
from scanbench.history.scenario_of_run import scenario_of
from scanbench.history.writer import find_writer
from scanbench.recording.format import Kind
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.wire.codec import ENTRIES
from tests.recording.damage import SCANS, whole
from tests.recording.recorded import COUNTER, SECOND, SourcePrograms, of_file
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


def test_runs_are_compared_after_a_gap_only(damaged: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.write_bytes(whole().data)
    with reading(damaged) as one, reading(other) as two:
        found = find_divergence(one, two)
    assert found.scan is None
    assert f"the same in all {SCANS - 50} scans that both have, 50 to {SCANS - 1}" in found.text
    assert f"Nothing before scan 50 was compared: the run file is damaged. {GAP}" in found.text


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
