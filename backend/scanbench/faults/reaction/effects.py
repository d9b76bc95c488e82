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
from scanbench.symbols.kept import KeptNames
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.values import format_value

SHOWN = 200
_NAMED = 5_000
"""More variables are not named: somebody who cleared an area knows it by then."""


class Variables:
    """Of one program: how they are called, which are outputs of the PLC, and which decide something."""

    def __init__(self, program: Program) -> None:
        layout, model = program.layout, program.layout.model
        self._layout = layout
        self.names = KeptNames(program)
        self.deciding = Deciding(program)
        self.outputs = [(layout.areas[each.area.name], each.first, each.last + 1) for each in model.fatal.outputs]
        self.outputs += [
            (layout.areas[each.area.name], each.first, each.first + each.words)
            for each in model.iec_maps
            if each.letter == "Q"
        ]

    def word_of(self, leaf: Leaf) -> str:
        """Its name; of a bit without a name of its own that of its word."""
        layout, found = self._layout, self._layout.area_at(leaf.offset) if leaf.raw and leaf.bit is not None else None
        return leaf.name if found is None else layout.model.format(found[0], found[1] & ~1, None, 16)

    def is_output(self, leaf: Leaf) -> bool:
        """Whether the variable is in an output area."""
        end = leaf.offset + leaf.type.size
        return any(base + 2 * first < end and leaf.offset < base + 2 * last for base, first, last in self.outputs)


class Effects:
    """Collects what differs. States are compared in the bits of `kept` only."""

    def __init__(self, variables: Variables, kept: Words) -> None:
        self._variables = variables
        self._fresh = kept.copy()
        """Bits that never differed until now."""
        self._buffer = np.empty_like(kept)
        self._found: dict[str, Difference] = {}
        self._leaves: dict[str, Leaf] = {}
        self._words: set[int] = set()
        """Offsets of words of the model that were named as a whole."""
        self._last: tuple[Words, Words] | None = None
        self.first: int | None = None
        """The first scan after which something differed that comes out of the program: an output, and the like."""

    def compare(self, scan: int, without: Words, value: Words) -> None:
        """The states after a scan."""
        self._last = without, value
        buffer = self._buffer
        np.bitwise_xor(without, value, out=buffer)
        np.bitwise_and(buffer, self._fresh, out=buffer)
        if not buffer.any():
            return
        where = np.flatnonzero(buffer)
        self._fresh[where] &= ~buffer[where]
        for leaf in self._named(where.tolist(), buffer[where].tolist()):
            if leaf.name in self._found or (leaf.raw and leaf.offset & ~1 in self._words) or not self.complete:
                continue
            self._found[leaf.name] = self._difference(scan, leaf, without, value)
            self._leaves[leaf.name] = leaf
            if leaf.raw and leaf.bit is None:
                self._words.add(leaf.offset)
            if self.first is None and self._variables.deciding.acts(leaf):
                self.first = scan

    @property
    def complete(self) -> bool:
        """Whether all that differs was named."""
        return len(self._found) < _NAMED

    def carried(self) -> dict[str, tuple[int, int, int]]:
        """State that differs in the end and decides something: variables, or blocks of the library that hold them, the first
        to differ first; since when, and the bytes from and to which it is in the image."""
        if self._last is None:
            return {}
        found: dict[str, tuple[int, int, int]] = {}
        without, value = self._last
        deciding = self._variables.deciding
        for each in sorted(self._found.values(), key=lambda each: each.scan):
            leaf = self._leaves[each.path]
            if _shown(leaf, without) != _shown(leaf, value) and deciding.decides(leaf):
                path, begin, end = deciding.block_of(leaf) or (each.path, leaf.offset, leaf.offset + leaf.type.size)
                found.setdefault(path, (each.scan, begin, end))
        return found

    def displayed(self) -> tuple[str, ...]:
        """What differed at any time and only tools read, no output; the first of them."""
        deciding = self._variables.deciding
        ordered = sorted(self._found.values(), key=lambda each: each.scan)[:SHOWN]
        leaves = (self._leaves[each.path] for each in ordered)
        shown = (leaf for leaf in leaves if deciding.shows(leaf) and not deciding.acts(leaf))
        return tuple(dict.fromkeys(map(self._variables.word_of, shown)))

    @property
    def count(self) -> int:
        """So many variables differed."""
        return len(self._found)

    def shown(self) -> tuple[Difference, ...]:
        """The first of them, outputs first."""
        ordered = sorted(self._found.values(), key=lambda each: (not each.output, each.scan))
        return tuple(ordered[:SHOWN])

    def _named(self, where: list[int], bits: list[int]) -> Iterator[Leaf]:
        for index, word in zip(where, bits, strict=True):
            if not self.complete:
                return
            for half in range(0, WORD, 2):
                mask = word >> 8 * half & 0xFFFF
                if mask:
                    yield from self._variables.names.at(index * WORD + half, mask)

    def _difference(self, scan: int, leaf: Leaf, without: Words, value: Words) -> Difference:
        return Difference(leaf.name, _shown(leaf, without), _shown(leaf, value), self._variables.is_output(leaf), scan)


def _shown(leaf: Leaf, state: Words) -> str:
    end = leaf.offset + leaf.type.size
    return format_value(leaf.type, leaf.cut(state.view(np.uint8)[leaf.offset : end].tobytes(), leaf.offset))
