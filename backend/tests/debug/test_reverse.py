"""Back to where something happened last, however long ago: the same with probes as statement by statement."""

from pathlib import Path
from typing import Literal

import pytest

from scanbench.debug.breakpoint import Breakpoint
from scanbench.engines.engine import Stop
from scanbench.faults.inject import Generate
from scanbench.faults.reference import ErrorRef
from scanbench.recording import checkpoints
from scanbench.recording.timeline import Timeline
from scanbench.runtime.inside import Diverged
from scanbench.runtime.write import Write
from tests.debug.test_walks import BUILDS
from tests.debug.walking import STATIONS, Counted, Walker
from tests.recording.recorded import COUNTER, SECOND, to_program
from tests.runtime.bench import value

SELDOM = STATIONS.replace("VAR n, i,", "VAR rare, n, i,").replace(
    "  motor :=", "  IF n MOD 700 = 0 THEN\n    rare := 7;\n    list[4] := n;\n  END_IF;\n  motor :="
)


@pytest.fixture(params=["probes", "statements"])
def walker(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Walker:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 5_000_000)
    walker = Walker(tmp_path / "a.run", SELDOM, BUILDS.engine)
    walker.prober = Counted() if request.param == "probes" else None
    walker.debugger.search_with(walker.prober)
    assert walker.run(3000) is None
    return walker


@pytest.mark.parametrize(("path", "line"), [("Main.list[4]", 32), ("Main.rare", 31), ("Main.list", 32)])
def test_the_last_write_of_a_variable(walker: Walker, path: str, line: int) -> None:
    scans = [2799, 2099, 1399, 699] if path != "Main.list" else [2999, 2999, 2999, 2998]
    for scan in scans:
        walker.step("reverse", path=path)
        assert walker.halt.past
        assert walker.halt.scan == scan
        assert (walker.line == line) == (path != "Main.list")
        assert value(walker.timeline.resource, "Main.n") == scan + 1
    if path != "Main.list":
        refusal = walker.debugger.step("reverse", "Ann", path=path)
        assert refusal is not None
        assert "did not happen since scan 0" in refusal.message
        assert walker.halt.scan == 699, "where nothing is found nothing moves"
        if walker.prober is not None:
            assert walker.prober.made > 0


def test_a_breakpoint_that_held_long_ago(walker: Walker) -> None:
    walker.set(
        Breakpoint(1, "line", "Ann", file="main.st", line=14, instance="Main.a", condition="Main.n = 611"),
        Breakpoint(2, "line", "Ann", file="main.st", line=32, enabled=False),
    )
    walker.step("reverse")
    assert (walker.halt.scan, walker.halt.instance, walker.line) == (610, "Main.a", 14)
    walker.step("continue")
    assert not walker.halt.past
    assert walker.halt.scan == 3000


def test_what_was_written_from_outside_inside_of_a_scan_is_followed(walker: Walker) -> None:
    walker.step("in")
    walker.submit(Write("Ann", "Main.n", "699"))
    walker.debugger.step("continue", "Ann")
    assert walker.run(2000) is None
    walker.step("reverse", path="Main.list[4]")
    assert (walker.halt.scan, value(walker.timeline.resource, "Main.n")) == (4400, 2100)


def test_a_write_is_shown_where_its_statement_begins(tmp_path: Path) -> None:
    source = STATIONS.replace("  n := n + 1;", "  n := n + Twice(1) - 1;")
    walker = Walker(tmp_path / "a.run", source, BUILDS.engine)
    walker.run(10)
    for scan in (9, 8):
        walker.step("reverse", path="Main.n")
        assert (walker.line, walker.here, value(walker.timeline.resource, "Main.n")) == (24, (scan, 1), scan)


def test_the_journal_knows_when_errors_were_raised_and_scans_were(walker: Walker) -> None:
    error = next(each.id for each in walker.timeline.resource.program.layout.model.errors() if each.severity != "fatal")
    walker.submit(Generate("Bob", (ErrorRef(error),)))
    assert walker.run(300) is None
    walker.set(
        Breakpoint(1, "error", "Ann", error=error),
        Breakpoint(2, "scan", "Ann", scan=1000),
        Breakpoint(3, "line", "Ann", file="main.st", line=31),
    )
    found = []
    for _ in range(4):
        walker.step("reverse")
        found.append((walker.halt.reason, walker.halt.scan))
    assert found == [("error", 3000), ("breakpoint", 2799), ("breakpoint", 2099), ("breakpoint", 1399)]
    walker.step("reverse")
    assert (walker.halt.reason, walker.here) == ("scan", (1000, 1))


def test_a_variable_that_an_online_change_added(tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", COUNTER)
    walker.run(30)
    assert to_program(walker.timeline, 2, SECOND.replace("n := n + 3", "first := n; n := n + 3")) == ""
    walker.debugger.moved()
    walker.run(30)
    assert walker.debugger.step("reverse", "Ann", path="Main.nix") is not None
    walker.step("reverse", path="Main.n")
    assert (walker.halt.past, walker.halt.scan) == (True, 59)


@pytest.mark.parametrize("action", ["continue", "reverse"])
def test_a_run_that_cannot_be_repeated_is_said_and_what_is_shown_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, action: Literal["continue", "reverse"]
) -> None:
    walker = Walker(tmp_path / "a.run", STATIONS, BUILDS.engine)
    assert walker.run(30) is None
    assert walker.timeline.goto(20) is None
    go_on, failed = Timeline.go_on, list[int]()

    def once(timeline: Timeline, until: int) -> Stop:
        if failed:
            return go_on(timeline, until)
        failed.append(until)
        raise Diverged("the replay stopped in scan 21")

    monkeypatch.setattr(Timeline, "go_on", once)
    if action == "reverse":
        refusal = walker.debugger.step("reverse", "Ann", path="Main.n")
        assert refusal is not None
        said = refusal.message
    else:
        assert walker.debugger.step("continue", "Ann") is None
        walker.debugger.move()
        said = walker.halt.text
    assert "cannot be shown: the replay stopped in scan 21" in said
    assert walker.timeline.resource.header.scan == 20
    assert value(walker.timeline.resource, "Main.n") == 20
    assert walker.timeline.past
    assert not walker.debugger.moving
