"""The contract of questions about the past of a run: who wrote this, what changed, where two runs part, what if."""

from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.public import Hex, Public
from scanbench.verify.contract import Place

MAX_CHANGES = 5000
"""Variables that are listed; how many there are is told in any case."""


@dataclass(frozen=True, slots=True)
class Writer(Public):
    """The last write of a variable before a moment."""

    PUBLIC: ClassVar = "LastWriter"

    path: str
    """The variable itself, after in-outs have been followed."""
    by: Literal["program", "command", "plc", "start"]
    """program: a statement. command: somebody, or an armed fault. plc: the PLC itself (system words, plant, input refresh).
    start: nobody wrote it since the first scan that is kept."""
    scan: int
    """In which it was written; a command's is the scan before which it was entered."""
    count: int
    """Of a statement: the position before it (`engines.debug`); else 0."""
    place: Place | None
    author: str
    """Of a command."""
    text: str
    """For people: `Main.st:31, Main.belt[3]: speed := LIMIT(...)`, `Write by Ada: Main.level := 7`."""
    value: Hex
    """The value after the write: its bytes in the image."""
    shown: str
    """The value as text."""


@dataclass(frozen=True, slots=True)
class Change(Public):
    """A variable, or an address without one, whose value differs."""

    PUBLIC: ClassVar = "VariableChange"

    path: str
    type: str
    kind: str
    size: int
    values: tuple[tuple[str, int], ...]
    before: Hex
    """Its bytes in the image at the first moment."""
    after: Hex
    """The same at the second."""
    before_shown: str
    """As text."""
    after_shown: str
    """As text."""


@dataclass(frozen=True, slots=True)
class BetweenEntry(Public):
    """A command that was entered."""

    scan: int
    run: Literal["", "A", "B"]
    """Which of two runs has it; empty where there is one."""
    author: str
    text: str


@dataclass(frozen=True, slots=True)
class Changes(Public):
    """What changed between two moments."""

    PUBLIC: ClassVar = "RunChanges"

    first: int
    last: int
    changes: tuple[Change, ...]
    count: int
    """So many there are, those that found no room included."""
    entries: tuple[BetweenEntry, ...]
    """What was entered in between; of two runs none."""
    note: str = ""
    """That the program changed in between, say: then variables are compared by their names."""
    at_least: bool = False
    """There may be more than `count`: so much differs that not every place was looked at."""


@dataclass(frozen=True, slots=True)
class NotCompared(Public):
    """What two runs cannot be compared in."""

    PUBLIC: ClassVar = "NotComparedVariable"

    path: str
    """The variable, or the program; empty where it is about all variables: scans that are lost."""
    reason: str
    """Which of them has it, or in what the two differ."""


@dataclass(frozen=True, slots=True)
class Divergence(Public):
    """Where two runs part first."""

    PUBLIC: ClassVar = "RunDivergence"

    compared: int
    """Scans. Fewer than from `first` to `last` where the files lost some between them: these are in `left`."""
    first: int
    last: int
    """The first and the last scan that was compared."""
    scan: int | None
    """The first scan after which anything differs; None: the two are the same as far as both go."""
    cause: Literal["", "command", "program", "start"]
    """command: what was entered differs. program: the programs differ. start: the runs differ from their beginning."""
    text: str
    """One sentence: the scan, the task, the variable, why."""
    place: Place | None
    """The statement that wrote the first variable that differs, if it is known."""
    changes: Changes | None
    """All variables that differ after that scan."""
    entries: tuple[BetweenEntry, ...]
    """Commands that only one of them has, up to that scan and shortly after it."""
    marks: tuple[tuple[int, int], ...] = ()
    """Stretches of scans in which they differ, for a timeline: at most 200, joined where there are more."""
    same: Literal["", "all", "partly", "nothing"] = ""
    """Without a difference. all: all variables, in all scans that both have. partly: only variables that both have, or a file is
    damaged and lost scans. nothing: the programs have no variable in common."""
    variables: int | None = None
    """How many were compared by their names, an array of plain values counts as one; None: one program ran, so all."""
    left: tuple[NotCompared, ...] = ()
    """What was not compared, and why: the first 100."""
    left_count: int = 0
    """So many there are, those that found no room included."""


@dataclass(frozen=True, slots=True)
class RerunChange:
    """What changes in the new run: an error that was raised is raised earlier or later, replaced by a different one, or left
    out. Everything else that was entered is entered again as commands, planned again."""

    scan: int
    """Before which the error was raised, in the original."""
    error: str
    """Its id, or with details the instance that is meant: `fal:number=5`."""
    by: int = 0
    """So many scans later; negative: earlier. Its recovery and whatever an armed fault does move with it."""
    instead: str = ""
    """Id of the error to raise in its place; empty: the same one."""
    leave_out: bool = False
    scans_after: int = 0
    """The number of scans that the new run continues after the end of the original."""
