"""Plain breakpoints on code with probes: nothing else runs until one of them is reached, and the halt is the same."""

from pathlib import Path

import pytest

from scanbench.debug.breakpoint import Breakpoint
from scanbench.recording import checkpoints
from tests.debug.test_walks import BUILDS
from tests.debug.walking import STATIONS, Counted, Walker
from tests.runtime.bench import value


@pytest.fixture
def walker(tmp_path: Path) -> Walker:
    walker = Walker(tmp_path / "a.run", STATIONS, BUILDS.engine)
    make = Counted()
    debugger = walker.debugger
    debugger.want_probes = lambda loaded, probes: debugger.take_probed(
        loaded, make(loaded.statements, loaded.memory, probes)
    )
    return walker


def line(id: int, number: int, **more: object) -> Breakpoint:
    return Breakpoint(id, "line", "Ann", file="main.st", line=number, **more)  # type: ignore[arg-type]


def test_a_condition_is_looked_at_by_the_fast_code(walker: Walker, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 2_000_000)
    walker.set(line(1, 14, condition="up > 6000"), line(2, 28, condition="n = 4000 AND i = 2"))
    assert walker.run(2000) is None
    assert walker.debugger.flavour == "probed"
    walker.run(2000)
    resource = walker.timeline.resource
    assert (walker.halt.breakpoints, walker.here[0], value(resource, "Main.n")) == ((1,), 3000, 3001)
    assert (walker.halt.instance, walker.debugger.flavour) == ("Main.b", "debug")
    state = resource.state
    walker.step("back")
    walker.step("in")
    assert resource.state == state
    walker.set(line(2, 28, condition="n = 4000 AND i = 2"))
    walker.step("continue")
    walker.run(2000)
    assert (walker.halt.breakpoints, value(resource, "Main.n"), value(resource, "Main.i")) == ((2,), 4000, 2)
    walker.step("over")
    assert walker.line == 28 or walker.line == 30
    walker.debugger.step("continue", "Ann")
    assert walker.run(100) is None
    assert walker.debugger.flavour == "probed"
    walker.timeline.goto(0)
    walker.timeline.step(walker.timeline.live_scan)
    again = resource.state
    walker.timeline.return_live()
    assert resource.state == again


def test_what_it_cannot_look_at_runs_in_the_debug_flavour(walker: Walker) -> None:
    walker.set(line(1, 14, hits=">= 100000"))
    assert walker.run(50) is None
    assert walker.debugger.flavour == "debug"
    walker.set(line(1, 25, condition="n < 0"))
    assert walker.run(50) is None
    assert walker.debugger.flavour == "probed"
    walker.set(line(1, 25, condition="n < 0", enabled=False))
    assert walker.run(50) is None
    assert walker.debugger.flavour == ""


def test_a_trap_is_halted_at_although_nobody_listens(tmp_path: Path) -> None:
    source = "PROGRAM Main\nVAR n : DINT := 500; d : DINT; END_VAR\n  n := n - 1;\n  d := 10 / n;\nEND_PROGRAM\n"
    walker = Walker(tmp_path / "a.run", source, BUILDS.engine)
    make, debugger = Counted(), walker.debugger
    debugger.want_probes = lambda loaded, probes: debugger.take_probed(
        loaded, make(loaded.statements, loaded.memory, probes)
    )
    walker.set(line(1, 3, condition="n < -5"), Breakpoint(2, "trap", "Ann"))
    walker.run(1000)
    assert (walker.halt.reason, walker.line, walker.here) == ("trap", 4, (499, 2))
