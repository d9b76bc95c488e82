"""Stepping through rungs: over goes from coil to coil, in stops at each contact, and so does a breakpoint at its column."""

from pathlib import Path

from scanbench.debug.breakpoint import Breakpoint
from tests.debug.test_walks import BUILDS
from tests.debug.walking import Walker

RUNGS = """\
PROGRAM Main
VAR go, stop, on, lamp : BOOL; n : INT; END_VAR
RUNG
    < [go] | [on] > [/stop] (on)
END_RUNG
RUNG again:
    [on] n := ADD(EN := ~, IN1 := n, IN2 := 1).ENO (lamp)
    [stop] JMP again
END_RUNG
END_PROGRAM
"""


def test_a_step_over_skips_contacts(tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", RUNGS.replace("(lamp)\n    ", "(lamp) "), BUILDS.engine)
    walker.set(Breakpoint(1, "line", "Ann", file="main.st", line=4, column=7))
    walker.run()
    assert column(walker) == (4, 7)
    walker.set()
    seen = []
    for _ in range(5):
        walker.step("over")
        seen.append(column(walker))
    assert seen == [(4, 29), (7, 10), (7, 52), (7, 66), (4, 29)]


def test_a_step_in_stops_at_each(tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", RUNGS, BUILDS.engine)
    walker.set(Breakpoint(1, "line", "Ann", file="main.st", line=4, column=14))
    walker.run()
    seen = [column(walker)]
    for _ in range(3):
        walker.step("in")
        seen.append(column(walker))
    assert seen == [(4, 14), (4, 21), (4, 29), (7, 5)]


def column(walker: Walker) -> tuple[int, int]:
    span = walker.halt.span
    assert span is not None
    return span.line, span.column
