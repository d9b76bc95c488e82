"""Where a PLC is halted, and why."""

from dataclasses import dataclass
from typing import Literal

from scanbench.problems import Span

HaltReason = Literal[
    "breakpoint", "data breakpoint", "step", "pause", "entry", "goto", "error", "violation", "trap", "scan"
]


@dataclass(frozen=True, slots=True)
class Halt:
    """The PLC stands in front of a statement of scan `scan`, or in the seam in front of that scan (`count` 0)."""

    number: int
    """Counts the halts of this process: another number is another halt."""
    reason: HaltReason
    text: str
    """For people: `breakpoint at Main.st:12`, `Main.level changed from 3 to 7`, `step over by Ann`."""
    by: str
    """Whose breakpoint or step it was."""
    breakpoints: tuple[int, ...]
    scan: int
    count: int
    """See `engines.debug`."""
    span: Span | None
    """The statement that is next; None in the seam (before the first statement of a scan it is that statement's)."""
    pou: str
    instance: str
    """Path of the instance; empty in a FUNCTION or the seam."""
    task: str
    past: bool
    """What is shown is behind where the PLC stands: nothing can be written; going on leads up to that place."""
