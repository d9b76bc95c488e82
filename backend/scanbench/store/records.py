"""What the store gives out: frozen data, and the refusals. This is the room's contract, with `store.Store`."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import ClassVar, Literal

from scanbench.faults.present import Origin, Way
from scanbench.faults.reaction.reaction import RequiredResult
from scanbench.public import Moment, Public

Status = Literal["generated", "cleared"]
ReactionState = Literal["recording", "done", "failed"]
SweepStatus = Literal["running", "done", "cancelled", "interrupted", "failed"]
Json = Mapping[str, object]
"""What JSON can say; `faults.reaction_json` makes it and reads it."""


class StoreError(Exception):
    """The database cannot be used; the message says why and what to do."""


class NotFound(Exception):
    """There is no such project, file, instance, state, sweep or record; the message names it."""


class NameTaken(Exception):
    """Another project, instance or state has this name; the message says which."""


class NotStorable(Exception):
    """A name or text that no database can keep; the message says which and why."""


@dataclass(frozen=True, slots=True)
class ProjectRow:
    """A project. `version` counts the builds that were accepted."""

    id: int
    name: str
    model: str
    version: int
    created: datetime
    watch: tuple[str, ...] = ()
    """Paths that a fresh watch list begins with."""


@dataclass(frozen=True, slots=True)
class FileInfo:
    """A file without its text. `version` counts its saves, from 1."""

    path: str
    version: int
    author: str
    saved: datetime


@dataclass(frozen=True, slots=True)
class FileRow:
    """A file as last saved."""

    path: str
    text: str
    version: int
    author: str
    saved: datetime


@dataclass(frozen=True, slots=True)
class BuildRow:
    """A build that was accepted, with the sources it was made of."""

    project: int
    version: int
    sources: dict[str, str]
    hash: str
    """sha256 over paths and texts."""
    author: str
    at: datetime


@dataclass(frozen=True, slots=True)
class BuildInfo:
    """The same without its sources."""

    version: int
    author: str
    at: datetime
    label: str = ""
    """A short name, such as that of a release; empty when it has none."""
    message: str = ""
    """What was changed and why, in the words of who built it."""


@dataclass(frozen=True, slots=True)
class Limits:
    """What an instance may cost at most; None is no limit of its own."""

    memory_mib: int | None = None
    cpu_percent: int | None = None
    """Of one core, for runs as fast as possible."""
    run_mib: int | None = None
    """Of the run file."""


@dataclass(frozen=True, slots=True)
class InstanceRow:
    """A virtual PLC that runs a project."""

    id: int
    project: int
    name: str
    created: datetime
    powered: bool = True
    """False: somebody switched it off, and it stays off."""
    limits: Limits = Limits()
    look: bool = False
    """A look at the past, of one person: it ends when nobody is there any more."""
    communication: Json | None = None
    """Its servers of protocols, as `server.communication` keeps them; None: nobody has switched one on."""


@dataclass(frozen=True, slots=True)
class HistoryRow:
    """The last time an error was raised on an instance and a version of its program. Errors never raised have no row."""

    error: str
    program_version: int
    status: Status
    code: str
    details: str
    generated_at: datetime
    recovered_at: datetime | None
    generated_scan: int
    recovered_scan: int | None
    by: str
    origin: Origin
    count: int
    reaction_state: ReactionState | None = None
    """None: nobody compared."""
    reaction: Json | None = None
    reaction_message: str = ""
    recovered_by: str = ""
    recovered_way: Way | None = None
    """None: it is present, went with a restart, or was kept before this was."""
    acknowledged: Json | None = None


@dataclass(frozen=True, slots=True)
class StateRow(Public):
    """A point in a run that was kept to begin sweeps from."""

    PUBLIC: ClassVar = "ProgramState"

    id: int
    project: int
    name: str
    instance: str
    """Name of the PLC that it was taken from."""
    scan: int
    program_version: int
    by: str
    at: Moment


@dataclass(frozen=True, slots=True)
class SweptError(Public):
    """A row of a sweep's matrix: an error as the catalogue knew it then."""

    PUBLIC: ClassVar = "SweepError"

    id: str
    name: str
    code: str
    severity: Literal["fatal", "nonfatal"]
    group: str


@dataclass(frozen=True, slots=True)
class SweepProblem(Public):
    """A mistake in what the project requires: what it says there was not tried."""

    line: int
    column: int
    message: str


@dataclass(frozen=True, slots=True)
class SweepRow:
    """Every error alone, from every state."""

    id: int
    project: int
    instance_id: int | None
    """None: that PLC is gone."""
    instance: str
    """The PLC's name when the sweep began."""
    model: str
    program_version: int
    by: str
    at: datetime
    status: SweepStatus
    message: str
    window: int
    states: tuple[str, ...]
    errors: tuple[SweptError, ...]
    seconds: float
    done: int
    """Cells that are there, those without a verdict included."""
    counts: Mapping[str, int]
    """Cells by verdict, without those that have none."""
    unmet: int = 0
    """So much in all cells is not as it is required."""
    problems: tuple[SweepProblem, ...] = ()
    """Of the file with what is required; each is a finding."""

    @property
    def total(self) -> int:
        """Cells of the whole matrix."""
        return len(self.states) * len(self.errors)


@dataclass(frozen=True, slots=True)
class CellRow:
    """One error from one state."""

    error: str
    state: str
    raised_scan: int
    verdict: str | None
    """None: it could not be raised or run, `note` says why."""
    first_read: int | None = None
    first_effect: int | None = None
    difference_count: int = 0
    note: str = ""
    reaction: Json | None = None
    """To be written; lists of cells come without, `Sweeps.reaction` gives it."""
    required: int = 0
    """So many requirements are about it,"""
    unmet: int = 0
    """and so much is not as it is required."""
    untried: tuple[RequiredResult, ...] = ()
    """Without a verdict: what is required, none of it checked."""


@dataclass(frozen=True, slots=True)
class AcceptedRow:
    """Somebody accepted a finding."""

    error: str
    state: str
    reason: str
    by: str
    at: datetime


@dataclass(frozen=True, slots=True)
class RecordInfo(Public):
    """A test record that came from elsewhere, without its text."""

    id: int
    project: int
    title: str
    by: str
    """Who brought it in."""
    at: Moment


@dataclass(frozen=True, slots=True)
class RecordRow(RecordInfo):
    """And with it."""

    text: str


@dataclass(frozen=True, slots=True)
class LogRow:
    """One action on an instance."""

    at: datetime
    scan: int
    author: str
    kind: str
    text: str
    program_version: int | None = None
    """That ran then; None in lines of before this was kept."""


@dataclass(frozen=True, slots=True)
class WatchEntry:
    """A line of a watch list: a path or address, its group ('' is none), and how its value is shown."""

    path: str
    group: str = ""
    format: str = "default"


@dataclass(frozen=True, slots=True)
class WatchContent:
    """What a watch list holds, in order."""

    groups: tuple[str, ...] = ()
    entries: tuple[WatchEntry, ...] = ()


@dataclass(frozen=True, slots=True)
class WatchListRow:
    """A watch list of a project. `owner` is empty when everybody shares it; `version` counts its saves, from 1."""

    id: int
    project: int
    owner: str
    name: str
    content: WatchContent
    version: int
    by: str
    """Who saved this version."""
    at: datetime


@dataclass(frozen=True, slots=True)
class KeptRow:
    """A record of a trace or a verification that was kept; `content` says what of."""

    id: int
    project: int
    name: str
    instance: str
    content: Json
    by: str
    at: datetime


@dataclass(frozen=True, slots=True)
class MappingRow:
    """A mapping of a trace file, by its name in the project."""

    id: int
    project: int
    name: str
    content: Json
    by: str


class ListConflict(Exception):
    """Somebody else saved this watch list first: nothing was written. `theirs` is what they saved."""

    def __init__(self, theirs: WatchListRow) -> None:
        super().__init__(f"{theirs.name} was saved by {theirs.by} in the meantime; nothing was written")
        self.theirs = theirs


class Conflict(Exception):
    """Somebody else saved first: nothing was written."""

    def __init__(self, path: str, theirs: FileRow | None) -> None:
        """`theirs` is what they saved; None if they deleted the file."""
        by = f"was saved by {theirs.author} in the meantime" if theirs else "was deleted in the meantime"
        super().__init__(f"{path} {by}; nothing was written")
        self.path = path
        self.theirs = theirs
