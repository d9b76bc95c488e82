"""Steps of a verification: about the statement that ran, in the range, and what is cause and what is consequence."""

from pathlib import Path

import pytest

from scanbench.engines.available import flavours
from scanbench.faults.disturb.definition import Disturbance
from scanbench.recording.programs import on, reference
from scanbench.verify.contract import ENDED, Output, Row
from scanbench.verify.verifier import Verifier
from tests.runtime.bench import program
from tests.verify.test_verifier import BELTS, INDEXED, TRAP, disturbed, value
from tests.verify.verified_runs import record, verifier

IL = """\
PROGRAM Main
VAR a, b : INT; END_VAR
LD a
ADD 1
ST a
GT 2
JMPC over
LD 5
ST b
over: LD b
ST a
END_PROGRAM
"""


@pytest.mark.parametrize("source", [BELTS, IL], ids=("ST", "IL"))
@pytest.mark.parametrize("make", [on(flavours()), reference], ids=("native", "reference"))
def stepped(verified: Verifier, scan: int) -> list[Row]:
    """All steps of a scan."""
    found, count = list[Row](), 0
    while not found or count:
        found += verified.step(scan, count).rows
        count = found[-1].count
    return found


@pytest.mark.parametrize("source", [BELTS, IL], ids=("ST", "IL"))
@pytest.mark.parametrize("make", [on(flavours()), reference], ids=("native", "reference"))
def test_a_step_is_about_the_statement_that_ran(source: str, make: object, tmp_path: Path) -> None:
    record(tmp_path / "run", program(source), 4)
    verified = verifier(tmp_path / "run", program(source), make=make)  # type: ignore[arg-type]
    first, *found = stepped(verified, 0 if source is IL else 2)
    assert (first.kind, first.count, first.place, first.outputs) == ("step", 1, None, {})
    assert all(row.differences == () for row in found)
    assert [row.count for row in found] == [*range(2, len(found) + 1), 0]
    assert found[-1].note == "end of the scan"
    lines = [row.place.line for row in found if row.place is not None]
    following = [row.next.line for row in (first, *found) if row.next is not None]
    assert lines == following
    written = {(row.place.line, name) for row in found if row.place is not None for name in row.outputs}
    if source is IL:
        assert lines == [3, 4, 5, 6, 7, 8, 9, 10, 11]
        assert {(5, "Main.a"), (9, "Main.b"), (11, "Main.a")} <= written
    else:
        assert lines[:4] == [21, 22, 8, 12]
        assert {(21, "Main.n"), (4, "Main.belt[2].pos"), (25, "Main.copy.b")} <= written


def test_the_current_result_of_il_is_shown_after_each_instruction(tmp_path: Path) -> None:
    record(tmp_path / "run", program(IL), 4)
    verified = verifier(tmp_path / "run", program(IL))
    found = stepped(verified, 0)[1:]
    results = [
        (row.place and row.place.line, name, value(each.control), value(each.monitor))
        for row in found
        for name, each in row.outputs.items()
        if name.startswith("CR")
    ]
    assert results == [(3, "CR (INT)", 0, 0), (4, "CR (INT)", 1, 1), (6, "CR (BOOL)", 0, 0), (8, "CR (DINT)", 5, 5), (10, "CR (INT)", 5, 5)]  # fmt: skip
    assert list(found[4].inputs) == ["CR (BOOL)"]


def test_only_the_first_statement_that_differs_is_the_cause(tmp_path: Path) -> None:
    path = disturbed(tmp_path, Disturbance("result", site="main.st:10", bit=1, scan=7))  # total of the blocks
    verified = verifier(path, program(BELTS))
    found = stepped(verified, 7)
    (cause,) = [row for row in found if row.differs]
    assert cause.place is not None
    assert (cause.place.line, cause.place.instance) == (10, "Main.belt[2]")
    assert [(each.name, each.cause) for each in cause.differences] == [("Main.total", "logic")]
    assert cause.outputs["Main.total"] == Output(cause.differences[0].control, cause.differences[0].monitor)
    later = found[found.index(cause) + 1 :]
    assert all("still different: Main.total" in row.note for row in later if not row.consequences)
    (consequence,) = [row for row in later if row.consequences]
    assert consequence.place is not None
    assert (consequence.place.line, consequence.place.instance) == (10, "Main.belt[3]")
    assert [(each.name, each.cause) for each in consequence.consequences] == [("Main.total", "input")]


@pytest.mark.parametrize("make", [on(flavours()), reference], ids=("native", "reference"))
def test_a_step_stays_in_the_range_and_goes_into_its_calls(make: object, tmp_path: Path) -> None:
    record(tmp_path / "run", program(BELTS), 4)
    verified = verifier(tmp_path / "run", program(BELTS), "Belt:8-10@Main.belt[2]", make=make)  # type: ignore[arg-type]
    found = stepped(verified, 2)
    places = [row.place and (row.place.line, row.place.instance) for row in found]
    assert places == [None, (8, "Main.belt[2]"), (9, "Main.belt[2]"), (4, "Twice"), (10, "Main.belt[2]")]
    assert [list(row.outputs) for row in found] == [[], [], [], ["Twice.Twice", "Main.belt[2].pos"], ["total"]]
    assert [row.note for row in found] == ["", "", "", "with the rest of main.st:9", "end of the scan"]


def test_a_statement_outside_of_the_range_that_differs_is_told_once(tmp_path: Path) -> None:
    path = disturbed(tmp_path, Disturbance("result", site="main.st:21", bit=1, scan=7))
    found = stepped(verifier(path, program(BELTS), "Belt:12-13"), 7)
    assert [[(each.name, each.cause) for each in row.differences] for row in found if row.differs] == [
        [("Main.n", "outside")]
    ]


LOOP = """\
PROGRAM Main
VAR k, i, sum, after : INT; END_VAR
  k := 3;
  FOR i := 1 TO k DO
    sum := sum + i;
  END_FOR;
  after := k + sum;
END_PROGRAM
"""


@pytest.mark.parametrize("make", [on(flavours()), reference], ids=("native", "reference"))
def test_what_follows_from_a_loop_that_goes_on_longer_is_no_further_cause(make: object, tmp_path: Path) -> None:
    path = disturbed(tmp_path, Disturbance("result", site="main.st:3", bit=2, scan=7), source=LOOP)  # 7 rounds
    found = stepped(verifier(path, program(LOOP), make=make), 7)  # type: ignore[arg-type]
    wrong = [(row.place and row.place.line, [each.name for each in row.differences]) for row in found if row.differs]
    assert wrong == [(3, ["Main.k"])]
    assert any(each.cause == "order" for row in found for each in row.consequences)


def test_a_statement_that_follows_outside_of_the_range_is_not_taken_for_one_of_it(tmp_path: Path) -> None:
    path = disturbed(tmp_path, Disturbance("result", site="main.st:9", bit=3, scan=7))
    found = stepped(verifier(path, program(BELTS), "Twice"), 7)
    assert [list(row.outputs) for row in found] == [[], *[["Twice"]] * (len(found) - 1)]
    told = [(each.name, each.cause, each.place) for row in found for each in row.differences]
    assert told[0] == ("Main.belt[1].pos", "outside", None) or told[0][1:] == ("outside", None)
    assert all(cause == "outside" for _, cause, _ in told)


def test_a_run_time_error_on_one_side_is_the_difference_of_its_step(tmp_path: Path) -> None:
    wanted = Disturbance("result", site="main.st:3", bit=4, scan=7)
    verified = verifier(disturbed(tmp_path, wanted, source=INDEXED), program(INDEXED))
    wrong = [row for row in stepped(verified, 7) if row.differs]
    assert [(row.place and row.place.line, [each.name for each in row.differences]) for row in wrong] == [
        (3, ["Main.ix"]), (4, ["run-time error"]),
    ]  # fmt: skip
    assert (wrong[1].differences[0].cause, wrong[1].differences[0].message) == ("trap", TRAP)
    assert wrong[1].note.startswith(ENDED)
