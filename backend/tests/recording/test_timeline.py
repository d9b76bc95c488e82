"""Any scan of a recorded run can be shown again, byte for byte, and gone on from."""

import tempfile
from dataclasses import dataclass
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.engine import Reason, Stop
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.detect import Detection
from scanbench.faults.inject import Recover
from scanbench.recording import checkpoints, recording
from scanbench.recording.moment import Moment
from scanbench.recording.replay import Diverged
from scanbench.recording.replay_file import replay_file
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.forces import FORCED, Force, Release
from scanbench.runtime.inside import Inside
from scanbench.runtime.journal import Journal
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import UnknownPath
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount
from tests.recording.recorded import (
    COUNTER,
    SECOND,
    THIRD,
    SourcePrograms,
    advance,
    begun,
    of_file,
    of_file_native,
    resumed,
    spare,
    tidy,
    to_program,
)
from tests.runtime.bench import value


@dataclass(frozen=True)
class Change:
    """To another program."""

    version: int
    source: str


COMMANDS: list[Command | Change] = [
    Write("Ada", "Main.n", "7"),
    Write("Ada", "Main.d", "-3"),
    Write("Ada", "Main.d", "0"),  # it traps in the next scan
    Write("Ada", "CIO 0.00", "TRUE"),
    Write("Ada", "D100", "4711"),
    Force("Bob", "Main.other", "5"),
    Force("Bob", "CIO 100.00", "TRUE"),
    Release("Bob", None),
    SetMode("Bob", "PROGRAM"),
    SetMode("Bob", "MONITOR"),
    SetMode("Bob", "RUN"),
    Restart("Bob", "cold"),
    Restart("Bob", "warm"),
    Restart("Bob", "power"),
    Change(1, COUNTER),
    Change(2, SECOND),
    Change(3, THIRD),
]
STEPS = st.lists(st.tuples(st.integers(0, 12), st.sampled_from(COMMANDS)), min_size=1, max_size=25)


def _live(timeline: Timeline, steps: list[tuple[int, Command | Change]]) -> dict[int, bytes]:
    """Runs it, and keeps the state in which each scan began."""
    states = {0: timeline.resource.state}
    for scans, command in [*steps, (3, Release("Ada", None))]:
        for _ in range(scans):
            advance(timeline, 1)
            states[timeline.live_scan] = timeline.resource.state
        if isinstance(command, Change):
            to_program(timeline, command.version, command.source)
        else:
            timeline.submit(command)
        states[timeline.live_scan] = timeline.resource.state
    return states


@pytest.mark.parametrize("engine", [ReferenceEngine, NativeEngine])
@settings(max_examples=amount(50, 8), deadline=None)
@given(steps=STEPS, every=st.sampled_from([0, 100_000, 10**12]), data=st.data())
def test_goto_any_scan_equals_what_was_recorded_live(
    engine: type[ReferenceEngine] | type[NativeEngine], steps: list[tuple[int, Command | Change]], every: int,
    data: st.DataObject,
) -> None:  # fmt: skip
    with tempfile.TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr(checkpoints, "EVERY_NS", every)
        path = Path(folder, "run")
        timeline = Timeline.begin(path, spare(engine), 1, COUNTER.encode(), ENTRIES, "Ada")
        states = _live(timeline, steps)
        end = timeline.live_scan
        gone = data.draw(st.lists(st.sampled_from(sorted(states)), min_size=1, max_size=8))
        for scan in gone:
            assert timeline.goto(scan) is None
            assert timeline.past
            assert timeline.resource.state == states[scan]
            assert timeline.live_scan == end
        branch = data.draw(st.sampled_from(sorted(states)))
        answers: list[Refusal | None] = []
        timeline.copy(Path(folder, "branch"), branch, "Bob", answers.append)
        timeline.recording.wait()
        assert answers == [None]
        assert timeline.resource.state == states[gone[-1]]
        timeline.return_live()
        assert timeline.resource.state == states[end]
        timeline.close()

        other = resumed(Path(folder, "branch"))
        assert (other.live_scan, other.resource.state) == (branch, states[branch])
        other.submit(Write("Bob", "Main.n", "1"))
        other.close()

        again = resumed(path)
        assert again.resource.state == states[end]
        for scan in gone:
            assert again.goto(scan) is None
            assert again.resource.state == states[scan]
        again.close()


def test_the_past_shows_what_held_then_and_takes_no_command(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run")
    advance(timeline, 10)
    timeline.submit(Force("Ada", "Main.other", "5"))
    advance(timeline, 10)
    assert timeline.goto(5) is None
    assert value(timeline.resource, "Main.n") == 5
    assert timeline.resource.journal.derived(FORCED) == {}
    assert len(timeline.live_journal) == 1
    refused = timeline.submit(Write("Ada", "Main.n", "1"))
    assert isinstance(refused, Refusal)
    assert "branch" in refused.message
    with pytest.raises(RuntimeError):
        timeline.run(1)
    for scan in (6, 7):
        assert timeline.step() is None
        assert timeline.resource.header.scan == scan == value(timeline.resource, "Main.n")
    assert timeline.step(1000) is None
    assert timeline.resource.header.scan == 20
    assert isinstance(timeline.step(), Refusal)
    assert isinstance(timeline.goto(21), Refusal)
    assert timeline.resource.header.scan == 20
    timeline.return_live()
    assert not timeline.past
    advance(timeline, 1)
    assert (timeline.live_scan, value(timeline.resource, "Main.n")) == (21, 21)
    timeline.close()


def test_a_killed_run_goes_on_at_the_scan_that_was_reported(tmp_path: Path) -> None:
    path = tmp_path / "run"
    timeline = begun(path)
    advance(timeline, 100)
    timeline.submit(Write("Ada", "Main.d", "2"))
    timeline.note()
    advance(timeline, 200)
    expected = timeline.resource.state
    (tmp_path / "killed").write_bytes(path.read_bytes())  # as a kill leaves it: no mark of the last scans
    again = resumed(tmp_path / "killed", until=300)
    assert again.live_scan == 300
    assert again.resource.state == expected
    assert [entry.scan for entry in again.new_entries()] == [100]
    assert again.new_entries() == []
    again.close()
    timeline.close()
    assert resumed(path).live_scan == 300


def test_a_program_that_comes_out_otherwise_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "run"
    begun(path).close()
    with pytest.raises(Exception, match="does not come out as it was"):
        Timeline.resume(path, lambda kept: spare(ReferenceEngine).__class__({1: SECOND}), ENTRIES)


def test_a_run_of_millions_of_scans_is_gone_back_in(tmp_path: Path) -> None:
    path = tmp_path / "run"
    timeline = begun(path, engine=NativeEngine)
    advance(timeline, 500_000)
    timeline.submit(Write("Ada", "Main.n", "0"))
    advance(timeline, 500_000)
    state = timeline.resource.state
    assert timeline.goto(500_001) is None
    assert value(timeline.resource, "Main.n") == 1
    assert timeline.goto(499_999) is None
    assert value(timeline.resource, "Main.n") == 499_999
    timeline.close()
    assert Timeline.resume(path, of_file_native, ENTRIES).resource.state == state


ASKING = """
PROGRAM Main
VAR n : DINT; stop : BOOL; END_VAR
  n := n + 1;
  IF n MOD 10 = 3 THEN FAL(N := n MOD 5 + 1); END_IF;
  IF n MOD 10 = 7 THEN FAL(N := 0); END_IF;
  IF stop THEN FALS(N := 9); END_IF;
END_PROGRAM
"""


@pytest.mark.parametrize("engine", [ReferenceEngine, NativeEngine])
def test_what_the_program_asked_for_is_gone_back_across(
    engine: type[ReferenceEngine] | type[NativeEngine], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 100_000)
    path = tmp_path / "run"
    programs = SourcePrograms({1: ASKING}, engine)
    timeline = Timeline.begin(path, programs, 1, ASKING.encode(), ENTRIES, "Ada", Detection())
    states: dict[int, bytes] = {}
    for _ in range(60):
        if timeline.live_scan == 40 and timeline.resource.trap is None and value(timeline.resource, "Main.n") == 40:
            timeline.submit(Write("Ada", "Main.stop", "TRUE"))
        elif timeline.resource.trap is not None:
            for command in (Write("Ada", "Main.stop", "FALSE"), Recover("Ada", None), SetMode("Ada", "MONITOR")):
                assert not isinstance(timeline.submit(command), Refusal)
        states[timeline.live_scan] = timeline.resource.state
        advance(timeline, 1)
        states[timeline.live_scan] = timeline.resource.state
    names = [type(entry.command).__name__ for entry in timeline.live_journal]
    assert names.count("Generate") == 7
    assert names.count("Trapped") == 1
    for scan, state in states.items():
        assert timeline.goto(scan) is None
        assert timeline.resource.state == state
    timeline.return_live()
    timeline.close()
    again = Timeline.resume(path, of_file, ENTRIES, 0, Detection())
    assert again.resource.state == states[again.live_scan]
    assert [type(entry.command).__name__ for entry in again.live_journal] == names
    again.close()
    assert replay_file(path, of_file_native, ENTRIES).scan == again.live_scan


def test_the_oldest_part_may_go_while_the_past_is_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    monkeypatch.setattr(recording, "DELTAS", 7)
    timeline = begun(tmp_path / "run")
    states: dict[int, bytes] = {}
    timeline.submit(Force("Ada", "Main.other", "5"))
    for scan in range(300):
        for word in range(8):
            timeline.submit(Write("Ada", f"D{(scan * 8 + word) % 3000}", str(scan * 7919 % 32768)))
        states[scan] = timeline.resource.state
        timeline.run(1)
    assert len(timeline.new_entries()) == 2401
    state, size = timeline.resource.state, timeline.recording.info.bytes
    assert timeline.goto(250) is None
    timeline.recording.bounds.set_limit(size // 2)
    tidy(timeline)
    info = timeline.recording.info
    assert 0 < info.dropped_before <= info.first_scan < 250
    assert info.bytes < size // 2
    assert timeline.resource.state == states[250]
    answers: list[Refusal | None] = []
    timeline.copy(tmp_path / "branch", 240, "Bob", answers.append)
    timeline.recording.wait()
    assert answers == [None]
    branch = resumed(tmp_path / "branch")
    assert branch.resource.state == states[240]
    branch.close()
    assert timeline.step() is None
    assert timeline.resource.state == states[251]
    assert timeline.goto(info.first_scan) is None
    assert timeline.resource.state == states[info.first_scan]
    assert isinstance(timeline.goto(info.first_scan - 1), Refusal)
    timeline.return_live()
    assert timeline.resource.state == state
    assert timeline.new_entries() == []
    assert len(timeline.live_journal) < 2401
    assert timeline.resource.journal.derived(FORCED).keys() == {"MAIN.OTHER"}
    timeline.close()


def test_what_is_live_is_known_while_the_past_is_shown_and_never_built_again(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run")
    advance(timeline, 10)
    assert not to_program(timeline, 2, SECOND)
    advance(timeline, 10)
    live, state = timeline.live, timeline.resource.state
    assert (live.version, live) == (2, timeline.resource.loaded)
    assert timeline.goto(5) is None
    assert timeline.resource.version == 1
    assert (timeline.live, timeline.live.version) == (live, 2)
    programs = timeline.programs
    assert isinstance(programs, SourcePrograms)
    programs.sources.clear()  # nothing can be built any more
    programs._loaded.clear()
    refused = timeline.goto(15)
    assert isinstance(refused, Refusal)
    assert "scan 15 cannot be shown" in refused.message
    assert timeline.resource.header.scan == 5
    assert timeline.past
    timeline.return_live()
    assert timeline.resource.loaded is live
    assert timeline.resource.state == state
    timeline.close()


def test_other_threads_never_take_the_past_for_what_is_live(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    timeline = begun(tmp_path / "run")
    advance(timeline, 10)
    assert not to_program(timeline, 2, SECOND)
    advance(timeline, 10)
    seen: list[int] = []
    restore = Resource.restore

    def watched(
        resource: Resource, loaded: Loaded, state: bytes, journal: Journal, inside: Inside | None = None
    ) -> None:
        seen.append(timeline.live.version)
        restore(resource, loaded, state, journal, inside)
        seen.append(timeline.live.version)

    monkeypatch.setattr(Resource, "restore", watched)
    assert timeline.goto(5) is None
    timeline.copy(tmp_path / "branch", 3, "Bob", lambda refusal: None)
    timeline.return_live()
    timeline.copy(tmp_path / "other", 3, "Bob", lambda refusal: None)
    assert len(seen) == 12
    assert set(seen) == {2}
    assert not timeline.past
    timeline.close()


@pytest.mark.parametrize("engine", [ReferenceEngine, NativeEngine])
def test_a_condition_holds_for_the_live_plc_whatever_happens(
    engine: type[ReferenceEngine] | type[NativeEngine], tmp_path: Path
) -> None:
    timeline = begun(tmp_path / "run", engine=engine)

    def until(text: str) -> None:
        condition = compile_condition(timeline.resource.program, text)
        assert isinstance(condition, Condition)
        timeline.resource.waiting.until = (condition,)

    def run() -> int:
        for _ in range(1000):
            if timeline.run(1000).reason is Reason.CONDITION:
                break
        return timeline.live_scan

    until("Main.n MOD 100 = 0")
    assert run() == 100
    assert timeline.goto(50) is None
    timeline.return_live()
    assert run() == 200
    assert isinstance(timeline.goto(10_000), Refusal)
    assert run() == 300
    timeline.copy(tmp_path / "copy", 150, "Bob", lambda refusal: None)
    assert run() == 400
    timeline.resource.loaded.engine = engine(
        timeline.resource.program, timeline.resource.memory
    )  # as optimised code comes
    assert run() == 500
    assert not to_program(timeline, 2, SECOND)
    timeline.submit(Write("Ada", "Main.n", "6"))
    scan, n = run(), value(timeline.resource, "Main.n")
    assert (scan, n) == (598, 300)
    timeline.resource.waiting.until = ()
    while timeline.live_scan < 898:  # a checkpoint may be due before
        timeline.run(898 - timeline.live_scan)
    until("Main.first = 1")
    assert not to_program(timeline, 1, COUNTER)
    assert timeline.resource.waiting.until == (), "there is no such variable in this program"
    timeline.close()


@pytest.mark.parametrize("engine", [ReferenceEngine, NativeEngine])
def test_a_condition_does_not_hold_up_the_way_into_the_past(
    engine: type[ReferenceEngine] | type[NativeEngine], tmp_path: Path
) -> None:
    timeline = begun(tmp_path / "run", engine=engine)
    condition = compile_condition(timeline.resource.program, "Main.n >= 0")
    assert isinstance(condition, Condition)
    timeline.resource.waiting.until = (condition,)
    assert timeline.run(10).reason is Reason.CONDITION
    assert timeline.live_scan == 1
    advance(timeline, 99)
    runs: list[int] = []
    rerun = Resource.rerun

    def counted(resource: Resource, scans: int) -> Stop:
        runs.append(scans)
        return rerun(resource, scans)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Resource, "rerun", counted)
        assert timeline.goto(90) is None
    assert len(runs) == 1  # from the last checkpoint in one go: how many are kept depends on the machine
    assert timeline.resource.header.scan == 90
    timeline.close()


def test_a_refused_step_leaves_what_was_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    timeline = begun(tmp_path / "run")
    for scan in range(20):
        timeline.submit(Write("Ada", "Main.other", str(scan)))
        advance(timeline, 1)
    assert timeline.goto(10) is None
    state, entries = timeline.resource.state, len(timeline.resource.journal)

    def broken(resource: Resource, entry: Entry) -> None:
        if entry.scan == 15:
            raise Diverged("as it happens")
        Resource._apply(resource, entry)

    with monkeypatch.context() as patch:
        patch.setattr(Resource, "reenter", broken)
        refused = timeline.step(8)
    assert isinstance(refused, Refusal)
    assert "as it happens" in refused.message
    assert (timeline.resource.state, len(timeline.resource.journal)) == (state, entries)
    assert timeline.step(8) is None
    assert value(timeline.resource, "Main.other") == 18
    timeline.close()


@pytest.mark.parametrize("past", [False, True])
def test_a_look_that_goes_wrong_leaves_what_was_shown(tmp_path: Path, past: bool) -> None:
    timeline = begun(tmp_path / "run")
    advance(timeline, 20)
    if past:
        assert timeline.goto(10) is None
    shown = Moment.of(timeline.resource)

    def unknown() -> None:
        raise UnknownPath("nobody")

    def diverged() -> None:
        raise Diverged("as it happens")

    with pytest.raises(UnknownPath):
        timeline.look_at(4, unknown)
    refused = [timeline.look_at(4, diverged)]
    if not past:
        refused.append(timeline.look_at(20, diverged, shown))
    for each in refused:
        assert isinstance(each, Refusal)
        assert "cannot be shown: as it happens" in each.message
    assert (timeline.past, timeline.live_scan) == (past, 20)
    assert (timeline.resource.header.scan, timeline.resource.state) == (shown.scan, shown.state)
    timeline.return_live()
    advance(timeline, 1)
    assert timeline.live_scan == 21
    timeline.close()
