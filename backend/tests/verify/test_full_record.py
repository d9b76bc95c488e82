"""A record that is full: what found no room was not compared, and nothing is said of it."""

from pathlib import Path

import pytest

from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from tests.cli.calling import scanbench
from tests.runtime.bench import program
from tests.verify.test_trace_run import ALL, COUNTER, GO, opened, trace_of
from tests.verify.trace_parts import program_of
from tests.verify.verified_runs import record, verifier

TWICE = """FUNCTION_BLOCK F
VAR_INPUT x : INT; END_VAR VAR t, y, i : INT; END_VAR
  {loop}y := y + x;{end}
  t := x * 2;
END_FUNCTION_BLOCK
PROGRAM Main
VAR f : F; a, b : INT; END_VAR
  a := a + 1;
  b := a + 2;
  f(x := a);
  f(x := b);
END_PROGRAM
"""
SHORT = TWICE.format(loop="", end="")
LONG = TWICE.format(loop="FOR i := 1 TO 40 DO ", end=" END_FOR")


def disturbed(path: Path, source: str) -> Path:
    """The first call gets a wrong result in scan 7; the second call overwrites it."""
    wrong = Disturbance("result", site="main.st:4", bit=4, scan=7)
    return record(path, program(source), 9, [(3, Disturb("Ada", wrong))], agenda=DisturbanceSchedule())


@pytest.mark.parametrize("limit", [1, 3, 6])
def test_a_scan_whose_record_is_full_is_not_compared(tmp_path: Path, limit: int) -> None:
    path = disturbed(tmp_path / "run", SHORT)
    whole = verifier(path, program(SHORT), "F").verify(7)
    assert whole.compared
    assert [each.name for row in whole.rows for each in row.differences] == ["t"]
    cut = verifier(path, program(SHORT), "F", limit=limit).verify(7)
    assert not cut.compared
    assert [row.compared for row in cut.rows] == [not row.note.startswith("record full") for row in cut.rows]


@pytest.mark.parametrize("limit", [40, 100])
def test_nothing_untrue_is_told_of_a_full_record(tmp_path: Path, limit: int) -> None:
    path = disturbed(tmp_path / "run", LONG)
    cut = verifier(path, program(LONG), "F", limit=limit).verify(7)
    assert [each.message for row in cut.rows for each in row.differences] == []
    assert not cut.compared


def test_a_difference_at_the_end_of_the_scan_is_told_all_the_same(tmp_path: Path) -> None:
    wrong = Disturbance("result", site="main.st:3", bit=4, scan=7)
    path = record(tmp_path / "run", program(SHORT), 9, [(3, Disturb("Ada", wrong))], agenda=DisturbanceSchedule())
    found = [each for row in verifier(path, program(SHORT), "F", limit=1).verify(7).rows for each in row.differences]
    assert [(each.cause, each.name) for each in found] == [("outside", "Main.f.y")]


def test_passes_of_a_trace_beyond_the_record_are_not_compared() -> None:
    program = program_of(COUNTER)
    text = trace_of(program, ALL, 5, GO)
    assert opened(text, program, "Main:13-15").verify(4).compared
    assert not opened(text, program, "Main:13-15", limit=1).verify(4).compared
    assert opened(text, program, limit=1).verify(4).compared  # its outputs at the end of the scan are


def test_the_command_says_it(tmp_path: Path) -> None:
    (tmp_path / "main.st").write_text(SHORT, "utf-8")
    ran = scanbench("verify", str(tmp_path / "main.st"), "--range", "F", "--scans", "0..9", "--limit", "3")
    assert "no difference" not in ran.stdout
    assert "the record was full in 10 scans" in ran.stdout
    assert "10 not compared (0 to 9): nothing was compared" in ran.stdout
    assert ran.returncode == 2
