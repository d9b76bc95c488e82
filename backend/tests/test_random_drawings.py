"""Random drawings on both engines; the same ones on every run. `make fuzz N=100000` takes others, and more."""

from dataclasses import replace
from random import Random

import pytest

from tests.amounts import amount, nightly
from tests.drawings import KINDS, SIZE, batch, batch_failure, explained, given, ladder
from tests.drawings.drawn import Drawn, Evaluate
from tests.drawings.draws import Draws, again, smaller

BATCHES = amount(60, 21)
"""3,000 drawings, by day 1,050: of each kind a third."""


@nightly
@pytest.mark.parametrize("seed", range(BATCHES))
def test_the_engines_and_the_evaluation_agree(seed: int) -> None:
    assert not (how := batch_failure(seed)), how


def test_batches_have_every_kind_and_all_of_it() -> None:
    batches = [batch(seed) for seed in range(6)]
    assert all(len(each) == SIZE for each in batches)
    assert sorted(each[0].kind for each in batches) == sorted([*KINDS] * 2)
    everything = "\n".join(each.drawn.source for some in batches for each in some)
    for word in (
        "[a]", "[/a]", "[P a]", "[N a]", "(a)", "(/a)", "(S a)", "(R a)", "(P a)", "(N a)", "-> #w", "< ",
        ":= SEL(EN := ~, ", "NOT ENO => ", "EN := < [", "Q => #w", ").Q", "RETURN", "JMP r1", "JMP n1", "CV => #v", "EN := #w",
        "R_EDGE #w", "F_EDGE a", "NOT #w", "S=", "R=", " : INT = ", "SEL(", "XOR(",
        "(PRIORITY := 1)", "FROM (S", "TO (S", ".T >= ", "(P0)", "(P1)", "(N)", "(R)", "(SD, T#", "(DS, T#", "(SL, T#",
    ):  # fmt: skip
        assert word in everything, word


def wrong_of_an_edge(draws: Draws) -> Drawn:
    """A ladder whose evaluation is wrong where it has a coil that falls."""
    drawn = ladder.drawn(draws)

    def begin() -> Evaluate:
        evaluate = drawn.begin()
        return lambda scan, written: evaluate(scan, written) | ({"a": 2} if "(N " in drawn.source else {})

    return replace(drawn, begin=begin)


def test_of_a_batch_that_fails_the_one_drawing_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(KINDS, "ladder", wrong_of_an_edge)
    monkeypatch.setattr("tests.drawings.smaller", lambda notes, fails: notes if fails(notes) else [])
    random = Random(1)
    said = explained([given("ladder", random) for _ in range(8)], 0)
    assert said.startswith("evaluation: a is ")
    assert "(N " in said
    assert said.count("END_PROGRAM") == 1


def test_a_drawing_is_made_small() -> None:
    made = given("ladder", Random(0))
    assert made.drawn.source.count("(N ") > 1
    notes = smaller(list(made.notes), lambda fewer: "(N " in ladder.drawn(again(fewer)).source)
    body = ladder.drawn(again(notes)).source.split("END_VAR")[1]
    assert body.split() == ["RUNG", "r0:", "(N", "a)", "END_RUNG", "END_PROGRAM"]


def test_numbers_are_made_small() -> None:
    assert smaller([5, 9, 1, 7, 3, 8], lambda notes: any(each > 6 for each in notes)) == [7]
