"""Whatever is done to a PLC at whatever scan: from any state on the way the journal leads to every later one."""

import os
import subprocess
import sys
from functools import cache

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.detect import Detection
from scanbench.faults.inject import Generate
from scanbench.recording.replay import replay
from scanbench.runtime.command import Entry
from scanbench.runtime.programs import EngineFactory, Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import Trapped
from scanbench.runtime.write import Write
from tests.amounts import amount
from tests.runtime.bench import ENGINES, program, value
from tests.runtime.random_runs import COMMANDS, SOURCE, Step, again, live, loaded_programs, random_steps

STEPS = st.lists(st.tuples(st.sampled_from(COMMANDS), st.sampled_from([0, 1, 2, 7, 40])), min_size=1, max_size=25)


@cache
def programs(engine: EngineFactory, use: str) -> LoadedPrograms:
    """Made once; `use` keeps what was recorded apart from what is replayed."""
    return loaded_programs(engine)


@settings(max_examples=amount(120, 20), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(steps=STEPS, data=st.data())
def test_any_state_leads_to_every_later_one(steps: list[Step], data: st.DataObject) -> None:
    points, entries = live(programs(NativeEngine, "live"), steps)
    start = data.draw(st.integers(0, len(points) - 1))
    engine = data.draw(st.sampled_from(ENGINES))
    assert again(programs(engine, "replay"), points, entries, start) == [point.state for point in points[start:]]


@settings(max_examples=amount(50, 8), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(steps=STEPS)
def test_both_engines_live_through_the_same(steps: list[Step]) -> None:
    native, reference = (live(programs(engine, "live"), steps) for engine in (NativeEngine, ReferenceEngine))
    assert native[0] == reference[0]
    assert [each.plan for each in native[1]] == [each.plan for each in reference[1]]


def test_two_processes_replay_to_the_same_bytes() -> None:
    found = set()
    for seed in ("1", "2"):
        done = subprocess.run(
            [sys.executable, "-m", "tests.runtime.random_runs", "4711"],
            env={**os.environ, "PYTHONHASHSEED": seed}, capture_output=True, text=True, check=True,
        )  # fmt: skip
        found.add(done.stdout)
    assert len(found) == 1
    assert len(found.pop().strip()) == 64


def test_the_random_runs_meet_everything() -> None:
    entries: list[Entry] = []
    for seed in range(12):
        entries += live(programs(NativeEngine, "live"), random_steps(seed))[1]
    kinds = {type(entry.command).__name__ for entry in entries}
    assert kinds == {
        "Write", "Force", "Release", "SetMode", "Restart", "ProgramChange", "Generate", "Recover", "ClearViolations", "SetClock", "Trapped",
        "Arm", "Disarm", "Missed",
    }  # fmt: skip
    assert {entry.command.info.kind for entry in entries if isinstance(entry.command, Trapped)} == {"division", "fatal"}
    assert {entry.command.author for entry in entries if isinstance(entry.command, Generate)} == {
        "Ada",
        "Eve",
        "PLC",
        "program",
    }


@pytest.mark.parametrize("engine", ENGINES)
def test_what_was_asked_for_just_before_the_end_is_answered_after_a_recovery(engine: EngineFactory) -> None:
    whole = Resource(Loaded.make(program(SOURCE), engine), detect=Detection())
    whole.submit(Write("Ada", "Main.ask", "3"))
    asked = whole.journal[:]
    whole.run(1)
    assert value(whole, "A400") == 0x4103

    again = Resource(Loaded.make(program(SOURCE), engine), detect=Detection())
    replay(again, asked, 1)  # it ended between the scan and the entry
    assert value(again, "A400") == 0
    again.settle()
    assert again.state == whole.state
    again.settle()
    assert len(again.journal) == len(whole.journal) == 2
