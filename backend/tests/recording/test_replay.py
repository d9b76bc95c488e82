"""Image + program + journal determine every later byte."""

import pytest

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.faults.detect import Detection
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.recording.headless import HeadlessRun, run_headless
from scanbench.recording.replay import Diverged, replay
from scanbench.runtime.command import Command
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.journal import Journal
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, program, value

SOURCE = """
PROGRAM Main
VAR n : DINT; d : DINT := 1; q : DINT; start AT CIO 0.00 : BOOL; motor AT CIO 100.00 : BOOL; battery AT A402.04 : BOOL;
  t : TON; text : STRING[20]; END_VAR
  n := n + 1; motor := start; q := q + 1000 / d;
  t(IN := start, PT := T#50ms);
  IF t.Q AND battery THEN text := 'late'; END_IF;
END_PROGRAM
"""
COMMANDS: list[tuple[int, Command]] = [
    (3, Write("Ada", "Main.start", "TRUE")),
    (5, Force("Bob", "Main.n", "77")),
    (8, Generate("Bob", (ErrorRef("battery-error"),))),
    (9, Release("Bob", None)),
    (12, Generate("Bob", (ErrorRef("memory-error", (("location", "io-table-checksum"),)),))),
    (14, Recover("Bob", None)),
    (15, SetMode("Bob", "RUN")),
    (20, SetMode("Bob", "MONITOR")),
    (21, Write("Ada", "Main.d", "-3")),
]


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("checkpoint", [0, 4, 10, 13, 22])
def test_a_run_can_be_gone_on_with_from_any_checkpoint(engine: EngineFactory, checkpoint: int) -> None:
    code = program(SOURCE)
    whole = run_headless(code, 30, engine, COMMANDS).resource
    part = run_headless(code, checkpoint, engine, [each for each in COMMANDS if each[0] <= checkpoint]).resource
    again = Resource(Loaded.make(code, engine))
    again.restore(again.loaded, part.state, Journal(part.journal))
    replay(again, whole.journal[len(part.journal) :], 30)
    assert again.state == whole.state
    assert [(each.scan, each.command, each.plan) for each in again.journal] == [
        (each.scan, each.command, each.plan) for each in whole.journal
    ]


def test_both_engines_agree_on_the_whole_run() -> None:
    states = {run_headless(program(SOURCE), 30, engine, COMMANDS).resource.state for engine in ENGINES}
    assert len(states) == 1


@pytest.mark.parametrize("engine", ENGINES)
def test_a_trap_is_replayed_with_what_ran_before_it(engine: EngineFactory) -> None:
    code = program(SOURCE)
    commands = [*COMMANDS, (25, Write("Ada", "Main.d", "0"))]
    run: HeadlessRun[None] = run_headless(code, 40, engine, commands)
    assert run.resource.trap is not None
    assert run.scans == 25
    run.resource.submit(SetMode("Ada", "PROGRAM"))
    run.resource.submit(Write("Ada", "Main.d", "1"))
    again = Resource(Loaded.make(code, engine))
    replay(again, run.resource.journal, 25)
    assert again.state == run.resource.state
    assert value(again, "Main.q") == value(run.resource, "Main.q")


def test_a_journal_of_a_different_program_is_noticed() -> None:
    trapping = program("PROGRAM Main\nVAR d : INT; q : INT; END_VAR\n  q := 1 / d;\nEND_PROGRAM\n")
    run: HeadlessRun[None] = run_headless(program(SOURCE), 10, ENGINES[0], [(5, Write("Ada", "D0", "1"))])
    with pytest.raises(Diverged, match="scan 0"):
        replay(Resource(Loaded.make(trapping, ENGINES[0])), run.resource.journal, 10)


def test_rows_refusals_and_scans_of_a_headless_run() -> None:
    commands: list[tuple[int, Command]] = [(2, Write("Ada", "Main.zz", "1")), (10, Write("Ada", "D0", "7"))]
    run = run_headless(program(SOURCE), 10, ENGINES[0], commands, 4, lambda resource: value(resource, "Main.n"))
    assert run.rows == ((4, 4), (8, 8))
    assert [(each.scan, each.command.author) for each in run.refused] == [(2, "Ada")]
    assert value(run.resource, "D0") == 7  # for the seam after the last scan
    assert run.scans == 10


@pytest.mark.parametrize("engine", ENGINES)
def test_a_headless_run_ends_where_the_condition_holds(engine: EngineFactory) -> None:
    code = program("PROGRAM Main\nVAR n : INT; END_VAR\n  n := n + 1; IF n = 7 THEN FAL(5); END_IF;\nEND_PROGRAM\n")
    for text, scans, met in (("Main.n >= 12", 12, True), ("A402.15", 7, True), ("Main.n < 0", 30, False)):
        until = compile_condition(code, text)
        assert isinstance(until, Condition)
        run: HeadlessRun[None] = run_headless(code, 30, engine, detect=Detection(), until=until)
        assert (run.scans, run.met) == (scans, met)
        assert value(run.resource, "A400") == 0x4105  # asked for and answered, also in the last scan
