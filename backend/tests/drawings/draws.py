"""Chance for the makers of drawings: each draw is a number below an end, so that what was made can be made again, and smaller."""

from collections.abc import Callable, Iterable, Sequence
from random import Random
from typing import TypeVar

from hypothesis import strategies as st

_T = TypeVar("_T")
Below = Callable[[int], int]
"""An end above 0 -> a number from 0 to the one before it. The smaller the number, the simpler what is made."""
WIDTHS, COUNTED, TRIES = (64, 16, 4, 2, 1), 16, 3000


class Draws:
    """What a maker asks."""

    def __init__(self, below: Below) -> None:
        self._below = below

    def integer(self, low: int, high: int) -> int:
        """Both ends are possible."""
        return low + self._below(high - low + 1)

    def flag(self) -> bool:
        return bool(self._below(2))

    def one(self, of: Sequence[_T]) -> _T:
        return of[self._below(len(of))]

    def some(self, of: Iterable[_T], least: int, most: int) -> list[_T]:
        """So many of them, each at most once."""
        left = list(of)
        return [left.pop(self._below(len(left))) for _ in range(self.integer(least, most))]

    def values(self, ranges: dict[str, tuple[int, int]]) -> dict[str, int]:
        """Of some of the variables a value in its range."""
        return {name: self.integer(*bounds) for name, bounds in ranges.items() if self.flag()}


def noted(random: Random, notes: list[int]) -> Draws:
    """By chance; what is drawn is noted."""

    def below(end: int) -> int:
        notes.append(int(random.random() * end))
        return notes[-1]

    return Draws(below)


def again(notes: Sequence[int]) -> Draws:
    """What was noted, and the simplest from where that ends."""
    left = iter(notes)
    return Draws(lambda end: min(next(left, 0), end - 1))


@st.composite
def of(draw: st.DrawFn, make: Callable[[Draws], _T]) -> _T:
    """For tests of hypothesis: what a maker makes."""
    return make(Draws(lambda end: draw(st.integers(0, end - 1))))


def smaller(notes: list[int], fails: Callable[[list[int]], bool]) -> list[int]:
    """Notes of which none can be left out or made less without losing the failure, as far as `TRIES` go."""
    tries = 0

    def shows(changed: list[int]) -> bool:
        nonlocal notes, tries
        tries += 1
        if tries > TRIES or not fails(changed):
            return False
        notes = changed
        return True

    before: list[int] = []
    while before != notes and tries <= TRIES:
        before = notes
        for width in WIDTHS:
            for at in reversed(range(len(notes) - width + 1)):
                shows(notes[:at] + notes[at + width :])
        for at in range(len(notes)):
            if at < len(notes):
                next((less for less in range(notes[at]) if shows([*notes[:at], less, *notes[at + 1 :]])), None)
        # one less of something that is counted, and what was drawn for the first of them
        for at, width in ((at, width) for at in range(len(notes)) for width in range(1, COUNTED)):
            if at + width < len(notes) and notes[at]:
                shows([*notes[:at], notes[at] - 1, *notes[at + 1 + width :]])
    return notes
