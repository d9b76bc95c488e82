"""Wire shapes of traces and of retrospective traces. Samples are bytes: see `taps/trace_buffer.py`, `Samples.pack`."""

from dataclasses import dataclass
from typing import Literal

from pydantic import Field

from scanbench.taps.trace import MAX_SCANS, SignalText, TraceDefinition, TraceSignal, TraceTrigger
from scanbench.web.messages_base import Scan, Wire


@dataclass(frozen=True, slots=True)
class DefineTrace(TraceDefinition):
    """A trace as it is to be."""

    start: bool = True
    """Recorded from now on; else only when it was already."""


class ChangeTrace(Wire):
    """What changes about a trace; what is left out stays, so that nobody takes back what somebody else has just changed."""

    name: str | None = Field(default=None, min_length=1, max_length=100)
    add: list[SignalText] = Field(
        default=[], max_length=64, description="signals; those that it has already stay where they are"
    )
    remove: list[SignalText] = Field(default=[], description="signals")
    every: int | None = Field(default=None, ge=1, le=1_000_000)
    scans: int | None = Field(default=None, ge=2, le=MAX_SCANS)
    trigger: TraceTrigger | None = Field(default=None, description="null: it has none from now on")
    repeat: bool | None = None
    start: bool = Field(default=False, description="recorded from now on; else only when it was already")


class KeepTrace(Wire):
    name: str = Field(min_length=1, max_length=100)


class TraceRecordInfo(Wire):
    """A record that was kept in the project: of a trace, or a retrospective one."""

    id: int
    project: int
    name: str
    instance: str
    origin: Literal["trace", "retrospective"]
    by: str
    at: str
    signals: tuple[TraceSignal, ...]
    every: int
    triggered: int | None
    first: int
    end: int
    rows: int
    interval_ns: int
    program_version: int


class NewRetrospective(Wire):
    """Scans that are over, to be recorded afterwards."""

    signals: list[SignalText] = Field(min_length=1, max_length=64)
    scans: int = Field(ge=1, le=10_000_000)
    last: Scan | None = Field(default=None, description="the last of them; null is the newest that is over")
    every: int = Field(default=1, ge=1, le=1_000_000)
