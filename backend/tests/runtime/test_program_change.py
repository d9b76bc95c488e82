"""Online change: what it says before, what it refuses, what follows the variables, and the way back."""

from datetime import UTC, datetime

import pytest

from scanbench.check.build import check_sources
from scanbench.program.program import Program
from scanbench.runtime.command import Command, Entry, Refusal, Swapped
from scanbench.runtime.forces import FORCED, Force, read_table
from scanbench.runtime.migrate_image import changes
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import EngineFactory, Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, change, model, plc, program, value

OLD = """
TYPE Point : STRUCT x : INT; y : INT; END_STRUCT; END_TYPE
VAR_GLOBAL total : DINT; at_d AT D7 : INT; END_VAR
VAR_GLOBAL CONSTANT LIMIT : INT := 5; END_VAR
FUNCTION_BLOCK Count VAR calls : INT; END_VAR calls := calls + 1; END_FUNCTION_BLOCK
PROGRAM Main
VAR n : INT; gone : INT; wide : INT; p : ARRAY[0..1, 2..3] OF Point; list : ARRAY[0..3] OF INT; c : Count; temp : BOOL; END_VAR
  n := n + 1; c();
END_PROGRAM
"""
NEW = (
    OLD.replace("gone : INT; wide : INT", "wide : DINT; fresh : Count")
    .replace("x : INT; y : INT", "x : INT; y : REAL")
    .replace("list : ARRAY[0..3]", "list : ARRAY[0..4]")
    .replace("n := n + 1", "n := n + 10")
    .replace("LIMIT : INT := 5", "LIMIT : INT := 6")
    .replace("at_d AT D7 : INT", "at_d : INT")
)


def refused(resource: Resource, command: Command) -> str:
    before = resource.state
    outcome = resource.submit(command)
    assert isinstance(outcome, Refusal), outcome
    assert resource.state == before
    return outcome.message


def test_what_would_be_lost_is_known_before() -> None:
    found = changes(program(OLD), program(NEW))
    assert {each.path: each.reason for each in found.lost} == {
        "at_d": "was at D7 before",
        "Main.wide": "type changed from INT to DINT",
        "Main.fresh": "new",
        "Main.gone": "removed",
        "Main.list": "type changed from ARRAY[0..3] OF INT to ARRAY[0..4] OF INT",
        **{f"Main.p[{i},{j}].y": "type changed from INT to REAL" for i in (0, 1) for j in (2, 3)},
    }
    assert found.kept == 8  # total, n, c.calls, temp, four x
    assert (
        str(found.counted) == "5 variables kept, 8 new or changed: initialised, 1 removed"
    )  # total, LIMIT, n, c, temp
    assert not changes(program(OLD), program(OLD)).lost


@pytest.mark.parametrize(
    ("values", "kept"),
    [
        ("red, green, blue, white", True),
        ("red, GRUEN, blue", True),
        ("red, orange, green, blue", False),
        ("red, blue", False),
    ],
)
def test_a_value_of_an_enumeration_goes_over_where_its_number_means_the_same(values: str, kept: bool) -> None:
    text = "TYPE E : (red, green, blue); END_TYPE\nPROGRAM Main VAR e : E; list : ARRAY[1..2] OF E; END_VAR END_PROGRAM"
    lost = changes(program(text), program(text.replace("red, green, blue", values))).lost
    shown = {each.path: each.reason for each in lost}
    assert shown == (
        {} if kept else {"Main.e": "E is declared otherwise", "Main.list": "ARRAY[1..2] OF E is declared otherwise"}
    )


def test_a_program_more_or_less() -> None:
    two = OLD + "PROGRAM Other VAR k : INT; END_VAR k := k + 1; END_PROGRAM\n"
    assert [(each.path, each.reason) for each in changes(program(OLD), program(two)).lost] == [("Other", "new")]
    assert [(each.path, each.reason) for each in changes(program(two), program(OLD)).lost] == [("Other", "removed")]


def test_variables_are_counted_as_they_are_declared() -> None:
    none = "PROGRAM Main\nEND_PROGRAM\n"
    eight = none.replace(
        "\n",
        "\nVAR start AT CIO0.00 : BOOL; stop, motor, ready, full : BOOL; ton1 : TON; ctu1 : CTU; parts : INT; END_VAR\n",
        1,
    )
    both = eight + "PROGRAM Other VAR_EXTERNAL END_VAR VAR k : INT; END_VAR k := k + 1; END_PROGRAM\n"
    old, new, more = program(none), program(eight), program(both)
    counted = [changes(*each).counted for each in ((old, new), (new, new), (new, old), (new, more), (more, new))]
    assert [(each.kept, each.reinitialised, each.new, each.removed) for each in counted] == [
        (0, 0, 8, 0), (8, 0, 0, 0), (0, 0, 0, 8), (8, 0, 1, 0), (8, 0, 0, 1),
    ]  # fmt: skip


@pytest.mark.parametrize("engine", ENGINES)
def test_there_is_a_way_back(engine: EngineFactory) -> None:
    resource = plc(OLD, engine)
    resource.run(3)
    change(resource, program(NEW), engine)
    resource.run(2)
    assert (value(resource, "Main.n"), value(resource, "LIMIT"), resource.version) == (23, 6, 2)
    back = resource.submit(ProgramChange("Ada", 1))
    assert isinstance(back, Entry)
    resource.run(1)
    assert (value(resource, "Main.n"), value(resource, "LIMIT"), resource.version) == (24, 5, 1)
    assert value(resource, "Main.c.calls") == 6
    assert resource.header.scan == 6
    assert [entry.scan for entry in resource.journal] == [3, 5]


@pytest.mark.parametrize("engine", ENGINES)
def test_forces_follow_their_variables(engine: EngineFactory) -> None:
    resource = plc(OLD, engine)
    for path, text in (("Main.temp", "TRUE"), ("Main.gone", "3"), ("D9", "4"), ("Main.n", "100")):
        assert isinstance(resource.submit(Force("Ada", path, text)), Entry)
    resource.run(1)
    message = change(resource, program(NEW), engine)
    assert message.endswith("forces released: Main.gone")
    effect = resource.journal[-1].plan.effect
    assert isinstance(effect, Swapped)
    assert effect.released == ("Main.gone",)
    assert resource.journal.derived(FORCED).keys() == {"MAIN.TEMP", "D9", "MAIN.N"}
    assert len(read_table(resource.memory)) == 5
    resource.run(2)
    assert [value(resource, path) for path in ("Main.temp", "D9", "Main.n")] == [True, 4, 100]


def test_what_cannot_be_changed_to() -> None:
    resource = plc(OLD)
    other = program(OLD.replace(" AT D7", ""), "GENERIC-IEC")
    resource.programs = LoadedPrograms(
        resource.loaded, Loaded.make(program(NEW), ENGINES[0], 2), Loaded.make(other, ENGINES[0], 3)
    )
    assert "runs already" in refused(resource, ProgramChange("Ada", 1))
    assert "no program version 9; known: 1, 2, 3" in refused(resource, ProgramChange("Ada", 9))
    message = refused(resource, ProgramChange("Ada", 3))
    assert "GENERIC-IEC" in message
    assert "CJ1M-CPU63" in message
    resource.submit(SetMode("Ada", "RUN"))
    assert "MONITOR" in refused(resource, ProgramChange("Ada", 2))
    for mode in ("PROGRAM", "MONITOR"):
        resource.submit(SetMode("Ada", mode))
        assert isinstance(resource.submit(ProgramChange("Ada", 3 - resource.version)), Entry)
        assert resource.header.mode.name == mode


def test_a_trapped_program_is_replaced_in_every_mode_and_keeps_what_is_forced() -> None:
    resource = plc("PROGRAM Main\nVAR n : INT; q : INT; d : INT; END_VAR\n  n := n + 1; q := 1 / d;\nEND_PROGRAM\n")
    resource.submit(Force("Ada", "Main.n", "3"))
    resource.submit(Write("Ada", "H3", "3"))
    resource.submit(SetMode("Ada", "RUN"))
    resource.run(1)
    assert resource.header.halted_by_trap
    change(resource, program("PROGRAM Main\nVAR n : INT := 7; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"))
    assert resource.trap is None
    assert (resource.header.mode.name, resource.header.force_count, value(resource, "H3")) == ("RUN", 2, 3)
    assert resource.journal.derived(FORCED).keys() == {"MAIN.N"}
    assert value(resource, "Main.n") == 3
    resource.run(2)
    assert value(resource, "Main.n") == 3


def test_a_force_without_a_place_after_a_trap_is_released() -> None:
    resource = plc("PROGRAM Main\nVAR n : INT; q : INT; d : INT; END_VAR\n  n := n + 1; q := 1 / d;\nEND_PROGRAM\n")
    resource.submit(Force("Ada", "Main.q", "3"))
    resource.submit(Force("Ada", "Main.n", "3"))
    resource.run(1)
    message = change(resource, program("PROGRAM Main\nVAR n : INT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"))
    assert "forces released: Main.q" in message
    assert resource.journal.derived(FORCED).keys() == {"MAIN.N"}
    assert resource.header.force_count == 2


def every(interval: str, text: str = OLD) -> Program:
    configuration = f"TASK T (INTERVAL := {interval}); PROGRAM Main WITH T : Main;"
    return program(f"{text}\nCONFIGURATION C\nRESOURCE R ON P\n{configuration}\nEND_RESOURCE\nEND_CONFIGURATION\n")


def test_the_clock_of_the_plc_goes_on_when_a_scan_takes_longer() -> None:
    resource = Resource(Loaded.make(every("T#10ms"), ENGINES[0]))
    resource.run(100)
    resource.submit(SetClock("Ada", datetime(2024, 1, 1, tzinfo=UTC)))
    resource.run(1)
    change(resource, every("T#1s"))
    resource.run(1)
    start = 1_704_067_200_000_000_000
    assert resource.header.epoch_ns + resource.header.clock_ns == start + 10_000_000
    resource.run(1)
    assert resource.header.epoch_ns + resource.header.clock_ns == start + 1_010_000_000


TIMED = """
PROGRAM Main
VAR t : TON; now : LTIME; pulse : BOOL; END_VAR
  t(IN := TRUE, PT := T#10s); now := LTIME(); pulse := P_0_1s;
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("stopped", [False, True])
def test_virtual_time_goes_on_when_a_scan_takes_longer_or_shorter(engine: EngineFactory, stopped: bool) -> None:
    resource = Resource(Loaded.make(every("T#10ms", TIMED), engine))
    resource.run(100)
    ms = 1_000_000
    assert (resource.header.clock_ns, value(resource, "Main.t.ET")) == (990 * ms, 990 * ms)
    if stopped:
        resource.submit(SetMode("Ada", "PROGRAM"))
    change(resource, every("T#70ms", TIMED), engine)
    if stopped:
        resource.pass_time(1)
        assert resource.header.clock_ns == 1000 * ms
        resource.submit(SetMode("Ada", "MONITOR"))
        resource.run(1)
        assert resource.header.clock_ns == 1070 * ms
        return
    assert resource.header.next_clock_ns(70 * ms) == 1000 * ms
    seen = []
    for _ in range(3):
        resource.run(1)
        seen.append([value(resource, path) for path in ("Main.now", "Main.t.ET", "Main.pulse")])
    assert seen == [
        [1000 * ms, 1000 * ms, False], [1070 * ms, 1070 * ms, True], [1140 * ms, 1140 * ms, False],
    ]  # fmt: skip
    change(resource, every("T#5ms", TIMED), engine, 3)
    resource.run(2)
    assert (resource.header.clock_ns, value(resource, "Main.t.ET")) == (1215 * ms, 1215 * ms)
    resource.submit(Restart("Ada", "warm"))
    resource.run(1)
    assert (resource.header.clock_ns, value(resource, "Main.t.ET")) == (1220 * ms, 0)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_table_by_time_goes_on_when_a_scan_takes_longer(engine: EngineFactory) -> None:
    source = "PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
    table = "time;CIO 1\n0;16#0\nT#100ms;16#1\nT#150ms;16#2\nT#300ms;16#3\n"

    def made(interval_ns: int) -> Program:
        checked = check_sources({"main.st": source, "plant/p.csv": table}, model(), interval_ns)
        assert checked.program is not None, checked.problems
        return checked.program

    resource = Resource(Loaded.make(made(10_000_000), engine))
    resource.run(3)
    resource.submit(Restart("Ada", "cold"))
    resource.run(10)
    assert value(resource, "CIO 1") == 0
    change(resource, made(50_000_000), engine)
    seen = []
    for _ in range(5):
        resource.run(1)
        seen.append(value(resource, "CIO 1"))
    assert seen == [1, 2, 2, 2, 3]


RUNGS = """
PROGRAM Main
VAR a, b, p : BOOL; n : INT; END_VAR
RUNG
    [P a] n := ADD(EN := ~, IN1 := n, IN2 := 1)
END_RUNG
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_a_rung_more_changes_no_memory_of_the_others(engine: EngineFactory) -> None:
    resource = plc(RUNGS, engine)
    resource.submit(Write("Ada", "Main.a", "TRUE"))
    resource.run(3)
    assert value(resource, "Main.n") == 1
    # were the memory of the edge lost, `a` would count as risen once more
    change(
        resource,
        program(RUNGS.replace("RUNG\n    [P", "RUNG\n    [P b] [N p] (S p)\nEND_RUNG\nRUNG\n    [P", 1)),
        engine,
    )
    resource.run(3)
    assert value(resource, "Main.n") == 1


CHART = """
PROGRAM Main
VAR go, lamp : BOOL; n : INT; END_VAR
INITIAL_STEP Wait:
END_STEP
STEP Work:
    lamp(S);
    Count(P1);
END_STEP
ACTION Count: n := n + 1; END_ACTION
TRANSITION FROM Wait TO Work := go; END_TRANSITION
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_a_step_more_changes_no_other_step_and_no_action(engine: EngineFactory) -> None:
    resource = plc(CHART, engine)
    resource.submit(Write("Ada", "Main.go", "TRUE"))
    resource.run(3)
    time = value(resource, "Main.Work.T")
    more = "STEP Rest:\nEND_STEP\nTRANSITION FROM Work TO Rest := NOT go; END_TRANSITION\nINITIAL_STEP"
    change(resource, program(CHART.replace("INITIAL_STEP", more)), engine)
    resource.run(1)
    names = ("Main.Work.X", "Main.lamp", "Main.n")
    assert [value(resource, name) for name in names] == [1, 1, 1]
    assert str(value(resource, "Main.Work.T")) != str(time)
    resource.submit(Write("Ada", "Main.go", "FALSE"))
    resource.run(2)
    assert [value(resource, name) for name in ("Main.Work.X", "Main.Rest.X", "Main.lamp")] == [0, 1, 1]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_pointer_follows_the_bytes_that_it_sees_as_something_else(engine: EngineFactory) -> None:
    text = "PROGRAM Main\nVAR memory : ARRAY[0..9] OF ULINT; p : POINTER TO DINT; END_VAR\n"
    text += "IF p = NULL THEN p := ADR(memory[3]); END_IF\np^ := p^ + 1;\nEND_PROGRAM\n"
    resource = plc(text, engine)
    resource.run(2)
    message = change(resource, program(text.replace("VAR memory", "VAR fresh : LINT; memory")), engine)
    assert message.endswith("2 variables kept, 1 new or changed: initialised")
    resource.run(1)
    assert value(resource, "Main.memory[3]") == 3
