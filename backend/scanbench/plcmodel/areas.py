"""The memory areas of a model: their words, who may touch them, and places in them."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

Access = Literal["none", "read", "write"]
Who = Literal["program", "tool", "engine"]
"""The user program, any tool or protocol client, and the engine interface (the error simulator's own door)."""


@dataclass(frozen=True, slots=True)
class AccessRange:
    """Words `first` to `last`, both included, and what each side may do with them."""

    first: int
    last: int
    program: Access = "write"
    tool: Access = "write"
    engine: Access = "write"


@dataclass(frozen=True, slots=True)
class Area:
    """One memory area. Where it lies in the image is the layout's business."""

    name: str
    words: int
    ranges: tuple[AccessRange, ...]
    """Without gaps or overlaps, ascending: the loader sees to it."""
    retain: bool = False
    """Keeps its content over a power cycle. What a change between PROGRAM and RUN clears: `FatalBehaviour.cleared`."""
    description: str = ""
    prefix: str = ""
    """What its addresses begin with, where that is not the name (`E0_`)."""
    aliases: tuple[str, ...] = ()
    """Other prefixes of its addresses, upper case (`AR` for `A`)."""
    first: int = 0
    """Number of its first word (or bit, see `unit`) in addresses."""
    unit: Literal["word", "bit"] = "word"
    """What the number in an address counts: `D100` is a word, `M100` on a MELSEC a bit."""
    radix: Literal[10, 16] = 10
    """Of that number: `X1F` is the 32nd bit."""
    bit_radix: Literal[10, 16] = 10
    """Of the bit after the dot: `A402.12`, `D100.F`."""
    bare_bits: bool = False
    """A bit may be written without a prefix: `0.00`."""
    source: str = ""
    verified: bool = False
    texts: bool = False
    """Only programs that give an instruction a text have it: see `as_used`."""

    @property
    def size(self) -> int:
        """Bytes: words are stored little endian, two bytes each."""
        return self.words * 2

    @property
    def written(self) -> str:
        """What its addresses begin with."""
        return self.prefix or self.name

    def access(self, word: int, who: Who) -> Access:
        """What `who` may do with this word; nothing outside of the area."""
        for entry in self.ranges:
            if entry.first <= word <= entry.last:
                return entry.program if who == "program" else entry.tool if who == "tool" else entry.engine
        return "none"

    def protected(self, byte: int, size: int, who: Who) -> int | None:
        """The first of the words with these bytes that `who` may not write; None where all may be written."""
        words = range(byte // 2, (byte + max(1, size) + 1) // 2)
        return next((word for word in words if self.access(word, who) != "write"), None)


class Location(NamedTuple):
    """A place in an area: bit n of word w is byte 2*w + n//8, bit n%8."""

    area: Area
    byte: int
    bit: int | None
    """0 to 7 within the byte; None for a whole byte, word, ..."""
    bits: int
    """1, 8, 16, 32 or 64."""

    @property
    def word(self) -> int:
        """The word that holds this place (its first one, if it is wider)."""
        return self.byte // 2


@dataclass(frozen=True, slots=True)
class IecMap:
    """Where `%I`, `%Q` or `%M` lie: `words` words of `area` from `first` on."""

    letter: str
    area: Area
    first: int
    words: int
