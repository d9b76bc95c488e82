"""What a program does, statement by statement, noted outside of the image: the contract of observed code.

Code is observed when it was made so (`interpreter.observed`, `native.observed`); other code pays nothing. Observing never
changes the image. A site is a statement of the user's files (`symbols.sites`); the system program, the plant and libraries
have none. What a library reads, the user's statement reads that called it. Nothing is noted while common processing, the
plant or a condition runs, nor when a task looks whether it is due, nor of what the model's instructions look at themselves. Following an in-out reads what it refers to, and taking
a reference or writing reads nothing (but for indices). A statement that traps has read what it read before that.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from scanbench.engines.engine import Engine
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.sites import Sites, sites_of

LIMIT = 8192
"""Reads that are kept from one `take` to the next."""


@dataclass(frozen=True, slots=True)
class ReadAt:
    """A statement read bits that are watched."""

    site: int
    """Index into `Sites.statements`."""
    offset: int
    """Of the byte in the image."""
    mask: int
    """Which of its bits were read."""


@dataclass(frozen=True, slots=True)
class Seen:
    """What was noted since the last time, in the user's program."""

    reached: frozenset[int]
    """Sites of the statements that began."""
    reads: tuple[ReadAt, ...]
    """Of watched bits, each (site, byte) once, in the order in which they were first read."""
    lost: int = 0
    """Reads that found no room any more."""
    outcomes: frozenset[int] = frozenset()
    """Ways that statements went (indices into `Sites.outcomes`); noted by the debug flavour alone."""


class Observer(ABC):
    """Made with an observed engine, for its program. Not while `run` is running."""

    def __init__(self, program: Program, sites: Sites | None = None) -> None:
        """`sites` of the program may be known already."""
        self.sites: Sites = sites or sites_of(program)
        """What the numbers mean."""
        self._areas = range(Layout.HEADER_SIZE, areas_end(program.layout))

    @abstractmethod
    def watch(self, bits: Iterable[tuple[int, int]]) -> None:
        """From now on reads of these (offset of a byte, mask) are noted, and of no others; of none before the first call.

        Bits of the model's areas can be watched, where located variables and addresses live. Raises ValueError for
        others. A BOOL reads its bit, everything else all bits of its bytes (a STRING those of its whole variable).
        """

    @abstractmethod
    def take(self) -> Seen:
        """What was noted, and forgets it. What is watched stays."""

    def _masks(self, bits: Iterable[tuple[int, int]]) -> dict[int, int]:
        """The watched bits of each byte."""
        masks: dict[int, int] = {}
        for offset, mask in bits:
            if offset not in self._areas or not 0 <= mask <= 0xFF:
                raise ValueError(f"byte {offset} with mask {mask:#x} is in no area of the model; watch one that is")
            masks[offset] = masks.get(offset, 0) | mask
        return {offset: mask for offset, mask in masks.items() if mask}


Observed = tuple[Engine, Observer]
MakeObserved = Callable[[Program, bytearray], Observed]
"""Makes an engine that is observed, on this image, with what it notes."""


def areas_end(layout: Layout) -> int:
    """The offset after the last byte of the model's areas."""
    ends = (layout.areas[area.name] + area.size for area in layout.model.areas)
    return max(ends, default=Layout.HEADER_SIZE)
