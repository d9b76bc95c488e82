"""Numbers that clients send back: frames, and variables that have parts. They are valid while the PLC is halted."""

from collections import OrderedDict
from dataclasses import dataclass

from scanbench.wire.refused import Refused

_KEPT = 20_000
"""So many at most: a client that asks on and on loses the oldest."""


@dataclass(frozen=True, slots=True)
class Below:
    """What has variables below it: a scope of a frame, or an expression."""

    frame: int | None
    scope: str
    expression: str


class Handles:
    """Given out upward and never again, so that a stale one is noticed."""

    def __init__(self) -> None:
        self._next = 1
        self._frames: dict[int, int] = {}
        self._below: OrderedDict[int, Below] = OrderedDict()
        self._numbers: dict[Below, int] = {}

    def clear(self) -> None:
        """Forgets the frames, as the PLC halted at a new place or runs: numbers that belong to no frame stay valid."""
        self._frames.clear()
        for number, below in list(self._below.items()):
            if below.frame is not None:
                self._forget(number)

    def frame_id(self, index: int) -> int:
        """The number of a frame of the stack."""
        found = next((number for number, each in self._frames.items() if each == index), None)
        if found is None:
            found = self._take()
            self._frames[found] = index
        return found

    def frame(self, id: int | None) -> int | None:
        """The index of a frame; None stays None."""
        if id is None:
            return None
        index = self._frames.get(id)
        if index is None:
            raise Refused(f"frame {id} is of an earlier halt, or there was none: ask for the stack again")
        return index

    def reference(self, below: Below) -> int:
        """The number of what has something below it."""
        number = self._numbers.get(below)
        if number is None:
            number = self._take()
            self._below[number] = below
            self._numbers[below] = number
            if len(self._below) > _KEPT:
                self._forget(next(iter(self._below)))
        return number

    def below(self, reference: int) -> Below:
        """What this number refers to."""
        found = self._below.get(reference)
        if found is None:
            raise Refused(f"variables {reference} are of an earlier halt, or there were none: ask for the scopes again")
        return found

    def _take(self) -> int:
        number, self._next = self._next, self._next + 1
        return number

    def _forget(self, number: int) -> None:
        del self._numbers[self._below.pop(number)]
