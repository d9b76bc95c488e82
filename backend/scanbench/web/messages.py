"""Every JSON shape of REST and of the WebSocket, of which `messages.gen.ts` of the page is made; `frames.py` has binary frames."""

from typing import Annotated, Literal

from pydantic import Field

from scanbench.check.pou_infos import PouInfo
from scanbench.check.task_infos import TaskInfo
from scanbench.faults.arm import ArmedInfo
from scanbench.faults.device_shapes import DeviceErrors
from scanbench.faults.disturb.disturb import DisturbanceInfo
from scanbench.faults.raised_numbers import RaisedNumber
from scanbench.runtime.forces import ForcedValue
from scanbench.web.messages_base import Id, Scan, Version, Wire
from scanbench.web.messages_debug import BreakpointInfo, Breakpoints, Dap, HaltInfo
from scanbench.web.messages_diagnostics import Diagnostics
from scanbench.web.messages_errors import ErrorHistoryRow, SweepProgress
from scanbench.web.messages_projects import OnlineChange
from scanbench.web.messages_together import Draft
from scanbench.web.messages_verify import VerificationInfo, Verifications
from scanbench.web.messages_watch import WatchListChanged
from scanbench.wire import events
from scanbench.wire.campaigns import CampaignState
from scanbench.wire.comparisons import Comparison, Rerun
from scanbench.wire.debugging import Coverage
from scanbench.wire.symbols import SymbolInfo
from scanbench.wire.together import DraftEdited, PeopleChanged

# ---- programs, files, problems -------------------------------------------------------------------------------


class Problem(Wire):
    """One finding of the compiler. Lines and columns count from 1; the end is exclusive."""

    code: str
    severity: Literal["error", "warning", "info"]
    message: str
    file: str
    line: int
    column: int
    end_line: int
    end_column: int


class Project(Wire):
    """A project: its files are built for a model."""

    id: int
    name: str
    model: str
    version: int = Field(description="counts the builds that were accepted")
    watch: list[str] = Field(description="what a fresh watch list begins with")


class FileInfo(Wire):
    path: str
    version: int
    author: str = Field(description="who saved this version; empty when nobody knows")
    saved: str = Field(default_factory=str, description="when, ISO 8601; empty when nobody knows")


class FileText(FileInfo):
    text: str


class SaveFile(Wire):
    """Optimistic save: `version` is the one the edit began from (0 for a new file)."""

    text: str
    version: Version
    draft: str | None = Field(
        default=None,
        description="the draft that has this text: without it, what is different in the text becomes a change of the draft",
    )


class SaveConflict(Wire):
    """Somebody else saved first (status 409): nothing was written; here is theirs."""

    message: str
    theirs: FileText


class CheckRequest(Wire):
    """Texts being edited, not yet saved; the other files of the project are taken as stored."""

    files: dict[str, str]
    numbers: bool = Field(default=False, description="also find the numbers that the program raises errors with")


class EmbeddedCheck(Wire):
    """A subrange check that the compiler embedded at this place, or left out."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int
    variable: str
    low: str = Field(description="a number as text: a ULINT is beyond what JSON numbers keep")
    high: str
    needless: str = Field(description="why no check was embedded; empty when there is one")


class CheckResult(Wire):
    problems: list[Problem]
    pous: tuple[PouInfo, ...]
    checks: list[EmbeddedCheck] = Field(description="none while there are errors")
    tasks: tuple[TaskInfo, ...] = Field(default=(), description="none while there are errors")
    numbers: tuple[RaisedNumber, ...] | None = Field(
        default=None,
        description="constants in calls of FAL, FALS and their like; null where nobody asked, or the program has errors",
    )


class ProgramText(Wire):
    """A version of the program as it ran in an instance, whatever the files of the project say since."""

    version: int
    files: dict[str, str] = Field(description="path -> text")
    pous: tuple[PouInfo, ...]


class Build(Wire):
    """`agreed`: variables may be initialised again; without it a build that would do so only reports what it would do."""

    agreed: bool = False
    instances: list[Id] | None = Field(default=None, description="which PLCs are to be changed; null is all of them")
    message: str = Field(default="", max_length=10_000, description="what was changed and why; kept with the version")


class BuildResult(Wire):
    ok: bool
    message: str
    problems: list[Problem]
    project: Project
    pous: tuple[PouInfo, ...]
    changes: list[OnlineChange] = Field(description="for each running PLC of the project")
    needs_agreement: bool = Field(description="nothing was swapped yet: variables would be lost; build again, agreed")


# ---- instances ---------------------------------------------------------------------------------------------------

RunState = Literal[
    "starting", "running", "paused", "halted", "stopped", "fatal", "trapped", "restarting", "silent", "failed", "past", "off",
    "no_space",
]  # fmt: skip
"""`no_space`: its run cannot be recorded, so it waits, and goes on when there is room. `halted`: by the debugger, inside of a scan or before one. `past`: everybody is shown an earlier scan, the PLC waits at its live one. `silent`: its process does not answer. `off`: somebody switched the instance off."""
Mode = Literal["PROGRAM", "MONITOR", "RUN"]
RestartKind = Literal["cold", "warm", "power"]
"""cold: everything initial; warm: RETAIN variables and retained areas are kept; power: as the model does at power-on."""


class TrapInfo(Wire):
    """Why the program was stopped by itself."""

    kind: Literal["bounds", "division", "null", "string", "loop", "abstract", "fatal"]
    message: str
    file: str
    line: int
    column: int
    scan: int


class PastInfo(Wire):
    """What is shown is the past: the PLC waits at `live_scan`."""

    live_scan: int
    by: str = Field(description="who went there")


class InstanceState(Wire):
    """The state of one virtual PLC, as the top bar and the rail show it."""

    state: RunState
    mode: Mode
    message: str = Field(description="one line that says why, e.g. the error code or the trap's place")
    scan: int
    time_ns: int
    interval_ns: int
    cycle_us: float = Field(description="measured duration of a scan")
    speed: float = Field(description="1 = real time, 0 = as fast as possible")
    pid: int | None
    restarts: int
    trap: TrapInfo | None
    forces: int
    program_version: int
    past: PastInfo | None
    previous_version: int | None = Field(description="what a roll back swaps in; null when there is nothing")
    target: str = Field(description="where a run ends: `scan 4711`, `until Main.count > 3`; or empty: it does not")
    late_percent: float = Field(description="scans of the last seconds that began after the next one was due")
    late_us: float = Field(description="how late scans began, in the mean, since speed was set or the PLC went on")
    worst_us: float = Field(description="how late the latest of them began: after a stall, too")
    halt: HaltInfo | None = Field(description="where the debugger halted it, also in the past; null while it runs")
    flavour: str = Field(description="which code runs: empty is the ordinary one, `debug`, `probed`")
    startable: bool = Field(description="false: nothing starts it, `message` says why and what to do")


class InstanceLoad(Wire):
    """What an instance costs now; zeros while it is off."""

    cpu_percent: float = Field(description="of one core")
    memory_bytes: int = Field(description="proportional share of memory (PSS)")
    run_bytes: int = Field(description="size of the run file")


class InstanceLimits(Wire):
    """What an instance may cost at most; null is no limit."""

    memory_mib: int | None = Field(default=None, ge=64, le=65536)
    cpu_percent: int | None = Field(default=None, ge=1, le=100, description="of one core, for runs as fast as possible")
    run_mib: int | None = Field(default=None, ge=1, le=65536, description="bound of the run file; null is the default")


class User(Wire):
    """Somebody who is at a PLC; a `client` of a protocol is no person."""

    name: str
    initials: str
    client: bool = False


class Instance(Wire):
    """A virtual PLC that runs the program of a project."""

    id: int
    name: str
    project: Project
    model: str
    state: InstanceState
    load: InstanceLoad
    limits: InstanceLimits
    users: list[User] = Field(description="who is at it now")


class ImportedInstance(Instance):
    """A PLC that goes on with the run of a file."""

    damage: str = Field(description="what is damaged in the file, and what is lost; empty where all is well")


class NewInstance(Wire):
    project: Id
    name: str = Field(min_length=1, max_length=100)


class Branch(Wire):
    """A new instance that begins as this one was before `scan`; null is now (a clone). A `look` is deleted a minute after its last viewer left."""

    name: str = Field(min_length=1, max_length=100)
    scan: Scan | None = None
    look: bool = False


class ChangeInstance(Wire):
    """Null leaves as it is."""

    name: str | None = Field(default=None, min_length=1, max_length=100)
    power: bool | None = Field(default=None, description="false ends the process, true starts it where it was")
    limits: InstanceLimits | None = None


class AppInfo(Wire):
    """What there is on a server."""

    version: str
    public_url: str = Field(description="what links that are passed on begin with; empty: the address of the page")
    you: User
    projects: list[Project]
    instances: list[Instance]


class Refusal(Wire):
    """Every refused request: what, and what to do next."""

    message: str
    near: list[str] = Field(default_factory=list, description="near matches for an unknown name")


# ---- WebSocket: server to browser -------------------------------------------------------------------------------


class Hello(Wire):
    """First message after connecting, and after every reconnection: everything but the values."""

    type: Literal["hello"] = "hello"
    you: User
    users: list[User]
    instance: Instance
    errors: list[ErrorHistoryRow]
    log: list[events.LogEntry]
    forces: tuple[ForcedValue, ...]
    device: DeviceErrors | None = Field(description="null until the PLC was there once")
    armed: tuple[ArmedInfo, ...]
    lines: events.LinesChanged
    diagnostics: Diagnostics
    timeline: events.TimelineChanged
    breakpoints: list[BreakpointInfo]
    coverage: Coverage | None
    verifications: list[VerificationInfo]
    disturbances: tuple[DisturbanceInfo, ...]


class State(Wire):
    type: Literal["state"] = "state"
    state: InstanceState


class Watched(Wire):
    """One path of a `Watch`: an id for the value frames, or the reason why there is none."""

    path: str
    id: int | None
    symbol: SymbolInfo | None
    refusal: Refusal | None


class Watching(Wire):
    """Answer to `watch`; sent again, for all ids, when a new program moved the variables."""

    type: Literal["watching"] = "watching"
    ref: int | None
    items: list[Watched]


class Done(Wire):
    """Answer to every command: applied in the seam before `scan`, or refused with a reason."""

    type: Literal["done"] = "done"
    ref: int
    ok: bool
    message: str
    scan: int | None
    near: list[str] = Field(default_factory=list)
    final: bool = Field(default=False, description="refused, and would be whenever it is sent again")


class Errors(Wire):
    """Rows of the error history that changed."""

    type: Literal["errors"] = "errors"
    rows: list[ErrorHistoryRow]
    whole: bool = Field(default=False, description="these are all rows: what is not among them is there no more")


class Users(Wire):
    type: Literal["users"] = "users"
    users: list[User]


class Built(Wire):
    """Somebody built: the running PLC has a new program (or the build was refused and the old one goes on)."""

    type: Literal["built"] = "built"
    author: str
    result: BuildResult


class Saved(Wire):
    """Somebody saved a file of this project."""

    type: Literal["saved"] = "saved"
    author: str
    file: FileInfo


class Alive(Wire):
    """Sent when there was nothing else to say for a while: a browser that hears nothing at all knows the server is gone."""

    type: Literal["alive"] = "alive"


ServerMessage = Annotated[
    Hello
    | State
    | Watching
    | Done
    | Errors
    | events.Logged
    | Users
    | PeopleChanged
    | Built
    | Saved
    | events.FileDeleted
    | events.InstanceDeleted
    | DraftEdited
    | Draft
    | events.DeviceChanged
    | events.ForcesChanged
    | Diagnostics
    | events.TimelineChanged
    | events.ValueWritten
    | events.ArmedChanged
    | events.LinesChanged
    | SweepProgress
    | WatchListChanged
    | Dap
    | Breakpoints
    | events.TracesChanged
    | events.RetrospectiveChanged
    | Coverage
    | Verifications
    | events.Disturbances
    | Comparison
    | CampaignState
    | Rerun
    | Alive,
    Field(discriminator="type"),
]
