"""What differs between two runs, by variable, and since when.

That a timer runs or a counter counts is no effect by itself: what comes of it is one. It is kept apart, for when nothing else
differs.
"""

from collections.abc import Iterator

import numpy as np

from scanbench.check.holding import Held, Holders
from scanbench.check.program import Program
from scanbench.check.symbols import Symbol
from scanbench.check.values import format_value
from scanbench.faults.error_memory import WORD, Words
from scanbench.faults.reaction import Difference

SHOWN = 200
_NAMED = 5_000
"""More variables are not named: somebody who cleared an area knows it by then."""


class Names:
    """How the variables of one program are called, and which are outputs of the PLC."""

    def __init__(self, program: Program) -> None:
        layout, model = program.layout, program.layout.model
        self.holders = Holders(program)
        self._outputs = [(layout.areas[each.area.name], each.first, each.last + 1) for each in model.fatal.outputs]
        self._outputs += [
            (layout.areas[each.area.name], each.first, each.first + each.words)
            for each in model.iec_maps
            if each.letter == "Q"
        ]

    def is_output(self, symbol: Symbol) -> bool:
        """Whether it stands where outputs are."""
        end = symbol.offset + symbol.type.size
        return any(base + 2 * first < end and symbol.offset < base + 2 * last for base, first, last in self._outputs)


class Effects:
    """Collects what differs. States are compared in the bits of `kept` only."""

    def __init__(self, names: Names, kept: Words) -> None:
        self._names = names
        self._fresh = kept.copy()
        """Bits that never differed until now."""
        self._buffer = np.empty_like(kept)
        self._found: dict[str, Difference] = {}
        self._inside: dict[str, Difference] = {}
        """Those inside of blocks of the library."""
        self._blocks: dict[str, int] = {}
        """Such blocks by their paths, and since when they differ."""
        self._words: set[int] = set()
        """Offsets of words of the model that were named as a whole."""
        self.first: int | None = None
        """The first scan behind which something differed, but for what is inside of blocks of the library."""

    def compare(self, scan: int, without: Words, value: Words) -> None:
        """The states behind a scan."""
        buffer = self._buffer
        np.bitwise_xor(without, value, out=buffer)
        np.bitwise_and(buffer, self._fresh, out=buffer)
        if not buffer.any():
            return
        where = np.flatnonzero(buffer)
        self._fresh[where] &= ~buffer[where]
        for held in self._named(where.tolist(), buffer[where].tolist()):
            symbol = held.symbol
            found = self._inside if held.block else self._found
            raw = symbol.section == "address"
            if symbol.path in found or (raw and symbol.offset & ~1 in self._words) or not self.complete:
                continue
            found[symbol.path] = self._difference(scan, symbol, without, value)
            if raw and symbol.bit is None:
                self._words.add(symbol.offset)
            if held.block:
                self._blocks.setdefault(held.block, scan)
            elif self.first is None:
                self.first = scan

    @property
    def complete(self) -> bool:
        """Whether all that differs was named."""
        return len(self._found) + len(self._inside) < _NAMED

    @property
    def under_way(self) -> dict[str, int]:
        """Blocks of the library that differ inside, the first to do so first, and since when."""
        return self._blocks

    @property
    def count(self) -> int:
        """So many variables differed; inside of blocks of the library where no other did."""
        return len(self._found or self._inside)

    def shown(self) -> tuple[Difference, ...]:
        """The first of them, outputs first."""
        ordered = sorted((self._found or self._inside).values(), key=lambda each: (not each.output, each.scan))
        return tuple(ordered[:SHOWN])

    def _named(self, where: list[int], bits: list[int]) -> Iterator[Held]:
        for index, word in zip(where, bits, strict=True):
            if not self.complete:
                return
            for half in range(0, WORD, 2):
                mask = word >> 8 * half & 0xFFFF
                if mask:
                    yield from self._names.holders.at(index * WORD + half, mask)

    def _difference(self, scan: int, symbol: Symbol, without: Words, value: Words) -> Difference:
        return Difference(
            symbol.path, _shown(symbol, without), _shown(symbol, value), self._names.is_output(symbol), scan
        )


def _shown(symbol: Symbol, state: Words) -> str:
    data = state.view(np.uint8)[symbol.offset : symbol.offset + symbol.type.size].tobytes()
    return format_value(symbol.type, data if symbol.bit is None else bytes((data[0] >> symbol.bit & 1,)))
