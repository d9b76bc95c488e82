"""Faults with a shape in time, scan by scan, on both engines; a replay comes to the same without ever asking."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.engine import Reason
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.engines.observe import MakeObserved
from scanbench.faults.arm import ARMED, MOST_ARMED, NUMBERED, Arm, Disarm, Missed, armed_faults
from scanbench.faults.detect import Detection
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.faults.schedule import Schedule
from scanbench.faults.shapes import Shape, Start, Wanted, lasts
from scanbench.recording.headless import HeadlessRun, run_headless
from scanbench.recording.journal_roots import journal_roots
from scanbench.recording.replay import replay
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import EngineFactory, Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.runtime.bench import model, program, value

OWN_ERRORS = (Path(__file__).parents[1] / "plcmodel" / "broken_user_errors" / "GOOD.xml").read_text("utf-8")
SOURCE = """
VAR_GLOBAL battery AT A402.04 : BOOL; units AT A402.07 : BOOL; END_VAR
PROGRAM Main
VAR n : DINT; list : ARRAY[0..127] OF BOOL; also : ARRAY[0..127] OF BOOL; d : DINT := 1; q : DINT; ack : BOOL; part : Part; END_VAR
  list[n MOD 128] := battery; also[n MOD 128] := units;
  q := 100 / d;
  IF n = 41 THEN
    part();
  END_IF;
  n := n + 1;
END_PROGRAM
FUNCTION_BLOCK Part
VAR calls : DINT; END_VAR
  calls := calls + 1;
END_FUNCTION_BLOCK
"""
BATTERY, UNIT = ErrorRef("battery-error"), ErrorRef("cpu-bus-unit-error", (("unit", "3"),))
KINDS: tuple[tuple[EngineFactory, MakeObserved], ...] = (
    (ReferenceEngine, observed_engine),
    (NativeEngine, ObservedBuilds().engine),
)
ON = pytest.mark.parametrize("kind", KINDS, ids=("reference", "native"))
Kind = tuple[EngineFactory, MakeObserved]


def ran(kind: Kind, scans: int, *commands: tuple[int, Command]) -> HeadlessRun[None]:
    """The run; from any entry on a replay comes to the same state."""
    engine, make = kind
    run: HeadlessRun[None] = run_headless(
        program(SOURCE), scans, engine, commands, detect=Detection(), agenda=Schedule(make)
    )
    again = Resource(Loaded.make(program(SOURCE), engine))
    replay(again, run.entries, run.resource.header.scan)
    assert again.state == run.resource.state
    return run


NOW, STAY = Start(), Shape()


def arm(*errors: ErrorRef, start: Start = NOW, shape: Shape = STAY, gap: int = 0) -> Arm:
    return Arm("Ada", Wanted(errors, start, shape, gap))


def seen(run: HeadlessRun[None], name: str = "list") -> list[int]:
    """In which scans the program saw the flag."""
    return [scan for scan in range(128) if value(run.resource, f"Main.{name}[{scan}]")]


def present(run: HeadlessRun[None]) -> list[str]:
    active = run.resource.journal.derived(ACTIVE)
    return list(active)


def kinds(run: HeadlessRun[None]) -> list[tuple[int, str]]:
    return [(entry.scan, type(entry.command).__name__) for entry in run.entries]


def left(run: HeadlessRun[None]) -> int:
    return len(run.resource.journal.derived(ARMED))


@ON
@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        (Shape("for", 5), range(10, 15)),
        (Shape("unacknowledged", 4), range(10, 14)),
        (Shape("chatter", times=4), (10, 12, 14, 16)),
        (Shape("intermittent", 3, 10, 4), [*range(10, 13), *range(20, 23), *range(30, 33), *range(40, 43)]),
        (Shape("intermittent", 1, 2), range(10, 100, 2)),
        (Shape(), range(10, 100)),
    ],
)
@pytest.mark.parametrize("start", ["now", "scan", "condition", "line"])
def test_a_shape_scan_by_scan(kind: Kind, shape: Shape, expected: Sequence[int], start: str) -> None:
    entered, wanted, by = {
        "now": (10, Start(), 0),
        "scan": (3, Start("scan", 10), 0),
        "condition": (3, Start("condition", condition="Main.n > 9"), 0),
        "line": (3, Start("line", file="main.st", line=8), 32),
    }[start]
    run = ran(kind, 100, (entered, arm(BATTERY, start=wanted, shape=shape)))
    assert seen(run) == [scan + by for scan in expected if scan + by < 100]
    assert left(run) == (shape.times is None and shape.kind in ("stay", "intermittent", "chatter"))
    assert not run.refused


@ON
def test_chance_is_the_same_everywhere(kind: Kind) -> None:
    shape = Shape("intermittent", 3, 9, 5, seed=4711)
    expected: list[int] = []
    scan = 7
    for step in range(10):
        expected += range(scan, scan + lasts(shape, step)) if step % 2 == 0 else []
        scan += lasts(shape, step)
    assert scan < 120
    assert seen(ran(kind, 120, (7, arm(BATTERY, shape=shape)))) == expected


@ON
def test_a_probability_in_each_scan(kind: Kind) -> None:
    """As `test_shapes` has it: it comes after 3 scans, and after each time when it has been gone for 7, 16, 2, 1 scans."""
    run = ran(kind, 120, (7, arm(BATTERY, shape=Shape("chance", 3, times=5, seed=7, per_million=100_000))))
    assert seen(run) == [scan for first in (10, 20, 39, 44, 48) for scan in range(first, first + 3)]
    assert left(run) == 0


@ON
def test_two_in_one_scan_and_one_after_the_other(kind: Kind) -> None:
    run = ran(kind, 60, (5, arm(BATTERY, UNIT, shape=Shape("for", 2))))
    assert (seen(run), seen(run, "also")) == ([5, 6], [5, 6])
    assert kinds(run) == [(5, "Arm"), (5, "Generate"), (7, "Recover")]
    run = ran(kind, 60, (5, arm(BATTERY, shape=Shape("for", 2))), (5, arm(UNIT, shape=Shape("for", 3))))
    assert (seen(run), seen(run, "also")) == ([5, 6], [5, 6, 7])
    start = Start("condition", condition="Main.n = 20")
    run = ran(kind, 60, (5, arm(BATTERY, UNIT, start=start, shape=Shape("intermittent", 1, 10, 2), gap=4)))
    assert (seen(run), seen(run, "also")) == ([20, 30], [24, 34])
    run = ran(kind, 60, (5, arm(BATTERY, UNIT, start=start, shape=Shape("for", 1), gap=4)))
    assert (seen(run), seen(run, "also")) == ([20], [24])  # the first is over before the second begins


@ON
def test_a_trap_in_one_condition_hides_no_other(kind: Kind) -> None:
    bad = arm(UNIT, start=Start("condition", condition="Main.list[Main.n + 200]"))
    good = arm(BATTERY, start=Start("condition", condition="Main.n = 9"), shape=Shape("for", 1))
    for commands in ((bad, good), (good, bad)):
        run = ran(kind, 40, *((2, each) for each in commands))
        assert (seen(run), seen(run, "also")) == ([9], [])


@ON
def test_the_end_of_a_run_and_what_is_armed_do_not_disturb_each_other(kind: Kind) -> None:
    resource = Resource(Loaded.make(program(SOURCE), kind[0]), agenda=Schedule(kind[1]))
    until = compile_condition(resource.program, "Main.n = 30")
    assert isinstance(until, Condition)
    resource.waiting.until = (until,)
    resource.submit(arm(BATTERY, start=Start("condition", condition="Main.n = 12"), shape=Shape("for", 3)))
    stops = []
    while resource.header.scan < 50:
        stop = resource.run(50 - resource.header.scan)
        if stop.reason is Reason.CONDITION:
            stops.append(resource.header.scan)
    assert stops == [30]
    assert [entry.scan for entry in resource.journal] == [0, 12, 15]


@ON
def test_acknowledged_before_it_goes(kind: Kind) -> None:
    shape = Shape("unacknowledged", 9, acknowledge="Main.ack")
    run = ran(kind, 60, (5, arm(BATTERY, shape=shape)), (8, Write("Bob", "Main.ack", "TRUE")))
    assert seen(run) == [5, 6, 7, 8]
    assert run.entries[-2].plan.message == "fault 1 ended: acknowledged after 4 of 9 scans: Main.ack"
    assert kinds(run)[-2:] == [(9, "Disarm"), (9, "Recover")]
    run = ran(kind, 60, (5, arm(BATTERY, shape=shape)), (30, Write("Bob", "Main.ack", "TRUE")))
    assert seen(run) == list(range(5, 14))


# ---- others ----------------------------------------------------------------------------------------------------------


@ON
def test_an_error_that_is_present_is_passed_over_and_the_next_time_comes(kind: Kind) -> None:
    run = ran(
        kind, 60, (3, Generate("Bob", (BATTERY,))), (5, arm(BATTERY, start=Start("scan", 10), shape=Shape("intermittent", 2, 10, 3))),
        (15, Recover("Bob", None)),
    )  # fmt: skip
    assert seen(run) == [*range(3, 15), 20, 21, 30, 31]
    missed = [entry for entry in run.entries if isinstance(entry.command, Missed)]
    assert [(entry.scan, entry.plan.message) for entry in missed] == [
        (10, "fault 1 passed over a step: battery-error: already generated by Bob. Recover it first")
    ]
    run = ran(
        kind, 60, (3, Generate("Bob", (BATTERY,))), (5, arm(BATTERY, start=Start("scan", 10), shape=Shape("for", 2)))
    )
    assert seen(run) == list(range(3, 60))
    assert left(run) == 0


@ON
@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        (Shape(), [5, 6, 7]), (Shape("for", 20), [5, 6, 7]), (Shape("unacknowledged", 20), [5, 6, 7]),
        (Shape("intermittent", 6, 10, 3), [5, 6, 7, *range(15, 21), *range(25, 31)]),
        (Shape("chatter", times=3), [5, 7, 9]),
    ],
)  # fmt: skip
def test_recovered_by_hand_it_is_over_but_what_comes_again_comes(kind: Kind, shape: Shape, expected: list[int]) -> None:
    run = ran(kind, 60, (5, arm(BATTERY, shape=shape)), (8, Recover("Bob", None)))
    assert seen(run) == expected
    assert left(run) == 0


@ON
def test_what_somebody_raises_again_is_theirs(kind: Kind) -> None:
    again = Generate("Bob", (ErrorRef(UNIT.id, (("unit", "7"),)),), again=True)
    run = ran(kind, 60, (5, arm(UNIT, shape=Shape("for", 10))), (8, again))
    assert seen(run, "also") == list(range(5, 60))
    assert left(run) == 0
    run = ran(kind, 60, (5, arm(BATTERY, UNIT, shape=Shape("for", 10))), (8, again))
    assert seen(run) == list(range(5, 15))  # of two the other goes in time
    assert present(run) == [UNIT.id]


@ON
def test_taken_back(kind: Kind) -> None:
    two = ((5, arm(BATTERY, shape=Shape("intermittent", 2, 4))), (5, arm(UNIT, start=Start("scan", 40))))
    run = ran(kind, 60, *two, (10, Disarm("Bob", (1,))))
    assert seen(run) == [5, 6, 9]
    assert kinds(run)[-3:] == [(10, "Disarm"), (10, "Recover"), (40, "Generate")]
    run = ran(kind, 60, *two, (12, Disarm("Bob", None)), (12, Disarm("Bob", (2,))), (12, Disarm("Bob", None)))
    assert (seen(run), seen(run, "also"), left(run)) == ([5, 6, 9, 10], [], 0)
    assert [entry.plan.message for entry in run.entries[-2:]] == ["faults 1, 2 taken back", "no fault is armed"]
    assert [each.refusal.message for each in run.refused] == [
        "no fault 2 is armed: it is over, or never was. Armed: none"
    ]


@ON
def test_a_restart_ends_it(kind: Kind) -> None:
    run = ran(
        kind, 60, (5, arm(BATTERY, shape=Shape("intermittent", 2, 4))), (5, arm(UNIT, start=Start("scan", 40))),
        (20, Restart("Bob", "warm")), (30, arm(UNIT, shape=Shape("for", 1))),
    )  # fmt: skip
    assert left(run) == 0
    assert kinds(run)[-3:] == [(30, "Arm"), (30, "Generate"), (31, "Recover")]
    assert run.resource.journal.derived(NUMBERED) == 3


@ON
def test_a_stopped_program_passes_scans_and_steps_alike(kind: Kind) -> None:
    run = ran(
        kind, 60, (5, arm(BATTERY, shape=Shape("for", 10))), (8, SetMode("Bob", "PROGRAM")), (30, SetMode("Bob", "RUN"))
    )
    assert [(entry.scan, type(entry.command)) for entry in run.entries][-2:] == [(15, Recover), (30, SetMode)]


@ON
def test_a_fatal_error_comes_and_stays(kind: Kind) -> None:
    run = ran(kind, 60, (5, arm(ErrorRef("memory-error"), start=Start("condition", condition="Main.n = 20"))))
    assert not run.resource.runnable
    assert value(run.resource, "Main.n") == 20
    assert left(run) == 1
    run.resource.submit(Disarm("Bob", (1,)))
    assert present(run) == []


@ON
def test_a_statement_is_reached_in_a_scan_that_traps(kind: Kind) -> None:
    run = ran(
        kind, 60, (10, arm(BATTERY, start=Start("line", file="main.st", line=5))), (10, Write("Bob", "Main.d", "0"))
    )
    assert kinds(run) == [(10, "Arm"), (10, "Write"), (10, "Trapped"), (10, "Generate"), (10, "Generate")]
    assert BATTERY.id in present(run)


# ---- other programs ----------------------------------------------------------------------------------------------------


@ON
def test_another_program(kind: Kind) -> None:
    engine, make = kind
    moved = SOURCE.replace("  q := 100 / d;\n", "  q := 100 / d;\n\n\n").replace("VAR n :", "VAR first : LINT; n :")
    programs = LoadedPrograms(
        *(Loaded.make(program(text), engine, version) for version, text in ((1, SOURCE), (2, moved)))
    )
    resource = Resource(programs.get(1), programs=programs, agenda=Schedule(make))
    for each in (
        arm(BATTERY, start=Start("condition", condition="Main.n > 50"), shape=Shape("for", 3)),
        arm(UNIT, start=Start("line", file="main.st", line=8)),
    ):
        assert isinstance(resource.submit(each), Entry)
    advance(resource, 10)
    resource.submit(ProgramChange("Bob", 2))
    assert [fault.id for fault in armed_faults(resource.journal.derived(ARMED))] == [1]  # line 8 is empty now
    ended = resource.journal[-1]
    assert isinstance(ended.command, Disarm)
    assert "no statement begins at main.st:8; the nearest are at main.st:6 and main.st:9" in ended.plan.message
    advance(resource, 60)
    assert seen_in(resource) == [51, 52, 53]


def advance(resource: Resource, scans: int) -> None:
    end = resource.header.scan + scans
    while resource.header.scan < end and resource.runnable:
        resource.run(end - resource.header.scan)


def seen_in(resource: Resource) -> list[int]:
    return [scan for scan in range(128) if value(resource, f"Main.list[{scan}]")]


@ON
def test_a_condition_that_means_nothing_any_more_ends_it(kind: Kind) -> None:
    engine, make = kind
    other = SOURCE.replace("n : DINT; list", "count : DINT; list").replace("n MOD", "count MOD")
    other = other.replace("IF n = 41", "IF count = 41").replace("n := n + 1", "count := count + 1")
    programs = LoadedPrograms(
        *(Loaded.make(program(text), engine, version) for version, text in ((1, SOURCE), (2, other)))
    )
    resource = Resource(programs.get(1), programs=programs, agenda=Schedule(make))
    resource.submit(arm(BATTERY, start=Start("condition", condition="Main.n > 50")))
    resource.submit(arm(UNIT, start=Start("condition", condition="Main.n > 3"), shape=Shape("intermittent", 1, 4)))
    advance(resource, 10)
    resource.submit(ProgramChange("Bob", 2))
    assert [fault.id for fault in armed_faults(resource.journal.derived(ARMED))] == [
        2
    ]  # it has begun: nothing is asked
    assert resource.journal[-1].plan.message.startswith(
        "fault 1 ended: the program has no meaning for it any more: `Main.n > 50`: "
    )


@ON
def test_an_error_that_the_project_has_no_more_ends_it(kind: Kind) -> None:
    engine, make = kind
    own = check_sources({"main.st": SOURCE, "errors.xml": OWN_ERRORS}, model()).program
    assert own is not None
    programs = LoadedPrograms(Loaded.make(own, engine, 1), Loaded.make(program(SOURCE), engine, 2))
    resource = Resource(programs.get(1), programs=programs, agenda=Schedule(make))
    assert isinstance(resource.submit(arm(ErrorRef("pump-hot"), start=Start("scan", 20))), Entry)
    assert isinstance(resource.submit(arm(BATTERY, start=Start("scan", 20))), Entry)
    advance(resource, 5)
    resource.submit(ProgramChange("Bob", 2))
    assert [fault.errors for fault in armed_faults(resource.journal.derived(ARMED))] == [(BATTERY.id,)]
    assert "knows no error 'pump-hot'" in resource.journal[-1].plan.message


# ---- what is refused ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (arm(), "no error is named"),
        (arm(ErrorRef("batery-error")), "CJ1M-CPU63 knows no error 'batery-error'. Did you mean `battery-error`"),
        (arm(ErrorRef(UNIT.id, (("unit", "99"),))), "unit=99 is outside"),
        (arm(BATTERY, BATTERY), "battery-error is there twice"),
        (arm(BATTERY, shape=Shape("for", 0)), "scans is 0"),
        (arm(BATTERY, start=Start("scan", 4)), "scan 4 is over: the PLC is at scan 5"),
        (arm(BATTERY, start=Start("condition", condition="Mian.n > 3")), "Did you mean `Main`?"),
        (arm(BATTERY, start=Start("condition", condition=" ")), "There is no condition"),
        (arm(BATTERY, start=Start("condition", condition="Main.n")), "The condition is DINT"),
        (arm(BATTERY, shape=Shape("unacknowledged", 3, acknowledge="ack")), "no variable and no address `ack`"),
        (arm(BATTERY, start=Start("line", file="main.st", line=12)), "the nearest are at main.st:10 and main.st:14"),
        (arm(BATTERY, start=Start("line", file="man.st", line=8)), "Did you mean `main.st`?"),
        (arm(ErrorRef("memory-error"), shape=Shape("for", 3)), "memory-error is fatal: where it stops the program"),
        (arm(ErrorRef("memory-error"), BATTERY, gap=1), "Put it last"),
        (arm(UNIT), "cpu-bus-unit-error: already generated by Bob (unit=3)"),
    ],
)
def test_refused_and_nothing_entered(command: Arm, words: str) -> None:
    resource = Resource(Loaded.make(program(SOURCE), ReferenceEngine), agenda=Schedule(observed_engine))
    resource.run(5)
    resource.submit(Generate("Bob", (UNIT,)))
    before = resource.state, len(resource.journal)
    outcome = resource.submit(command)
    assert isinstance(outcome, Refusal)
    assert words in outcome.message
    assert (resource.state, len(resource.journal)) == before


def test_only_so_many() -> None:
    resource = Resource(Loaded.make(program(SOURCE), ReferenceEngine), agenda=Schedule(observed_engine))
    late = partial(arm, BATTERY, start=Start("scan", 1_000_000))
    for _ in range(MOST_ARMED):
        assert isinstance(resource.submit(late()), Entry)
    outcome = resource.submit(late())
    assert isinstance(outcome, Refusal)
    assert outcome.message == "200 faults are armed: take some back first"


# ---- the journal ---------------------------------------------------------------------------------------------------------


def test_of_a_long_run_little_has_to_stay_in_the_journal() -> None:
    run = ran(
        KINDS[1], 3000, (3, arm(BATTERY, start=Start("condition", condition="Main.n = 9"), shape=Shape("intermittent", 2, 5, seed=1))),
        (4, arm(UNIT, ErrorRef("special-io-unit-error"), start=Start("condition", condition="Main.n = 20"), shape=Shape("for", 2000), gap=500)),
    )  # fmt: skip
    for cut in (len(run.entries), 700, 501, 8, 5):
        entries = run.entries[:cut]
        kept = journal_roots(entries, ENTRIES.folds)
        assert len(kept) <= 6
        for fold in ENTRIES.folds:
            assert fold.over(entries[index] for index in kept) == fold.over(entries)


def test_armed_for_people() -> None:
    run = ran(
        KINDS[0],
        14,
        (3, arm(BATTERY, shape=Shape("intermittent", 2, 5))),
        (4, arm(UNIT, start=Start("line", file="main.st", line=8))),
    )
    first, second = armed_faults(run.resource.journal.derived(ARMED))
    assert (first.id, first.errors, first.text, first.by) == (1, (BATTERY.id,), "now, 2 scans of every 5", "Ada")
    assert (first.state, first.raised, first.next_scan) == ("running", 3, 15)
    assert (second.id, second.state, second.raised, second.next_scan) == (2, "waiting", 0, None)
