"""What is written while a debugger has halted inside of a block: on the variable at once, and for the next statement."""

from dataclasses import replace

import pytest

from scanbench.check.build import check_sources
from scanbench.check.symbols import resolve
from scanbench.engines.debug import Listen
from scanbench.engines.engine import Reason
from scanbench.runtime.command import Entry
from scanbench.runtime.forces import Force
from scanbench.runtime.inside import HaltAt
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, model, value

SOURCE = """
FUNCTION_BLOCK Valve
VAR_IN_OUT level : INT; on : BOOL; END_VAR
VAR first, second : INT; END_VAR
first := level;
second := level;
level := level + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Pump
VAR_IN_OUT l : INT; on : BOOL; END_VAR
VAR valve : Valve; seen : INT; END_VAR
l := l + 10;
valve(level := l, on := on);
seen := l;
END_FUNCTION_BLOCK
PROGRAM Main
VAR pump : Pump; tank : ARRAY[1..2] OF INT; word : WORD; END_VAR
pump(l := tank[2], on := word.%X3);
END_PROGRAM
"""
BEHIND_FIRST = 5
"""In front of `second := level`."""


def halted(engine: EngineFactory, convention: str) -> Resource:
    checked = check_sources({"main.st": SOURCE}, replace(model(), in_out=convention))  # type: ignore[arg-type]
    assert checked.program is not None, checked.problems
    resource = Resource(Loaded.make(checked.program, engine))
    resource.run(1)
    resource.hook = HaltAt(BEHIND_FIRST)
    resource.listen(Listen(count=BEHIND_FIRST))
    assert resource.run(1).reason is Reason.HALTED
    assert value(resource, "Main.pump.valve.first") == 21
    return resource


def went_on(resource: Resource) -> None:
    resource.hook = None
    resource.listen(Listen())
    resource.run(1)


@pytest.mark.parametrize("path", ["Main.pump.valve.level", "Main.pump.l", "Main.tank[2]"])
@pytest.mark.parametrize("convention", ["reference", "value"])
@pytest.mark.parametrize("engine", ENGINES)
def test_the_next_statement_sees_it(engine: EngineFactory, convention: str, path: str) -> None:
    resource = halted(engine, convention)
    entry = resource.submit(Write("Ada", path, "500"))
    assert isinstance(entry, Entry), entry
    assert entry.step == BEHIND_FIRST
    assert value(resource, "Main.tank[2]") == 500
    assert value(resource, "Main.pump.valve.second") == 10
    went_on(resource)
    assert value(resource, "Main.pump.valve.second") == 500
    assert value(resource, "Main.pump.seen") == 501
    assert value(resource, "Main.tank[2]") == 501


@pytest.mark.parametrize("convention", ["reference", "value"])
def test_bits_and_forces(convention: str) -> None:
    resource = halted(ENGINES[0], convention)
    assert isinstance(resource.submit(Write("Ada", "Main.pump.valve.on", "TRUE")), Entry)
    assert value(resource, "Main.word") == 8
    forced = resource.submit(Force("Ada", "Main.pump.valve.level", "70"))
    assert isinstance(forced, Entry)
    assert forced.step == BEHIND_FIRST
    went_on(resource)
    assert value(resource, "Main.word.3") is True
    assert value(resource, "Main.tank[2]") == 70  # held at the end of the scan
    assert value(resource, "Main.pump.valve.second") == 70
    went_on(resource)
    assert value(resource, "Main.pump.valve.first") == 80
    assert resolve(resource.program, "Main.pump.valve.level").locate(resource.memory) is not None
