"""What is asked of a PLC's variables by their paths, and what its process answers: bytes, all of one scan."""

from dataclasses import dataclass

from scanbench.wire.symbols import WatchItem


@dataclass(frozen=True, slots=True)
class ReadVariables:
    """Whole variables, all of one seam of the PLC that runs, also while its past is shown; answered with `VariablesAre`."""

    ref: int
    paths: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class VariablesAre:
    """Answer to `ReadVariables`, as it is before `scan`; `message` says why nothing was read."""

    ref: int
    version: int
    """Of the program that runs: sizes and types are those it has."""
    scan: int
    mode: str
    """PROGRAM, MONITOR or RUN."""
    stopped: bool
    """A fatal error or a trap keeps the program from running."""
    clock_ns: int
    """What the PLC's own clock shows, since 1970."""
    there: bytes
    """Of each path one byte: 0 where the program has no such variable, or an in-out leads nowhere yet."""
    data: bytes
    """The values one after the other, as they lie in memory; a BOOL in a bit of a word is a byte 0 or 1, and what is not there takes no
    room."""
    message: str = ""


@dataclass(frozen=True, slots=True)
class DescribeVariables:
    """What these paths mean in the program of the PLC that runs; answered with `VariablesDescribed`."""

    ref: int
    paths: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class VariablesDescribed:
    """Answer to `DescribeVariables`: each path in its place."""

    ref: int
    version: int
    """Of the program."""
    items: tuple[WatchItem, ...]
