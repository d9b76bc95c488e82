"""Verifications and disturbances -> wire shapes, and back. Nothing is decided here."""

from dataclasses import asdict

from scanbench.public import iso
from scanbench.server.uploads import TraceFile, mapping_of
from scanbench.server.verifications import Kept
from scanbench.store.records import MappingRow
from scanbench.verify import contract as verified
from scanbench.verify.trace.mapping import ColumnMap, TraceMapping
from scanbench.web import messages_verify as wire
from scanbench.wire import events
from scanbench.wire.verifying import VerificationStatus, VerifyWish


def range_of(of: wire.VerifyRange) -> verified.Range:
    """What somebody wants verified."""
    return verified.Range(of.pou.strip(), of.file.strip(), of.first, of.last, of.instance.strip())


def wanted(of: wire.NewVerification) -> VerifyWish:
    """How somebody wants it verified."""
    return VerifyWish(range_of(of.range), of.pace, of.first, of.last, of.limit)


def info(of: VerificationStatus) -> wire.VerificationInfo:
    """The state of a verification."""
    stretch = of.wanted.range
    return wire.VerificationInfo.model_validate(
        {
            "id": of.id, "by": of.by, "title": of.title, "source": of.source, "trace": of.trace, "pace": of.pace,
            "range": {
                "pou": stretch.pou, "file": stretch.file, "first": stretch.first, "last": stretch.last,
                "instance": stretch.instance,
            },
            "auto": of.auto, "memory": of.memory, "state": of.state, "message": " ".join(filter(None, (of.note, of.message))),
            "instances": list(of.instances), "limit": of.wanted.limit, "first": of.first, "last": of.last,
            "scan": of.scan, "compared": of.compared, "skipped": of.skipped, "stretches": list(of.stretches),
            "differing": of.differing, "first_difference": of.first_difference,
            "first_scan": of.first_scan, "rows": of.rows, "forgotten": of.forgotten, "used": of.used,
            "generation": of.generation, "coverage": of.coverage, "not_run": of.not_run, "not_reached": of.not_reached,
            "verdict": of.verdict,
        }
    )  # fmt: skip


def told(of: events.VerificationsChanged) -> wire.Verifications:
    """All verifications."""
    return wire.Verifications(verifications=list(map(info, of.verifications)))


def record(of: Kept) -> wire.VerificationRecord:
    """One that was kept."""
    row = of.row
    return wire.VerificationRecord(
        id=row.id, project=row.project, name=row.name, instance=row.instance, by=row.by, at=iso(row.at),
        program_version=of.status.version, info=info(of.status),
    )  # fmt: skip


# ---- controller logs -------------------------------------------------------------------------------------------------


def mapping(of: wire.TraceMapping) -> TraceMapping:
    """How a trace file is meant."""
    columns = tuple(
        ColumnMap(each.column, each.path.strip(), each.role, each.absolute, each.relative, each.late_ms)
        for each in of.columns
    )
    return TraceMapping(of.axis, of.unit, of.gaps, columns, of.sampled)


def _mapping(of: TraceMapping) -> wire.TraceMapping:
    return wire.TraceMapping.model_validate({**asdict(of), "columns": [asdict(each) for each in of.columns]})


def uploaded(of: TraceFile) -> wire.UploadedTrace:
    """A trace file that was read."""
    return wire.UploadedTrace(
        file=of.handle, name=of.name, columns=list(of.columns), rows=of.rows,
        sample=[list(row) for row in of.sample], mapping=_mapping(of.proposal),
        problems=list(of.problems), guesses=list(of.guesses), layout=of.layout, left_out=list(of.left_out),
    )  # fmt: skip


def saved_mapping(of: MappingRow) -> wire.SavedMapping:
    """A mapping that was saved."""
    return wire.SavedMapping(id=of.id, name=of.name, by=of.by, mapping=_mapping(mapping_of(of)))
