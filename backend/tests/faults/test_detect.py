"""Errors that the PLC finds itself: in the error memory as if they were injected, with the device's own way back."""

import pytest

from scanbench.faults.detect import Detection
from scanbench.faults.history import History
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.program.layout import Layout
from scanbench.recording.replay import replay
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.header import Halt, Mode
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.trap import Trapped
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, model, program, value

SOURCE = """
VAR_GLOBAL motor AT CIO 100.00 : BOOL; END_VAR
PROGRAM Main
VAR n : INT; which : INT; zero : INT; a : ARRAY[1..3] OF INT; r : REF_TO INT; work AT W0 : INT; kept AT D0 : INT; i : DINT; part : Part; END_VAR
  n := n + 1; motor := TRUE; work := n; kept := n;
  CASE which OF
    1: n := n / zero;
    2: a[which + 5] := 1;
    3: r^ := 1;
    4: WHILE which = 4 DO i := i + 1; END_WHILE;
    5: part();
  END_CASE;
END_PROGRAM
FUNCTION_BLOCK Part
VAR zero : INT; x : INT; END_VAR
  x := 7 / zero;
END_FUNCTION_BLOCK
"""


def plc(source: str, engine: EngineFactory = ENGINES[0], model_name: str = "CJ1M-CPU63") -> Resource:
    resource = Resource(Loaded.make(program(source, model_name), engine), detect=Detection())
    resource.memory[Layout.BUDGET_LIMIT : Layout.BUDGET_LIMIT + 8] = (1000).to_bytes(8, "little")
    return resource


def done(resource: Resource, command: Command) -> Entry:
    outcome = resource.submit(command)
    assert isinstance(outcome, Entry), outcome
    return outcome


def run_into(which: int, engine: EngineFactory = ENGINES[0]) -> Resource:
    resource = plc(SOURCE, engine)
    resource.run(5)
    done(resource, Write("Ada", "Main.which", str(which)))
    resource.run(5)
    return resource


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("which", "code", "flag", "cause"),
    [(1, 0x80F0, 9, 8), (2, 0x80F0, 9, 8), (3, 0x80F0, 9, 10), (4, 0x809F, 8, None), (5, 0x80F0, 9, 8)],
)
def test_a_trap_is_an_error_of_the_device(
    engine: EngineFactory, which: int, code: int, flag: int, cause: int | None
) -> None:
    resource = run_into(which, engine)
    assert value(resource, "A400") == code
    assert value(resource, "A401") == 1 << flag
    assert value(resource, "A402") == 0
    assert value(resource, "A295") == (1 << cause if cause is not None else 0)
    assert value(resource, "A294") == 0
    assert resource.header.scan == 5
    assert resource.header.halt == Halt.FATAL_ERROR | Halt.TRAP
    assert resource.header.mode is Mode.MONITOR
    assert [value(resource, path) for path in ("motor", "Main.work", "Main.kept")] == [False, 0, 6]
    assert [type(entry.command) for entry in resource.journal] == [Write, Trapped, Generate]
    generated = resource.journal[-1]
    assert (generated.scan, generated.command.author) == (5, "PLC")


def test_the_error_memory_has_the_task_that_ran() -> None:
    source = """
    PROGRAM Calm
    VAR n : INT; END_VAR
      n := n + 1;
    END_PROGRAM
    FUNCTION Half : INT
    VAR_INPUT by : INT; END_VAR
      Half := 1 / by;
    END_FUNCTION
    PROGRAM Wild
    VAR n : INT; by : INT := 2; END_VAR
      n := Half(by);
    END_PROGRAM
    PROGRAM Alarm
    VAR on_alarm : INT; by : INT; END_VAR
      on_alarm := 5 / by;
    END_PROGRAM
    CONFIGURATION C
      VAR_GLOBAL event : BOOL; END_VAR
      RESOURCE R ON PLC
        TASK One(INTERVAL := T#10ms, PRIORITY := 1); TASK Two(INTERVAL := T#20ms, PRIORITY := 2);
        TASK Three(SINGLE := event, PRIORITY := 0);
        PROGRAM Calm WITH One : Calm; PROGRAM Wild WITH Two : Wild; PROGRAM Alarm WITH Three : Alarm;
      END_RESOURCE
    END_CONFIGURATION
    """
    resource = plc(source)
    resource.run(3)
    done(resource, Write("Ada", "Wild.by", "0"))
    resource.run(5)
    assert resource.trap is not None
    assert (value(resource, "A294"), value(resource, "A401")) == (1, 1 << 9)
    again = plc(source)
    done(again, Write("Ada", "event", "TRUE"))
    again.run(5)
    assert (value(again, "A294"), value(again, "A401")) == (0x8000, 1 << 9)


def test_the_way_back_from_an_error_of_its_own() -> None:
    resource = run_into(1)
    assert isinstance(resource.submit(SetMode("Ada", "MONITOR")), Refusal)
    message = done(resource, Recover("Ada", ("program-error",))).plan.message
    assert "stays stopped" in message
    assert (resource.header.mode, resource.header.halt, resource.trap) == (Mode.PROGRAM, Halt.NONE, None)
    assert [value(resource, word) for word in ("A400", "A401", "A295")] == [0, 0, 0]
    done(resource, Write("Ada", "Main.which", "0"))
    done(resource, SetMode("Ada", "MONITOR"))
    assert resource.header.started == 5
    resource.run(3)
    assert (resource.header.scan, value(resource, "motor")) == (8, True)


def test_program_mode_ends_the_trap_but_not_the_error() -> None:
    resource = run_into(1)
    done(resource, SetMode("Ada", "PROGRAM"))
    assert (resource.header.halt, resource.trap) == (Halt.FATAL_ERROR, None)
    refusal = resource.submit(SetMode("Ada", "RUN"))
    assert isinstance(refusal, Refusal)
    assert "fatal error" in refusal.message
    done(resource, Recover("Ada", None))
    done(resource, Write("Ada", "Main.which", "0"))
    done(resource, SetMode("Ada", "RUN"))
    resource.run(1)
    assert resource.header.scan == 6


def test_a_second_fatal_error_keeps_it_stopped() -> None:
    resource = run_into(1)
    done(resource, Generate("Ada", (ErrorRef("memory-error"),)))
    done(resource, Recover("Ada", ("program-error",)))
    assert (resource.header.halt, resource.header.mode) == (Halt.FATAL_ERROR, Mode.MONITOR)
    done(resource, Recover("Ada", ("memory-error",)))
    assert (resource.header.halt, resource.header.mode) == (Halt.NONE, Mode.PROGRAM)


@pytest.mark.parametrize("which", [1, 4])
def test_the_trap_ends_with_its_error_although_somebody_raised_that_again(which: int) -> None:
    resource = run_into(which)
    found = resource.journal[-1].command
    assert isinstance(found, Generate)
    done(resource, Generate("Ada", (ErrorRef(found.errors[0].id),), again=True))
    message = done(resource, Recover("Ada", None)).plan.message
    assert message.endswith("; the program stays stopped: change to MONITOR or RUN, or restart")
    assert (resource.header.mode, resource.header.halt, resource.trap) == (Mode.PROGRAM, Halt.NONE, None)
    done(resource, Write("Ada", "Main.which", "0"))
    done(resource, SetMode("Ada", "MONITOR"))


def test_a_recovery_says_what_keeps_the_program_stopped() -> None:
    resource = run_into(1)
    done(resource, Generate("Ada", (ErrorRef("memory-error"), ErrorRef("io-bus-error"))))
    message = done(resource, Recover("Ada", ("program-error",))).plan.message
    assert message == "recovered program-error; the program stays stopped: memory-error, io-bus-error are still present"
    other = Resource(Loaded.make(program(SOURCE), ENGINES[0]))  # nobody raises the error of a trap there
    done(other, Write("Ada", "Main.which", "1"))
    other.run(1)
    done(other, Generate("Ada", (ErrorRef("memory-error"),)))
    message = done(other, Recover("Ada", None)).plan.message
    assert message.startswith("recovered memory-error; the program stays stopped: main.st:7")
    assert message.endswith("Change to PROGRAM, or restart")
    assert other.header.halt == Halt.TRAP


def test_recovering_an_error_of_somebody_else_leaves_the_trap() -> None:
    resource = run_into(1)
    done(resource, Generate("Ada", (ErrorRef("battery-error"),)))
    done(resource, Recover("Ada", ("battery-error",)))
    assert resource.trap is not None
    assert resource.header.halt == Halt.FATAL_ERROR | Halt.TRAP


@pytest.mark.parametrize("kind", ["cold", "warm", "power"])
def test_a_restart_takes_the_error_back(kind: str) -> None:
    resource = run_into(1)
    done(resource, Restart("Ada", kind))  # type: ignore[arg-type]
    assert [value(resource, word) for word in ("A400", "A401", "A295")] == [0, 0, 0]
    assert value(resource, "A300") == (0 if kind == "cold" else 1)  # the device keeps its log without power
    assert value(resource, "A100") == (0 if kind == "cold" else 0x80F0)
    assert resource.runnable
    done(resource, Generate("Ada", (ErrorRef("program-error"),)))  # it is not present any more


def test_the_history_says_who_found_it() -> None:
    resource = run_into(4)
    done(resource, Restart("Ada", "power"))
    history = History(model())
    for entry in resource.journal:  # as the session hears of them
        history.fold(entry)
    row = next(row for row in history.rows if row.id == "cycle-time-over")
    assert (row.origin, row.by, row.count, row.status) == ("plc", "PLC", 1, "cleared")
    assert (row.generated_scan, row.recovered_scan, row.code) == (5, 5, "809F")
    assert {row.status for row in history.rows if row.id != "cycle-time-over"} == {"never"}


def test_a_replay_asks_nobody() -> None:
    resource = run_into(3)
    done(resource, Recover("Ada", None))
    done(resource, Write("Ada", "Main.which", "0"))
    done(resource, SetMode("Ada", "RUN"))
    resource.run(10)
    again = plc(SOURCE, ENGINES[1])
    replay(again, resource.journal, 15)
    assert again.state == resource.state


def test_a_model_that_tells_no_such_error_only_traps() -> None:
    resource = Resource(Loaded.make(program(SOURCE), ENGINES[0]))
    done(resource, Write("Ada", "Main.which", "1"))
    resource.run(1)
    assert [type(entry.command) for entry in resource.journal] == [Write, Trapped]
