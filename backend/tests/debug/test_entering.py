"""What is entered while a PLC is halted, or by its breakpoints: where it is entered, and what that means for them."""

import hashlib
from pathlib import Path

import pytest

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.debugger import MOST_ASSIGNED
from scanbench.recording.replay_file import replay_file
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.debug.test_breakpoints import data, line
from tests.debug.test_walks import BUILDS
from tests.debug.walking import STATIONS, Walker
from tests.recording.recorded import of_file
from tests.runtime.bench import value

SETS = """PROGRAM Main
VAR n, x, y : INT; END_VAR
  n := n + 1;
  x := 5;
  y := y;
  x := 5;
  y := y + 1;
END_PROGRAM
"""
ROUNDS = """PROGRAM Main
VAR i, k, n : DINT; END_VAR
  n := n + 1;
  FOR i := 1 TO 3000 DO
    k := k + 1;
  END_FOR;
END_PROGRAM
"""


@pytest.mark.parametrize("kind", ["line", "trap"])
def test_what_needs_the_seam_is_never_entered_inside_of_a_scan(kind: str, tmp_path: Path) -> None:
    source = STATIONS.replace("  a(up", "  IF n = 4 THEN\n    i := 1 / (n - 4);\n  END_IF;\n  a(up")
    walker = Walker(tmp_path / "a.run", source, BUILDS.engine)
    walker.set(line(14, condition="Main.n = 3") if kind == "line" else Breakpoint(1, "trap", "Ann"))
    walker.run()
    scan = walker.halt.scan
    walker.set(
        line(14), Breakpoint(2, "line", "Ann", file="main.st", line=20, log="{total}"), Breakpoint(3, "trap", "A")
    )
    entry = walker.submit(Restart("Bob", "cold"))
    assert (entry.scan, entry.step) == (scan + (kind == "line"), 0)
    assert (walker.timeline.resource.listening.inside, value(walker.timeline.resource, "Main.n")) == (None, 0)
    assert (walker.debugger.halt is None) == (kind == "trap"), "what had trapped begins again"
    assert len(walker.heard.logs) == (2 if kind == "line" else 0), "what was set acts in the rest of the scan"
    walker.set()
    walker.debugger.step("continue", "Ann")
    assert walker.run(2) is None
    timeline = walker.timeline
    state, scan = hashlib.sha256(timeline.resource.state).hexdigest(), timeline.live_scan
    walker.close()
    again = replay_file(tmp_path / "a.run", of_file, ENTRIES, scan)
    assert (again.scan, again.hash) == (scan, state)


@pytest.mark.parametrize("by", ["people", "an execution point"])
def test_a_change_after_what_was_entered_is_a_change(by: str, tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", SETS, BUILDS.engine)
    walker.run(3)
    if by == "people":
        walker.set(line(5))
        walker.run()
        walker.set(line(5), Breakpoint(2, "data", "Ann", path="Main.x"))
        walker.submit(Write("Bob", "Main.x", "9"))
        walker.step("continue")
    else:
        walker.set(line(5, assign="x := 9"), Breakpoint(2, "data", "Ann", path="Main.x"))
        walker.run()
    assert (walker.line, walker.halt.text, walker.halt.scan) == (7, "Main.x changed from 9 to 5", 3)
    walker.step("back")
    walker.step("continue")
    assert (walker.halt.past, walker.line) == (False, 7)


def test_execution_points_are_bounded_in_each_scan(tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", ROUNDS, BUILDS.engine)
    walker.set(line(5, assign="k := k + 1; n := k;"))
    assert walker.run(2) is None
    resource = walker.timeline.resource
    assert value(resource, "Main.k") == 2 * (3000 + MOST_ASSIGNED)
    assert [scan for _, scan, _ in walker.heard.logs] == [0, 1]
    assert "1,000 times is all" in walker.heard.logs[0][2]
    first = next(iter(walker.timeline.live_journal))
    assert first.plan.message == "Main.k := 1; Main.n := 1", "each sees what the one before it assigns"
    state = resource.state
    walker.timeline.goto(0)
    walker.timeline.step(2)
    assert resource.state == state


def test_a_data_breakpoint_on_a_statement_that_traps_does_not_halt(tmp_path: Path) -> None:
    source = "PROGRAM Main\nVAR x, d, y : DINT; END_VAR\n  y := 3;\n  y := x / d;\nEND_PROGRAM\n"
    walker = Walker(tmp_path / "a.run", source, BUILDS.engine)
    walker.set(data("Main.x", "read"))
    assert walker.run() is None
    assert walker.timeline.resource.header.halted_by_trap
    walker.submit(Restart("Bob", "cold"))
    walker.submit(Write("Bob", "Main.d", "1"))
    walker.run()
    assert (walker.halt.text, walker.here) == ("Main.x was read: 0", (1, 0))
