"""Wire shapes of traces and of the flight recorder. Samples are bytes: see `taps/trace_buffer.py`, `Samples.pack`."""

from typing import Annotated, Literal

from pydantic import Field

from scanbench.taps.trace import TraceSignal
from scanbench.web.messages_base import Scan, Wire

TraceState = Literal["stopped", "recording", "armed", "triggered", "complete"]
"""`recording`: without a trigger, for ever. `armed`: it waits for its trigger. `triggered`: the rest is being recorded."""
TraceWhen = Literal["rises", "falls", "changes", "above", "below", "equals", "holds"]
SignalText = Annotated[str, Field(min_length=1, max_length=2000)]


class TraceTrigger(Wire):
    """What a trace waits for. An edge of a number is that of `text >= value`."""

    text: SignalText = Field(description="a variable, an address, or an expression")
    when: TraceWhen = "rises"
    value: str = Field(default="", max_length=200, description="to compare with; empty for an edge of a BOOL")
    before: int = Field(default=50, ge=0, le=100, description="percent of the buffer that is in front of the trigger")


class TraceDefinition(Wire):
    name: str = Field(min_length=1, max_length=100)
    signals: list[SignalText] = Field(min_length=1, max_length=64, description="variables, addresses, expressions")
    every: int = Field(default=1, ge=1, le=1_000_000, description="so many scans from sample to sample")
    scans: int = Field(default=30_000, ge=2, le=10_000_000, description="how far the buffer reaches back")
    trigger: TraceTrigger | None = None
    repeat: bool = Field(default=False, description="armed again when it is complete")


class DefineTrace(TraceDefinition):
    start: bool = Field(default=True, description="recorded from now on; else only when it was already")


class TraceInfo(Wire):
    """A trace of an instance, shared by everybody."""

    id: int
    definition: TraceDefinition
    by: str
    state: TraceState
    signals: tuple[TraceSignal, ...]
    generation: int = Field(description="other samples than those of another generation")
    triggered: int | None = Field(description="after which scan the trigger came, of what is shown")
    hits: int = Field(description="how often it came since it was started")
    rows: int
    first: int = Field(description="scans `first` to `end` - 1 are in the buffer; both 0 where there are none")
    end: int
    bytes: int = Field(description="what the buffer takes when it is full")
    interval_ns: int
    note: str


class Traces(Wire):
    """All traces of the instance, whenever one changes, and a few times a second while one grows."""

    type: Literal["traces"] = "traces"
    traces: list[TraceInfo]


class KeepTrace(Wire):
    name: str = Field(min_length=1, max_length=100)


class TraceRecordInfo(Wire):
    """A record that was kept in the project: of a trace, or by the flight recorder."""

    id: int
    project: int
    name: str
    instance: str
    origin: Literal["trace", "flight"]
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


class NewFlight(Wire):
    """Scans that are over, to be recorded afterwards."""

    signals: list[SignalText] = Field(min_length=1, max_length=64)
    scans: int = Field(ge=1, le=10_000_000)
    last: Scan | None = Field(default=None, description="the last of them; null is the newest that is over")
    every: int = Field(default=1, ge=1, le=1_000_000)
