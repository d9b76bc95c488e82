"""What the store gives out: frozen data, and the refusals. This is the room's contract, with `store.Store`."""

from dataclasses import dataclass
from datetime import datetime
from typing import Literal

Status = Literal["generated", "cleared"]
Origin = Literal["simulator", "plc", "program"]


class StoreError(Exception):
    """The database cannot be used; the message says why and what to do."""


class NotFound(Exception):
    """There is no such project, file or instance; the message names it."""


class NameTaken(Exception):
    """Another project or instance has this name; the message says which."""


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


@dataclass(frozen=True, slots=True)
class HistoryRow:
    """The last time an error of the catalogue was raised on an instance. Errors never raised have no row."""

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


@dataclass(frozen=True, slots=True)
class LogRow:
    """One action on an instance."""

    at: datetime
    scan: int
    author: str
    kind: str
    text: str


class Conflict(Exception):
    """Somebody else saved first: nothing was written."""

    def __init__(self, path: str, theirs: FileRow | None) -> None:
        """`theirs` is what they saved; None if they deleted the file."""
        by = f"was saved by {theirs.author} in the meantime" if theirs else "was deleted in the meantime"
        super().__init__(f"{path} {by}; nothing was written")
        self.path = path
        self.theirs = theirs
