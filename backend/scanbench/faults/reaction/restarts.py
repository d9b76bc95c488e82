"""Outputs that an error switched off, and that go on again by themselves when it is recovered: an unexpected restart."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from scanbench.faults.reaction.effects import Variables
from scanbench.faults.reaction.error_memory import Words
from scanbench.program.types import Elementary
from scanbench.symbols.leaves import Leaf

_Bytes = NDArray[np.uint8]


class Outputs:
    """The outputs of two runs, scan by scan, up to the recovery."""

    def __init__(self, variables: Variables, start: Words) -> None:
        """`start` is the state before the first scan."""
        self._variables = variables
        self._places = np.array(sorted(set(_places(variables))), np.int64)
        self._now = self._take(start)
        self._scans = 0
        bits = 8 * len(self._places)
        self._differed = np.zeros(bits, np.bool_)
        self._last_on, self._last_on_without = np.full(bits, -1, np.int32), np.full(bits, -1, np.int32)
        """By bit the last scan in which it was on, with the error and without; -1: in none."""
        self._longest_off = np.zeros(bits, np.int32)
        """Without the error, in a row of scans that an on ended."""
        self._see(self._now, self._now)

    def add(self, without: Words, value: Words) -> None:
        """The states after a scan."""
        self._now = self._take(value)
        self._see(self._take(without), self._now)

    def _see(self, without: _Bytes, value: _Bytes) -> None:
        """Nothing is kept of a scan but this: a window may have a hundred thousand."""
        bits = np.unpackbits(without, bitorder="little"), np.unpackbits(value, bitorder="little")
        self._differed |= bits[0] != bits[1]
        on = np.flatnonzero(bits[0])
        self._longest_off[on] = np.maximum(self._longest_off[on], self._scans - 1 - self._last_on_without[on])
        self._last_on_without[on] = self._scans
        self._last_on[np.flatnonzero(bits[1])] = self._scans
        self._scans += 1

    def switched_off(self) -> list[Leaf]:
        """What was on, and then off until now, for longer than it ever is without the error."""
        off = self._scans - 1 - self._last_on
        longest = np.maximum(self._longest_off, self._scans - 1 - self._last_on_without)
        was_on = (self._last_on >= 0) & (off > 0) & self._differed
        found: dict[str, Leaf] = {}
        for bit in np.flatnonzero(was_on & (self._last_on_without > self._last_on) & (off > longest)).tolist():
            for leaf in self._leaves(int(self._places[bit >> 3]), bit & 7):
                found.setdefault(leaf.name, leaf)
        return list(found.values())

    def _leaves(self, place: int, bit: int) -> Iterator[Leaf]:
        for leaf in self._variables.names.at(place & ~1, 1 << bit << 8 * (place & 1)):
            if isinstance(leaf.type, Elementary) and not any(self._byte_now(leaf, at) for at in range(leaf.type.size)):
                yield leaf

    def _byte_now(self, leaf: Leaf, at: int) -> int:
        index = int(np.searchsorted(self._places, leaf.offset + at))
        if index >= len(self._places) or self._places[index] != leaf.offset + at:
            return 0
        return int(self._now[index]) & leaf.bits

    def _take(self, state: Words) -> _Bytes:
        return state.view(np.uint8)[self._places]


def is_on(leaf: Leaf, memory: bytearray) -> bool:
    """Whether an output is anything but off."""
    return any(leaf.cut(memory))


def _places(variables: Variables) -> Iterator[int]:
    for base, first, last in variables.outputs:
        yield from range(base + 2 * first, base + 2 * last)
