"""Breakpoints, as people set them, and what became of each."""

from dataclasses import dataclass
from typing import Literal

BreakpointKind = Literal["line", "data", "error", "violation", "trap", "scan"]
DataAccess = Literal["read", "write", "change", "access"]
"""`access`: reads and writes. `change`: a write after which the value is different."""


@dataclass(frozen=True, slots=True)
class Breakpoint:
    """Where, or at what, to halt; `log` or `assign` instead of halting. Texts are as typed."""

    id: int
    """Of one PLC; chosen by the parent."""
    kind: BreakpointKind
    author: str
    group: str = ""
    """The list to which it belongs: empty for the one that all browsers share, else that of one debug session of a DAP client."""
    enabled: bool = True
    file: str = ""
    """Of a line: path in the project."""
    line: int = 0
    column: int = 0
    """From 1; 0 is the first statement in the line."""
    path: str = ""
    """Of data: instance path or address, in-outs are followed again in each scan."""
    access: DataAccess = "change"
    error: str = ""
    """Of an error raised: its id, or any."""
    scan: int = 0
    """Halts before this scan's first statement."""
    condition: str = ""
    """A BOOL expression in the scope of the statement (of the whole program for the other kinds)."""
    hits: str = ""
    """`3`, `= 3`: the third time alone; `>= 3`: from the third on; `% 3`: every third. Counted where the condition holds."""
    log: str = ""
    """A message with `{expression}` in it."""
    assign: str = ""
    """Assignments of ST, `a := a + 1; b := TRUE;`, entered by the author through the one door."""
    instance: str = ""
    """Only in this instance (path) of the POU; empty is any."""
    task: str = ""
    """Only while this task runs; empty is any."""

    def is_of(self, group: str, kind: str | None, file: str | None) -> bool:
        """Whether a new list of the group replaces it; `kind` narrows that, `file` to line breakpoints in it."""
        in_file = file is None or (self.kind == "line" and self.file == file)
        return self.group == group and kind in (None, self.kind) and in_file


@dataclass(frozen=True, slots=True)
class Verdict:
    """A breakpoint, and what became of it in the program that runs."""

    breakpoint: Breakpoint
    verified: bool
    message: str
    """Why it is not, or what is special: `moved to line 12: line 11 has no statement`."""
    line: int = 0
    """Where it really is; 0 for other kinds."""
    column: int = 0
    end_line: int = 0
    end_column: int = 0
    hits: int = 0
    """How often its place was reached with its condition true, since it was set."""
