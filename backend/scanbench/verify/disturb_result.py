"""Corrupted results: what statements wrote in one scan, and which bit of it turns over."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from scanbench.check.named import temporary_at, variable_at
from scanbench.check.program import Program
from scanbench.check.symbols import UnknownPath, at_offset, resolve
from scanbench.check.types import BOOL
from scanbench.runtime.command import Command
from scanbench.verify.disturb import Disturbed
from scanbench.verify.disturb_fire import Corrupt
from scanbench.verify.disturb_wanted import chance

_WHOLE = 0xFF


@dataclass(slots=True)
class Wish:
    """A disturbance that is to come about in the scan that runs."""

    of: Disturbed
    sites: frozenset[int]
    """The statements."""
    written: list[tuple[int, int, int]] = field(default_factory=list)
    """Offset, size, bits: by the first of them that wrote anything, up to the next statement."""
    done: bool = False
    why: str = "the statement did not run"
    """Why it did not come about, where it did not."""


class Results:
    """An `Insider`: enters the corrupted results of one scan."""

    def __init__(self, program: Program, wishes: Sequence[Wish]) -> None:
        self._program, self.wishes = program, wishes

    def wrote(self, site: int, offset: int, size: int, bits: int) -> bool:
        """See `Insider`."""
        found = False
        for wish in self.wishes:
            if site in wish.sites and not wish.done:
                wish.written.append((offset, size, bits))
            found = found or (bool(wish.written) and not wish.done)
        return found

    def due(self) -> tuple[Command, ...]:
        """See `Insider`."""
        made = [self._corrupt(wish) for wish in self.wishes if wish.written and not wish.done]
        return tuple(each for each in made if each is not None)

    @property
    def over(self) -> bool:
        """See `Insider`."""
        return all(wish.done for wish in self.wishes)

    def _corrupt(self, wish: Wish) -> Corrupt | None:
        """Of the first value, unless chance says which; what the compiler keeps for itself is no result."""
        values = [each for each in wish.written if _name(self._program, each[0])]
        if not values:
            wish.written.clear()  # the next one, perhaps
            return None
        wish.done = True
        of = wish.of
        drawn = chance(of.wanted, of.number, of.time, "bit")
        offset, size, bits = values[0 if of.wanted.bit is not None else drawn % len(values)]
        count = self._bits(offset, size, bits)
        index = drawn // len(values) % count if of.wanted.bit is None else of.wanted.bit
        name = _name(self._program, offset)
        if index >= count:
            wish.why = f"what it wrote to {name} has no bit {index}"
            return None
        at, bit = (offset, bits.bit_length() - 1) if bits != _WHOLE else (offset + index // 8, index % 8)
        return Corrupt(of.by, of.number, of.time + 1, of.fired + 1, of.wanted.site, at, bit, index, name)

    def _bits(self, offset: int, size: int, bits: int) -> int:
        """So many bits of what was written mean anything."""
        if bits != _WHOLE:
            return 1
        if size > 1:
            return 8 * size
        symbol = variable_at(self._program, (offset, 0), BOOL)
        if symbol is not None:
            return 1 if symbol.bit is None else 8
        temporary = temporary_at(self._program, offset)
        if temporary is None or temporary[0].frame.members[temporary[1].upper()].type == BOOL:
            return 1
        return 8


def _name(program: Program, offset: int) -> str:
    """For people; empty for what has none, and for what an in-out or reference refers to: that is no value."""
    if offset >= program.layout.state_size:
        temporary = temporary_at(program, offset)
        return f"{temporary[0].name}.{temporary[1]}" if temporary is not None and temporary[1] else ""
    path = at_offset(program, offset)
    try:
        return "" if resolve(program, path).slots else path
    except UnknownPath:
        return ""
