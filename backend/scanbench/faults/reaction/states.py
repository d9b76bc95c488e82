"""The states of a run, scan by scan, in memory: kept as what each scan changed."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from scanbench.faults.reaction.error_memory import Words

_BYTES_OF_CHANGE = 12


class Trace:
    """States of one program, in order."""

    def __init__(self, first: Words, limit: int) -> None:
        """`first` is the state before the first scan; the changes are to take no more than `limit` bytes."""
        self._first, self._last = first.copy(), first.copy()
        self._changes: list[tuple[NDArray[np.uint32], Words]] = []
        self._left = limit

    def __len__(self) -> int:
        return len(self._changes)

    @property
    def full(self) -> bool:
        """Whether there is no room for more."""
        return self._left < 0

    def add(self, state: Words) -> None:
        """The state after the next scan."""
        where = np.flatnonzero(state != self._last).astype(np.uint32)
        values = state[where]
        self._last[where] = values
        self._changes.append((where, values))
        self._left -= _BYTES_OF_CHANGE * len(where)

    def states(self) -> Iterator[Words]:
        """The state after each scan; one array that changes."""
        state = self._first.copy()
        for where, values in self._changes:
            state[where] = values
            yield state
