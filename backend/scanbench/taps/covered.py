"""What was reached of a program's files: the shape of coverage."""

from dataclasses import dataclass

from scanbench.public import Public


@dataclass(frozen=True, slots=True)
class CoveredOutcome(Public):
    """A way that a statement can go."""

    name: str
    """As `symbols.sites.Outcome`."""
    taken: bool
    """Whether it went that way."""


@dataclass(frozen=True, slots=True)
class CoveredSite(Public):
    """A statement, how it went so far, and the ways it can go."""

    line: int
    column: int
    end_line: int
    end_column: int
    pou: str
    reached: bool
    outcomes: tuple[CoveredOutcome, ...] = ()


@dataclass(frozen=True, slots=True)
class CoveredFile(Public):
    """A file of the program, and its places that can be reached."""

    file: str
    sites: tuple[CoveredSite, ...]
