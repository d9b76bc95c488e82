"""Answers of the REST API: how programs react to errors. Made by `python -m tests.client_shapes`; do not edit."""

from typing import Literal, TypedDict


class Reader(TypedDict):
    """A statement that read what the error writes."""

    file: str
    line: int
    pou: str
    what: Literal["flag", "code", "detail", "log"]
    scan: int
    """Of the window in which it first did, from 1."""


class Difference(TypedDict):
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


class HandlerLine(TypedDict):
    """A statement that was reached with the error only: the handler."""

    file: str
    line: int


class Carried(TypedDict):
    """State that still differs when the window ends, and that decides an output."""

    path: str
    """A variable, or a block of the library that holds the state."""
    scan: int
    """Of the window in which it first differed, from 1."""
    readers: list[str]
    """The statements that read it, as `file:line`."""


class Unreached(TypedDict):
    """A statement that would read the error, and was not executed in the window."""

    file: str
    line: int
    paths: list[str]
    """The instances that it runs on."""
    why: Literal["condition", "left", "task", "body"]
    at: str
    """The statement around it as `file:line`, or the name of the task."""


class ValueThen(TypedDict):
    """A part of a condition, and its value when that was decided."""

    path: str
    value: str


class RequiredResult(TypedDict):
    """What became of one requirement of `required.reactions`."""

    text: str
    line: int
    """In the file."""
    outcome: Literal["passed", "failed", "not_checked"]
    recovery: bool
    """It counts from the recovery on."""
    scan: int | None
    """In which it was decided, from 1: since the error was raised, or since it was recovered."""
    values: list[ValueThen]
    """What decided it."""
    reason: Literal[
        "", "stopped", "window", "invalid", "ended", "not_recovered", "other_state", "not_raised", "no_state", "present"
    ]
    note: str


class OutputRestart(TypedDict):
    """An output that the error had switched off, and that went on again by itself when the error was recovered."""

    path: str
    scan: int
    """Since the recovery, from 1."""
    allowed_by: str
    """The requirement that allows it; empty: none does, it is a finding."""


class Reaction(TypedDict):
    """What became of one error, raised alone or in a run as it was."""

    verdict: Literal[
        "acted",
        "decided",
        "displayed",
        "stored",
        "no_effect",
        "not_reached",
        "never_read",
        "stopped",
        "reacted",
        "stored_only",
    ]
    window: int
    """Scans that were compared; fewer where something ended them."""
    first_read: int | None
    """Scan of the window in which flag, code, detail or log was first read, from 1."""
    first_effect: int | None
    """Scan of the window from which on the program did something else, from 1: an output differs, and the like. None where that did not happen in the window."""
    readers: list[Reader]
    differences: list[Difference]
    """The first 200, outputs first."""
    difference_count: int
    lines: list[HandlerLine]
    note: str
    """What ended the comparison early, or must be known: the program trapped with it, it was refused."""
    basis: Literal["", "exact", "static"]
    carried: list[Carried]
    """decided: the state that decides."""
    decided_by: list[str]
    """decided: the statements, as `file:line`, that ran with the error only and write what an output depends on."""
    displayed: list[str]
    """The variables and words that it reached and only tools read."""
    unreached: list[Unreached]
    """Statements that would read it and were not executed."""
    required: list[RequiredResult]
    """What the project requires, in the order of its file."""
    restarts: list[OutputRestart]
    recovery: int
    """Scans that were run after the recovery; 0: it was not tried, as nothing depends on it."""


class ProgramState(TypedDict):
    """A point in a run that was kept to begin sweeps from."""

    id: int
    project: int
    name: str
    instance: str
    """Name of the PLC that it was taken from."""
    scan: int
    program_version: int
    by: str
    at: str


class SweepProblem(TypedDict):
    """A mistake in what the project requires: what it says there was not tried."""

    line: int
    column: int
    message: str


class SweepSummary(TypedDict):
    """A sweep without its cells: what it tries, and how far it is."""

    id: int
    project: int
    instance_id: int | None
    """null: that PLC is gone."""
    instance: str
    model: str
    program_version: int
    by: str
    at: str
    status: Literal["running", "done", "cancelled", "interrupted", "failed"]
    message: str
    done: int
    total: int
    window: int
    states: list[str]
    counts: dict[str, int]
    unmet: int
    """so much in all cells is not as it is required, requirements that could not be tried counted."""
    problems: list[SweepProblem]
    """mistakes in required.reactions: what it says there was not tried; each is a finding."""
    seconds: float
    """spent so far."""


class SweepError(TypedDict):
    """A row of a sweep's matrix: an error as the catalogue knew it then."""

    id: str
    name: str
    code: str
    severity: Literal["fatal", "nonfatal"]
    group: str


class Accepted(TypedDict):
    """Somebody accepted a finding: the record shows it with this reason."""

    reason: str
    by: str
    at: str


class SweepCell(TypedDict):
    """What came of one error, raised from one state."""

    error: str
    state: str
    verdict: (
        Literal[
            "acted",
            "decided",
            "displayed",
            "stored",
            "no_effect",
            "not_reached",
            "never_read",
            "stopped",
            "reacted",
            "stored_only",
        ]
        | None
    )
    """null: it could not be raised, `note` says why."""
    first_read: int | None
    first_effect: int | None
    raised_scan: int
    difference_count: int
    required: int
    """so many required reactions of the project are about it."""
    unmet: int
    """and so much is not as it is required; unexpected restarts and what was not tried are counted."""
    untried: list[RequiredResult]
    """without a verdict: what is required all the same, and why it was not tried."""
    note: str
    accepted: Accepted | None


class Sweep(TypedDict):
    """A sweep with all its cells."""

    id: int
    project: int
    instance_id: int | None
    """null: that PLC is gone."""
    instance: str
    model: str
    program_version: int
    by: str
    at: str
    status: Literal["running", "done", "cancelled", "interrupted", "failed"]
    message: str
    done: int
    total: int
    window: int
    states: list[str]
    counts: dict[str, int]
    unmet: int
    """so much in all cells is not as it is required, requirements that could not be tried counted."""
    problems: list[SweepProblem]
    """mistakes in required.reactions: what it says there was not tried; each is a finding."""
    seconds: float
    """spent so far."""
    errors: list[SweepError]
    cells: list[SweepCell]


class SweepChange(TypedDict):
    """One cell in two sweeps; null where a sweep has none."""

    error: str
    name: str
    state: str
    before: (
        Literal[
            "acted",
            "decided",
            "displayed",
            "stored",
            "no_effect",
            "not_reached",
            "never_read",
            "stopped",
            "reacted",
            "stored_only",
        ]
        | None
    )
    after: (
        Literal[
            "acted",
            "decided",
            "displayed",
            "stored",
            "no_effect",
            "not_reached",
            "never_read",
            "stopped",
            "reacted",
            "stored_only",
        ]
        | None
    )
    scans_before: int | None
    scans_after: int | None
    change: Literal["same", "better", "worse", "fewer", "slower", "faster", "new", "gone"]
    """worse: what is required, the grade, or an output differs no longer; fewer: only some other variable does not."""
    lost: list[str]
    """what differs no longer because of the error, outputs first."""
    unmet: list[str]
    """what was as required before, and is not any more."""


class SweepComparison(TypedDict):
    """SweepComparison."""

    before: SweepSummary
    after: SweepSummary
    changes: list[SweepChange]
