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
        first = self._take(start)
        self._with, self._without = [first], [first]

    def add(self, without: Words, value: Words) -> None:
        """The states after a scan."""
        self._without.append(self._take(without))
        self._with.append(self._take(value))

    def switched_off(self) -> list[Leaf]:
        """What was on, and then off until now, for longer than it ever is without the error."""
        value, without = np.stack(self._with), np.stack(self._without)
        columns = np.flatnonzero((value != without).any(0))
        if not len(columns):
            return []
        value, without = _bits(value[:, columns]), _bits(without[:, columns])
        likely = np.flatnonzero(value.any(0) & (value[-1] == 0) & without.any(0) & (value != without).any(0))
        found: dict[str, Leaf] = {}
        for bit in likely.tolist():
            off = int(np.argmax(value[::-1, bit]))
            if without[-off:, bit].any() and off > _longest_off(without[:, bit]):
                for leaf in self._leaves(int(self._places[columns[bit >> 3]]), bit & 7):
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
        return int(self._with[-1][index]) & leaf.bits

    def _take(self, state: Words) -> _Bytes:
        return state.view(np.uint8)[self._places]


def is_on(leaf: Leaf, memory: bytearray) -> bool:
    """Whether an output is anything but off."""
    return any(leaf.cut(memory))


def _places(variables: Variables) -> Iterator[int]:
    for base, first, last in variables.outputs:
        yield from range(base + 2 * first, base + 2 * last)


def _bits(states: _Bytes) -> _Bytes:
    return np.unpackbits(states, axis=1, bitorder="little")


def _longest_off(column: _Bytes) -> int:
    """In a row of scans."""
    edges = np.flatnonzero(np.diff(np.concatenate(([1], column, [1])).astype(np.int8)))
    return int((edges[1::2] - edges[::2]).max(initial=0))
