"""From the tables' objects to the records that the store gives out."""

from typing import cast

from scanbench.store.records import (
    BuildRow,
    FileRow,
    HistoryRow,
    InstanceRow,
    Limits,
    LogRow,
    Origin,
    ProjectRow,
    Status,
)
from scanbench.store.tables import ErrorHistory, File, Instance, Log, ProgramVersion, Project


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
    return InstanceRow(row.id, row.project_id, row.name, row.created, row.powered, limits)


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
    )


def log(row: Log) -> LogRow:
    """A line of the log."""
    return LogRow(row.at, row.scan, row.author, row.kind, row.text)
