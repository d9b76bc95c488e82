"""From the tables' objects to the records that the store gives out."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import NamedTuple, cast

from scanbench.faults.present import Origin, Way
from scanbench.faults.reaction.reaction import RequiredResult
from scanbench.store.records import (
    AcceptedRow,
    BuildRow,
    CellRow,
    FileRow,
    HistoryRow,
    InstanceRow,
    Limits,
    LogRow,
    ProjectRow,
    ReactionState,
    RecordInfo,
    StateRow,
    Status,
    StoreError,
    SweepProblem,
    SweepRow,
    SweepStatus,
    SweptError,
    WatchContent,
    WatchEntry,
    WatchListRow,
)
from scanbench.store.tables import (
    AcceptedFinding,
    ErrorHistory,
    File,
    Instance,
    Log,
    ProgramState,
    ProgramVersion,
    Project,
    Sweep,
    SweepCell,
    TestRecord,
    WatchList,
)
from scanbench.typed import BadValue, make_kept


def project(row: Project) -> ProjectRow:
    """A project."""
    return ProjectRow(row.id, row.name, row.model, row.version, row.created, tuple(row.watch))


def file(row: File) -> FileRow:
    """A file."""
    return FileRow(row.path, row.text, row.version, row.author, row.saved)


def build(row: ProgramVersion) -> BuildRow:
    """An accepted build."""
    return BuildRow(row.project_id, row.version, row.sources, row.hash, row.author, row.at)


def instance(row: Instance) -> InstanceRow:
    """An instance."""
    limits = Limits(row.memory_mib, row.cpu_percent, row.run_mib)
    return InstanceRow(row.id, row.project_id, row.name, row.created, row.powered, limits, row.look, row.communication)


def history(row: ErrorHistory) -> HistoryRow:
    """An error's row."""
    return HistoryRow(
        error=row.error,
        program_version=row.program_version,
        status=cast(Status, row.status),
        code=row.code,
        details=row.details,
        generated_at=row.generated_at,
        recovered_at=row.recovered_at,
        generated_scan=row.generated_scan,
        recovered_scan=row.recovered_scan,
        by=row.by,
        origin=cast(Origin, row.origin),
        count=row.count,
        reaction_state=cast(ReactionState | None, row.reaction_state),
        reaction=row.reaction,
        reaction_message=row.reaction_message,
        recovered_by=row.recovered_by,
        recovered_way=cast(Way | None, row.recovered_way),
        acknowledged=row.acknowledged,
    )


def state(row: ProgramState) -> StateRow:
    """A kept state."""
    return StateRow(
        row.id, row.project_id, row.name, row.instance, row.scan, row.program_version, row.by, row.at
    )  # fmt: skip


class UnreadableSweep(StoreError):
    """A newer version of Scanbench kept it."""


@dataclass(frozen=True, slots=True)
class _Swept:
    """What a sweep keeps as JSON."""

    states: tuple[str, ...]
    errors: tuple[SweptError, ...]
    problems: tuple[SweepProblem, ...] = ()


class Counted(NamedTuple):
    """The cells of a sweep in numbers."""

    verdicts: Mapping[str | None, int]
    unmet: int


NOTHING = Counted({}, 0)


def sweep(row: Sweep, counted: Counted) -> SweepRow:
    """A sweep. `UnreadableSweep` names one that cannot be read."""
    try:
        swept = make_kept(_Swept, {"states": row.states, "errors": row.errors, "problems": row.problems})
    except BadValue as error:
        raise _unreadable(row.id, error) from error
    counts = counted.verdicts
    return SweepRow(
        id=row.id, project=row.project_id, instance_id=row.instance_id, instance=row.instance, model=row.model,
        program_version=row.program_version, by=row.by, at=row.at, status=cast(SweepStatus, row.status),
        message=row.message, window=row.window, states=swept.states,
        errors=swept.errors, seconds=row.seconds, done=sum(counts.values()),
        counts={verdict: count for verdict, count in counts.items() if verdict is not None},
        unmet=counted.unmet, problems=swept.problems,
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class _Untried:
    """What a cell keeps as JSON."""

    untried: tuple[RequiredResult, ...]


def cell(row: SweepCell) -> CellRow:
    """A cell without its reaction."""
    try:
        untried = make_kept(_Untried, {"untried": row.untried}).untried if row.untried else ()
    except BadValue as error:
        raise _unreadable(row.sweep_id, error) from error
    return CellRow(
        row.error, row.state, row.raised_scan, row.verdict, row.first_read, row.first_effect, row.difference_count,
        row.note, required=row.required, unmet=row.unmet, untried=untried,
    )  # fmt: skip


def _unreadable(sweep: int, why: BadValue) -> UnreadableSweep:
    return UnreadableSweep(f"sweep {sweep} cannot be read: {why}. Use the version of Scanbench that kept it")


def accepted(row: AcceptedFinding) -> AcceptedRow:
    """An accepted finding."""
    return AcceptedRow(row.error, row.state, row.reason, row.by, row.at)


def record(row: TestRecord) -> RecordInfo:
    """An imported record without its text."""
    return RecordInfo(row.id, row.project_id, row.title, row.by, row.at)


def log(row: Log) -> LogRow:
    """A line of the log."""
    return LogRow(row.at, row.scan, row.author, row.kind, row.text, row.program_version)


def watch_list(row: WatchList) -> WatchListRow:
    """A watch list. Of its entries only the values are kept, in the order of the fields; a newer version may know more."""
    entries = cast(list[list[str]], row.content.get("entries", []))
    groups = cast(list[str], row.content.get("groups", []))
    known = len(fields(WatchEntry))
    kept = WatchContent(tuple(groups), tuple(WatchEntry(*entry[:known]) for entry in entries))
    return WatchListRow(row.id, row.project_id, row.owner, row.name, kept, row.version, row.by, row.at)
