"""What the parent asks a job process, and what it answers: reactions, sweeps and checks. Packed by `codec.py`, length first.

Its process (`jobs/process.py`) reads requests from a socket, in order, and answers on it: each with the answer that is named here,
or with `JobRefused`. It ends when the socket is closed, and with its parent. A sweep is cancelled by ending the process.
Nothing here changes a PLC.
"""

from dataclasses import dataclass

from scanbench.faults.reaction.reaction import Reaction, RequiredResult
from scanbench.problems import Problem
from scanbench.wire.events import CheckOutcome
from scanbench.wire.host import Sources

# ---- parent to job -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class FindReaction:
    """How the program reacted to `error`, which was raised before `scan` in the run of this file.

    The file may be that of a PLC that runs: it is opened read-only. Entries up to `end` are known to be in it. Answered with `Reacted`.
    """

    ref: int
    run: str
    error: str
    scan: int
    end: int
    window: int


@dataclass(frozen=True, slots=True)
class StartPoint:
    """Where sweeps begin: the end of a run file (a copy, which nobody writes)."""

    name: str
    run: str


@dataclass(frozen=True, slots=True)
class RunSweep:
    """Every error alone from every point, but for the pairs in `done`. Answered with `CellFound` for each, then `JobDone`.

    Errors in the order given, for each all points. A point of a different version of the program is carried over to `sources`.
    """

    ref: int
    sources: Sources
    points: tuple[StartPoint, ...]
    errors: tuple[str, ...]
    window: int
    done: tuple[tuple[str, str], ...]
    """(error, name of the point)."""
    known: tuple[str, ...] = ()
    """Further states that the project has: what is required may name them."""


@dataclass(frozen=True, slots=True)
class Check:
    """What is wrong with these sources, and what they declare. Answered with `Checked`."""

    ref: int
    sources: Sources
    numbers: bool = False
    """Also the numbers that the program raises errors with: they take a program that is put together."""


@dataclass(frozen=True, slots=True)
class KeepProgram:
    """Keeps the program of these sources, which were checked just now, for hosts to start with. Not answered."""

    sources: Sources


# ---- job to parent -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class JobRefused:
    """In place of any answer: why there is none, and what to do. `near` was perhaps meant."""

    ref: int
    message: str
    near: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Reacted:
    """Answer to `FindReaction`."""

    ref: int
    reaction: Reaction


@dataclass(frozen=True, slots=True)
class Checked:
    """Answer to `Check`."""

    ref: int
    outcome: CheckOutcome


@dataclass(frozen=True, slots=True)
class Trying:
    """What is tried now, for the progress bar; told a few times a second at most."""

    ref: int
    error: str
    point: str


@dataclass(frozen=True, slots=True)
class SweepPlanned:
    """What a sweep raises, before it begins: its errors, with the details that the program tells apart."""

    ref: int
    errors: tuple[str, ...]
    """In the notation of the command line."""
    problems: tuple[Problem, ...] = ()
    """What is wrong with what the project requires."""


@dataclass(frozen=True, slots=True)
class CellFound:
    """One error from one point; without a reaction `note` says why it could not be raised or run."""

    ref: int
    error: str
    point: str
    scan: int
    """Before which it was raised."""
    reaction: Reaction | None
    note: str = ""
    untried: tuple[RequiredResult, ...] = ()
    """Without a reaction: what is required all the same."""


@dataclass(frozen=True, slots=True)
class JobDone:
    """The sweep is over. It is refused where it cannot be done at all (no program, a point that cannot be used)."""

    ref: int
