"""What a session tells its subscribers, in order. Value frames go beside these, as bytes."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Protocol

from scanbench.check.violations import Violations
from scanbench.debug.breakpoint import Verdict
from scanbench.debug.halt import Halt
from scanbench.faults.arm import ArmedInfo
from scanbench.faults.history import ErrorRow
from scanbench.runtime.forces import ForcedValue
from scanbench.runtime.recording import RecordingInfo
from scanbench.runtime.trap import TrapInfo
from scanbench.session import debug_protocol
from scanbench.session.builds import BuildOutcome
from scanbench.session.protocol import RunMark, WatchItem
from scanbench.session.trace_protocol import TraceStatus
from scanbench.store.records import AcceptedRow, CellRow, SweepRow


@dataclass(frozen=True, slots=True)
class User:
    """Somebody at a browser."""

    name: str


@dataclass(frozen=True, slots=True)
class PlcState:
    """The state of one virtual PLC, host process included."""

    state: str
    mode: str
    message: str
    scan: int = 0
    time_ns: int = 0
    interval_ns: int = 0
    cycle_us: float = 0.0
    speed: float = 1.0
    pid: int | None = None
    restarts: int = 0
    trap: TrapInfo | None = None
    forces: int = 0
    version: int = 0
    live_scan: int = 0
    past_by: str = ""
    """Who shows the past; empty when it is live."""
    target: str = ""
    previous_version: int | None = None
    late_percent: float = 0.0
    late_us: float = 0.0
    """Mean lateness of scans since the pace was set; `worst_us` is the most."""
    worst_us: float = 0.0
    halt: Halt | None = None
    flavour: str = ""
    """Which code runs: empty is the ordinary one, `debug`, `probed`."""


@dataclass(frozen=True, slots=True)
class LogEntry:
    """One line of the log, for people."""

    at: datetime
    scan: int
    author: str
    text: str
    kind: str


@dataclass(frozen=True, slots=True)
class StateChanged:
    """The PLC's state is another."""

    state: PlcState


@dataclass(frozen=True, slots=True)
class ErrorsChanged:
    """Rows of the error history that changed."""

    rows: tuple[ErrorRow, ...]


@dataclass(frozen=True, slots=True)
class Logged:
    """New lines of the log."""

    lines: tuple[LogEntry, ...]


@dataclass(frozen=True, slots=True)
class UsersChanged:
    """Somebody came or went."""

    users: tuple[User, ...]


@dataclass(frozen=True, slots=True)
class ProgramBuilt:
    """Somebody built; refused builds are told too."""

    author: str
    outcome: BuildOutcome


@dataclass(frozen=True, slots=True)
class FileSaved:
    """Somebody saved a file of the project."""

    author: str
    path: str
    version: int


@dataclass(frozen=True, slots=True)
class FileDeleted:
    """Somebody deleted a file of the project."""

    author: str
    path: str


@dataclass(frozen=True, slots=True)
class ValueWritten:
    """Somebody wrote or forced a variable."""

    path: str
    author: str
    scan: int
    forced: bool


@dataclass(frozen=True, slots=True)
class ForcesChanged:
    """All forces that hold now, and what they did."""

    forces: tuple[ForcedValue, ...]


@dataclass(frozen=True, slots=True)
class DiagnosticsChanged:
    """The runtime diagnostics, all of them, whenever one changes."""

    violations: Violations


@dataclass(frozen=True, slots=True)
class TimelineChanged:
    """The run file or its marks changed; `fresh`: these are all the marks there are."""

    info: RecordingInfo
    marks: tuple[RunMark, ...]
    fresh: bool


@dataclass(frozen=True, slots=True)
class Watching:
    """Answer to the `watch` of a subscriber; with ref None what all ids mean now that the variables moved."""

    ref: int | None
    items: tuple[WatchItem, ...]


@dataclass(frozen=True, slots=True)
class ArmedChanged:
    """All faults that are armed, whenever they change."""

    faults: tuple[ArmedInfo, ...]


@dataclass(frozen=True, slots=True)
class SweepChanged:
    """A sweep of the project began, went on or ended."""

    row: SweepRow
    now: str
    cells: tuple[CellRow, ...]
    """Those that are new, or accepted or not any more."""
    accepted: Mapping[tuple[str, str], AcceptedRow]


@dataclass(frozen=True, slots=True)
class WatchListChanged:
    """Somebody saved or deleted (version 0) a watch list; with an `owner` it is nobody else's business."""

    id: int
    owner: str
    version: int
    author: str


@dataclass(frozen=True, slots=True)
class BreakpointsChanged:
    """All breakpoints and what became of them, whenever that changes."""

    verdicts: tuple[Verdict, ...]


@dataclass(frozen=True, slots=True)
class LogpointSaid:
    """A logpoint was reached."""

    said: debug_protocol.LogpointSaid


@dataclass(frozen=True, slots=True)
class CoverageChanged:
    """Something more was reached, or coverage was switched."""

    coverage: debug_protocol.Coverage


@dataclass(frozen=True, slots=True)
class TracesChanged:
    """All traces of the PLC, whenever one changes or grows."""

    traces: tuple[TraceStatus, ...]


@dataclass(frozen=True, slots=True)
class FlightChanged:
    """How far the record of earlier scans is that somebody asked for."""

    id: int
    by: str
    done: int
    of: int
    """Scans."""
    record: int | None = None
    """The trace record that came of it."""
    message: str = ""
    """Why none came of it."""


@dataclass(frozen=True, slots=True)
class WrittenInside:
    """Something was written into the scan that is halted: what is shown of it is not what it was."""

    scan: int


Told = (
    StateChanged
    | ErrorsChanged
    | Logged
    | UsersChanged
    | ProgramBuilt
    | FileSaved
    | FileDeleted
    | ValueWritten
    | ForcesChanged
    | DiagnosticsChanged
    | TimelineChanged
    | ArmedChanged
    | SweepChanged
    | WatchListChanged
    | BreakpointsChanged
    | CoverageChanged
    | TracesChanged
    | FlightChanged
    | Watching
)

"""What everybody is told."""
Event = Told | LogpointSaid | WrittenInside
"""And what debug sessions say in their own words."""


class Subscriber(Protocol):
    """Somebody who looks at a PLC. Called in the event loop; must not wait."""

    user: User

    def on_event(self, event: Event) -> None:
        """Something happened."""

    def on_frame(self, frame: bytes) -> None:
        """Values changed."""

    def on_snapshot(self, frame: bytes) -> None:
        """All values, as asked for."""
