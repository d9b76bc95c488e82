"""Where a PLC is halted, and why."""

from dataclasses import dataclass
from typing import Literal

from scanbench.debug.placed import Placing
from scanbench.problems import Span
from scanbench.runtime.resource import Resource
from scanbench.symbols.names import names_of

HaltReason = Literal[
    "breakpoint", "data breakpoint", "step", "pause", "entry", "goto", "error", "violation", "trap", "scan"
]


@dataclass(frozen=True, slots=True)
class Found:
    """Why to halt."""

    reason: HaltReason
    text: str
    by: str
    breakpoints: tuple[int, ...] = ()
    left: "Left | None" = None


@dataclass(frozen=True, slots=True)
class Left:
    """A value that left its subrange, and caused a halt."""

    variable: str
    """As the line has it: `tank.level`; with `instance` before it, it is a path of the program."""
    value: int
    low: int
    high: int
    instance: str
    """Path of the instance that ran; empty in a FUNCTION."""
    place: str
    """`Belt.st:12`."""
    calls: tuple[str, ...]
    """The calls that were open, the innermost first: `FB_Belt Main.belt[2] Belt.st:12`."""
    target: str = ""
    """Path of the variable, where `variable` is an in-out, or leads through one or through a reference."""


@dataclass(frozen=True, slots=True)
class Halt:
    """The PLC is halted before a statement of scan `scan`, or in the seam before that scan (`count` 0)."""

    number: int
    """Counts the halts of this process: each halt has a number of its own."""
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
    """The position is earlier than that of the live PLC: nothing can be written; Continue runs up to the live position."""
    left: Left | None = None
    """What caused a halt with the reason violation, where the list of violations has it."""


def halt_of(resource: Resource, placing: Placing, found: Found, number: int, past: bool) -> Halt:
    """The halt of a resource at its present position."""
    scan, inside = resource.header.scan, resource.listening.inside
    if inside is None or not inside.frames:
        return Halt(
            number, found.reason, found.text, found.by, found.breakpoints, scan, 0, None, "", "", "", past,
            found.left,
        )  # fmt: skip
    frame, root = inside.frames[0], inside.frames[-1]
    span = placing.sites.statements[frame.site].span
    instance = names_of(resource.program).instance(frame.instance, frame.pou.name) if frame.instance else ""
    task = placing.task_of.get(root.instance, "")
    return Halt(
        number, found.reason, found.text, found.by, found.breakpoints, scan, inside.count, span, frame.pou.name, instance,
        task, past, found.left,
    )  # fmt: skip
