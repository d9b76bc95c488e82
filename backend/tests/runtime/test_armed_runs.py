"""Recorded runs with faults that come by themselves: any scan can be gone back to, a killed run goes on just so, and so does a branch."""

import shutil
from collections.abc import Mapping
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.arm import ARMED
from scanbench.faults.detect import Detection
from scanbench.faults.schedule import Schedule
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Refusal
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount
from tests.runtime.bench import program
from tests.runtime.random_runs import ARMS, COMMANDS, SOURCE, Step

STEPS = st.lists(
    st.tuples(st.sampled_from([*ARMS, *ARMS, *(each for each in COMMANDS if not isinstance(each, ProgramChange))]), st.sampled_from([0, 1, 2, 7, 30])),
    min_size=1, max_size=12,
)  # fmt: skip


class One:
    """The one program of these runs."""

    def __init__(self, engine: EngineFactory) -> None:
        self._loaded = Loaded.make(program(SOURCE), engine)

    def get(self, version: int) -> Loaded:
        return self._loaded


def begun(path: Path, engine: EngineFactory) -> Timeline:
    return Timeline.begin(
        path, One(engine), 1, b"", ENTRIES, "Ada", Detection(), agenda=Schedule(observed_engine)
    )  # fmt: skip


def resumed(path: Path, until: int, engine: EngineFactory) -> Timeline:
    def programs_of(kept: Mapping[int, KeptProgram]) -> One:
        return One(engine)

    return Timeline.resume(path, programs_of, ENTRIES, until, Detection(), agenda=Schedule(observed_engine))


def lived(timeline: Timeline, steps: list[Step], states: dict[int, bytes]) -> None:
    """What happens; the state in which each scan begins."""
    resource = timeline.resource
    for command, scans in steps:
        timeline.submit(command)
        states[timeline.live_scan] = resource.state
        end = timeline.live_scan + scans
        while resource.runnable and timeline.live_scan < end:
            timeline.run(1)
            states[timeline.live_scan] = resource.state


@settings(
    max_examples=amount(60, 10),
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)
@given(steps=STEPS, data=st.data())
def test_whatever_is_armed_every_scan_is_found_again(
    tmp_path_factory: pytest.TempPathFactory, steps: list[Step], data: st.DataObject
) -> None:
    folder = tmp_path_factory.mktemp("run")
    engine, other = data.draw(st.permutations([ReferenceEngine, NativeEngine]))
    states: dict[int, bytes] = {}
    timeline = begun(folder / "run", engine)
    cut = data.draw(st.integers(0, len(steps)))
    lived(timeline, steps[:cut], states)
    until = timeline.live_scan
    shutil.copy(folder / "run", folder / "killed")  # what a killed process leaves
    later = dict(states)
    lived(timeline, steps[cut:], states)
    for scan in data.draw(st.lists(st.sampled_from(sorted(states)), max_size=6)) if states else []:
        refusal = timeline.goto(scan)
        assert not isinstance(refusal, Refusal)
        assert timeline.resource.state == states[scan]
    timeline.return_live()
    armed, entries = timeline.resource.journal.derived(ARMED), list(timeline.live_journal)
    timeline.close()

    again = resumed(folder / "killed", until, other)
    lived(again, steps[cut:], later)
    assert later == states
    assert again.resource.journal.derived(ARMED) == armed
    assert [(each.scan, each.command, each.plan) for each in again.live_journal] == [
        (each.scan, each.command, each.plan) for each in entries
    ]
    again.close()


@pytest.mark.parametrize("engine", [ReferenceEngine, NativeEngine])
def test_a_branch_goes_on_with_what_was_armed_there(engine: EngineFactory, tmp_path: Path) -> None:
    states: dict[int, bytes] = {}
    timeline = begun(tmp_path / "run", engine)
    lived(timeline, [(ARMS[1], 3), (ARMS[2], 60)], states)
    done: list[Refusal | None] = []
    timeline.copy(tmp_path / "branch", 17, "Bob", done.append)
    timeline.recording.wait()
    assert done == [None]
    assert timeline.live_scan == 63
    branch = resumed(tmp_path / "branch", 0, engine)
    assert branch.live_scan == 17
    assert len(branch.resource.journal.derived(ARMED)) == 3
    found: dict[int, bytes] = {}
    while branch.live_scan < 63:
        branch.run(1)
        found[branch.live_scan] = branch.resource.state
    assert found == {scan: state for scan, state in states.items() if scan > 17}
    for each in (branch, timeline):
        each.close()
