"""How a program reacted to an error: a run with it compared with the same run without it. Data only; `react.py` computes it."""

from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.public import Public

Verdict = Literal["reacted", "stored_only", "no_effect", "not_reached", "never_read", "stopped"]
"""stored_only: what differs decides nothing. not_reached: a statement that would read it did not come to it. stopped: a fatal
error, the PLC stopped as the model says, so no program could react."""
What = Literal["flag", "code", "detail", "log"]
"""log: the PLC's own error log or its counter, where a record of the error is."""
FINDINGS: tuple[Verdict, ...] = ("never_read", "not_reached", "no_effect", "stored_only")
"""What the program missed: nobody read it, or nothing came of it."""
WINDOW = 200
"""Scans that a program gets to react."""


@dataclass(frozen=True, slots=True)
class Reader(Public):
    """A statement that read what the error writes."""

    file: str
    line: int
    pou: str
    what: What
    scan: int
    """Of the window in which it first did, from 1."""


@dataclass(frozen=True, slots=True)
class Difference(Public):
    """A variable or address, outside of error memory, whose value differed from that without the error."""

    path: str
    without: str
    """Its value without the error in the scan where it first differed, as the watch table shows it."""
    value: str
    """And with it."""
    output: bool
    """An output of the PLC."""
    scan: int
    """Of the window in which it first differed, from 1."""


@dataclass(frozen=True, slots=True)
class Line(Public):
    """A statement that was reached with the error only: the handler."""

    PUBLIC: ClassVar = "HandlerLine"

    file: str
    line: int


@dataclass(frozen=True, slots=True)
class Reaction(Public):
    """What became of one error, raised alone or in a run as it was."""

    verdict: Verdict
    window: int
    """Scans that were compared; fewer where something ended them."""
    first_read: int | None = None
    """Scan of the window in which flag, code, detail or log was first read, from 1."""
    first_effect: int | None = None
    """Scan of the window from which on the program did something else, from 1: an output differs, and the like; where there is
    none, state that decides one later. None where nothing but copies differ."""
    readers: tuple[Reader, ...] = ()
    differences: tuple[Difference, ...] = ()
    """The first 200, outputs first."""
    difference_count: int = 0
    lines: tuple[Line, ...] = ()
    note: str = ""
    """What ended the comparison early, or must be known: the program trapped with it, it was refused."""

    @property
    def reader_places(self) -> tuple[str, ...]:
        """`file:line` of what read it, each once, the first to read first."""
        return tuple(dict.fromkeys(f"{each.file}:{each.line}" for each in self.readers))
