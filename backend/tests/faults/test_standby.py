"""A device of two CPU Units: for some fatal errors the standby takes over, and the program goes on."""

import pytest

from scanbench.engines.native.observed import ObservedBuilds
from scanbench.faults.clear import ClearErrors
from scanbench.faults.detect import Detection
from scanbench.faults.device import read_device
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.reaction.reaction import Reaction, Verdict
from scanbench.faults.reference import ErrorRef
from scanbench.faults.schedule import Schedule
from scanbench.recording.replay import replay
from scanbench.runtime.command import Command, Entry, Refusal, RestartKind
from scanbench.runtime.header import Halt
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from tests.faults.reacting import MAKES, attempt, checked
from tests.runtime.bench import ENGINES, plc, program, value

MODEL = "CS1D-CPU65H"
SOURCE = """
PROGRAM Main
VAR n, simplex : INT; d : INT := 1; alarm : BOOL; lamp AT CIO 100.00 : BOOL; duplex AT A328.08 : BOOL; right AT A328.10 : BOOL; END_VAR
  n := n + 10 / d;
  lamp := TRUE;
  IF NOT duplex AND right THEN simplex := simplex + 1; END_IF;
  IF alarm THEN FALS(7); END_IF;
END_PROGRAM
"""
MEMORY, FALS, BUS, SETTING = "memory-error", "fals", "io-bus-error", "io-setting-error"
SWITCHING = ("memory-error", "program-error", "cycle-time-over", "fals", "fatal-inner-board-error")
SIMPLEX = "the standby takes over: simplex, the right CPU Unit controls"


def raised(*ids: str) -> Generate:
    return Generate("Ada", tuple(map(ErrorRef, ids)))


def ran(*commands: Command | int, engine: EngineFactory = ENGINES[0]) -> Resource:
    """Commands, and so many scans between them."""
    loaded = Loaded.make(program(SOURCE, MODEL), engine)
    resource = Resource(loaded, detect=Detection(), agenda=Schedule(ObservedBuilds(None).engine))
    for each in commands:
        if isinstance(each, int):
            (resource.run if resource.runnable else resource.idle)(each)
        else:
            assert isinstance(resource.submit(each), Entry)
    return resource


def message(resource: Resource) -> str:
    return resource.journal[-1].plan.message


def status(resource: Resource) -> tuple[object, ...]:
    """Duplex, this CPU Unit controls, and it is the right one."""
    return tuple(value(resource, f"A328.{bit:02}") for bit in (8, 9, 10))


def test_at_the_start_both_run_and_the_left_one_controls() -> None:
    assert status(ran()) == status(ran(3)) == (True, True, False)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("error", SWITCHING)
def test_the_standby_goes_on_in_the_same_scan(error: str, engine: EngineFactory) -> None:
    resource = ran(5, raised(error), 3, engine=engine)
    assert resource.runnable
    assert (value(resource, "Main.n"), value(resource, "Main.simplex")) == (80, 3)
    assert value(resource, "CIO 100.00") is True
    assert status(resource) == (False, True, True)
    assert message(resource).endswith(SIMPLEX)
    assert value(resource, "A300") == 1


def test_cause_and_time_say_why_and_when() -> None:
    resource = ran(5, raised(FALS))
    assert [bit for bit in range(16) if value(resource, f"A023.{bit:02}")] == [4]
    assert [value(resource, f"A{word:03}") for word in (24, 25, 26)] == [0x0000, 0x0100, 0x0001]  # 2000-01-01 00:00:00
    resource = ran(5, raised(FALS), 5, Recover("Ada", None), 395, raised(MEMORY))
    assert [bit for bit in range(16) if value(resource, f"A023.{bit:02}")] == [10]
    assert value(resource, "A024") == 0x0004


def test_flags_details_and_log_are_those_of_the_error() -> None:
    resource = ran(5, raised(MEMORY), 3)
    assert (value(resource, "A400"), value(resource, "A401.15"), value(resource, "A403.00")) == (0x80F1, True, True)
    assert (value(resource, "A100"), value(resource, "A101")) == (0x80F1, 1)


@pytest.mark.parametrize("engine", ENGINES)
def test_the_second_one_stops_the_program(engine: EngineFactory) -> None:
    resource = ran(5, raised(MEMORY), 3, raised(FALS), 3, engine=engine)
    assert resource.header.halt == Halt.FATAL_ERROR
    assert value(resource, "Main.n") == 80
    assert status(resource) == (False, True, True)
    assert [bit for bit in range(16) if value(resource, f"A023.{bit:02}")] == [10]
    assert value(resource, "A300") == 2


def test_what_the_standby_took_over_for_may_change_its_details() -> None:
    again = Generate("Ada", (ErrorRef(MEMORY, (("location", "flash-memory"),)),), again=True)
    resource = ran(5, raised(MEMORY), 3, again, 3)
    assert (resource.runnable, value(resource, "Main.n")) == (True, 110)
    assert status(resource) == (False, True, True)
    assert (value(resource, "A403.00"), value(resource, "A403.10")) == (False, True)
    assert ran(5, raised(MEMORY), 3, again, 3, Recover("Ada", (MEMORY,)), 1).runnable


def test_all_that_is_recovered_without_names_repairs_too() -> None:
    """Also while something else is present."""
    resource = ran(5, raised(MEMORY), ClearErrors("Tool", "all"), raised("battery-error"), Recover("Ada", None))
    assert status(resource) == (True, True, True)
    assert message(resource) == "recovered battery-error; duplex again, the right CPU Unit controls"


@pytest.mark.parametrize("error", [BUS, SETTING, "too-many-io", "duplicated-unit-number", "duplicated-rack-number"])
def test_what_concerns_both_stops_it(error: str) -> None:
    resource = ran(5, raised(error), 3)
    assert not resource.runnable
    assert status(resource) == (True, True, False)


def test_together_with_one_that_stops_it_nobody_takes_over() -> None:
    resource = ran(5, raised(MEMORY, BUS))
    assert not resource.runnable
    assert status(resource) == (True, True, False)


def test_two_at_once_are_one_change() -> None:
    resource = ran(5, raised(MEMORY, FALS, "battery-error"), 3)
    assert resource.runnable
    assert [bit for bit in range(16) if value(resource, f"A023.{bit:02}")] == [4, 10]
    resource.submit(Recover("Ada", ("battery-error",)))
    assert status(resource)[0] is False


def test_what_stopped_it_goes_and_what_the_standby_survived_stays() -> None:
    resource = ran(5, raised(MEMORY), 3, raised(BUS), Recover("Ada", (BUS,)))
    assert resource.header.halt == Halt.NONE
    present = resource.journal.derived(ACTIVE)
    assert set(present) == {MEMORY}
    assert status(resource)[0] is False


def test_recovered_the_failed_one_is_the_standby_again() -> None:
    resource = ran(5, raised(MEMORY), 3, Recover("Ada", (MEMORY,)), 3)
    assert status(resource) == (True, True, True)
    assert message(resource) == "recovered memory-error; duplex again, the right CPU Unit controls"
    resource.submit(raised(FALS))
    assert status(resource) == (False, True, False)
    assert resource.runnable


def test_cleared_by_a_tool_it_stays_out_of_order() -> None:
    resource = ran(5, raised(MEMORY), 3, ClearErrors("Bob", "all"), 3)
    assert resource.journal.derived(ACTIVE) == {}
    assert status(resource) == (False, True, True)
    assert not isinstance(resource.submit(Recover("Ada", None)), Refusal)
    assert message(resource) == "duplex again, the right CPU Unit controls"
    assert status(resource) == (True, True, True)
    resource.submit(Recover("Ada", None))
    assert message(resource) == "no error is generated"


def test_both_failed_and_both_repaired() -> None:
    resource = ran(5, raised(MEMORY), 3, raised(FALS), Recover("Ada", None))
    assert resource.header.halt == Halt.NONE
    assert status(resource) == (True, True, True)


def test_what_the_program_itself_runs_into_happens_in_both() -> None:
    for command in (Write("Ada", "Main.d", "0"), Write("Ada", "Main.alarm", "TRUE")):
        resource = ran(5, command, 3)
        assert resource.trap is not None
        assert status(resource) == (True, True, False)


@pytest.mark.parametrize("kind", ["cold", "warm", "power"])
def test_a_restart_begins_with_both(kind: RestartKind) -> None:
    resource = ran(5, raised(MEMORY), 3, Restart("Bob", kind), 3)
    assert status(resource) == (True, True, False)
    assert value(resource, "A023") == 0


def test_a_cause_that_lasts_is_there_at_once() -> None:
    board = "fatal-inner-board-error"
    resource = ran(5, raised(board), 3, Restart("Bob", "power"), 3)
    assert resource.runnable
    assert status(resource) == (False, True, True)


def test_a_device_of_one_cpu_stops() -> None:
    resource = plc("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM", model_name="CS1H-CPU65H")
    resource.submit(raised(MEMORY))
    assert not resource.runnable


COMMANDS = (5, raised(MEMORY), 3, Recover("Ada", (MEMORY,)), 4, raised(FALS), 2, ClearErrors("Bob", "all"), 2)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("parts", [1, 3, 5, 7])
def test_a_replay_from_any_state_ends_in_the_same_bytes(parts: int, engine: EngineFactory) -> None:
    whole, part = ran(*COMMANDS, engine=engine), ran(*COMMANDS[:parts], engine=engine)
    again = Resource(Loaded.make(program(SOURCE, MODEL), engine))
    again.restore(again.loaded, part.state, Journal(part.journal))
    replay(again, whole.journal[len(part.journal) :], whole.header.scan)
    assert again.state == whole.state
    assert again.journal.derived(ACTIVE) == whole.journal.derived(ACTIVE)


def test_both_engines_agree() -> None:
    states = {ran(*COMMANDS, engine=engine).state for engine in ENGINES}
    assert len(states) == 1


PROGRAMS: tuple[tuple[str, str, Verdict], ...] = (
    ("IF NOT %A328.08 THEN %QX0.0 := TRUE; END_IF;", MEMORY, "acted"),
    ("IF %A401.15 THEN %QX0.0 := TRUE; END_IF;", MEMORY, "acted"),
    ("IF %A023.10 THEN %QX0.0 := TRUE; END_IF;", MEMORY, "acted"),
    ("%D100 := %A328;", MEMORY, "displayed"),
    ("IF NOT %A328.08 THEN ; END_IF;", MEMORY, "no_effect"),
    ("IF %A24 = 16#FFFF THEN %QX0.0 := TRUE; END_IF;", MEMORY, "no_effect"),
    ("n := n + 1;", MEMORY, "never_read"),
    ("IF %A023.04 THEN %QX0.0 := TRUE; END_IF;", MEMORY, "never_read"),
    ("IF NOT %A328.08 THEN %QX0.0 := TRUE; END_IF;", BUS, "stopped"),
)


@pytest.mark.parametrize("make", MAKES)
@pytest.mark.parametrize(("body", "error", "verdict"), PROGRAMS)
def test_the_reaction_of_the_program_is_graded(body: str, error: str, verdict: Verdict, make: str) -> None:
    code = checked({"main.st": f"PROGRAM Main VAR n : INT; END_VAR {body} END_PROGRAM"}, MODEL)
    found = attempt(code, (error,), MAKES[make])
    assert isinstance(found, Reaction)
    assert found.verdict == verdict


def test_the_devices_own_view_says_who_controls() -> None:
    resource = ran(5, raised(MEMORY), 3)
    shown = read_device(resource.view)
    assert [(each.id, each.severity, each.code) for each in shown.errors] == [(MEMORY, "fatal", "80F1")]
    assert shown.standby is not None
    assert (shown.standby.duplex, shown.standby.side, shown.standby.causes) == (False, "right", (MEMORY,))
    assert shown.standby.time == "2000-01-01 00:00:00"
    before = read_device(ran(5).view).standby
    assert before is not None
    assert (before.duplex, before.side, before.causes, before.time) == (True, "left", (), "")
    assert read_device(plc("PROGRAM Main VAR n : INT; END_VAR n := 1; END_PROGRAM").view).standby is None
