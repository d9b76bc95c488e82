"""A drawing, and what is expected of it."""

from collections.abc import Callable
from dataclasses import dataclass

Values = dict[str, int]
"""By path below the drawing; a BOOL is 0 or 1, a TIME nanoseconds."""
Evaluate = Callable[[int, Values], Values]
"""The scan and what is written before it -> what there is after it. Called for each scan in order."""


@dataclass(frozen=True, slots=True)
class Drawn:
    source: str
    """A `PROGRAM Main`."""
    sets: list[Values]
    """Before each scan, what is written."""
    begin: Callable[[], Evaluate]
    """A straightforward evaluation from the beginning."""
