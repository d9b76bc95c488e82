"""What each mode permits, and what starting and stopping do to memory."""

from datetime import UTC, datetime

import pytest

from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.program.layout import Layout
from scanbench.runtime.clear_violations import ClearViolations
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.header import Mode
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.rights import Right, may
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, plc, value

SOURCE = """
VAR_GLOBAL input AT CIO 0.00 : BOOL; motor AT CIO 100.00 : BOOL; END_VAR
PROGRAM Main
VAR n : INT; work AT W0 : INT; timer AT T0 : WORD; inner AT CIO 2000 : INT; kept AT D0 : INT; held AT H0 : INT; first AT A200.11 : BOOL;
  starts : INT; END_VAR
  IF first THEN starts := starts + 1; END_IF;
  n := n + 1; motor := TRUE; work := n; timer := INT_TO_WORD(n); inner := n; kept := n; held := n;
END_PROGRAM
"""
IN_RUN_TOO = {"mode", "restart", "generate", "recover", "clock", "diagnostics"}
COMMANDS: dict[str, Command] = {
    "write": Write("Ada", "Main.kept", "1"),
    "force": Force("Ada", "Main.kept", "1"),
    "release": Release("Ada", None),
    "mode": SetMode("Ada", "MONITOR"),
    "restart": Restart("Ada", "warm"),
    "generate": Generate("Ada", (ErrorRef("battery-error"),)),
    "recover": Recover("Ada", None),
    "clock": SetClock("Ada", datetime(2024, 2, 28, tzinfo=UTC)),
    "diagnostics": ClearViolations("Ada"),
}


def done(resource: Resource, command: Command) -> Entry:
    outcome = resource.submit(command)
    assert isinstance(outcome, Entry), outcome
    return outcome


def words(resource: Resource, *paths: str) -> list[object]:
    return [value(resource, path) for path in paths]


@pytest.mark.parametrize("mode", ["PROGRAM", "MONITOR", "RUN"])
@pytest.mark.parametrize("name", COMMANDS)
def test_what_a_mode_permits(mode: str, name: str) -> None:
    resource = plc(SOURCE)
    done(resource, SetMode("Ada", mode))
    before = bytes(resource.memory)
    outcome = resource.submit(COMMANDS[name])
    if mode != "RUN" or name in IN_RUN_TOO:
        assert isinstance(outcome, Entry), outcome
    else:
        assert isinstance(outcome, Refusal)
        assert "RUN mode" in outcome.message
        assert "change to MONITOR" in outcome.message
        assert bytes(resource.memory) == before


def test_the_table_of_rights() -> None:
    permitted = {
        Mode.PROGRAM: {"write", "force", "transfer a program", "change the mode", "clear errors", "restart"},
        Mode.MONITOR: {"write", "force", "change the program", "change the mode", "clear errors", "restart"},
        Mode.RUN: {"change the mode", "clear errors", "restart"},
    }
    for mode, rights in permitted.items():
        assert {right.value for right in Right if may(mode, right) is None} == rights
    refused = may(Mode.MONITOR, Right.TRANSFER)
    assert refused is not None
    assert refused.message == "MONITOR mode does not permit it: change to PROGRAM to transfer a program"


@pytest.mark.parametrize("engine", ENGINES)
def test_stopping_and_starting_clear_what_is_volatile(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    done(resource, Write("Ada", "input", "TRUE"))
    resource.run(5)
    done(resource, SetMode("Ada", "PROGRAM"))
    assert words(resource, "motor", "Main.work", "Main.timer", "Main.inner") == [False, 0, 0, 0]
    assert words(resource, "input", "Main.kept", "Main.held", "Main.n") == [True, 5, 5, 5]
    done(resource, Write("Ada", "Main.work", "7"))
    done(resource, SetMode("Ada", "RUN"))
    assert words(resource, "Main.work", "input", "Main.n") == [0, True, 5]
    assert resource.header.started == 5


@pytest.mark.parametrize("engine", ENGINES)
def test_the_first_cycle_flag_after_each_start(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    resource.run(3)
    assert value(resource, "Main.starts") == 1
    done(resource, SetMode("Ada", "RUN"))  # from MONITOR: it goes on
    resource.run(3)
    assert value(resource, "Main.starts") == 1
    done(resource, SetMode("Ada", "PROGRAM"))
    resource.pass_time(10)
    done(resource, SetMode("Ada", "MONITOR"))
    assert resource.header.started == 16
    resource.run(3)
    assert value(resource, "Main.starts") == 2
    assert value(resource, "Main.first") is False


def test_between_monitor_and_run_nothing_changes() -> None:
    resource = plc(SOURCE)
    resource.run(5)
    before = bytearray(resource.memory)
    for mode in (Mode.RUN, Mode.MONITOR):
        done(resource, SetMode("Ada", mode.name))
        before[Layout.MODE] = mode
        assert resource.memory == before


def test_the_hold_bit_keeps_memory_and_outputs() -> None:
    resource = plc(SOURCE)
    done(resource, Write("Ada", "A500.12", "TRUE"))
    resource.run(5)
    for mode in ("PROGRAM", "MONITOR"):
        done(resource, SetMode("Ada", mode))
        assert words(resource, "motor", "Main.work", "Main.inner") == [True, 5, 5]


def test_what_is_forced_keeps_its_value() -> None:
    resource = plc(SOURCE)
    done(resource, Force("Ada", "motor", "TRUE"))
    done(resource, Force("Ada", "Main.work", "-2"))
    resource.run(1)
    for mode in ("PROGRAM", "RUN"):
        done(resource, SetMode("Ada", mode))
        assert words(resource, "motor", "Main.work") == [True, -2]


def test_a_model_without_volatile_areas_switches_its_outputs_off() -> None:
    source = "PROGRAM Main\nVAR n AT %MW0 : INT; q AT %QX0.0 : BOOL; END_VAR\nn := n + 1; q := TRUE;\nEND_PROGRAM\n"
    resource = plc(source, model_name="GENERIC-IEC")
    resource.run(4)
    done(resource, SetMode("Ada", "PROGRAM"))
    assert words(resource, "Main.q", "Main.n") == [False, 4]
    done(resource, SetMode("Ada", "MONITOR"))
    resource.run(1)
    assert words(resource, "Main.q", "Main.n") == [True, 5]


def test_the_same_mode_again_does_nothing() -> None:
    resource = plc(SOURCE)
    resource.run(2)
    before = bytes(resource.memory)
    assert done(resource, SetMode("Ada", "MONITOR")).plan.message == "already in MONITOR"
    assert bytes(resource.memory) == before
    refusal = resource.submit(SetMode("Ada", "run"))
    assert isinstance(refusal, Refusal)
    assert refusal.near == ("PROGRAM", "MONITOR", "RUN")
