"""Random runs: commands of every kind between random numbers of scans. `python -m tests.runtime.random_runs SEED` replays one."""

import hashlib
import random
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

from scanbench.engines.interpreter.observed import observed_engine
from scanbench.faults.arm import Arm, Disarm
from scanbench.faults.detect import Detection
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.faults.schedule import Schedule
from scanbench.faults.shapes import Shape, Start, Wanted
from scanbench.recording.replay import replay
from scanbench.runtime.clear_violations import ClearViolations
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.journal import Journal
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import EngineFactory, Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.write import Write
from tests.runtime.bench import program

SOURCE = """
VAR_GLOBAL start AT CIO 0.00 : BOOL; motor AT CIO 100.00 : BOOL; total AT D100 : DINT; END_VAR
VAR_GLOBAL RETAIN kept : DINT; END_VAR
TYPE Level : INT (0..9); END_TYPE
FUNCTION_BLOCK Count
VAR_IN_OUT target : DINT; END_VAR
VAR RETAIN calls : DINT; END_VAR
VAR last : REF_TO DINT; END_VAR
  calls := calls + 1; target := target + calls; last := REF(kept); last^ := last^ + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n : DINT; d : DINT := 1; ask : INT := -1; stop : INT; level : Level; t : TON; count : Count; list : ARRAY[0..3] OF INT; END_VAR
  n := n + 1; total := total + n / d; motor := start AND NOT t.Q;
  t(IN := start, PT := T#70ms);
  count(target := total);
  level := DINT_TO_INT(n); list[n MOD 4] := list[n MOD 4] + 1;
  IF ask >= 0 THEN FAL(ask); END_IF;
  IF stop > 0 THEN FALS(stop); END_IF;
END_PROGRAM
"""
SOURCES = (
    SOURCE,
    SOURCE.replace("VAR n : DINT; d", "VAR first : LINT := 4; n : DINT; d").replace("n := n + 1", "n := n + 3"),
    SOURCE.replace("list : ARRAY[0..3] OF INT", "list : ARRAY[0..4] OF INT").replace("calls : DINT", "calls : LINT")
    .replace("calls + 1; target := target + calls", "calls + 1; target := target + 2"),
)  # fmt: skip

Step = tuple[Command, int]
"""A command, and how many scans follow."""

BATTERY, UNIT = (ErrorRef("battery-error"),), (ErrorRef("cpu-bus-unit-error", (("unit", "3"),)),)
ARMS = tuple(
    Arm("Eve", wanted) for wanted in (
        Wanted(BATTERY, shape=Shape("for", 3)), Wanted((*BATTERY, *UNIT), shape=Shape("intermittent", 2, 5)),
        Wanted((*UNIT, *BATTERY), Start("condition", condition="Main.n MOD 7 = 3"), Shape("intermittent", 2, 5, 4, seed=9), gap=2),
        Wanted(UNIT, Start("scan", 20), Shape("chatter", times=3)), Wanted(BATTERY, Start("condition", condition="Main.list[Main.n] > 0")),
        Wanted(UNIT, shape=Shape("unacknowledged", 4, acknowledge="Main.t.Q OR Main.n MOD 5 = 0")),
        Wanted((ErrorRef("memory-error"),), Start("condition", condition="NOT motor AND Main.n > 60")),
        Wanted(BATTERY, Start("line", file="main.st", line=17), Shape("for", 2)), Wanted(UNIT, Start("line", file="main.st", line=9), Shape("chatter")),
    )
)  # fmt: skip

COMMANDS: tuple[Command, ...] = (
    *(Write("Ada", path, text) for path, text in (
        ("start", "TRUE"), ("start", "FALSE"), ("total", "-7"), ("Main.n", "100"), ("Main.d", "-3"), ("Main.d", "0"), ("Main.d", "1"),
        ("Main.ask", "1"), ("Main.ask", "2"), ("Main.ask", "0"), ("Main.ask", "-1"), ("Main.stop", "5"), ("Main.stop", "0"),
        ("Main.count.target", "5"), ("kept", "12"), ("A500.12", "TRUE"), ("A500.12", "FALSE"), ("W3", "9"), ("H3", "9"), ("Main.zz", "1"),
    )),
    *(Force("Bob", path, text) for path, text in (("Main.n", "5"), ("motor", "TRUE"), ("start", "TRUE"), ("Main.list[2]", "8"))),
    Release("Bob", None), Release("Bob", "motor"),
    *(SetMode("Ada", mode) for mode in ("PROGRAM", "MONITOR", "MONITOR", "RUN")),
    Restart("Ada", "cold"), Restart("Ada", "warm"), Restart("Ada", "power"),
    *(ProgramChange("Bob", version) for version in (1, 2, 3)),
    Generate("Ada", (ErrorRef("battery-error"),)), Generate("Ada", (ErrorRef("memory-error"),)),
    Recover("Ada", None), Recover("Ada", None), *ARMS, Disarm("Ada", None), ClearViolations("Ada"), SetClock("Ada", datetime(2024, 2, 28, 23, 59, tzinfo=UTC)),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Point:
    """An earlier moment of the run: after `entries` entries, in the seam before `scan`."""

    entries: int
    scan: int
    version: int
    state: bytes


def loaded_programs(engine: EngineFactory) -> LoadedPrograms:
    return LoadedPrograms(*(Loaded.make(program(text), engine, version) for version, text in enumerate(SOURCES, 1)))


def live(programs: LoadedPrograms, steps: Sequence[Step]) -> tuple[list[Point], list[Entry]]:
    """What happens."""
    resource = Resource(programs.get(1), programs=programs, detect=Detection(), agenda=Schedule(observed_engine))
    points = [_point(resource)]
    for command, scans in steps:
        resource.submit(command)
        points.append(_point(resource))
        end = resource.header.scan + scans
        while resource.runnable and resource.header.scan < end:
            resource.run(end - resource.header.scan)
        points.append(_point(resource))
    return points, list(resource.journal)


def again(programs: LoadedPrograms, points: Sequence[Point], entries: Sequence[Entry], start: int) -> list[bytes]:
    """The states at the points from `start` on, replayed from there."""
    first = points[start]
    resource = Resource(programs.get(1), programs=programs)
    resource.restore(programs.get(first.version), first.state, Journal(entries[: first.entries]))
    states, done = [], first.entries
    for point in points[start:]:
        replay(resource, entries[done : point.entries], point.scan)
        done = point.entries
        states.append(resource.state)
    return states


def random_steps(seed: int, count: int = 60) -> list[Step]:
    chance = random.Random(seed)
    return [(chance.choice(COMMANDS), chance.choice((0, 1, 1, 2, 5, 30))) for _ in range(count)]


def _point(resource: Resource) -> Point:
    return Point(len(resource.journal), resource.header.scan, resource.version, resource.state)


if __name__ == "__main__":
    from scanbench.engines.native.engine import NativeEngine

    made = loaded_programs(NativeEngine)
    known, journal = live(made, random_steps(int(sys.argv[1])))
    print(hashlib.sha256(b"".join(again(made, known, journal, 0))).hexdigest())
