"""Disturbed runs as they live in a host: any scan is found again, a killed run goes on just so, a debugger may halt in them."""

import shutil
from collections.abc import Mapping
from pathlib import Path

import pytest

from scanbench.engines.debug import Listen
from scanbench.engines.engine import Reason
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.faults.detect import Detection
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import DISTURBED, Disturb
from scanbench.faults.disturb.fire import Corrupt
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.faults.schedule import Schedule
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.replay_file import replay_file
from scanbench.recording.timeline import Timeline
from scanbench.runtime.inside import HaltAt
from scanbench.runtime.joined import Joined
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.runtime.bench import ENGINES, program, value

SOURCE = """VAR_GLOBAL word AT CIO1 : WORD; END_VAR
PROGRAM Main VAR n : DINT; list : ARRAY[0..63] OF WORD; x, y : INT; END_VAR
  list[n MOD 64] := word;
  x := x + 1;
  y := x;
  n := n + 1;
END_PROGRAM"""
ON = pytest.mark.parametrize("engine", ENGINES, ids=("reference", "native"))


class One:
    """The one program of these runs."""

    def __init__(self, engine: EngineFactory) -> None:
        self._loaded = Loaded.make(program(SOURCE), engine)

    def get(self, version: int) -> Loaded:
        return self._loaded


def agenda() -> Joined:
    return Joined(Schedule(observed_engine), DisturbanceSchedule())


def begun(path: Path, engine: EngineFactory) -> Timeline:
    return Timeline.begin(path, One(engine), 1, b"", ENTRIES, "Ada", Detection(), agenda=agenda())


def resumed(path: Path, until: int, engine: EngineFactory) -> Timeline:
    def programs_of(kept: Mapping[int, KeptProgram]) -> One:
        return One(engine)

    return Timeline.resume(path, programs_of, ENTRIES, until, Detection(), agenda=agenda())


def define(timeline: Timeline) -> None:
    for wanted in (
        Disturbance("flip", "Main.list[7]", probability=0.2, seed=1), Disturbance("late", scan=5, scans=4),
        Disturbance("stuck", "word", scan=14, scans=9), Disturbance("result", bit=3, site="main.st:4", probability=0.3, seed=2),
        Disturbance("result", bit=5, site="main.st:6", scan=12),
    ):  # fmt: skip
        timeline.submit(Disturb("Ada", wanted))


def advance(timeline: Timeline, until: int, states: dict[int, bytes]) -> None:
    """Runs to a scan, in runs of varying lengths; `states` gets the state before each scan at which a run ends."""
    while timeline.live_scan < until:
        if timeline.live_scan % 3 == 0:
            timeline.submit(Write("Bob", "word", str(timeline.live_scan)))
        states[timeline.live_scan] = timeline.resource.state
        timeline.run(min(until, timeline.live_scan - timeline.live_scan % 3 + 3) - timeline.live_scan)
        states[timeline.live_scan] = timeline.resource.state


@ON
def test_every_scan_is_found_again_and_a_killed_run_goes_on(tmp_path: Path, engine: EngineFactory) -> None:
    states: dict[int, bytes] = {}
    timeline = begun(tmp_path / "run", engine)
    define(timeline)
    advance(timeline, 18, states)  # an input is held, and other things are to come
    shutil.copy(tmp_path / "run", tmp_path / "killed")
    killed = timeline.resource.state
    advance(timeline, 40, states)
    entries = [(each.scan, each.step, each.command, each.plan) for each in timeline.live_journal]
    for scan in (6, 9, 12, 13, 15, 18, 24, 39):
        if scan in states:
            assert timeline.goto(scan) is None
            assert timeline.resource.state == states[scan]
    timeline.return_live()
    assert timeline.resource.state == states[40]
    timeline.close()
    assert replay_file(tmp_path / "run", lambda kept: One(ENGINES[0]), ENTRIES).scan == 40

    other: dict[int, bytes] = {}
    again = resumed(tmp_path / "killed", 18, engine)
    assert again.resource.state == killed
    advance(again, 40, other)
    assert other == {scan: state for scan, state in states.items() if scan >= 18}
    assert [(each.scan, each.step, each.command, each.plan) for each in again.live_journal] == entries
    again.close()


@ON
@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_a_debugger_that_halts_in_the_scan_changes_nothing(tmp_path: Path, engine: EngineFactory, count: int) -> None:
    undisturbed = begun(tmp_path / "one", engine)
    halted = begun(tmp_path / "two", engine)
    for timeline in (undisturbed, halted):
        timeline.submit(Disturb("Ada", Disturbance("result", bit=3, site="main.st:4", scan=2)))
        while timeline.live_scan < 2:
            timeline.run(1)
    resource = halted.resource
    resource.listening.attach(HaltAt(count), Listen(count=count))
    assert halted.run(1).reason is Reason.HALTED
    assert value(resource, "Main.x") == (2 if count <= 2 else 3 ^ 8)
    assert bool(resource.journal.derived(DISTURBED)) == (count <= 2)
    resource.listening.attach(None)
    for timeline in (undisturbed, halted):
        while timeline.live_scan < 5:
            timeline.run(1)
    assert halted.resource.state == undisturbed.resource.state
    assert sum(isinstance(each.command, Corrupt) for each in halted.live_journal) == 1
    assert value(halted.resource, "Main.y") == (3 ^ 8) + 2
    undisturbed.close()
    halted.close()
