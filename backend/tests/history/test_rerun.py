"""A run once more, with one error another."""

from datetime import UTC, datetime
from pathlib import Path

import pytest

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.faults.arm import ARMED, Arm, Disarm
from scanbench.faults.detect import Detection
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.faults.schedule import Schedule
from scanbench.faults.shapes import Shape, Start, Wanted
from scanbench.history.contract import RerunChange
from scanbench.history.divergence import find_divergence
from scanbench.history.renumbered import Numbers
from scanbench.history.rerun import Rerun, rerun
from scanbench.recording.format import Kind, RunFile
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Command, Entry, Numbered, Plan, Refusal
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import SourcePrograms, advance, of_file
from tests.runtime.bench import value

BATTERY, SETUP = "battery-error", "plc-setup-error"
SOURCE = """
PROGRAM Main
VAR n, low, seen, d : INT; level : INT := 1; battery AT A402.04 : BOOL; setup AT A402.10 : BOOL; END_VAR
  n := n + 1;
  IF battery THEN low := low + 1; END_IF;
  IF setup THEN seen := seen + 1; END_IF;
  d := 100 / level;
END_PROGRAM
"""


def _begun(path: Path) -> Timeline:
    programs = SourcePrograms({1: SOURCE}, ReferenceEngine)
    return Timeline.begin(
        path, programs, 1, SOURCE.encode(), ENTRIES, "Ada", Detection(), agenda=Schedule(observed_engine)
    )


def _enter(timeline: Timeline, command: Command) -> None:
    outcome = timeline.submit(command)
    assert not isinstance(outcome, Refusal), outcome


def _again(timeline: Timeline, change: RerunChange) -> tuple[Rerun, Timeline]:
    path = timeline.recording.path.with_name("again")
    with RunReader(timeline.recording.path, of_file, ENTRIES) as reading:
        reading.follow(timeline.live_scan)
        made = rerun(reading, path, change, "Bob", of_file, ENTRIES, Schedule(observed_engine))
    return made, Timeline.resume(path, of_file, ENTRIES, 0, Detection(), agenda=Schedule(observed_engine))


def _with_an_error(folder: Path) -> Timeline:
    """Raised before scan 10, recovered before 15; something is written before 5, 12 and 20; 30 scans."""
    timeline = _begun(folder / "run")
    for scan, command in (
        (5, Write("Ada", "Main.level", "2")),
        (10, Generate("Ada", (ErrorRef(BATTERY),))),
        (12, Write("Ada", "Main.level", "4")),
        (15, Recover("Cleo", (BATTERY,))),
        (20, Write("Ada", "Main.level", "5")),
    ):
        advance(timeline, scan - timeline.live_scan)
        _enter(timeline, command)
    advance(timeline, 30 - timeline.live_scan)
    assert value(timeline.resource, "Main.low") == 5
    return timeline


def _when(timeline: Timeline) -> list[tuple[int, str, str]]:
    return [(each.scan, type(each.command).__name__, each.command.author) for each in timeline.live_journal]


@pytest.mark.parametrize("by", [-7, -1, 1, 3, 9])
def test_the_same_error_earlier_or_later(by: int, tmp_path: Path) -> None:
    timeline = _with_an_error(tmp_path)
    made, again = _again(timeline, RerunChange(10, BATTERY, by))
    assert made == Rerun(30, ())
    assert (again.live_scan, value(again.resource, "Main.low")) == (30, 5), "its recovery moves with it"
    assert sorted(_when(again)) == sorted(
        [
            (5, "Write", "Ada"),
            (10 + by, "Generate", "Ada"),
            (12, "Write", "Ada"),
            (15 + by, "Recover", "Cleo"),
            (20, "Write", "Ada"),
        ]
    )
    assert value(again.resource, "Main.d") == value(timeline.resource, "Main.d")
    with (
        RunReader(timeline.recording.path, of_file, ENTRIES) as one,
        RunReader(again.recording.path, of_file, ENTRIES) as two,
    ):
        one.follow(30)
        two.follow(30)
        assert find_divergence(one, two).scan == min(10, 10 + by)


def test_a_different_error_instead(tmp_path: Path) -> None:
    made, again = _again(_with_an_error(tmp_path), RerunChange(10, BATTERY, instead=SETUP))
    assert made.refused == ()
    assert (value(again.resource, "Main.low"), value(again.resource, "Main.seen")) == (0, 5)
    assert not again.resource.journal.derived(ACTIVE)


def test_it_is_left_out(tmp_path: Path) -> None:
    made, again = _again(_with_an_error(tmp_path), RerunChange(10, BATTERY, leave_out=True, scans_after=12))
    assert made == Rerun(42, ()), "nobody tries to recover it"
    assert (again.live_scan, value(again.resource, "Main.n"), value(again.resource, "Main.low")) == (42, 42, 0)
    assert [name for _, name, _ in _when(again)] == ["Write", "Write", "Write"]


def test_one_of_several(tmp_path: Path) -> None:
    timeline = _begun(tmp_path / "run")
    advance(timeline, 4)
    _enter(timeline, Generate("Ada", (ErrorRef(BATTERY), ErrorRef(SETUP))))
    advance(timeline, 4)
    _enter(timeline, Recover("Ada", (BATTERY, SETUP)))
    advance(timeline, 4)
    made, again = _again(timeline, RerunChange(4, BATTERY, leave_out=True))
    assert made.refused == ()
    assert (value(again.resource, "Main.low"), value(again.resource, "Main.seen")) == (0, 4)


def test_what_follows_is_planned_again(tmp_path: Path) -> None:
    """What cannot be entered this time is told."""
    timeline = _with_an_error(tmp_path)
    _enter(timeline, Generate("Ada", (ErrorRef(BATTERY),)))
    advance(timeline, 5)
    made, again = _again(timeline, RerunChange(10, BATTERY, by=25))
    assert len(made.refused) == 1
    assert "Generate by Ada" in made.refused[0], "it is raised already"
    assert "before scan 3" in made.refused[0]
    assert again.live_scan == 35


def test_a_gap_after_the_change_is_not_crossed(tmp_path: Path) -> None:
    """What was entered before scan 20 is lost, up to the state of scan 25."""
    timeline = _begun(tmp_path / "run")
    for scan in range(30):
        if scan == 10:
            _enter(timeline, Generate("Ada", (ErrorRef(BATTERY),)))
        if scan == 20:
            _enter(timeline, Write("Ada", "Main.level", "5"))
        if scan in (18, 25):
            timeline.recording.checkpoint(scan, timeline.resource.version, timeline.resource.state)
        advance(timeline, 1)
    timeline.close()
    path = tmp_path / "run"
    file = RunFile.open(path, read_only=True)
    last = [each for each in file.scan_blocks() if each.kind is Kind.ENTRY][-1]
    file.close()
    data = bytearray(path.read_bytes())
    data[last.payload_offset] ^= 4
    path.write_bytes(data)
    with RunReader(path, of_file, ENTRIES) as reading:
        reading.follow()
        with pytest.raises(Unreadable, match=r"not all that was entered from scan 10 on is known.*are lost"):
            rerun(reading, tmp_path / "again", RerunChange(10, BATTERY, leave_out=True), "Bob", of_file, ENTRIES)


def test_an_armed_fault_moves_as_a_whole(tmp_path: Path) -> None:
    timeline = _begun(tmp_path / "run")
    advance(timeline, 3)
    _enter(
        timeline, Arm("Ada", Wanted((ErrorRef(BATTERY),), Start("condition", condition="Main.n = 10"), Shape("for", 4)))
    )
    _enter(timeline, Arm("Ada", Wanted((ErrorRef(SETUP),), Start("scan", 25), Shape("intermittent", 1, 3))))
    advance(timeline, 27)
    _enter(timeline, Disarm("Ada", (2,)))
    advance(timeline, 10)
    raised = [each.scan for each in timeline.live_journal if isinstance(each.command, Generate)]
    assert raised[0] == 10
    for by in (-9, 5):
        made, again = _again(timeline, RerunChange(10, BATTERY, by))
        assert made.refused == ()
        moved = [each.scan for each in again.live_journal if isinstance(each.command, Generate)]
        assert moved == [10 + by, *raised[1:]]
        assert value(again.resource, "Main.low") == 4
        assert not again.resource.journal.derived(ARMED), "the other one is taken back by its new number"
        again.close()
        again.recording.path.unlink()


def test_a_run_time_error_ends_it(tmp_path: Path) -> None:
    timeline = _begun(tmp_path / "run")
    advance(timeline, 5)
    _enter(timeline, Generate("Ada", (ErrorRef("memory-error"),)))
    _enter(timeline, Write("Ada", "Main.level", "0"))
    _enter(timeline, Write("Ada", "Main.level", "3"))
    advance(timeline, 5)
    _enter(timeline, Write("Ada", "Main.level", "4"))
    advance(timeline, 5)
    assert timeline.live_scan == 15
    assert value(timeline.resource, "Main.n") == 5, "it has not run since"
    made, again = _again(timeline, RerunChange(5, "memory-error", leave_out=True))
    assert made == Rerun(15, ())
    assert value(again.resource, "Main.n") == 15


def test_the_new_run_is_one(tmp_path: Path) -> None:
    """It can be gone back in, gone on with, and says whose it is."""
    timeline = _with_an_error(tmp_path)
    state = timeline.resource.state
    _, again = _again(timeline, RerunChange(10, BATTERY, 3))
    assert again.recording.about.by == "Bob"
    assert again.goto(3) is None
    assert value(again.resource, "Main.n") == 3
    again.return_live()
    advance(again, 5)
    assert value(again.resource, "Main.n") == 35
    assert timeline.resource.state == state


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (RerunChange(10, SETUP, 1), "was not raised in this run at all"),
        (RerunChange(11, BATTERY, 1), "it was before scan 10"),
        (RerunChange(10, BATTERY), "nothing would change"),
        (RerunChange(10, BATTERY, 1, leave_out=True), "choose one"),
        (RerunChange(10, BATTERY, instead="batery-error"), "batery-error"),
        (RerunChange(10, BATTERY, -11), "scan -1 is not kept"),
    ],
)
def test_changes_that_are_refused(change: RerunChange, says: str, tmp_path: Path) -> None:
    timeline = _with_an_error(tmp_path)
    with pytest.raises(Unreadable, match=says):
        _again(timeline, change)
    assert not (tmp_path / "again").exists()


def test_what_the_plc_found_itself(tmp_path: Path) -> None:
    timeline = _begun(tmp_path / "run")
    _enter(timeline, Write("Ada", "Main.level", "0"))
    advance(timeline, 3)
    found = [each for each in timeline.live_journal if isinstance(each.command, Generate)]
    assert found
    assert isinstance(found[0], Entry)
    command = found[0].command
    assert isinstance(command, Generate)
    with pytest.raises(Unreadable, match="the PLC raised"):
        _again(timeline, RerunChange(found[0].scan, command.errors[0].id, 1))


def test_somebody_ends_it(tmp_path: Path) -> None:
    timeline = _with_an_error(tmp_path)

    class Enough(Exception):
        pass

    def on_progress(done: int, of: int) -> None:
        raise Enough

    path = tmp_path / "again"
    with RunReader(timeline.recording.path, of_file, ENTRIES) as reading:
        reading.follow(30)
        with pytest.raises(Enough):
            rerun(reading, path, RerunChange(10, BATTERY, 1), "Bob", of_file, ENTRIES, None, on_progress)
    assert not path.exists()


def test_what_takes_back_something_refused_takes_back_nothing_else() -> None:
    numbers = Numbers()
    plan = Plan((), "armed", Numbered(5))
    taken = Entry(3, datetime(2026, 1, 1, tzinfo=UTC), Arm("Ada", Wanted((ErrorRef(BATTERY),))), plan)
    numbers.note(2, taken)
    numbers.note(5, Refusal("it is present already"))
    assert numbers.renamed(Disarm("Ada", (2,))) == Disarm("Ada", (5,))
    assert numbers.renamed(Disarm("Ada", (2, 5))) == Disarm("Ada", (5,))
    assert numbers.renamed(Disarm("Ada", (5,))) == Refusal("what it takes back was refused this time: 5")
    assert numbers.renamed(Disarm("Ada", None)) == Disarm("Ada", None)
