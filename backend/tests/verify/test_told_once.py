"""A difference that a step has told is none of its scan's row; what the steps did not see stays one."""

from pathlib import Path

import pytest

from scanbench.faults.disturb.definition import Disturbance
from scanbench.verify.told_once import ToldOnce
from tests.runtime.bench import program
from tests.verify.test_steps import stepped
from tests.verify.test_verifier import BELTS, INDEXED, disturbed
from tests.verify.verified_runs import verifier


@pytest.mark.parametrize(
    ("source", "range", "wanted"),
    [
        (INDEXED, "", Disturbance("result", site="main.st:3", bit=4, scan=7)),
        (BELTS, "", Disturbance("result", site="main.st:10", bit=1, scan=7)),
        (BELTS, "Belt", Disturbance("result", site="main.st:10", bit=1, scan=7)),
    ],
    ids=("trap", "whole scan", "range"),
)
def test_each_is_told_once(source: str, range: str, wanted: Disturbance, tmp_path: Path) -> None:
    verified, once = verifier(disturbed(tmp_path, wanted, source=source), program(source), range), ToldOnce()
    rows = verified.verify(7).rows
    found = {(each.cause, each.name) for row in rows for each in row.differences}
    assert found
    assert tuple(map(once.rest, rows)) == rows  # nothing was told
    for row in stepped(verified, 7):
        once.stepped(row)
    left = tuple(map(once.rest, verified.verify(7).rows))
    assert not any(row.differences for row in left)
    assert {(each.cause, each.name) for row in left for each in row.consequences} == found
    other = verified.verify(6).rows
    assert tuple(map(once.rest, other)) == other


def test_what_the_steps_did_not_see_stays_a_difference(tmp_path: Path) -> None:
    wanted = Disturbance("result", site="main.st:10", bit=1, scan=7)
    verified, once = verifier(disturbed(tmp_path, wanted), program(BELTS)), ToldOnce()
    once.stepped(verified.step(7, 0).rows[0])  # nothing is different yet
    rows = verified.verify(7).rows
    assert tuple(map(once.rest, rows)) == rows
