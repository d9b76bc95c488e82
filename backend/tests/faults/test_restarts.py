"""Which outputs an error switched off, from all scans and from what is kept of them."""

import random
import tracemalloc
from collections.abc import Iterator
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from scanbench.faults.reaction.effects import Variables
from scanbench.faults.reaction.restarts import Outputs
from scanbench.program.types import BOOL
from scanbench.symbols.leaves import Leaf


class Bits:
    """A variable for each bit of the outputs."""

    def at(self, word: int, bits: int) -> Iterator[Leaf]:
        place, bit = divmod(bits.bit_length() - 1, 8)
        yield cast(Leaf, SimpleNamespace(name=f"{word + place}.{bit}", type=BOOL, offset=word + place, bits=1 << bit))


def outputs(start: int, words: int = 1) -> Outputs:
    variables = SimpleNamespace(outputs=((0, 0, words),), names=Bits())
    return Outputs(cast(Variables, variables), np.array([start] * words, np.uint64))


def longest_off(row: str) -> int:
    return max(map(len, row.split("1")))


@pytest.mark.parametrize("seed", range(20))
def test_what_was_switched_off_is_as_all_scans_say(seed: int) -> None:
    chance = random.Random(seed)
    start = chance.getrandbits(16)
    states = [(start, start)]
    found = outputs(start)
    for _ in range(chance.randrange(1, 12)):
        states.append((chance.getrandbits(16), chance.getrandbits(16) & chance.getrandbits(16)))
        without, value = (np.array([each], np.uint64) for each in states[-1])
        found.add(without, value)
    wanted = set()
    for bit in range(16):
        alone, there = ("".join(str(each >> bit & 1) for each in run) for run in zip(*states, strict=True))
        off = len(there) - len(there.rstrip("0"))
        if "1" in there and off and "1" in alone[-off:] and off > longest_off(alone):
            wanted.add(f"{bit >> 3}.{bit & 7}")
    assert {leaf.name for leaf in found.switched_off()} == wanted


def test_a_long_window_needs_no_more_memory_than_a_short_one() -> None:
    found = outputs(1, 1000)
    state = np.zeros(1000, np.uint64)
    tracemalloc.start()
    try:
        for _ in range(500):
            found.add(state, state)
        assert tracemalloc.get_traced_memory()[0] < 200_000  # all scans would be 2,000,000
    finally:
        tracemalloc.stop()
