"""Random ladders, diagrams and charts: both engines leave the same bytes, and what a straightforward evaluation computes.

Many are in one program, each a block with an instance of its own: most of what one costs alone is building a program.
A batch that fails is divided until one drawing is left, and that is made small.
"""

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from scanbench.garbage import without_collection
from tests.drawings import charts, diagrams, ladder
from tests.drawings.compare import failure
from tests.drawings.drawn import Drawn
from tests.drawings.draws import Draws, again, noted, smaller

KINDS: dict[str, Callable[[Draws], Drawn]] = {
    "ladder": ladder.drawn,
    "diagram": diagrams.drawn,
    "chart": charts.drawn,
}
SIZE = 50
"""Drawings of a batch."""
OPTIMISED_EACH = 8
"""Building at O2 takes several times as long as at O0, so only every eighth batch of a kind is optimised."""


@dataclass(frozen=True, slots=True)
class Given:
    """A drawing as it can be made again."""

    kind: str
    notes: tuple[int, ...]
    drawn: Drawn


def given(kind: str, random: Random) -> Given:
    notes: list[int] = []
    drawn = KINDS[kind](noted(random, notes))
    return Given(kind, tuple(notes), drawn)


def kind_of(seed: int) -> str:
    """Of three batches one of each kind, and every second or third one is not always of the same."""
    return [*KINDS][(seed + seed // len(KINDS)) % len(KINDS)]


def batch(seed: int) -> list[Given]:
    """The drawings of a seed."""
    random = Random(f"drawings {seed}")
    return [given(kind_of(seed), random) for _ in range(SIZE)]


def batch_failure(seed: int) -> str:
    """How the batch of a seed fails, with the one drawing that does, made small; '' if it does not."""
    level = 0 if seed // len(KINDS) % OPTIMISED_EACH else 2
    with without_collection():
        found = batch(seed)
        how = failure([each.drawn for each in found], level)
    return how and f"{kind_of(seed)} at O{level}: {explained(found, level)}"


def explained(found: list[Given], level: int) -> str:
    """The failure of as few of these drawings as show one."""

    def fails(some: list[Given]) -> str:
        return failure([each.drawn for each in some], level)

    while len(found) > 1:
        halves = found[: len(found) // 2], found[len(found) // 2 :]
        half = next((each for each in halves if fails(each)), None)
        if half is None:
            return f"only together: {fails(found)}\n{''.join(each.drawn.source for each in found)}"
        found = half
    make, sort = KINDS[found[0].kind], fails(found).split(":")[0]
    notes = smaller(list(found[0].notes), lambda fewer: failure([make(again(fewer))], level).split(":")[0] == sort)
    drawn = make(again(notes))
    return f"{failure([drawn], level)}\n{drawn.source}before each scan: {drawn.sets}"
