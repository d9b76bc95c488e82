"""What was reached of a program's files: the shape of coverage."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CoveredSite:
    """A statement, how it went so far, and the ways it can go."""

    line: int
    column: int
    end_line: int
    end_column: int
    pou: str
    reached: bool
    outcomes: tuple[tuple[str, bool], ...] = ()
    """Name (`check.sites.Outcome`) and whether it went that way."""


@dataclass(frozen=True, slots=True)
class CoveredFile:
    file: str
    sites: tuple[CoveredSite, ...]
