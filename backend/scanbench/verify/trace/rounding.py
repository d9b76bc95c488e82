"""What numbers that are written with a few digits leave open.

A controller's tool writes 10.00 for 10.0042. The monitor begins with 10.00, so it is never quite right; with an integrator or a
comparison it is wrong by more and more. So the program is run several times more, from the ends of what the written numbers can
mean: all of them at the upper end, all at the lower, and some in which signals differ in their direction, so that no two always go
the same way. What is recorded agrees as long as it is between what these runs come to; and each further value that is recorded
narrows them again, so a fault that adds up is found once it is larger than what the digits leave open. It is an estimate: a
program that is very uneven between the ends can come to values that none of the runs has.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

from scanbench.program.types import Elementary, Kind
from scanbench.runtime.command import Patch
from scanbench.verify.sides import Begin, Side
from scanbench.verify.trace.bind import Signal, Trace
from scanbench.verify.trace.patches import patch_of, put, value_of
from scanbench.verify.trace.values import number_of, real_bytes

MOST_RANKS = 4
"""Two runs each: of rank 0 all numbers go the same way, of rank n as the bits n - 1 of their places say."""
SLACK = 1.1
"""How much wider than its digits say a written number is taken to be: the runs round, too."""


Shift = Callable[[Signal, bytes], bytes]
"""The value of an input in one of the runs."""


class Judged(Protocol):
    """An output of a scan, and what came of it."""

    @property
    def signal(self) -> Signal:
        """Which one."""

    @property
    def recorded(self) -> bytes | None:
        """What the trace says."""

    @property
    def same(self) -> bool:
        """Whether it agrees."""


@dataclass(frozen=True, slots=True)
class Spread:
    """What the runs came to at the end of a scan; without runs, nothing is left open."""

    memories: tuple[bytes, ...] = ()

    def leaves_open(self, signal: Signal, was: bytes, now: bytes) -> bool:
        """Whether the recorded value is between those of the runs, or one of theirs."""
        if not self.memories:
            return False
        found = [now, *(value_of(signal, each) for each in self.memories)]
        if not is_real(signal):
            return any(signal.exactness.same(signal.type, was, each) for each in found)
        numbers = [number_of(signal.type, each) for each in found]
        written = number_of(signal.type, was)
        half = SLACK * signal.exactness.half(max(abs(written), *(abs(each) for each in numbers)))
        return min(numbers) - half <= written <= max(numbers) + half


NO_SPREAD = Spread()
"""Of no runs."""


class Rounding:
    """The runs, in the seam before the same scan as the monitor."""

    def __init__(self, side: Side, trace: Trace) -> None:
        self._side = side
        cold = trace.scans.cold and trace.gaps != "skip"
        inputs = [each for each in trace.inputs if _is_open(each) and len(set(each.values)) > 1]
        outputs = [] if cold else [each for each in trace.outputs if _is_open(each)]
        self._places = {id(each): at for at, each in enumerate((*inputs, *outputs))}
        """Of the signals whose numbers leave something open."""
        ranks = min(MOST_RANKS, 1 + max(0, len(self._places) - 1).bit_length()) if self._places else 0
        self._runs = tuple((rank, sign) for rank in range(ranks) for sign in (1, -1))
        self.memories: list[bytes] = [side.state] * len(self._runs)

    @staticmethod
    def parts(kept: bytes, size: int) -> list[bytes]:
        """The states that were kept as one."""
        return [kept[at : at + size] for at in range(0, len(kept), size)]

    def take_up(self, memories: Sequence[bytes]) -> None:
        """Goes on from these."""
        self.memories = list(memories)

    def run(self, begin: Begin, inputs: Callable[[Shift], Sequence[Patch]]) -> Spread:
        """The scan in each of the runs; the monitor stays where it is, before it."""
        found = []
        for memory, run in zip(self.memories, self._runs, strict=True):
            whole = memory + begin.memory[len(memory) :]
            scan = partial(self._scan, inputs(partial(self._shifted, run)))
            found.append(self._side.again(replace(begin, memory=whole), scan))
        return Spread(tuple(found))

    def _shifted(self, run: tuple[int, int], signal: Signal, value: bytes) -> bytes:
        """The end of what a written number can mean at which a run begins."""
        place = self._places.get(id(signal))
        if place is None:
            return value
        rank, sign = run
        turned = rank > 0 and place >> (rank - 1) & 1
        number = number_of(signal.type, value)
        return real_bytes(signal.type, number + (-sign if turned else sign) * SLACK * signal.exactness.half(number))

    def put(self, patches: Sequence[Patch]) -> None:
        """The same values in each of the runs."""
        changed = [bytearray(each) for each in self.memories]
        for each in changed:
            put(each, patches)
        self.memories = list(map(bytes, changed))

    def _scan(self, patches: Sequence[Patch]) -> bytes:
        side = self._side
        put(side.memory, patches)
        side.run(None)
        return side.state

    def settle(self, spread: Spread, results: Sequence[Judged], taken_over: bool) -> None:
        """What is recorded narrows each run; where it differs, or is believed, they begin at its ends."""
        if not spread.memories:
            return
        self.memories = []
        for memory, run in zip(spread.memories, self._runs, strict=True):
            changed = bytearray(memory)
            for each in results:
                if each.recorded is None:
                    continue
                if taken_over or not each.same:
                    value = self._shifted(run, each.signal, each.recorded)
                else:
                    value = narrowed(each.signal, each.recorded, value_of(each.signal, changed))
                put(changed, [patch_of(each.signal, value)])
            self.memories.append(bytes(changed))


def is_real(signal: Signal) -> bool:
    """Whether it is a REAL or LREAL."""
    return isinstance(signal.type, Elementary) and signal.type.kind is Kind.REAL


def _is_open(signal: Signal) -> bool:
    return is_real(signal) and signal.exactness.rounds


def narrowed(signal: Signal, written: bytes, value: bytes) -> bytes:
    """The value of a run, or the end of what the written number can mean that is nearest to it."""
    if not is_real(signal):
        return written
    if not signal.exactness.rounds:
        return value
    number, middle = number_of(signal.type, value), number_of(signal.type, written)
    half = SLACK * signal.exactness.half(middle)
    if middle - half <= number <= middle + half:
        return value
    return real_bytes(signal.type, min(max(number, middle - half), middle + half))
