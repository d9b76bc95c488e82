"""Disturbances of the control device: each kind, live and replayed byte for byte, on both engines; and what is refused."""

from collections.abc import Sequence
from functools import partial

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import (
    DISTURBED,
    MOST_DISTURBANCES,
    Calm,
    Disturb,
    disturbances,
    is_disturbance,
    told,
)
from scanbench.faults.disturb.fire import Corrupt, Flip, Hold, Unfired, Unhold
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.recording.headless import HeadlessRun, run_headless
from scanbench.recording.journal_roots import journal_roots
from scanbench.recording.replay import replay
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.forces import Force, Release, read_table
from scanbench.runtime.holds import HELD, held
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import EngineFactory, Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import resolve
from scanbench.wire.codec import ENTRIES
from tests.runtime.bench import ENGINES, model, plc, program, value

SOURCE = """
VAR_GLOBAL switch AT 0.03 : BOOL; count AT D120 : INT; word AT CIO1 : WORD; spare : INT; END_VAR
PROGRAM Main
VAR n : INT; seen : ARRAY[0..63] OF BOOL; words : ARRAY[0..63] OF WORD; text : STRING[10] := 'abc'; r : REAL := 1.5;
  b : BOOL; sum : DINT; twice : Twice; half : INT; END_VAR
  seen[n] := switch;
  words[n] := word;
  IF n = 7 THEN
    sum := sum + 100;
  END_IF;
  twice(x := n);
  half := Half(n);
  b := n > 3;
  n := n + 1;
END_PROGRAM
FUNCTION_BLOCK Twice
VAR_INPUT x : INT; END_VAR VAR_OUTPUT y : INT; END_VAR
  y := 2 * x;
END_FUNCTION_BLOCK
FUNCTION Half : INT
VAR_INPUT x : INT; END_VAR VAR t : INT; END_VAR
  t := x;
  Half := t / 2;
END_FUNCTION
"""
HALF = SOURCE.splitlines().index("  t := x;") + 1
LINES = {text.strip(): number for number, text in enumerate(SOURCE.splitlines(), 1)}
ON = pytest.mark.parametrize("engine", ENGINES, ids=("reference", "native"))
disturb = partial(Disturb, "Ada")


def site(text: str) -> str:
    return f"main.st:{LINES[text]}"


def run(engine: EngineFactory, scans: int, *commands: tuple[int, Command], source: str = SOURCE) -> HeadlessRun[None]:
    """A run, which a replay has to find again byte for byte, also from a journal that was packed."""
    result: HeadlessRun[None] = run_headless(program(source), scans, engine, commands, agenda=DisturbanceSchedule())
    packed = [ENTRIES.unpack(ENTRIES.pack(each)) for each in result.entries]
    assert packed == list(result.entries)
    for other in ENGINES:
        again = plc(source, other)
        replay(again, packed, result.resource.header.scan)
        assert again.state == result.resource.state
        assert again.journal.derived(DISTURBED) == result.resource.journal.derived(DISTURBED)
        assert again.journal.derived(HELD) == result.resource.journal.derived(HELD)
    return result


def seen(result: HeadlessRun[None], name: str, count: int) -> list[object]:
    return [value(result.resource, f"Main.{name}[{index}]") for index in range(count)]


def texts(result: HeadlessRun[None]) -> list[tuple[int, str]]:
    return [(each.scan, told(each)) for each in result.entries if told(each)]


def kinds(result: HeadlessRun[None]) -> list[str]:
    return [type(each.command).__name__ for each in result.entries]


# ---- one bit of memory ---------------------------------------------------------------------------------------------


@ON
@pytest.mark.parametrize(
    ("path", "bit", "before", "after"),
    [
        ("D120", 0, 0, 1), ("count", 15, 0, -32768), ("Main.n", 3, 5, 13), ("Main.b", 0, True, False), ("0.03", 0, False, True),
        ("Main.text", 32, "abc", "ab" + chr(ord("c") ^ 1)), ("Main.r", 31, 1.5, -1.5), ("Main.twice.y", 1, 8, 10), ("W3.02", 0, False, True),
    ],
)  # fmt: skip
def test_a_bit_flips_before_its_scan(engine: EngineFactory, path: str, bit: int, before: object, after: object) -> None:
    result = run(engine, 5, (2, disturb(Disturbance("flip", path, bit, scan=5))))
    assert kinds(result) == ["Disturb", "Flip"]
    entry = result.entries[1]
    assert (entry.scan, entry.step, entry.command.author) == (5, 0, "Ada")
    assert value(result.resource, path) == after
    (patch,) = entry.plan.patches
    assert sum(mask.bit_count() for mask in patch.mask) == 1
    assert told(entry) == f"Memory {path}, bit {bit}"
    assert result.resource.journal.derived(DISTURBED) == {}
    undisturbed = run(engine, 5)
    assert value(undisturbed.resource, path) == before


@ON
def test_without_a_scan_it_comes_at_once(engine: EngineFactory) -> None:
    result = run(engine, 3, (2, disturb(Disturbance("flip", "D120", 4))))
    assert texts(result) == [(2, "Memory D120, bit 4")]
    assert value(result.resource, "count") == 16


def test_any_bit_is_chosen_by_the_seed() -> None:
    def flipped(seed: int) -> object:
        return run(ReferenceEngine, 3, (1, disturb(Disturbance("flip", "D120", seed=seed)))).entries[1].command

    assert flipped(1) == flipped(1)
    assert len({each.bit for each in map(flipped, range(20)) if isinstance(each, Flip)}) > 5


@ON
def test_by_chance_it_comes_about_as_often_as_the_probability_says(engine: EngineFactory) -> None:
    wanted = Disturbance("flip", "D120", probability=0.1, seed=3, scan=10)
    result = run(engine, 60, (0, disturb(wanted)), source=SOURCE.replace("n := n + 1", "n := (n + 1) MOD 8"))
    scans = [scan for scan, _ in texts(result)]
    assert 1 <= len(scans) <= 15
    assert scans == sorted(set(scans))
    assert min(scans) >= 10
    (info,) = disturbances(result.resource.journal.derived(DISTURBED))
    assert (info.fired, info.state, info.kind, info.by) == (len(scans), "waiting", "flip", "Ada")
    assert info.next_scan is not None
    assert info.next_scan > 60
    assert info.text == "Memory D120, any bit, with probability 0.1 of each scan from scan 10 on, seed 3"


def test_the_mean_over_many_scans_is_the_probability() -> None:
    source = "PROGRAM Main VAR n : DINT; END_VAR n := n + 1; END_PROGRAM"
    result: HeadlessRun[None] = run_headless(
        program(source), 20_000, NativeEngine, [(0, disturb(Disturbance("flip", "D1", 0, probability=0.05, seed=11)))],
        agenda=DisturbanceSchedule(),
    )  # fmt: skip
    assert 800 < len(texts(result)) < 1200


@ON
def test_with_probability_1_it_comes_in_each_scan_and_so_often(engine: EngineFactory) -> None:
    result = run(engine, 20, (4, disturb(Disturbance("flip", "D120", 0, probability=1, times=3))))
    assert [scan for scan, _ in texts(result)] == [4, 5, 6]
    assert result.resource.journal.derived(DISTURBED) == {}


# ---- inputs --------------------------------------------------------------------------------------------------------


@ON
def test_a_lost_refresh_comes_a_scan_later(engine: EngineFactory) -> None:
    result = run(engine, 10, (0, disturb(Disturbance("late", "0.03", scan=4))), (4, Write("Bob", "switch", "TRUE")))
    assert seen(result, "seen", 7) == [False, False, False, False, False, True, True]
    assert kinds(result) == ["Disturb", "Hold", "Write", "Unhold"]
    assert texts(result) == [(4, "Input 0.03 late")]
    assert read_table(result.resource.memory) == {}


@ON
def test_all_inputs_are_late(engine: EngineFactory) -> None:
    result = run(
        engine, 10, (3, disturb(Disturbance("late", scans=3))), (3, Write("Bob", "switch", "TRUE")),
        (4, Write("Bob", "word", "16#1234")), (5, Write("Bob", "1.15", "TRUE")),
    )  # fmt: skip
    assert seen(result, "seen", 8) == [False] * 6 + [True] * 2
    assert seen(result, "words", 8) == [0] * 6 + [0x9234] * 2


@ON
def test_a_stuck_input_stays_so_until_it_is_taken_back(engine: EngineFactory) -> None:
    result = run(
        engine, 12, (1, Write("Bob", "word", "7")), (2, disturb(Disturbance("stuck", "word", scans=1_000_000))),
        (4, Write("Bob", "word", "8")), (6, Release("Bob", None)), (9, Calm("Ada", None)),
    )  # fmt: skip
    assert seen(result, "words", 11) == [0, 7, 7, 7, 7, 7, 7, 7, 7, 8, 8]
    assert result.resource.journal.derived(DISTURBED) == {}
    assert held(result.resource.journal) == {}


@ON
def test_it_is_stuck_again_and_again(engine: EngineFactory) -> None:
    writes = [(scan, Write("Bob", "word", str(scan))) for scan in range(20)]
    result = run(engine, 20, (2, disturb(Disturbance("stuck", "word", probability=1, scans=3, times=2))), *writes)
    # the refresh that lets go is disturbed at once: what came in it counts for that hold
    assert seen(result, "words", 12) == [0, 1, 1, 1, 1, 4, 4, 4, 8, 9, 10, 11]


@ON
def test_people_s_forces_and_what_is_held_are_kept_apart(engine: EngineFactory) -> None:
    result = run(
        engine, 12, (1, Force("Bob", "1.00", "TRUE")), (2, disturb(Disturbance("stuck", "word", scans=6))),
        (3, Force("Bob", "1.01", "TRUE")), (4, Write("Bob", "1.03", "TRUE")), (5, Release("Bob", "1.00")),
        (6, Release("Bob", "1.01")),
    )  # fmt: skip
    refused = {each.scan: each.refusal.message for each in result.refused}
    assert refused == {
        3: "1.01 is held by disturbance 1: take that back first",
        6: "CIO1.01 is not forced",
    }
    # the force of bit 0 was there first: that bit is not held, so it stays as the force left it
    assert seen(result, "words", 11) == [0, 1, 1, 1, 1, 1, 1, 1, 9, 9, 9]


def test_what_is_forced_cannot_be_held() -> None:
    result = run(ReferenceEngine, 6, (1, Force("Bob", "word", "5")), (2, disturb(Disturbance("stuck", "word"))))
    assert kinds(result) == ["Force", "Disturb", "Unfired"]
    assert result.entries[-1].plan.message == "disturbance 1 did not come about in scan 2: word is forced"
    assert texts(result) == []


PLANT = {
    "plant/Plant.st": """PROGRAM Plant VAR n : INT; END_VAR n := n + 1; word := INT_TO_WORD(n); END_PROGRAM""",
}


@ON
def test_what_the_plant_makes_of_an_input_counts_afterwards(engine: EngineFactory) -> None:
    checked = check_sources({"main.st": SOURCE, **PLANT}, model())
    assert checked.program is not None, checked.problems
    commands = [(3, disturb(Disturbance("late", scans=2)))]
    result: HeadlessRun[None] = run_headless(checked.program, 8, engine, commands, agenda=DisturbanceSchedule())
    assert seen(result, "words", 7) == [1, 2, 3, 3, 3, 6, 7]
    unhold = next(each for each in result.entries if isinstance(each.command, Unhold))
    assert unhold.plan.patches[-1].data  # in the seam it is what the plant made of it in the scan before
    again = Resource(Loaded.make(checked.program, engine))
    replay(again, result.entries, 8)
    assert again.state == result.resource.state


@ON
@pytest.mark.parametrize("kind", ["cold", "warm", "power"])
def test_a_restart_does_not_mend_an_input(engine: EngineFactory, kind: str) -> None:
    restart = Restart("Bob", kind)  # type: ignore[arg-type]
    result = run(
        engine, 12, (1, Write("Bob", "word", "7")), (2, disturb(Disturbance("stuck", "word", scans=6))), (4, restart),
        (5, Write("Bob", "word", "9")),
    )  # fmt: skip
    assert result.resource.journal.derived(DISTURBED) == {}
    # all input words stay through a warm restart, as the device would read them again at once
    kept = 0 if kind == "cold" else 7
    assert seen(result, "words", 6) == [kept, kept, kept, kept, 9, 9]


@ON
def test_a_new_program_finds_it_stuck_too(engine: EngineFactory) -> None:
    new = program(SOURCE.replace("sum : DINT;", "sum : LINT; more : ARRAY[0..99] OF LINT;"))
    resource = Resource(Loaded.make(program(SOURCE), engine), agenda=DisturbanceSchedule())
    resource.programs = LoadedPrograms(resource.loaded, Loaded.make(new, engine, 2))
    resource.submit(Write("Bob", "word", "7"))
    resource.submit(disturb(Disturbance("stuck", "word", scans=6)))
    resource.run(2)
    assert isinstance(resource.submit(ProgramChange("Bob", 2)), Entry)
    resource.submit(Write("Bob", "word", "9"))
    for _ in range(6):
        resource.run(1)
    assert [value(resource, f"Main.words[{index}]") for index in range(8)] == [7] * 6 + [9] * 2
    again = Resource(Loaded.make(program(SOURCE), engine))
    again.programs = LoadedPrograms(again.loaded, Loaded.make(new, engine, 2))
    replay(again, list(resource.journal), 8)
    assert again.state == resource.state


# ---- results -------------------------------------------------------------------------------------------------------


@ON
def test_a_result_is_corrupted_where_it_was_computed(engine: EngineFactory) -> None:
    result = run(engine, 6, (0, disturb(Disturbance("result", bit=4, site=site("twice(x := n);"), scan=3))))
    entry = result.entries[1]
    assert (entry.scan, type(entry.command)) == (3, Corrupt)
    assert entry.step > 0
    assert told(entry) == f"Result of {site('twice(x := n);')}, bit 4"
    assert "bit 4 of Main.twice.x" in entry.plan.message


@ON
def test_what_reads_a_corrupted_result_goes_on_with_it(engine: EngineFactory) -> None:
    source = """PROGRAM Main VAR a, b : INT; list : ARRAY[0..9] OF INT; n : INT; END_VAR
  a := n;
  b := a + 1;
  list[n] := b;
  n := n + 1;
END_PROGRAM"""
    result = run(engine, 6, (0, disturb(Disturbance("result", bit=4, site="main.st:2", scan=3))), source=source)
    assert seen(result, "list", 6) == [1, 2, 3, 20, 5, 6]


@ON
def test_the_result_of_the_last_statement_is_corrupted_after_it(engine: EngineFactory) -> None:
    result = run(engine, 6, (0, disturb(Disturbance("result", bit=3, site=site("n := n + 1;"), scan=3))))
    assert [each.scan for each in result.entries] == [0, 3]
    assert value(result.resource, "Main.n") == 4 + 8 + 2
    assert seen(result, "seen", 3) == [False] * 3


@ON
def test_temporaries_are_results_too(engine: EngineFactory) -> None:
    wanted = Disturbance("result", bit=6, site=f"main.st:{HALF}", scan=3)
    resource = Resource(Loaded.make(program(SOURCE), engine), agenda=DisturbanceSchedule())
    resource.submit(disturb(wanted))
    while resource.header.scan < 4:
        resource.run(4 - resource.header.scan)
    assert value(resource, "Main.half") == (3 + 64) // 2
    again = plc(SOURCE, engine)
    replay(again, list(resource.journal), 4)
    assert again.state == resource.state


@ON
def test_a_statement_that_does_not_run_has_no_result(engine: EngineFactory) -> None:
    where = site("sum := sum + 100;")
    result = run(
        engine, 12, (0, disturb(Disturbance("result", site=where, scan=3))),
        (0, disturb(Disturbance("result", bit=9, site=where, scan=5, probability=1, times=1))),
    )  # fmt: skip
    assert [(each.scan, type(each.command)) for each in result.entries[2:]] == [
        (4, Unfired), (6, Unfired), (7, Unfired), (7, Corrupt)
    ]  # fmt: skip
    assert result.entries[2].plan.message == "disturbance 1 did not come about in scan 3: the statement did not run"
    assert value(result.resource, "Main.sum") == 100 ^ 512
    (info,) = disturbances(result.resource.journal.derived(DISTURBED))  # the other one came about in the end
    assert (info.id, info.state, info.why) == (1, "missed", "scan 3: the statement did not run")
    assert result.resource.submit(Calm("Ada", (1,))) is not None
    assert result.resource.journal.derived(DISTURBED) == {}


def test_commands_of_the_same_seam_come_before_the_scan_that_is_disturbed() -> None:
    result = run(
        ReferenceEngine, 6, (0, disturb(Disturbance("result", bit=0, site=site("n := n + 1;"), scan=3))),
        (3, Write("Bob", "spare", "1")), (3, Write("Bob", "spare", "2")),
    )  # fmt: skip
    assert kinds(result) == ["Disturb", "Write", "Write", "Corrupt"]
    assert {each.scan for each in result.entries[1:]} == {3}


@ON
def test_two_results_in_one_scan(engine: EngineFactory) -> None:
    result = run(
        engine, 5, *((0, disturb(Disturbance("result", bit=4, site=site(text), scan=3))) for text in ("n := n + 1;", "words[n] := word;"))
    )  # fmt: skip
    assert kinds(result) == ["Disturb", "Disturb", "Corrupt", "Corrupt"]
    assert seen(result, "words", 5) == [0, 0, 0, 16, 0]
    assert value(result.resource, "Main.n") == 4 + 16 + 1


def test_a_bit_of_an_area_is_one_bit_of_a_result() -> None:
    source = """VAR_GLOBAL lamp AT 100.05 : BOOL; END_VAR
PROGRAM Main VAR n : INT; END_VAR
  lamp := FALSE;
  n := n + 1;
END_PROGRAM"""
    result = run(ReferenceEngine, 4, (0, disturb(Disturbance("result", site="main.st:3", scan=3))), source=source)
    assert value(result.resource, "100.05") is True
    assert result.resource.memory.count(b"\x20", resolve(result.resource.program, "100.00").offset) >= 1


# ---- in any case ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        (Disturbance("flip", "Main.nn", 0), "nn"),
        (Disturbance("flip", "Main.n", 16), "Main.n is INT and has bits 0 to 15: there is no bit 16"),
        (Disturbance("flip", "Main.b", 1), "Main.b is BOOL and has bit 0 only: there is no bit 1"),
        (Disturbance("flip", "Main.twice", 1), "Main.twice is Twice, not a single value: name one of its members instead"),
        (Disturbance("flip"), "say of which variable or address a bit is to turn over, as `D120` or `Main.count`"),
        (Disturbance("flip", "D1", 0, scan=2), "scan 2 is over: the PLC is at scan 3"),
        (Disturbance("flip", "D1", 0, probability=1.5), "the probability is 1.5: it must be 0 (once) to 1 (in each scan)"),
        (Disturbance("flip", "D1", 0, times=2), "2 times of what? Give a probability of each scan, or leave `times` at 0: it comes once"),
        (Disturbance("flip", "D1", 0, seed=-1), "seed is -1: it must be 0 to 9223372036854775807"),
        (Disturbance("stuck", "0.03", scans=0), "scans is 0: it must be 1 to 1000000"),
        (Disturbance("stuck", "0.03", 2), "an input that is stuck is so with all its bits: name the bit in its path, as `0.03`"),
        (Disturbance("result", site="Main"), "`Main` is no place of the program: write file and line, as `Main.st:34`"),
        (Disturbance("result", site="main.st:1"), "no statement begins at main.st:1"),
        (Disturbance("result", bit=77, site=site("n := n + 1;")), f"the result of {site('n := n + 1;')} has bits 0 to 15: there is no bit 77"),
        (Disturbance("result", bit=1, site=site("b := n > 3;")), f"the result of {site('b := n > 3;')} has bit 0 only: there is no bit 1"),
        (Disturbance("result", site=site("IF n = 7 THEN")), f"the statement at {site('IF n = 7 THEN')} writes nothing itself: name a line with an assignment or a call"),
        (Disturbance("melt"), "melt is no kind of disturbance"),  # type: ignore[arg-type]
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_words(wanted: Disturbance, message: str) -> None:
    resource = plc(SOURCE)
    resource.run(3)
    outcome = resource.submit(disturb(wanted))
    assert isinstance(outcome, Refusal)
    assert message in outcome.message
    assert resource.journal.derived(DISTURBED) == {}


def test_what_is_not_there_cannot_be_taken_back() -> None:
    resource = plc(SOURCE)
    outcome = resource.submit(Calm("Ada", (3,)))
    assert outcome == Refusal("there is no disturbance 3: it is over, or never was. There are: none")
    assert isinstance(resource.submit(Calm("Ada", None)), Entry)


def test_there_is_room_for_so_many() -> None:
    resource = plc(SOURCE)
    for _ in range(MOST_DISTURBANCES):
        assert isinstance(resource.submit(disturb(Disturbance("flip", "D1", 0, scan=10**6))), Entry)
    outcome = resource.submit(disturb(Disturbance("flip", "D1", 0, scan=10**6)))
    assert outcome == Refusal(f"there are {MOST_DISTURBANCES} disturbances: take some back first")


def test_one_of_two_is_taken_back() -> None:
    result = run(
        ReferenceEngine, 9, (0, disturb(Disturbance("flip", "D1", 0, scan=7))), (0, disturb(Disturbance("flip", "D2", 0, scan=7))),
        (3, Calm("Bob", (1,))),
    )  # fmt: skip
    assert texts(result) == [(7, "Memory D2, bit 0")]


@ON
def test_a_journal_may_forget_what_lies_between(engine: EngineFactory) -> None:
    result = run(
        engine, 60, (0, disturb(Disturbance("flip", "D120", probability=0.9, seed=1))),
        (0, disturb(Disturbance("stuck", "word", probability=0.3, scans=2, seed=2))),
        (3, disturb(Disturbance("result", site=site("sum := sum + 100;"), probability=0.5))),
        (40, SetMode("Bob", "PROGRAM")), (45, SetMode("Bob", "MONITOR")),
    )  # fmt: skip
    entries = list(result.entries)
    for cut in range(0, len(entries), 7):
        kept = journal_roots(entries[:cut], ENTRIES.folds)
        assert len(kept) <= 14
        for fold in (DISTURBED, HELD):
            assert fold.over(entries[index] for index in kept) == fold.over(entries[:cut])


def test_while_the_program_is_stopped_its_memory_is_disturbed_and_no_result() -> None:
    commands: Sequence[tuple[int, Command]] = (
        (0, disturb(Disturbance("flip", "D120", 0, scan=5))), (0, disturb(Disturbance("result", site=site("n := n + 1;"), scan=5))),
        (3, SetMode("Bob", "PROGRAM")), (9, SetMode("Bob", "MONITOR")),
    )  # fmt: skip
    result = run(ReferenceEngine, 12, *commands)
    assert [(each.scan, type(each.command)) for each in result.entries[3:5]] == [(5, Flip), (6, Unfired)]


def test_the_monitor_leaves_all_of_it_out() -> None:
    result = run(
        ReferenceEngine, 9, (0, disturb(Disturbance("late", scan=2))), (0, disturb(Disturbance("flip", "D1", scan=2))),
        (0, disturb(Disturbance("result", bit=4, site=site("n := n + 1;"), scan=2))), (1, Write("Bob", "spare", "3")), (5, Calm("Ada", None)),
    )  # fmt: skip
    assert [type(each.command) for each in result.entries if not is_disturbance(each.command)] == [Write]
    assert {Hold, Unhold, Flip, Corrupt, Disturb, Calm} == {type(each.command) for each in result.entries} - {Write}


def test_the_least_of_chances_never_comes() -> None:
    resource = plc(SOURCE)
    assert not isinstance(resource.submit(disturb(Disturbance("flip", "D1", 0, probability=5e-324))), Refusal)
    resource.run(3)
    assert resource.journal.derived(DISTURBED) == {}
