"""Verifications and disturbances -> wire shapes, and back. Nothing is decided here."""

from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb, DisturbanceInfo
from scanbench.runtime.clock import iso
from scanbench.server.uploads import Checked, TraceFile, mapping_of
from scanbench.server.verifications import Kept
from scanbench.server.verify_rows import RowsPage
from scanbench.store.records import MappingRow
from scanbench.verify import contract as verified
from scanbench.verify.trace.mapping import ColumnMap, TraceMapping
from scanbench.verify.trace.table import TraceProblem
from scanbench.web import messages_verify as wire
from scanbench.wire import events
from scanbench.wire.events import VerificationStatus, VerifyWish
from scanbench.wire.verification import UseRow


def range_of(of: wire.VerifyRange) -> verified.Range:
    """What somebody wants verified."""
    return verified.Range(of.pou.strip(), of.file.strip(), of.first, of.last, of.instance.strip())


def wanted(of: wire.NewVerification) -> VerifyWish:
    """How somebody wants it verified."""
    return VerifyWish(range_of(of.range), of.pace, of.first, of.last, of.limit)


def info(of: VerificationStatus) -> wire.VerificationInfo:
    """How a verification stands."""
    stretch, first = of.wanted.range, of.first_difference
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
            "differing": of.differing, "first_difference": None if first is None else difference(first),
            "first_scan": of.first_scan, "rows": of.rows, "forgotten": of.forgotten, "used": of.used,
            "generation": of.generation,
        }
    )  # fmt: skip


def told(of: events.VerificationsChanged) -> wire.Verifications:
    """All verifications."""
    return wire.Verifications(verifications=list(map(info, of.verifications)))


def place(of: verified.Place | None) -> wire.VerifyPlace | None:
    """Where in the program."""
    if of is None:
        return None
    return wire.VerifyPlace(task=of.task, instance=of.instance, pou=of.pou, file=of.file, line=of.line, text=of.text)


def difference(of: verified.Mismatch) -> wire.VerifyDifference:
    """Where the two part."""
    return wire.VerifyDifference(
        cause=of.cause, name=of.name, control=of.control.hex(), monitor=of.monitor.hex(), place=place(of.place),
        message=of.message, type=of.type, kind=of.kind, size=of.size,
    )  # fmt: skip


def rows(of: RowsPage) -> wire.VerifyRows:
    """Rows, with the columns."""
    return wire.VerifyRows(
        columns=[
            wire.VerifyColumn(
                name=each.name, type=each.type, kind=each.kind, size=each.size, values=list(each.values),
                output=each.name in of.outputs, input=each.name in of.inputs,
            )
            for each in of.columns
        ],
        rows=[_row(index, row) for index, row in of.rows],
        first=of.first, count=of.count, differing=list(of.differing),
    )  # fmt: skip


def _row(index: int, of: verified.Row) -> wire.VerifyRow:
    return wire.VerifyRow(
        index=index, kind=of.kind, scan=of.scan, call=of.call, count=of.count, instance=of.instance,
        place=place(of.place), used=of.used, note=of.note, compared=of.compared, disturbances=list(of.disturbances),
        differences=list(map(difference, of.differences)),
        outputs={
            name: wire.VerifyOutput(control=_hex(each.control), monitor=_hex(each.monitor), set=_hex(each.set))
            for name, each in of.outputs.items()
        },
        inputs={
            name: wire.VerifyInput(recorded=each.recorded.hex(), expected=_hex(each.expected), set=_hex(each.set))
            for name, each in of.inputs.items()
        },
    )  # fmt: skip


def _hex(value: bytes | None) -> str | None:
    return None if value is None else value.hex()


def use(of: UseRow) -> wire.VerifyUse:
    """One use of a variable."""
    return wire.VerifyUse(
        name=of.name, written=of.written, control=of.control, monitor=of.monitor, file=of.file, line=of.line,
        instance=of.instance,
    )  # fmt: skip


def record(of: Kept) -> wire.VerificationRecord:
    """One that was kept."""
    row = of.row
    return wire.VerificationRecord(
        id=row.id, project=row.project, name=row.name, instance=row.instance, by=row.by, at=iso(row.at),
        program_version=of.status.version, info=info(of.status),
    )  # fmt: skip


# ---- disturbances ----------------------------------------------------------------------------------------------------


def disturb(of: wire.NewDisturbance, author: str) -> Disturb:
    """The command."""
    return Disturb(
        author,
        Disturbance(
            of.kind, of.path.strip(), of.bit, of.site.strip(), of.scan, of.probability, of.seed, of.scans, of.times
        ),
    )


def disturbance(of: DisturbanceInfo) -> wire.DisturbanceInfo:
    """One that is defined."""
    return wire.DisturbanceInfo.model_validate(
        {
            "id": of.id, "text": of.text, "kind": of.kind, "by": of.by, "state": of.state, "fired": of.fired,
            "next_scan": of.next_scan, "why": of.why,
        }
    )  # fmt: skip


def disturbances(of: events.DisturbancesChanged) -> wire.Disturbances:
    """All that are defined."""
    return wire.Disturbances(disturbances=list(map(disturbance, of.disturbances)))


# ---- traces of real controllers --------------------------------------------------------------------------------------


def mapping(of: wire.TraceMapping) -> TraceMapping:
    """How a trace file is meant."""
    columns = tuple(ColumnMap(each.column, each.path.strip(), each.role) for each in of.columns)
    return TraceMapping(of.axis, of.unit, of.gaps, columns)


def _mapping(of: TraceMapping) -> wire.TraceMapping:
    return wire.TraceMapping.model_validate(
        {
            "axis": of.axis, "unit": of.unit, "gaps": of.gaps,
            "columns": [{"column": each.column, "path": each.path, "role": each.role} for each in of.columns],
        }
    )  # fmt: skip


def uploaded(of: TraceFile) -> wire.UploadedTrace:
    """A trace file that was read."""
    return wire.UploadedTrace(
        file=of.handle, name=of.name, columns=list(of.columns), rows=of.rows,
        sample=[list(row) for row in of.sample], mapping=_mapping(of.proposal),
        problems=list(map(_problem, of.problems)),
    )  # fmt: skip


def _problem(of: TraceProblem) -> wire.TraceProblem:
    return wire.TraceProblem(row=of.row, column=of.column, message=of.message, warning=of.warning)


def checked(of: Checked) -> wire.TraceMappingChecked:
    """Whether a mapping fits."""
    return wire.TraceMappingChecked(
        ok=of.ok, first=of.first, last=of.last, missing=of.missing,
        problems=list(map(_problem, of.problems)),
    )  # fmt: skip


def saved_mapping(of: MappingRow) -> wire.SavedMapping:
    """A mapping that was saved."""
    return wire.SavedMapping(id=of.id, name=of.name, by=of.by, mapping=_mapping(mapping_of(of)))
