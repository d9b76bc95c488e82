"""FB_init and what belongs to it, in the life of a PLC: starts, program changes, runs that are repeated, halts."""

import hashlib
from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.frames import frame_name
from scanbench.recording.replay_file import replay_file
from scanbench.runtime.command import Entry
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.syntax.language_file import with_dialect
from scanbench.wire.codec import ENTRIES
from tests.debug.test_walks import ENGINES as DEBUG_ENGINES
from tests.debug.walking import MakeDebug, Walker
from tests.recording.recorded import of_file
from tests.runtime.bench import CODESYS, ENGINES, change, model, plc, program, value

LIFE = f"""{CODESYS}FUNCTION_BLOCK Unit
VAR inits, changes, given : INT; new, moved : BOOL; END_VAR
VAR RETAIN kept : INT; END_VAR
METHOD FB_init : BOOL
VAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; number : INT; END_VAR
  inits := inits + 1;
  given := number;
  new := bInitRetains;
  moved := bInCopyCode;
  IF bInitRetains THEN
    kept := 100;
  END_IF;
END_METHOD
METHOD FB_reinit : BOOL
  changes := changes + 1;
END_METHOD
END_FUNCTION_BLOCK
VAR_GLOBAL number : INT := 40; END_VAR
PROGRAM Main
VAR n : INT; unit : Unit(number := number + 2); END_VAR
VAR RETAIN held : Unit(1) := (given := 5); END_VAR
  n := n + 1;
END_PROGRAM
"""


def values(resource: Resource, *names: str) -> list[object]:
    return [value(resource, f"Main.{name}") for name in names]


def done(resource: Resource, command: Write | Restart) -> None:
    assert isinstance(resource.submit(command), Entry)


@pytest.mark.parametrize("engine", ENGINES)
def test_each_start_initialises_again_and_a_warm_one_leaves_what_is_retained(engine: EngineFactory) -> None:
    resource = plc(LIFE, engine)
    resource.run(2)
    assert values(resource, "unit.inits", "unit.given", "unit.new", "unit.kept") == [1, 42, True, 100]
    for path in ("Main.unit.kept", "Main.unit.inits", "Main.held.given", "Main.held.inits"):
        done(resource, Write("Ada", path, "7"))
    done(resource, Restart("Ada", "warm"))
    resource.run(2)
    assert values(resource, "unit.inits", "unit.given", "unit.new", "unit.kept") == [1, 42, False, 7]
    assert values(resource, "held.inits", "held.given") == [8, 1], (
        "retained, so neither is initialised by its declaration"
    )
    done(resource, Restart("Ada", "cold"))
    resource.run(2)
    assert values(resource, "unit.inits", "unit.new", "unit.kept", "held.inits", "held.given") == [1, True, 100, 1, 5]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_program_change_initialises_what_is_new_and_tells_what_was_changed(engine: EngineFactory) -> None:
    resource = plc(LIFE, engine)
    resource.run(3)
    more = LIFE.replace("unit : Unit(number", "second : ARRAY[0..2] OF Unit[(7), (8), (9)]; unit : Unit(number")
    change(resource, program(more), engine)
    resource.run(2)
    assert values(resource, "n", "unit.inits", "unit.changes") == [5, 1, 0]
    assert values(resource, "second[2].inits", "second[2].given", "second[2].moved", "second[2].new") == [
        1,
        9,
        True,
        False,
    ]
    wider = more.replace("VAR inits,", "VAR added, inits,")
    change(resource, program(wider), engine, 3)
    resource.run(2)
    assert values(resource, "n", "unit.inits", "unit.changes", "second[1].changes", "second[1].inits") == [
        7,
        1,
        1,
        1,
        1,
    ]
    other = wider.replace("n := n + 1;", "n := n + 2;")
    change(resource, program(other), engine, 4)
    resource.run(1)
    assert values(resource, "n", "unit.inits", "unit.changes") == [9, 1, 1], "the code alone was changed"


@DEBUG_ENGINES
def test_a_halt_inside_of_fb_init_and_back_shows_what_forward_showed(make: MakeDebug, tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", LIFE, make=make)
    walker.set(Breakpoint(1, "line", "Ann", file="main.st", line=8))
    walker.run(1)
    assert walker.line == 8
    resource = walker.timeline.resource
    assert resource.listening.inside is not None
    frames = resource.listening.inside.frames
    assert [frame_name(resource.program, each) for each in frames] == ["Main.unit.FB_init (Unit)"]
    walker.set()
    forward = [walker.seen]
    for _ in range(25):
        walker.step("in")
        forward.append(walker.seen)
    assert len({scan for scan, *_ in forward}) > 5, "the steps lead on into the program"
    for expected in reversed(forward[:-1]):
        walker.step("back")
        assert walker.seen == expected
    walker.step("continue")
    walker.debugger.step("continue", "Ann")
    assert walker.run(3) is None
    timeline = walker.timeline
    state, scan = hashlib.sha256(timeline.resource.state).hexdigest(), timeline.live_scan
    walker.close()
    again = replay_file(tmp_path / "a.run", of_file, ENTRIES, scan)
    assert (again.scan, again.hash) == (scan, state)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_check_of_an_edit_makes_the_same_program(engine: EngineFactory) -> None:
    sources = with_dialect({"main.st": LIFE}, "codesys")
    edited = {**sources, "main.st": LIFE.replace("n := n + 1;", "n := n + 2;")}
    checks = Checks()
    checks.check(sources, model(), 10_000_000)
    images = []
    for made in (checks.check(edited, model(), 10_000_000), check_sources(edited, model())):
        assert made.program is not None
        resource = Resource(Loaded.make(made.program, engine))
        resource.run(3)
        images.append(bytes(resource.state))
    assert images[0] == images[1]


COMPUTED = f"""{CODESYS}VAR_GLOBAL level : INT := 4; END_VAR
FUNCTION_BLOCK Unit
VAR own : INT := level + 1; END_VAR
own := own + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR unit : Unit; first : INT := level * 2; END_VAR
VAR RETAIN kept : INT := level * 3; END_VAR
unit();
kept := kept + 1;
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_start_values_are_computed_at_each_start_and_for_what_is_new(engine: EngineFactory) -> None:
    resource = plc(COMPUTED, engine)
    resource.run(2)
    assert values(resource, "unit.own", "first", "kept") == [7, 8, 14]
    done(resource, Write("Ada", "level", "10"))
    resource.run(1)
    change(resource, program(COMPUTED.replace("unit : Unit;", "unit, other : Unit;")), engine)
    resource.run(1)
    assert values(resource, "unit.own", "other.own", "first", "kept") == [9, 11, 8, 16]
    done(resource, Restart("Ada", "warm"))
    resource.run(1)
    assert values(resource, "unit.own", "other.own", "first", "kept") == [6, 5, 8, 17]
    done(resource, Restart("Ada", "cold"))
    resource.run(1)
    assert values(resource, "kept") == [13]
