"""Cold, warm, power: what each keeps, against what is written down here by hand."""

from datetime import UTC, datetime

import pytest

from scanbench.faults.inject import Generate
from scanbench.faults.reference import ErrorRef
from scanbench.program.layout import Layout
from scanbench.runtime.command import Command, Entry, Refusal, RestartKind
from scanbench.runtime.forces import FORCED, Force
from scanbench.runtime.header import DEFAULT_EPOCH, Mode
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, plc, value

SOURCE = """
VAR_GLOBAL RETAIN kept_global : INT := 3; END_VAR
VAR_GLOBAL PERSISTENT kept_always : INT := 3; END_VAR
VAR_GLOBAL lost_global : INT := 3; on_d AT D10 : INT := 3; END_VAR
TYPE Pair : STRUCT a : INT := 3; b : INT; END_STRUCT; END_TYPE
FUNCTION_BLOCK Inner
VAR plain : INT := 3; END_VAR
VAR RETAIN own : INT := 3; END_VAR
  plain := plain; own := own;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Counter
VAR plain : INT := 3; inner : Inner; END_VAR
VAR NON_RETAIN never : INT := 3; END_VAR
VAR RETAIN always : INT := 3; END_VAR
  plain := plain; inner();
END_FUNCTION_BLOCK
FUNCTION_BLOCK Kept
VAR plain : INT := 3; END_VAR
VAR NON_RETAIN never : INT := 3; END_VAR
VAR PERSISTENT always : INT := 3; END_VAR
  plain := plain;
END_FUNCTION_BLOCK
PROGRAM Main
VAR RETAIN n : INT := 3; pair : Pair; list : ARRAY[0..2] OF INT := [3(3)]; c : Counter; cs : ARRAY[1..2] OF Counter; END_VAR
VAR PERSISTENT p : INT := 3; pc : Kept; END_VAR
VAR RETAIN PERSISTENT pr : INT := 3; END_VAR
VAR m : INT := 3; d : Counter; END_VAR
VAR NON_RETAIN z : INT := 3; END_VAR
  c(); d(); pc(); cs[1](); m := m;
END_PROGRAM
"""
RETAINED = (
    "kept_global", "Main.n", "Main.p", "Main.pair.a", "Main.list[1]", "Main.c.plain", "Main.c.always", "Main.c.inner.own",
    "Main.cs[2].plain", "Main.d.always", "Main.d.inner.own", "kept_always", "Main.pc.plain", "Main.pc.always", "Main.pr",
)  # fmt: skip
INITIAL = (
    "lost_global", "Main.m", "Main.z", "Main.c.never", "Main.c.inner.plain", "Main.d.plain", "Main.d.never", "Main.d.inner.plain",
    "Main.pc.never", "Main.cs[2].never", "Main.cs[1].inner.plain",
)  # fmt: skip
PERSISTENT = ("kept_always", "Main.p", "Main.pc.plain", "Main.pc.always", "Main.pr")
RETAINED_WORDS, VOLATILE_WORDS, SYSTEM_WORDS = ("D20", "H5"), ("W7", "CIO 3000"), ("A400", "A402")


def done(resource: Resource, command: Command) -> Entry:
    outcome = resource.submit(command)
    assert isinstance(outcome, Entry), outcome
    return outcome


def used(engine: EngineFactory, *more: Command) -> Resource:
    """A PLC whose every variable and word is 77, with a battery error, at scan 5."""
    resource = plc(SOURCE, engine)
    resource.run(5)
    for path in (*RETAINED, *INITIAL, *RETAINED_WORDS, *VOLATILE_WORDS, "on_d", "CIO 0"):
        done(resource, Write("Ada", path, "77"))
    for command in (Generate("Ada", (ErrorRef("battery-error"),)), *more):
        done(resource, command)
    assert value(resource, "A400") == 0xF7
    return resource


def values(resource: Resource, *paths: str) -> set[object]:
    return {value(resource, path) for path in paths}


@pytest.mark.parametrize("engine", ENGINES)
def test_a_cold_start_begins_with_nothing_but_time(engine: EngineFactory) -> None:
    resource = used(engine, Force("Ada", "Main.m", "9"), SetClock("Ada", datetime(2024, 2, 28, tzinfo=UTC)))
    epoch = resource.header.epoch_ns
    done(resource, Restart("Ada", "cold"))
    assert values(resource, *(path for path in RETAINED if path not in PERSISTENT), *INITIAL, "on_d") == {3}
    assert values(resource, *PERSISTENT) == {77}
    assert values(resource, *RETAINED_WORDS, *VOLATILE_WORDS, *SYSTEM_WORDS, "A300", "CIO 0") == {0}
    assert (resource.header.scan, resource.header.started) == (5, 5)
    assert resource.header.epoch_ns == epoch
    assert not resource.journal.derived(FORCED)
    assert resource.header.force_count == 0
    resource.run(1)
    assert resource.header.scan == 6
    assert value(resource, "Main.m") == 3


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("kind", ["warm", "power"])
def test_what_is_retained_is_kept(engine: EngineFactory, kind: RestartKind) -> None:
    resource = used(engine)
    done(resource, Restart("Ada", kind))
    assert values(resource, *RETAINED, *RETAINED_WORDS, "on_d") == {77}
    assert values(resource, *INITIAL) == {3}
    assert values(resource, *VOLATILE_WORDS, *SYSTEM_WORDS) == {0}
    assert value(resource, "CIO 0") == 77  # an input: it is wired
    assert (value(resource, "A300"), value(resource, "A100")) == (1, 0xF7)  # the log
    assert (resource.header.scan, resource.header.started) == (5, 5)


@pytest.mark.parametrize("kind", ["warm", "power"])
def test_the_hold_bit_keeps_what_is_volatile(kind: RestartKind) -> None:
    resource = used(ENGINES[0], Write("Ada", "A500.12", "TRUE"))
    done(resource, Restart("Ada", kind))
    assert values(resource, *VOLATILE_WORDS, *RETAINED_WORDS) == {77}
    assert values(resource, *INITIAL) == {3}
    assert values(resource, *SYSTEM_WORDS) == {0}
    assert value(resource, "A500.12") is True


def test_forces_hold_over_a_warm_start_alone() -> None:
    resource = used(ENGINES[0], Force("Ada", "Main.m", "9"), Force("Bob", "W7", "8"))
    done(resource, Restart("Ada", "warm"))
    assert [value(resource, path) for path in ("Main.m", "W7")] == [9, 8]  # at once
    assert resource.journal.derived(FORCED).keys() == {"MAIN.M", "W7"}
    done(resource, Restart("Ada", "power"))
    assert [value(resource, path) for path in ("Main.m", "W7")] == [3, 0]
    assert not resource.journal.derived(FORCED)
    assert not any(resource.memory[Layout.FORCE_COUNT : Layout.FORCES + 8 * Layout.FORCE_LIMIT])


@pytest.mark.parametrize("kind", ["cold", "warm", "power"])
@pytest.mark.parametrize(("before", "after"), [("RUN", Mode.RUN), ("MONITOR", Mode.MONITOR), ("PROGRAM", Mode.MONITOR)])
def test_it_runs_afterwards(kind: RestartKind, before: str, after: Mode) -> None:
    resource = plc(SOURCE)
    done(resource, SetMode("Ada", before))
    done(resource, Restart("Ada", kind))
    assert resource.header.mode is after
    assert resource.runnable


@pytest.mark.parametrize("kind", ["cold", "warm", "power"])
def test_a_fatal_error_and_a_trap_are_over(kind: RestartKind) -> None:
    resource = plc("PROGRAM Main\nVAR q : INT; d : INT; END_VAR\n  q := 1 / d;\nEND_PROGRAM\n")
    resource.run(1)
    done(resource, Generate("Ada", (ErrorRef("memory-error"),)))
    assert resource.header.halted_by_trap
    done(resource, Restart("Ada", kind))
    assert resource.trap is None
    assert resource.runnable
    assert value(resource, "A401") == 0


def test_there_is_no_other_kind() -> None:
    refusal = plc(SOURCE).submit(Restart("Ada", "hot"))  # type: ignore[arg-type]
    assert isinstance(refusal, Refusal)
    assert refusal.near == ("cold", "warm", "power")


def test_the_clock_is_set_for_the_next_scan_and_goes_on_with_virtual_time() -> None:
    resource = plc(SOURCE)
    assert resource.header.epoch_ns == DEFAULT_EPOCH
    resource.run(250)
    at = datetime(2024, 2, 29, 23, 59, 58, 500_000, tzinfo=UTC)
    assert "2024-02-29T23:59:58.500Z" in done(resource, SetClock("Ada", at)).plan.message
    resource.run(1)
    assert resource.header.epoch_ns + resource.header.clock_ns == 1_709_251_198_500_000_000
    resource.run(100)
    assert resource.header.epoch_ns + resource.header.clock_ns == 1_709_251_199_500_000_000
    for year in (1969, 2200):
        refusal = resource.submit(SetClock("Ada", datetime(year, 12, 31, tzinfo=UTC)))
        assert isinstance(refusal, Refusal)
        assert "1970 to 2199" in refusal.message


@pytest.mark.parametrize("engine", ENGINES)
def test_an_instance_of_a_program_can_be_retained(engine: EngineFactory) -> None:
    tasks = "TASK T (INTERVAL := T#10ms); PROGRAM RETAIN a WITH T : P; PROGRAM b WITH T : P; PROGRAM NON_RETAIN c WITH T : P;"
    resource = plc(
        "PROGRAM P VAR n : INT; END_VAR VAR NON_RETAIN z : INT; END_VAR n := n + 1; z := n; END_PROGRAM\n"
        f"CONFIGURATION C RESOURCE R ON PLC {tasks} END_RESOURCE END_CONFIGURATION",
        engine,
    )
    resource.run(4)
    done(resource, Restart("Ada", "warm"))
    assert [value(resource, path) for path in ("a.n", "b.n", "c.n", "a.z")] == [4, 0, 0, 0]


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("kind", ["warm", "power"])
def test_a_chart_that_is_retained_goes_on_where_it_was(engine: EngineFactory, kind: RestartKind) -> None:
    resource = plc(
        """FUNCTION_BLOCK Press
VAR_OUTPUT n : INT; END_VAR
INITIAL_STEP Up: END_STEP
STEP Down: Count(N); END_STEP
TRANSITION FROM Up TO Down := TRUE; END_TRANSITION
TRANSITION FROM Down TO Up := Down.T >= T#50ms; END_TRANSITION
ACTION Count: n := n + 1; END_ACTION
END_FUNCTION_BLOCK
PROGRAM Main
VAR RETAIN kept : Press; END_VAR
VAR lost : Press; END_VAR
kept(); lost();
END_PROGRAM""",
        engine,
    )
    resource.run(4)
    done(resource, Restart("Ada", kind))
    resource.run(1)
    shown = [f"Main.{name}.{what}" for name in ("kept", "lost") for what in ("Up.X", "Down.X", "n")]
    assert [value(resource, path) for path in shown] == [False, True, 4, False, True, 0]
    resource.run(2)
    assert [value(resource, path) for path in shown] == [True, False, 6, False, True, 2]
