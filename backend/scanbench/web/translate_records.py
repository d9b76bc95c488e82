"""Test records and histories -> wire shapes. Nothing is decided here."""

from datetime import datetime

from scanbench.public import iso
from scanbench.reports import record as kept
from scanbench.server.test_records import HistoryVersion
from scanbench.store import records as store
from scanbench.web import messages_records as wire
from scanbench.web import translate_errors


def version(found: HistoryVersion) -> wire.HistoryVersion:
    """A version with a history."""
    build = found.build
    return wire.HistoryVersion(
        version=found.version, running=found.running, raised=found.raised, at=None if build is None else iso(build.at),
        author="" if build is None else build.author,
    )  # fmt: skip


def info(row: store.RecordInfo) -> wire.RecordInfo:
    """An imported record in a list."""
    return wire.RecordInfo(id=row.id, project=row.project, title=row.title, by=row.by, at=iso(row.at))


def record(of: kept.TestRecord) -> wire.TestRecord:
    """A whole record."""
    head, summary = of.head, of.summary
    return wire.TestRecord(
        project=head.project, model=head.model, instance=head.instance, program_version=head.program_version,
        program_hash=head.program_hash, exported_at=iso(head.exported_at), exported_by=head.exported_by,
        tool=head.tool,
        summary=wire.RecordSummary(
            errors=summary.errors, tested=summary.tested, generated=summary.generated, verdicts=summary.verdicts,
            unknown=summary.unknown, accepted=summary.accepted, open=summary.open,
        ),
        errors=[_error(of, error) for error in of.errors],
        sweeps=list(map(_sweep, of.sweeps)),
        log=[wire.RecordLine(at=iso(line.at), scan=line.scan, by=line.by, text=line.text) for line in of.log],
    )  # fmt: skip


def _error(of: kept.TestRecord, error: kept.RecordError) -> wire.RecordError:
    finding = of.finding(error)
    return wire.RecordError(
        id=error.id, name=error.name, group=error.group, code=error.code, flag=error.flag, severity=error.severity,
        status=error.status, details=error.details, generated_at=_moment(error.generated_at),
        recovered_at=_moment(error.recovered_at), generated_scan=error.generated_scan,
        recovered_scan=error.recovered_scan, by=error.by, origin=error.origin, count=error.count,
        verdict=finding.verdict, verdict_from=finding.where, scans=finding.scans,
        reaction=None if error.reaction is None else translate_errors.reaction(error.reaction),
        reaction_note=error.reaction_note,
        accepted=[
            wire.RecordAccepted(state=one.state, reason=one.reason, by=one.by, at=iso(one.at)) for one in error.accepted
        ],
    )  # fmt: skip


def _sweep(sweep: kept.RecordSweep) -> wire.RecordSweep:
    return wire.RecordSweep(
        at=iso(sweep.at), by=sweep.by, instance=sweep.instance, status=sweep.status, window=sweep.window,
        states=list(sweep.states),
        cells=[
            wire.RecordCell(error=cell.error, state=cell.state, verdict=cell.verdict, scans=cell.scans, note=cell.note)
            for cell in sweep.cells
        ],
    )  # fmt: skip


def _moment(at: datetime | None) -> str | None:
    return None if at is None else iso(at)
