"""What a session tells its subscribers, in order. Value frames are sent separately, as bytes."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import ClassVar, Literal, Protocol

from scanbench.check.pou_infos import PouInfo
from scanbench.check.task_infos import TaskInfo
from scanbench.debug.breakpoint import Verdict
from scanbench.faults.arm import ArmedInfo
from scanbench.faults.device_shapes import DeviceErrors
from scanbench.faults.disturb.disturb import DisturbanceInfo
from scanbench.faults.history import ErrorRow
from scanbench.faults.line_faults import BrokenLine
from scanbench.faults.raised_numbers import RaisedNumber
from scanbench.problems import Problem, Severity
from scanbench.program.sites import CheckSite
from scanbench.public import Moment, Public
from scanbench.recording.recording import RecordingInfo
from scanbench.runtime.forces import ForcedValue
from scanbench.store.records import AcceptedRow, CellRow, ProjectRow, SweepRow
from scanbench.symbols.violations import Violations
from scanbench.wire import debugging as debug_protocol
from scanbench.wire.campaigns import CampaignState
from scanbench.wire.comparisons import Comparison, Rerun
from scanbench.wire.host import MarkKind, PlcState, Previewed, RunMark
from scanbench.wire.symbols import WatchItem
from scanbench.wire.together import DraftEdited, PeopleChanged
from scanbench.wire.traces import TraceStatus
from scanbench.wire.verifying import VerificationStatus


@dataclass(frozen=True, slots=True)
class CheckOutcome:
    """What a check found: no subrange checks, embedded or proved needless, while there are errors."""

    problems: tuple[Problem, ...]
    pous: tuple[PouInfo, ...]
    checks: tuple[CheckSite, ...] = ()
    numbers: tuple[RaisedNumber, ...] | None = None
    """Those that the program raises errors with; None where nobody asked, or the program has errors."""
    tasks: tuple[TaskInfo, ...] = ()

    @property
    def errors(self) -> int:
        """The number of problems that prevent the program from running."""
        return sum(problem.severity is Severity.ERROR for problem in self.problems)


@dataclass(frozen=True, slots=True)
class Change:
    """What a swap does to the variables of one running PLC."""

    instance: int
    name: str
    previewed: Previewed


@dataclass(frozen=True, slots=True)
class BuildOutcome:
    """What became of a build, and the project after it."""

    ok: bool
    message: str
    found: CheckOutcome
    project: ProjectRow
    changes: tuple[Change, ...] = ()
    needs_agreement: bool = False
    """Nothing was swapped yet: variables would begin again."""


@dataclass(frozen=True, slots=True)
class User:
    """Somebody at a browser, or a client of a protocol."""

    name: str
    client: bool = False
    """A program that speaks a protocol: nobody who sees others."""

    @property
    def initials(self) -> str:
        """Of the first two words, digits whole (`Guest 12` is G12)."""
        letters = [word if word.isdigit() else word[0].upper() for word in self.name.split()[:2]]
        return "".join(letters) or "?"


@dataclass(frozen=True, slots=True)
class LogEntry(Public):
    """One line of the log, for people."""

    PUBLIC: ClassVar = "LogLine"

    at: Moment
    scan: int
    author: str
    text: str
    kind: MarkKind


@dataclass(frozen=True, slots=True)
class StateChanged:
    """The PLC's state changed."""

    state: PlcState


@dataclass(frozen=True, slots=True)
class ErrorsChanged:
    """Rows of the error history that changed."""

    rows: tuple[ErrorRow, ...]
    whole: bool = False
    """These are all rows: what is not among them is there no more."""


@dataclass(frozen=True, slots=True)
class Logged(Public):
    """New lines of the log."""

    PUBLIC: ClassVar = "Log"

    lines: tuple[LogEntry, ...]
    type: Literal["log"] = "log"


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
    saved: datetime


@dataclass(frozen=True, slots=True)
class InstanceDeleted(Public):
    """Somebody deleted the PLC: who is at it goes on with a different one."""

    PUBLIC: ClassVar = "InstanceDeleted"

    author: str
    type: Literal["instance_deleted"] = "instance_deleted"


@dataclass(frozen=True, slots=True)
class FileDeleted(Public):
    """Somebody deleted a file of the project."""

    PUBLIC: ClassVar = "Deleted"

    author: str
    path: str
    type: Literal["deleted"] = "deleted"


@dataclass(frozen=True, slots=True)
class ValueWritten(Public):
    """Somebody wrote or forced a variable."""

    PUBLIC: ClassVar = "Written"

    path: str
    author: str
    scan: int
    forced: bool
    type: Literal["written"] = "written"


@dataclass(frozen=True, slots=True)
class DeviceChanged(Public):
    """The device's own view of its errors, read from its memory."""

    PUBLIC: ClassVar = "Device"

    found: DeviceErrors
    type: Literal["device"] = "device"


@dataclass(frozen=True, slots=True)
class EndedForce(Public):
    """A force that somebody ended: released, or by a restart or a program that does not keep it."""

    path: str
    by: str


@dataclass(frozen=True, slots=True)
class ForcesChanged(Public):
    """All forces that hold now, and what they did."""

    PUBLIC: ClassVar = "Forces"

    forces: tuple[ForcedValue, ...]
    ended: tuple[EndedForce, ...] = ()
    """Those that held until then. None of those that only do not hold at the scan of the past that is shown."""
    type: Literal["forces"] = "forces"


@dataclass(frozen=True, slots=True)
class DiagnosticsChanged:
    """The runtime diagnostics, all of them, whenever one changes."""

    violations: Violations


@dataclass(frozen=True, slots=True)
class TimelineChanged(Public):
    """The run file or its marks changed; `fresh`: these are all the marks there are."""

    PUBLIC: ClassVar = "Timeline"

    info: RecordingInfo
    marks: tuple[RunMark, ...]
    fresh: bool
    type: Literal["timeline"] = "timeline"


@dataclass(frozen=True, slots=True)
class Watching:
    """Answer to the `watch` of a subscriber; with ref None what all ids mean now that the variables moved."""

    ref: int | None
    items: tuple[WatchItem, ...]


@dataclass(frozen=True, slots=True)
class ArmedChanged(Public):
    """All faults that are armed, whenever they change."""

    PUBLIC: ClassVar = "Armed"

    faults: tuple[ArmedInfo, ...]
    type: Literal["armed"] = "armed"


@dataclass(frozen=True, slots=True)
class LinesChanged(Public):
    """The lines to clients that something is wrong with, whenever they change."""

    PUBLIC: ClassVar = "Lines"

    broken: tuple[BrokenLine, ...]
    type: Literal["lines"] = "lines"


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
class TracesChanged(Public):
    """All traces of the PLC, whenever one changes or grows."""

    PUBLIC: ClassVar = "Traces"

    traces: tuple[TraceStatus, ...]
    type: Literal["traces"] = "traces"


@dataclass(frozen=True, slots=True)
class RetrospectiveChanged(Public):
    """How far the record of earlier scans is that somebody asked for."""

    PUBLIC: ClassVar = "Retrospective"

    id: int
    by: str
    done: int
    of: int
    """Scans."""
    record: int | None = None
    """The trace record that came of it."""
    message: str = ""
    """Why none came of it."""
    type: Literal["retrospective"] = "retrospective"


@dataclass(frozen=True, slots=True)
class VerificationsChanged:
    """All verifications of the PLC, whenever one changes or goes on."""

    verifications: tuple[VerificationStatus, ...]


@dataclass(frozen=True, slots=True)
class Disturbances(Public):
    """Those that are not over, and those that were missed, whenever they change."""

    disturbances: tuple[DisturbanceInfo, ...]
    type: Literal["disturbances"] = "disturbances"


@dataclass(frozen=True, slots=True)
class WrittenInside:
    """Something was written into the scan that is halted: what is shown of it is not what it was."""

    scan: int


Told = (
    StateChanged
    | ErrorsChanged
    | Logged
    | UsersChanged
    | PeopleChanged
    | ProgramBuilt
    | FileSaved
    | FileDeleted
    | InstanceDeleted
    | DraftEdited
    | ValueWritten
    | DeviceChanged
    | ForcesChanged
    | DiagnosticsChanged
    | TimelineChanged
    | ArmedChanged
    | LinesChanged
    | SweepChanged
    | WatchListChanged
    | BreakpointsChanged
    | debug_protocol.Coverage
    | TracesChanged
    | RetrospectiveChanged
    | VerificationsChanged
    | Disturbances
    | Comparison
    | CampaignState
    | Rerun
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
