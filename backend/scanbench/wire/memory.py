"""What is asked of a PLC's memory, area by area, and what its process answers."""

from dataclasses import dataclass

from scanbench.wire.symbols import SymbolInfo


@dataclass(frozen=True, slots=True)
class WantWords:
    """`count` words of a memory area from `first` on; answered with `WordsAre`."""

    ref: int
    area: str
    first: int
    count: int


@dataclass(frozen=True, slots=True)
class WantPlace:
    """The word in which a variable or an address lies; answered with `PlaceIs`."""

    ref: int
    path: str


@dataclass(frozen=True, slots=True)
class FindWords:
    """At which words of a memory area, from `first` on, these bytes begin, all in one scan; answered with `WordsFound`."""

    ref: int
    area: str
    pattern: bytes
    first: int
    most: int


@dataclass(frozen=True, slots=True)
class WordInfo:
    """A word of memory, by its address, and the variables that lie in it."""

    address: str
    symbols: tuple[SymbolInfo, ...]


@dataclass(frozen=True, slots=True)
class WordsAre:
    """Answer to `WantWords`; `message` says why there are none."""

    ref: int
    words: tuple[WordInfo, ...]
    message: str = ""


@dataclass(frozen=True, slots=True)
class PlaceIs:
    """Answer to `WantPlace`; `message` says why there is none, `near` what was perhaps meant."""

    ref: int
    area: str
    word: int
    message: str = ""
    near: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class WordsFound:
    """Answer to `FindWords`: numbers of words, as they were before `scan`; `message` says why nothing was looked at."""

    ref: int
    scan: int
    words: tuple[int, ...]
    message: str = ""


@dataclass(frozen=True, slots=True)
class AreaSpan:
    """`size` bytes of a memory area from `byte` on, as they lie there: words little endian."""

    area: str
    byte: int
    size: int
    forced: bool = False
    """Which bits of them are forced is asked, not what they are."""


@dataclass(frozen=True, slots=True)
class ReadAreas:
    """Bytes of memory areas, all of one seam of the PLC that runs, also while its past is shown; answered with `AreasAre`."""

    ref: int
    spans: tuple[AreaSpan, ...]


@dataclass(frozen=True, slots=True)
class AreasAre:
    """Answer to `ReadAreas`, as it is before `scan`; `message` says why nothing was read."""

    ref: int
    scan: int
    mode: str
    """PROGRAM, MONITOR or RUN."""
    stopped: bool
    """A fatal error or a trap keeps the program from running."""
    clock_ns: int
    """What the PLC's own clock shows, since 1970."""
    data: tuple[bytes, ...]
    message: str = ""
