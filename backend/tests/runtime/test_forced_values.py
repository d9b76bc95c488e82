"""The order of forces: what the program, another task and a reader between two scans see, and what a force had to hold down."""

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.runtime.command import Entry
from scanbench.runtime.forces import Force, ForcedValue, Release, forced_values
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, model, value

SOURCES = {
    "main.st": """
VAR_GLOBAL level AT D100 : INT; lamp AT CIO 100.03 : BOOL; sensor AT CIO 0.00 : BOOL; END_VAR
PROGRAM Main
VAR seen, seen_again, n : INT; saw_sensor : BOOL; END_VAR
  n := n + 1; seen := level; level := level + n; seen_again := level; lamp := n MOD 2 = 0; saw_sensor := sensor;
END_PROGRAM
PROGRAM Other
VAR seen : INT; END_VAR
  seen := level; level := 1000;
END_PROGRAM
CONFIGURATION C
  TASK Fast(INTERVAL := T#10ms, PRIORITY := 1);
  TASK Slow(INTERVAL := T#20ms, PRIORITY := 2);
  PROGRAM Main WITH Fast : Main;
  PROGRAM Other WITH Slow : Other;
END_CONFIGURATION
""",
    "plant/input.st": "PROGRAM Input VAR k : INT; END_VAR k := k + 1; sensor := k MOD 2 = 1; END_PROGRAM",
}


def plc(engine: EngineFactory) -> Resource:
    checked = check_sources(SOURCES, model())
    assert checked.program is not None, checked.problems
    return Resource(Loaded.make(checked.program, engine))


def done(resource: Resource, command: Write | Force | Release | Restart) -> None:
    outcome = resource.submit(command)
    assert isinstance(outcome, Entry), outcome


def forced(resource: Resource, path: str) -> tuple[str, str, str]:
    found = next(each for each in forced_values(resource.view) if each.path == path)
    return found.before, found.after_program, found.after


@pytest.mark.parametrize("engine", ENGINES)
def test_who_sees_what_before_while_and_after(engine: EngineFactory) -> None:
    resource = plc(engine)
    resource.run(1)  # scan 0: both tasks
    assert (value(resource, "level"), value(resource, "Main.seen"), value(resource, "Other.seen")) == (1000, 0, 1)
    done(resource, Force("Ada", "level", "50"))
    assert value(resource, "level") == 50  # at once, for whoever reads
    assert forced(resource, "level") == ("1000", "1000", "50")  # nothing ran with it yet
    resource.run(1)  # scan 1: Main alone
    assert value(resource, "Main.seen") == 50  # from its first statement on
    assert value(resource, "Main.seen_again") == 52  # what it writes holds until the program ends
    assert value(resource, "level") == 50  # not for a reader, nor for the outputs
    assert forced(resource, "level") == ("50", "52", "50")
    resource.run(1)  # scan 2: both
    assert value(resource, "Other.seen") == 53  # the other task sees what the first one wrote
    assert forced(resource, "level") == ("50", "1000", "50")
    done(resource, Release("Ada", "level"))
    assert value(resource, "level") == 50  # until somebody writes it
    resource.run(1)
    assert value(resource, "level") == 54
    assert forced_values(resource.view) == ()


@pytest.mark.parametrize("engine", ENGINES)
def test_inputs_and_bits(engine: EngineFactory) -> None:
    resource = plc(engine)
    done(resource, Force("Ada", "sensor", "FALSE"))
    done(resource, Force("Bob", "lamp", "TRUE"))
    resource.run(1)
    assert forced(resource, "sensor") == ("TRUE", "FALSE", "FALSE")  # the plant had set it
    assert value(resource, "Main.saw_sensor") is False
    assert forced(resource, "lamp") == ("TRUE", "FALSE", "TRUE")
    resource.run(1)
    assert forced(resource, "sensor") == ("FALSE", "FALSE", "FALSE")
    assert forced(resource, "lamp") == ("TRUE", "TRUE", "TRUE")
    assert forced_values(resource.view)[1] == ForcedValue("lamp", "", "TRUE", "Bob", 0, "TRUE", "TRUE", "TRUE")


@pytest.mark.parametrize("engine", ENGINES)
def test_what_was_noted_stays_when_other_forces_come_and_go(engine: EngineFactory) -> None:
    resource = plc(engine)
    done(resource, Force("Ada", "level", "50"))
    resource.run(2)
    before = forced(resource, "level")
    done(resource, Force("Ada", "D7", "1"))
    done(resource, Force("Ada", "Main.n", "3"))
    assert forced(resource, "level") == before
    done(resource, Release("Ada", "D7"))
    assert forced(resource, "level") == before
    done(resource, Restart("Ada", "warm"))
    assert forced(resource, "level") == before
    done(resource, Force("Ada", "level", "60"))
    assert (before[1], forced(resource, "level")[2]) == (forced(resource, "level")[1], "60")


def test_both_engines_note_the_same() -> None:
    resources = [plc(engine) for engine in (ReferenceEngine, NativeEngine)]
    for resource in resources:
        for path, text in (("level", "-2"), ("lamp", "TRUE"), ("CIO 100.04", "TRUE"), ("Main.n", "7")):
            done(resource, Force("Ada", path, text))
    for _ in range(6):
        for resource in resources:
            resource.run(1)
        assert resources[0].state == resources[1].state
        assert forced_values(resources[0].view) == forced_values(resources[1].view)


def test_who_forces_over_the_force_of_somebody_else_says_whose_it_was() -> None:
    resource = plc(ReferenceEngine)
    said = []
    for author, number in (("Mika", "1"), ("Mika", "2"), ("Aki", "3")):
        outcome = resource.submit(Force(author, "level", number))
        assert isinstance(outcome, Entry), outcome
        said.append(outcome.plan.message)
    assert said == ["level forced to 1", "level forced to 2", "level forced to 3; Mika held it at 2"]
