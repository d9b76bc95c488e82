"""Test records and histories -> wire shapes. Nothing is decided here."""

from datetime import datetime

from scanbench.public import iso
from scanbench.reports import record as kept
from scanbench.web import messages_records as wire


def record(of: kept.TestRecord) -> wire.TestRecord:
    """A whole record."""
    head = of.head
    return wire.TestRecord(
        project=head.project, model=head.model, instance=head.instance, program_version=head.program_version,
        program_hash=head.program_hash, exported_at=iso(head.exported_at), exported_by=head.exported_by,
        tool=head.tool,
        summary=of.summary,
        errors=[_error(of, error) for error in of.errors],
        sweeps=of.sweeps,
        log=of.log,
    )  # fmt: skip


def _error(of: kept.TestRecord, error: kept.RecordError) -> wire.RecordError:
    finding = of.finding(error)
    return wire.RecordError(
        id=error.id, name=error.name, group=error.group, code=error.code, flag=error.flag, severity=error.severity,
        status=error.status, details=error.details, generated_at=_moment(error.generated_at),
        recovered_at=_moment(error.recovered_at), generated_scan=error.generated_scan,
        recovered_scan=error.recovered_scan, by=error.by, origin=error.origin, count=error.count,
        verdict=finding.verdict, verdict_from=finding.where, scans=finding.scans,
        unmet=finding.unmet, reaction=error.reaction,
        reaction_note=error.reaction_note,
        accepted=error.accepted,
    )  # fmt: skip


def _moment(at: datetime | None) -> str | None:
    return None if at is None else iso(at)
