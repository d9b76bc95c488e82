"""Makes the golden run file: `python -m tests.recording.golden_run` writes `golden/format-N.run`, and beside it what it comes to.

It is made once for each format of run files: a newer program must replay it byte for byte. It is made again only together with
a new format, or while nothing was released.
"""

import json
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path

from scanbench.debug.assign import Assign
from scanbench.engines.available import Reference
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.faults.arm import Arm, Disarm
from scanbench.faults.clear import ClearErrorLog
from scanbench.faults.detect import Detection
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Calm, Disturb
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.faults.schedule import Schedule
from scanbench.faults.shapes import Shape, Start, Wanted
from scanbench.host.run_files import programs_by
from scanbench.jobs.starting import checked_program, model_of
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.format import FORMAT
from scanbench.recording.programs import Make, ProgramsOf, on
from scanbench.recording.reader import RunReader, no_programs
from scanbench.recording.replay_file import replay_file
from scanbench.recording.timeline import Timeline
from scanbench.runtime.clear_violations import ClearViolations
from scanbench.runtime.command import Command, Refusal
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.joined import Joined
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.restart import Restart
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.write import Write
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.wire.codec import ENTRIES, pack_body
from scanbench.wire.host import Sources

GOLDEN = Path(__file__).with_name("golden")
SCANS = 200
MODEL, INTERVAL_NS = "CJ1M-CPU63", 10_000_000
TEXT = """
TYPE Color : (red, green, blue); Level : INT(0..90); END_TYPE
FUNCTION_BLOCK Counter
VAR_INPUT step : INT; END_VAR
VAR_OUTPUT total : DINT; END_VAR
VAR RETAIN kept : DINT; END_VAR
  total := total + step; kept := kept + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR
  n, level, divisor : INT := 1; counter : Counter; low AT A402.04 : BOOL; start AT CIO0.00 : BOOL; lamp AT CIO100.00 : BOOL;
  list : ARRAY[0..9] OF DINT; name : STRING[20]; long : LREAL; timer : TON; color : Color; bounded : Level;
END_VAR
  n := n + 1; counter(step := level); list[n MOD 10] := counter.total;
  timer(IN := start, PT := T#50ms); lamp := timer.Q AND NOT low;
  name := CONCAT('n is ', INT_TO_STRING(n)); long := long + 0.5;
  color := SEL(low, Color#red, Color#blue);
  level := 100 / divisor;
END_PROGRAM
"""
SECOND = TEXT.replace("long : LREAL", "more : DWORD; long : LREAL").replace("n := n + 1", "n := n + 2")
BATTERY, UNIT = ErrorRef("battery-error"), ErrorRef("cpu-bus-unit-error", (("unit", "3"),))


def tool_write(value: int) -> WriteAreas:
    """D10 as a client writes it."""
    return WriteAreas("FINS client, node 5", (AreaWrite("D", 20, value.to_bytes(2, "little")),))


COMMANDS: tuple[tuple[int, Command], ...] = (
    (2, Write("Ada", "Main.level", "7")),
    (3, Force("Ada", "Main.start", "TRUE")),
    (4, Force("Ada", "Main.bounded", "80")),
    (12, Release("Ada", "Main.bounded")),
    (14, SetClock("Ada", datetime(2030, 1, 2, 3, 4, 5, tzinfo=UTC))),
    (16, Assign("Ada", "Main", 0, "level := level + 1; list[3] := 5;")),
    (20, Generate("Ada", (BATTERY,))),
    (24, Recover("Bob", ("battery-error",))),
    (26, Arm("Ada", Wanted((BATTERY,), Start("scan", scan=30), Shape("intermittent", scans=2, period=5, times=4)))),
    (40, Arm("Ada", Wanted((UNIT,), Start("condition", condition="Main.n > 45"), Shape("for", scans=6)))),
    (50, tool_write(0x0001)),
    (51, tool_write(0x0002)),
    (53, tool_write(0x0102)),
    (60, Arm("Ada", Wanted((BATTERY,), Start("scan", scan=1_000)))),
    (62, Disarm("Ada", None)),
    (64, Generate("Ada", (BATTERY, UNIT))),
    (66, Recover("Ada", None)),
    (68, ClearErrorLog("Ada")),
    (70, ClearViolations("Ada")),
    (74, Disturb("Ada", Disturbance("flip", "Main.list[7]", probability=0.2, seed=1))),
    (75, Disturb("Ada", Disturbance("late", scan=78, scans=4))),
    (76, Disturb("Ada", Disturbance("stuck", "Main.start", scan=80, scans=9))),
    (77, Disturb("Ada", Disturbance("result", bit=3, site="main.st:17", probability=0.3, seed=2))),
    (100, Calm("Ada", None)),
    (104, ProgramChange("Ada", 2)),
    (110, SetMode("Ada", "PROGRAM")),
    (114, SetMode("Ada", "RUN")),
    (118, SetMode("Ada", "MONITOR")),
    (120, Restart("Ada", "warm")),
    (130, Write("Ada", "Main.divisor", "0")),
    (131, Restart("Ada", "power")),
    (150, Restart("Ada", "cold")),
)  # fmt: skip
"""The scans before which commands are entered. In scan 130 a run-time error ends the program until it is restarted."""


@dataclass(frozen=True, slots=True)
class Expected:
    """What a replay of the golden file comes to."""

    scan: int
    hash: str
    entries: int
    checkpoints: int
    commands: tuple[str, ...]
    """Kinds of commands in its journal."""


def sources(version: int) -> Sources:
    """A program of the run."""
    return Sources(MODEL, {"main.st": TEXT if version == 1 else SECOND}, INTERVAL_NS, version)


def program_of(wanted: Sources) -> Program:
    """As a PLC has it built."""
    return checked_program(wanted, model_of(wanted))


def programs_on(make: Make) -> ProgramsOf:
    """Of the golden run file."""
    return programs_by(program_of, make)


def make(path: Path) -> None:
    """Writes the run file."""
    kept = {number: KeptProgram(number, pack_body(sources(number)), "") for number in (1, 2)}
    timeline = Timeline.begin(
        path, programs_on(on(Reference()))(kept), 1, kept[1].sources, ENTRIES, "Ada", Detection(),
        agenda=Joined(Schedule(observed_engine), DisturbanceSchedule()),
    )  # fmt: skip
    assert timeline.add_program(2, kept[2].sources) is None
    for scan, command in (*COMMANDS, (SCANS, None)):
        while timeline.live_scan < scan and not timeline.resource.header.halted_by_trap:
            if timeline.resource.runnable:
                timeline.run(scan - timeline.live_scan)
            else:
                timeline.resource.pass_time(1)
        if not isinstance(command, WriteAreas):  # those after the first repeat it, in few bytes
            timeline.recording.checkpoint(timeline.live_scan, timeline.live.version, timeline.resource.state)
        if command is not None:
            outcome = timeline.submit(command)
            assert not isinstance(outcome, Refusal), (command, outcome)
    timeline.close()


def expected(path: Path) -> Expected:
    """What it comes to now."""
    replayed = replay_file(path, programs_on(on(Reference())), ENTRIES)
    return Expected(replayed.scan, replayed.hash, replayed.entries, replayed.checkpoints, commands(path))


def commands(path: Path) -> tuple[str, ...]:
    """Kinds of commands in a run file."""
    with RunReader(path, no_programs, ENTRIES) as reader:
        reader.follow()
        return tuple(sorted({type(each.command).__name__ for each in reader.entries}))


def main() -> None:
    """Makes it, beside those of other formats."""
    path = GOLDEN / f"format-{FORMAT}.run"
    path.unlink(missing_ok=True)
    make(path)
    path.with_suffix(".json").write_text(json.dumps(asdict(expected(path)), indent=2) + "\n")


if __name__ == "__main__":
    main()
