"""Shapes in time by themselves: how long each step lasts, and what no scan can be made of."""

from itertools import accumulate

import pytest

from scanbench.faults.reference import ErrorRef
from scanbench.faults.shapes import Shape, Start, Wanted, describe_shape, flaw, lasts, step_count, waits_first

BATTERY = (ErrorRef("battery-error"),)


def scans(shape: Shape, steps: int) -> list[int]:
    """The scans before which its steps come, counted from its beginning."""
    return [0, *accumulate(lasts(shape, step) for step in range(steps - 1))]


def test_each_step_comes_so_many_scans_after_the_last() -> None:
    assert scans(Shape("for", 5), 2) == [0, 5]
    assert scans(Shape("unacknowledged", 7), 2) == [0, 7]
    assert scans(Shape("chatter"), 6) == [0, 1, 2, 3, 4, 5]
    assert scans(Shape("intermittent", 2, 10), 6) == [0, 2, 10, 12, 20, 22]
    assert [step_count(Shape(kind)) for kind in ("stay", "for", "unacknowledged", "chatter", "intermittent")] == [
        1, 2, 2, None, None,
    ]  # fmt: skip
    assert step_count(Shape("chatter", times=3)) == step_count(Shape("intermittent", times=3)) == 6


def test_chance_is_the_same_for_the_same_seed_and_around_what_was_asked_for() -> None:
    shape = Shape("intermittent", 3, 10, seed=7)
    steps = [lasts(shape, step) for step in range(2000)]
    assert steps == [lasts(Shape("intermittent", 3, 10, times=5, seed=7), step) for step in range(2000)]
    on, off = steps[::2], steps[1::2]
    assert set(on) == set(range(1, 6))
    assert set(off) == set(range(1, 14))
    assert 2.8 < sum(on) / len(on) < 3.2
    assert 6.5 < sum(off) / len(off) < 7.5
    assert steps != [lasts(Shape("intermittent", 3, 10, seed=8), step) for step in range(2000)]
    # written down, as every machine and every later version has to come to the same
    assert steps[:8] == [3, 5, 3, 5, 5, 5, 2, 2]


def test_a_probability_in_each_scan() -> None:
    shape = Shape("chance", 3, seed=7, per_million=100_000)
    on, off = [lasts(shape, step) for step in range(0, 4000, 2)], [lasts(shape, step) for step in range(1, 4000, 2)]
    assert set(on) == {3}
    assert 9.5 < sum(off) / len(off) < 10.5  # one in ten
    assert 0.09 < off.count(1) / len(off) < 0.11  # at once as often as in any scan
    assert waits_first(shape) == lasts(shape, -1) - 1
    assert {lasts(Shape("chance", per_million=1_000_000, seed=each), 1) for each in range(9)} == {1}
    rare = Shape("chance", seed=7, per_million=1)
    assert sum(lasts(rare, step) for step in range(1, 400, 2)) / 200 > 700_000
    # written down, as every machine and every later version has to come to the same
    assert (waits_first(shape), off[:6]) == (3, [7, 16, 2, 1, 2, 9])
    assert describe_shape(Wanted(BATTERY, Start(), shape)) == (
        "now, for 3 scans, with a probability of 10 % in each scan, by chance 7"
    )
    assert flaw(Wanted(BATTERY, Start(), Shape("chance", per_million=0))) == (
        "the probability is 0 millionths: it must be 1 to 1000000"
    )


@pytest.mark.parametrize(
    ("shape", "gap", "words"),
    [
        (Shape("for", 0), 0, "scans is 0: it must be 1 to 1000000000"),
        (Shape("intermittent", 1, 1), 0, "period is 1: it must be 2 to 1000000000"),
        (Shape("intermittent", 5, 5), 0, "present for 5 of every 5 scans, so it would never go"),
        (Shape("chatter", times=0), 0, "times is 0"),
        (Shape("intermittent", seed=-1), 0, "seed is -1: it must be 0 to 4294967295"),
        (Shape("for", 2_000_000_000), 0, "scans is 2000000000"),
        (Shape(), -1, "gap is -1: it must be 0"),
    ],
)
def test_numbers_that_mean_nothing_are_told(shape: Shape, gap: int, words: str) -> None:
    found = flaw(Wanted(BATTERY, Start(), shape, gap))
    assert found is not None
    assert words in found
    assert flaw(Wanted(BATTERY, Start("scan"), Shape())) == "say before which scan it begins"


def test_words() -> None:
    two = (*BATTERY, ErrorRef("io-bus-error"))
    assert describe_shape(Wanted(BATTERY)) == "now, until it is recovered"
    assert describe_shape(Wanted(two, Start("scan", 9), Shape("for", 1), 3)) == (
        "before scan 9, for 1 scan, 3 scans from one to the next"
    )
    assert describe_shape(Wanted(BATTERY, Start("line", file="a.st", line=3), Shape("chatter", times=1))) == (
        "when a.st:3 was reached, on and off in turn, 1 time"
    )
    assert describe_shape(
        Wanted(BATTERY, Start("condition", condition="x > 1"), Shape("intermittent", 2, 9, 4, 1))
    ) == ("when x > 1, 2 scans of every 9, 4 times, varied by chance 1")
    assert describe_shape(Wanted(BATTERY, Start(), Shape("unacknowledged", 2, acknowledge="ack"))) == (
        "now, gone after 2 scans, before it is acknowledged, unless ack comes first"
    )
