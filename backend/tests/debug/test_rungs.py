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


LINES = """\
PROGRAM Main
VAR a, q, r : BOOL; n : INT; c : CTU; END_VAR
NETWORK
    q := a;
    q := R_EDGE a;
    c(CU := R_EDGE a, PV := 3);
    n := ADD(EN := NOT F_EDGE a, IN1 := n, IN2 := 1);
    #w = AND(NOT R_EDGE a, q);
    r S= R_EDGE a;
    JMP out IF q;
    r := #w;
END_NETWORK
NETWORK out:
    RETURN IF NOT R_EDGE a;
END_NETWORK
END_PROGRAM
"""


def test_a_step_over_comes_to_each_line_of_a_network(tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", LINES, BUILDS.engine)
    walker.set(Breakpoint(1, "line", "Ann", file="main.st", line=4, column=5))
    walker.run()
    walker.set()
    seen = [column(walker)]
    for _ in range(9):
        walker.step("over")
        seen.append(column(walker))
    assert seen == [(line, 5) for line in (4, 5, 6, 7, 8, 9, 10, 11, 14, 4)]


BOX = """\
PROGRAM Main
VAR on, go, full : BOOL; c : CTU; END_VAR
RUNG
    [P on] c(CU := ~, R := < [go] | [N go] >, PV := 3).Q (full)
END_RUNG
END_PROGRAM
"""


def test_a_breakpoint_at_the_name_of_a_box_halts_after_the_contact_before_it(tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", BOX, BUILDS.engine)
    walker.set(Breakpoint(1, "line", "Ann", file="main.st", line=4, column=BOX.split("\n")[3].index("c(") + 1))
    walker.run()
    assert column(walker) == (4, BOX.split("\n")[3].index("[go]") + 1)
    walker.set(Breakpoint(1, "line", "Ann", file="main.st", line=4, column=BOX.split("\n")[3].index(").Q") + 1))
    walker.step("scan")
    walker.step("continue")
    assert column(walker) == (4, BOX.split("\n")[3].index(").Q") + 1)


def column(walker: Walker) -> tuple[int, int]:
    span = walker.halt.span
    assert span is not None
    return span.line, span.column
