"""Campaigns: the same seed tries the same, who noticed what is right, and what stops a program is found where it happened."""

from collections import Counter
from pathlib import Path

import pytest

from scanbench.engines.available import flavours
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.faults.agenda import agenda_of_faults
from scanbench.faults.arm import Arm, Disarm
from scanbench.faults.disturb.definition import FOR_EVER, Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.reference import ErrorRef
from scanbench.faults.schedule import Schedule
from scanbench.faults.shapes import Wanted
from scanbench.history.bench import Bench
from scanbench.history.campaign.contract import BadCampaign, Campaign, CampaignWanted, Trial
from scanbench.history.campaign.plan import planned
from scanbench.history.campaign.trials import Trials, run_campaign
from scanbench.program.program import Program
from scanbench.recording.programs import cached, on, programs_of
from scanbench.recording.reader import RunReader
from scanbench.reports.campaign_report import trial_text
from scanbench.runtime.command import Command
from scanbench.runtime.forces import Force
from scanbench.runtime.write import Write
from scanbench.verify.contract import Range
from scanbench.verify.run_subject import RunSubject
from scanbench.verify.verifier import Verifier
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount, nightly, slow
from tests.runtime.bench import program
from tests.verify.verified_runs import record

SOURCE = """
VAR_GLOBAL start AT CIO0.00 : BOOL; lamp AT CIO100.00 : BOOL; level AT CIO101 : INT; END_VAR
PROGRAM Main
VAR ix : INT; list : ARRAY[0..9] OF INT; one : INT := 1; q : INT; twice, half : INT; alarm : BOOL; spare : LINT;
  limited : INT(0..100); text : STRING[10]; END_VAR
  ix := (ix + 1) MOD 10;
  list[ix] := list[ix] + 1;
  q := 1000 / one;
  limited := list[3] MOD 100;
  half := list[5];
  twice := 2 * half;
  IF twice <> 2 * half THEN
    alarm := TRUE;
  END_IF;
  lamp := start AND NOT alarm;
  level := level + 1;
END_PROGRAM
"""
LINES = {text.strip(): number for number, text in enumerate(SOURCE.splitlines(), 1)}
MAKE = on(flavours())


def bench(folder: Path, checked: Program) -> Bench:
    programs = cached({1: checked}, MAKE), cached({1: checked}, MAKE)
    return Bench(folder, ENTRIES, *programs, lambda: agenda_of_faults(ObservedBuilds().engine))


def reading(folder: Path, scans: int = 200) -> RunReader:
    commands = [(scan, Write("Ada", "start", "TRUE" if scan % 2 else "FALSE")) for scan in range(5, scans, 7)]
    (folder / "base.run").unlink(missing_ok=True)
    path = record(folder / "base.run", program(SOURCE), scans, commands, engine=NativeEngine)
    reader = RunReader(path, programs_of(lambda kept: program(SOURCE), MAKE), ENTRIES)
    reader.follow()
    return reader


def tried(folder: Path, wanted: CampaignWanted) -> Campaign:
    with reading(folder) as reader:
        return run_campaign(reader, wanted, bench(folder, program(SOURCE)))


@slow
def test_the_same_seed_tries_the_same(tmp_path: Path) -> None:
    wanted = CampaignWanted(seed=5, count=30, first=10, last=150, window=20)
    one = tried(tmp_path, wanted)
    with reading(tmp_path) as reader:
        again = run_campaign(reader, wanted, bench(tmp_path, program(SOURCE)), only=(7, 3))
    assert again.trials == (one.trials[6], one.trials[2])
    assert planned(program(SOURCE), wanted) != planned(program(SOURCE), CampaignWanted(6, 30, 10, 150, 20))


@nightly
def test_who_noticed_what(tmp_path: Path) -> None:
    wanted = CampaignWanted(seed=2, count=amount(400, 60), first=10, last=150, window=20, alarms=("Main.alarm",))
    found = tried(tmp_path, wanted)
    by = Counter(each.outcome for each in found.trials)
    assert by["verification"], by
    assert by["both"], by
    for each in found.trials:
        if (
            each.kind in ("flip", "result")
            and each.outcome != "missed"
            and (each.differs or each.output_scan is not None)
        ):
            assert each.verification, each
        if each.outcome == "no effect":
            assert (each.output_scan, each.differs, each.program, each.verification) == (None, False, (), ""), each
        if each.trapped:
            assert any("run-time error at main.st:" in text for text in each.program), each
    alarmed = [each for each in found.trials if "`Main.alarm` held" in each.program]
    assert all(each.program_scan is not None and each.program_scan >= each.scan for each in alarmed)
    assert alarmed, "a wrong sum is seen by the program itself"


def test_an_alarm_without_a_value_noticed_nothing_and_is_told(tmp_path: Path) -> None:
    alarms = ("10 / Main.spare = 3", "Main.alarm")
    with reading(tmp_path) as reader:
        wanted = CampaignWanted(seed=2, count=1, first=10, last=150, window=3, kinds=("stuck",), alarms=alarms)
        trial = Trials(reader, wanted, bench(tmp_path, program(SOURCE))).trial(1)
    assert trial.program == ()
    (told,) = trial.unvalued
    assert told.startswith(
        f"after scan {trial.scan} `10 / Main.spare = 3` has no value (an index is outside, a divisor"
    )
    assert f"  no value      {told}" in trial_text(trial)


def one_of(trials: Trials, wanted: str) -> Trial:
    for number, each in enumerate(trials.disturbances, 1):
        if each.site == wanted or each.path == wanted:
            return trials.trial(number)
    raise AssertionError(f"nothing disturbs {wanted}")


def test_an_output_that_is_wrong_is_silent_where_the_program_says_nothing(tmp_path: Path) -> None:
    wanted = CampaignWanted(seed=3, count=80, first=10, last=150, window=20, alarms=("Main.alarm",))
    with reading(tmp_path) as reader:
        trials = Trials(reader, wanted, bench(tmp_path, program(SOURCE)))
        found = one_of(trials, f"main.st:{LINES['level := level + 1;']}")
    assert (found.silent, found.output_scan, found.outcome) == (True, found.scan, "verification")
    assert found.place is not None
    assert found.place.line == LINES["level := level + 1;"]


def test_what_cannot_be_tried_is_refused(tmp_path: Path) -> None:
    for wanted, message in (
        (CampaignWanted(count=0, last=10), "number of disturbances is 0"),
        (CampaignWanted(first=10, last=500), "scans 10 to 500 cannot be disturbed: the run has scans 0 to 199"),
        (CampaignWanted(last=10, alarms=("Main.nowhere",)), "nowhere"),
        (CampaignWanted(last=10, kinds=()), "no kind"),
    ):
        with pytest.raises(BadCampaign, match=message):
            tried(tmp_path, wanted)


@nightly
def test_what_stops_the_program_is_found_in_its_scan_and_at_its_statement(tmp_path: Path) -> None:
    """A thousand that end in a run-time error, in the nightly run."""
    stopped, seed = 0, 0
    with reading(tmp_path) as reader:
        while stopped < amount(1000, 8):
            seed += 1
            wanted = CampaignWanted(seed, 100, 10, 150, 15, ("result", "flip"))
            trials = Trials(reader, wanted, bench(tmp_path, program(SOURCE)))
            for number, each in enumerate(trials.disturbances, 1):
                if (
                    each.path not in ("Main.one", "Main.ix")
                    and each.site != f"main.st:{LINES['ix := (ix + 1) MOD 10;']}"
                ):
                    continue
                found = trials.trial(number)
                if found.trapped:
                    stopped += 1
                    assert_found(trials, found)


def harmless(folder: Path, wanted: CampaignWanted, *commands: tuple[int, Command]) -> tuple[Trial, ...]:
    """Of a run in which the input stays as it is."""
    path = record(
        folder / "base.run",
        program(SOURCE),
        120,
        commands,
        engine=NativeEngine,
        agenda=Schedule(ObservedBuilds().engine),
    )
    with RunReader(path, programs_of(lambda kept: program(SOURCE), MAKE), ENTRIES) as reader:
        reader.follow()
        return run_campaign(reader, wanted, bench(folder, program(SOURCE))).trials


def test_what_was_armed_is_taken_back_under_the_number_of_now(tmp_path: Path) -> None:
    armed = Arm("Ada", Wanted((ErrorRef("battery-error"),)))
    wanted = CampaignWanted(seed=1, count=8, first=10, last=15, window=60, kinds=("stuck", "late"))
    found = harmless(tmp_path, wanted, (20, armed), (40, Disarm("Ada", (1,))))
    assert [(each.outcome, each.refused) for each in found] == 8 * [("no effect", ())]


def test_what_is_refused_because_of_the_disturbance_is_told(tmp_path: Path) -> None:
    wanted = CampaignWanted(seed=1, count=4, first=39, last=39, window=40, kinds=("stuck",))
    found = harmless(tmp_path, wanted, (40, Force("Ada", "start", "TRUE")))
    refused = {each.refused for each in found}
    assert refused == {("before scan 40: Force by Ada: start is held by disturbance 1: take that back first",)}


def test_an_input_that_is_still_held_at_the_end_of_the_window_is_no_difference(tmp_path: Path) -> None:
    wanted = CampaignWanted(seed=1, count=12, first=10, last=60, window=1, kinds=("stuck", "late"))
    assert [(each.outcome, each.differs) for each in harmless(tmp_path, wanted)] == 12 * [("no effect", False)]


def assert_found(trials: Trials, found: Trial) -> None:
    assert found.verified_scan == found.scan, found
    (stop,) = (each for each in found.program if each.startswith("run-time error"))
    place = stop.removeprefix("run-time error at main.st:").partition(":")[0]
    assert found.program_scan is not None
    reader = RunReader(trials.file, programs_of(lambda kept: program(SOURCE), MAKE), ENTRIES)
    with Verifier(RunSubject(reader)) as verifier:
        verifier.begin(Range())
        rows = verifier.verify(found.program_scan).rows
    told = [row.note for row in rows] + [each.message for row in rows for each in row.differences]
    assert any("run-time error" in text and f"main.st:{place}" in text for text in told), (found, told)


ADD = f"main.st:{LINES['level := level + 1;']}"


@pytest.mark.parametrize(
    "before",
    [
        ((20, Disturbance("flip", "Main.spare", 3)),),
        ((20, Disturbance("stuck", "start", scans=FOR_EVER)),),
        ((20, Disturbance("flip", "Main.spare", probability=0.5)),),
        ((20, Disturbance("result", site=ADD, bit=3, scan=50)),),
        ((50, Disturbance("flip", "Main.spare", 3)), (60, Disturbance("flip", "Main.spare", 4))),
    ],
)
def test_disturbances_of_the_run_itself_are_left_out(
    before: tuple[tuple[int, Disturbance], ...], tmp_path: Path
) -> None:
    """Long over, under way, in the first scan of the stretch, and in the middle of it."""
    path = record(
        tmp_path / "base.run", program(SOURCE), 120, [(scan, Disturb("Ada", each)) for scan, each in before],
        engine=NativeEngine, agenda=agenda_of_faults(ObservedBuilds().engine),
    )  # fmt: skip
    wanted = CampaignWanted(seed=3, count=5, first=50, last=52, window=10, kinds=("flip",))
    with RunReader(path, programs_of(lambda kept: program(SOURCE), MAKE), ENTRIES) as reader:
        reader.follow()
        found = run_campaign(reader, wanted, bench(tmp_path, program(SOURCE))).trials
    (tmp_path / "base.run").unlink()
    undisturbed = harmless(tmp_path, wanted)
    assert [each.outcome for each in found] == [each.outcome for each in undisturbed]
    assert [each.verified_scan for each in found] == [each.verified_scan for each in undisturbed]
    assert any(each.verified_scan == each.scan for each in found)
