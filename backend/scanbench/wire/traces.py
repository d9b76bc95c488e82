"""What the parent and the host of a PLC say to each other about traces. See `host.py`."""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.public import Public
from scanbench.taps.trace import State, TraceDefinition, TraceSignal

# ---- parent to host ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class DefineTrace:
    """A new trace with this id, or a new definition for it; a trace that runs is started again. With `start` it is always
    started. Answered with `TracesAre`, then `Ack`."""

    ref: int
    id: int
    definition: TraceDefinition
    author: str
    start: bool


@dataclass(frozen=True, slots=True)
class DriveTrace:
    """`start` (arms it again, too), `stop` or `delete`. Answered with `TracesAre`, then `Ack`."""

    ref: int
    id: int
    action: str
    author: str


@dataclass(frozen=True, slots=True)
class ReadTrace:
    """Samples of scans `first` to `last` (None: the last one), at most `points` of them. Answered with `TraceRead`.

    As a `page`: the newest of these only, as many as one message should have; none where there are none in front.
    """

    ref: int
    id: int
    first: int
    last: int | None
    points: int | None
    page: bool = False


# ---- host to parent ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class TraceStatus(Public):
    """A trace of a PLC, which everybody shares, and its state."""

    PUBLIC: ClassVar = "TraceInfo"

    id: int
    definition: TraceDefinition
    by: str
    state: State
    signals: tuple[TraceSignal, ...]
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


@dataclass(frozen=True, slots=True)
class TracesAre:
    """All traces of the PLC, whenever one changes, and a few times a second while one grows."""

    traces: tuple[TraceStatus, ...]


@dataclass(frozen=True, slots=True)
class TraceRead:
    """Answer to `ReadTrace`: packed samples (`taps.trace_buffer.Samples.pack`), or why there are none.

    A page comes with what it is of.
    """

    ref: int
    data: bytes
    message: str = ""
    status: TraceStatus | None = None


# ---- retrospective traces: parent to job process and back -----------------------------------------------------------


@dataclass(frozen=True, slots=True)
class RecordRetrospective:
    """Runs scans `first` to `last` of this run file again, and writes samples of these signals to the file `to`, as records are
    kept (`taps/spool.py`).

    The file may be that of a PLC that runs: it is opened read-only. `RetrospectiveAt` says how far it got, `RetrospectiveDone` ends it. It is
    cancelled by ending the process.
    """

    ref: int
    run: str
    signals: tuple[str, ...]
    every: int
    first: int
    last: int
    to: str


@dataclass(frozen=True, slots=True)
class RetrospectiveAt:
    """So many scans of so many are sampled."""

    ref: int
    done: int
    of: int


@dataclass(frozen=True, slots=True)
class RetrospectiveDone:
    """The samples are in the file, of these signals."""

    ref: int
    signals: tuple[TraceSignal, ...]
    rows: int
    first: int
    end: int
    interval_ns: int
    version: int
