"""What a CONFIGURATION says: which program runs when, and what else variables are called."""

from dataclasses import dataclass

from scanbench.problems import Span
from scanbench.program.program import Place, Pou, Stmt


@dataclass(frozen=True, slots=True)
class ProgramInstance:
    """`before` and `after` are what a CONFIGURATION connects: run around the body, with places of Base.IMAGE only.

    Sites in them count from 0 (as with a POU whose `first_check` is 0), and no instance is running there. `pou` may be a function block that a task
    runs by itself: `name` is the path of that instance.
    """

    name: str
    pou: Pou
    offset: int
    before: tuple[Stmt, ...] = ()
    after: tuple[Stmt, ...] = ()
    retain: bool = False
    """Declared as PROGRAM RETAIN: so are its variables, where they say nothing else themselves."""


@dataclass(frozen=True, slots=True)
class Task:
    """Runs in every scan n for which n * base_interval is a multiple of `interval_ns`, in this order of priority.

    With `single`, a BOOL: also in a scan where it is TRUE and was FALSE when this was last looked at (`previous`, a
    BOOL of the image that the engine keeps), and its interval counts only while it is FALSE. It is looked at in each
    scan when the task's turn comes. `every` is 0 for a task without an interval.
    """

    name: str
    interval_ns: int
    priority: int
    every: int
    """Due in scans that are multiples of this."""
    programs: tuple[ProgramInstance, ...]
    single: Place | None = None
    previous: Place | None = None
    single_span: Span | None = None
    """The span of SINGLE."""


@dataclass(frozen=True, slots=True)
class AccessPath:
    """VAR_ACCESS: an additional name for a variable, for tools."""

    name: str
    path: str
    writable: bool
