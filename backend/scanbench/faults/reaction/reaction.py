"""How a program reacted to an error: a run with it compared with the same run without it. Data only; `react.py` computes it."""

from dataclasses import dataclass
from typing import ClassVar, Literal, get_args

from scanbench.public import Public

Grade = Literal["acted", "decided", "displayed", "stored", "no_effect", "not_reached", "never_read"]
"""What an error did, the most first. acted: an output differs, the program raised or recovered an error or stopped. decided: state
differs that decides an output later, or a handler ran whose output had its value already. displayed: it reached memory that
only tools read. stored: it was kept, and nothing comes of it. not_reached: a statement that would read it did not come to it."""
Verdict = Literal[Grade, "stopped", "reacted", "stored_only"]
"""stopped: a fatal error, the PLC stopped as the model says, so no program could react. Only in what was kept before there were
grades: reacted (acted or decided), stored_only (displayed or stored)."""
Basis = Literal["", "exact", "static"]
"""exact: the two runs say it. static: the program's flows say it, of what did not happen in the window. Empty: not known."""
What = Literal["flag", "code", "detail", "log"]
"""log: the PLC's own error log or its counter, where a record of the error is."""
GRADES: tuple[Grade, ...] = get_args(Grade)
FINDINGS: tuple[Verdict, ...] = ("never_read", "not_reached", "no_effect", "stored", "stored_only", "displayed")
"""What the program missed, the worst first: nobody read it, or nothing came of it."""
WORST_FIRST: tuple[Verdict, ...] = (*FINDINGS, "decided", "reacted", "acted", "stopped")
UNGRADED: tuple[Verdict, ...] = ("reacted", "stored_only")
"""Only in what was kept before there were grades."""
_UNGRADED: dict[Verdict, Verdict] = {
    "acted": "reacted", "decided": "reacted", "displayed": "stored_only", "stored": "stored_only"
}  # fmt: skip
WINDOW = 200
"""Scans that a program gets to react."""


def ungraded(verdict: Verdict) -> Verdict:
    """What it was called before there were grades."""
    return _UNGRADED.get(verdict, verdict)


def fulfils(verdict: Verdict, required: Grade) -> bool:
    """Whether an error did at least this. What was not graded did what it did at most; a PLC that stopped did all there is."""
    if verdict == "stopped":
        return True
    if verdict in UNGRADED:
        return GRADES.index(required) >= GRADES.index("acted" if verdict == "reacted" else "displayed")
    return GRADES.index(verdict) <= GRADES.index(required)


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
class Carried(Public):
    """State that still differs when the window ends, and that decides an output."""

    path: str
    """A variable, or a block of the library that holds the state."""
    scan: int
    """Of the window in which it first differed, from 1."""
    readers: tuple[str, ...] = ()
    """The statements that read it, as `file:line`."""


Obstacle = Literal["condition", "left", "task", "body"]
"""condition: a statement around it ran, and did not come to it. left: its body ran, and was left before it. task: its task had
no turn. body: its program or block was not run."""


@dataclass(frozen=True, slots=True)
class Unreached(Public):
    """A statement that would read the error, and was not executed in the window."""

    file: str
    line: int
    paths: tuple[str, ...]
    """The instances that it runs on."""
    why: Obstacle
    at: str = ""
    """The statement around it as `file:line`, or the name of the task."""


Outcome = Literal["passed", "failed", "not_checked"]
Unchecked = Literal[
    "", "stopped", "window", "invalid", "ended", "not_recovered", "other_state", "not_raised", "no_state", "present"
]
"""Why a requirement was not checked. stopped: the PLC stops with this error, as the model says. window: the window is too short for it.
invalid: it does not fit the program. ended: the comparison ended before. not_recovered: the error could not be recovered.
other_state: it counts in states only that the sweep does not begin from. not_raised: the error could not be raised. no_state: it counts
in a state that there is not. present: the error was there already, and another state tried it."""

UNTRIED: tuple[Unchecked, ...] = ("not_raised", "no_state", "present")
"""The error did not come, so nothing was run."""
UNMET: tuple[Unchecked, ...] = ("window", "invalid", "ended", "not_recovered", "not_raised", "no_state")
"""Nobody knows, though the program could have been asked: a finding like one that failed."""


@dataclass(frozen=True, slots=True)
class ValueThen(Public):
    """A part of a condition, and its value when that was decided."""

    path: str
    value: str


@dataclass(frozen=True, slots=True)
class RequiredResult(Public):
    """What became of one requirement of `required.reactions`."""

    text: str
    line: int
    """In the file."""
    outcome: Outcome
    recovery: bool = False
    """It counts from the recovery on."""
    scan: int | None = None
    """In which it was decided, from 1: since the error was raised, or since it was recovered."""
    values: tuple[ValueThen, ...] = ()
    """What decided it."""
    reason: Unchecked = ""
    note: str = ""

    @property
    def is_finding(self) -> bool:
        """Failed, or nobody knows."""
        return self.outcome == "failed" or self.reason in UNMET


@dataclass(frozen=True, slots=True)
class OutputRestart(Public):
    """An output that the error had switched off, and that went on again by itself when the error was recovered."""

    path: str
    scan: int
    """Since the recovery, from 1."""
    allowed_by: str = ""
    """The requirement that allows it; empty: none does, it is a finding."""


def went_on(path: str) -> str:
    """What is wrong with an output that nothing allows to go on."""
    return f"{path} went on again by itself"


@dataclass(frozen=True, slots=True)
class Reaction(Public):
    """What became of one error, raised alone or in a run as it was."""

    verdict: Verdict
    window: int
    """Scans that were compared; fewer where something ended them."""
    first_read: int | None = None
    """Scan of the window in which flag, code, detail or log was first read, from 1."""
    first_effect: int | None = None
    """Scan of the window from which on the program did something else, from 1: an output differs, and the like. None where
    that did not happen in the window."""
    readers: tuple[Reader, ...] = ()
    differences: tuple[Difference, ...] = ()
    """The first 200, outputs first."""
    difference_count: int = 0
    lines: tuple[Line, ...] = ()
    note: str = ""
    """What ended the comparison early, or must be known: the program trapped with it, it was refused."""
    basis: Basis = ""
    carried: tuple[Carried, ...] = ()
    """decided: the state that decides."""
    decided_by: tuple[str, ...] = ()
    """decided: the statements, as `file:line`, that ran with the error only and write what an output depends on."""
    displayed: tuple[str, ...] = ()
    """The variables and words that it reached and only tools read."""
    unreached: tuple[Unreached, ...] = ()
    """Statements that would read it and were not executed."""
    required: tuple[RequiredResult, ...] = ()
    """What the project requires, in the order of its file."""
    restarts: tuple[OutputRestart, ...] = ()
    recovery: int = 0
    """Scans that were run after the recovery; 0: it was not tried, as nothing depends on it."""

    @property
    def unmet(self) -> tuple[str, ...]:
        """What is not as the project requires it, each in a line."""
        return (
            *(each.text for each in self.required if each.is_finding),
            *(went_on(each.path) for each in self.restarts if not each.allowed_by),
        )

    @property
    def reader_places(self) -> tuple[str, ...]:
        """`file:line` of what read it, each once, the first to read first."""
        return tuple(dict.fromkeys(f"{each.file}:{each.line}" for each in self.readers))
