"""Answers of the REST API: traces. Made by `python -m tests.client_shapes`; do not edit."""

from typing import Literal, NotRequired, TypedDict


class TraceTrigger(TypedDict):
    """What a trace waits for: an edge of `text` (of `text >= value`, where there is one), or that it is above, below, equal to the value, or that it `holds`, from when the trace is armed on."""

    text: str
    """A variable, an address, or an expression."""
    when: NotRequired[Literal["rises", "falls", "changes", "above", "below", "equals", "holds"]]
    value: NotRequired[str]
    """To compare with; empty for an edge of a BOOL."""
    before: NotRequired[int]
    """Percent of the buffer that is before the trigger."""


class TraceDefinition(TypedDict):
    """What is to be recorded: `scans` is how far the buffer reaches back."""

    name: str
    signals: list[str]
    """Variables, addresses, expressions."""
    every: int
    """So many scans from sample to sample."""
    scans: int
    """How far the buffer reaches back."""
    trigger: TraceTrigger | None
    repeat: bool
    """With a trigger: armed again when it is complete; what is shown is the last complete record."""


class TraceSignal(TypedDict):
    """A signal of a trace; `message` says why it has no values (any more)."""

    text: str
    type: str
    """Empty where it was never found."""
    kind: str
    size: int
    values: list[list[str | int]]
    """Names of an enumeration's numbers."""
    message: str


class TraceInfo(TypedDict):
    """A trace of a PLC, which everybody shares, and its state."""

    id: int
    definition: TraceDefinition
    by: str
    state: Literal["stopped", "recording", "armed", "triggered", "complete"]
    signals: list[TraceSignal]
    generation: int
    """Changes with every buffer that is shown: when the trace is recorded again, a trigger came again, or its signals changed."""
    triggered: int | None
    """After which scan the trigger came, of what is shown."""
    hits: int
    """How often it came since it was started."""
    rows: int
    first: int
    end: int
    """Scans `first` to `end` - 1 are in the buffer; both 0 where there are none."""
    bytes: int
    """What the buffer takes when it is full."""
    interval_ns: int
    note: str


class TraceRecordInfo(TypedDict):
    """A record that was kept in the project: of a trace, or a retrospective one."""

    id: int
    project: int
    name: str
    instance: str
    origin: Literal["trace", "retrospective"]
    by: str
    at: str
    signals: list[TraceSignal]
    every: int
    triggered: int | None
    first: int
    end: int
    rows: int
    interval_ns: int
    program_version: int


class Retrospective(TypedDict):
    """How far the record of earlier scans is that somebody asked for."""

    id: int
    by: str
    done: int
    of: int
    """Scans."""
    record: int | None
    """The trace record that came of it."""
    message: str
    """Why none came of it."""
    type: Literal["retrospective"]
