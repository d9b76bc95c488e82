"""What differs between two runs, by variable, and since when.

That something is stored is no effect by itself: what comes of it is one. State that still differs in the end and decides
something is told apart from what is only stored.
"""

from collections.abc import Iterator

import numpy as np

from scanbench.faults.reaction.deciding import Deciding
from scanbench.faults.reaction.error_memory import WORD, Words
from scanbench.faults.reaction.reaction import Difference
from scanbench.program.program import Program
from scanbench.symbols.holding import Held, Holders
from scanbench.symbols.symbols import Symbol
from scanbench.symbols.values import format_value

SHOWN = 200
_NAMED = 5_000
"""More variables are not named: somebody who cleared an area knows it by then."""


class Names:
    """How the variables of one program are called, which are outputs of the PLC, and which decide something."""

    def __init__(self, program: Program) -> None:
        layout, model = program.layout, program.layout.model
        self.holders = Holders(program)
        self.deciding = Deciding(program)
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
        self._symbols: dict[str, Symbol] = {}
        self._words: set[int] = set()
        """Offsets of words of the model that were named as a whole."""
        self._last: tuple[Words, Words] | None = None
        self.first: int | None = None
        """The first scan behind which something differed that comes out of the program: an output, and the like."""

    def compare(self, scan: int, without: Words, value: Words) -> None:
        """The states behind a scan."""
        self._last = without, value
        buffer = self._buffer
        np.bitwise_xor(without, value, out=buffer)
        np.bitwise_and(buffer, self._fresh, out=buffer)
        if not buffer.any():
            return
        where = np.flatnonzero(buffer)
        self._fresh[where] &= ~buffer[where]
        for held in self._named(where.tolist(), buffer[where].tolist()):
            symbol = held.symbol
            raw = symbol.section == "address"
            if symbol.path in self._found or (raw and symbol.offset & ~1 in self._words) or not self.complete:
                continue
            self._found[symbol.path] = self._difference(scan, symbol, without, value)
            self._symbols[symbol.path] = symbol
            if raw and symbol.bit is None:
                self._words.add(symbol.offset)
            if self.first is None and self._names.deciding.acts(symbol):
                self.first = scan

    @property
    def complete(self) -> bool:
        """Whether all that differs was named."""
        return len(self._found) < _NAMED

    def under_way(self) -> dict[str, int]:
        """State that differs in the end and decides something: variables, or blocks of the library that hold them, the first
        to differ first, and since when."""
        if self._last is None:
            return {}
        found: dict[str, int] = {}
        without, value = self._last
        for each in sorted(self._found.values(), key=lambda each: each.scan):
            symbol = self._symbols[each.path]
            if _shown(symbol, without) != _shown(symbol, value) and self._names.deciding.decides(symbol):
                found.setdefault(self._names.deciding.block_of(symbol) or each.path, each.scan)
        return found

    @property
    def count(self) -> int:
        """So many variables differed."""
        return len(self._found)

    def shown(self) -> tuple[Difference, ...]:
        """The first of them, outputs first."""
        ordered = sorted(self._found.values(), key=lambda each: (not each.output, each.scan))
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
