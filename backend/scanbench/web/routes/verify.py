"""REST: verifications of an instance, their rows, what is kept of them, disturbances, and controller logs."""

import re
from typing import Annotated, Literal
from urllib.parse import quote

from fastapi import APIRouter, Query, Request
from fastapi.responses import Response

from scanbench.comm.controller.contract import Connection
from scanbench.debug.flow_shown import FlowAsked
from scanbench.faults.disturb.disturb import DisturbanceInfo
from scanbench.server.kept import readable
from scanbench.server.uploads import LAST, Checked
from scanbench.server.verifications import Exported
from scanbench.server.verify_questions import flows_of, uses_of
from scanbench.server.verify_rows import RowsPage
from scanbench.verify.contract import VerifyFlows
from scanbench.verify.trace.read import MAX_BYTES
from scanbench.web import messages_verify as wire
from scanbench.web import translate_verify
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id, Scan
from scanbench.web.messages_errors import CommandResult
from scanbench.web.reach import Bench, file_body
from scanbench.web.routes.entering import entered
from scanbench.wire.verification import UseRow

router = APIRouter(prefix="/api", tags=["verification"])
Count = Annotated[int, Query(ge=0, le=500)]
Format = Literal["csv", "json", "html", "junit"]


@router.get("/instances/{instance}/verifications")
async def on_verifications(bench: Bench, instance: Id) -> list[wire.VerificationInfo]:
    """The verifications of an instance, the oldest first."""
    return list(map(translate_verify.info, bench.verifications.of(bench.session(instance))))


@router.post("/instances/{instance}/verifications", status_code=201)
async def on_new_verification(
    bench: Bench, request: Request, instance: Id, new: wire.NewVerification
) -> wire.VerificationInfo:
    """Begins to verify, live or a stretch of the past; progress comes by the instance's WebSocket."""
    wanted = translate_verify.wanted(new)
    return translate_verify.info(
        await bench.verifications.begin(bench.session(instance), wanted, user_of(request).name)
    )


@router.post("/instances/{instance}/trace-verifications", status_code=201)
async def on_new_trace_verification(
    bench: Bench, request: Request, instance: Id, new: wire.NewTraceVerification
) -> wire.VerificationInfo:
    """Verifies a controller log with the program that runs."""
    file, session, author = bench.trace_files.get(new.file), bench.session(instance), user_of(request).name
    mapping = translate_verify.mapping(new.mapping)
    begun = await bench.verifications.begin_trace(
        session, file, mapping, translate_verify.range_of(new.range), new.limit, author
    )
    await bench.trace_files.save_mapping(session.project_id, LAST, mapping, author)
    return translate_verify.info(begun)


@router.get("/verifications/{verification}")
async def on_verification(bench: Bench, verification: Id) -> wire.VerificationInfo:
    """One verification: how far it is, what was compared, and what differs."""
    return translate_verify.info(bench.verifications.one(verification).status)


@router.patch("/verifications/{verification}")
async def on_drive(
    bench: Bench, request: Request, verification: Id, drive: wire.DriveVerification
) -> wire.VerificationInfo:
    """Changes pace or memory of a verification; steps, pauses or resumes it."""
    return translate_verify.info(
        await bench.verifications.drive(
            verification, drive.pace, drive.auto, drive.memory, drive.action, user_of(request).name
        )
    )


@router.delete("/verifications/{verification}", status_code=204)
async def on_delete(bench: Bench, request: Request, verification: Id) -> None:
    """Ends a verification and deletes its rows."""
    await bench.verifications.delete(verification, user_of(request).name)


@router.get("/verifications/{verification}/rows")
async def on_rows(
    bench: Bench, verification: Id, first: Scan = 0, count: Count = 200, differing: bool = False
) -> RowsPage:
    """Rows from index `first` on; with `differing` only those that differ count."""
    return await bench.verifications.rows(verification, first, count, differing)


@router.post("/verifications/{verification}/cells")
async def on_cells(bench: Bench, request: Request, verification: Id, cells: wire.SetCells) -> wire.VerificationInfo:
    """Edits inputs of the set data; the monitor runs those passes again."""
    edits = tuple((each.scan, each.call, each.column, each.value) for each in cells.cells)
    return translate_verify.info(await bench.verifications.set_cells(verification, edits, user_of(request).name))


@router.get("/verifications/{verification}/uses")
async def on_uses(bench: Bench, verification: Id, scan: Scan, call: Scan = 1) -> tuple[UseRow, ...]:
    """The used-variable record of one row, in the order of use."""
    return await uses_of(bench.verifications.one(verification), scan, call)


@router.get("/verifications/{verification}/flow")
async def on_flow(
    bench: Bench, verification: Id, scan: Scan, pou: Annotated[str, Query(max_length=500)],
    path: Annotated[str, Query(max_length=2000)] = "", call: Scan = 1,
) -> VerifyFlows:  # fmt: skip
    """Power and values at each element of a POU as the code of the instance `path` saw them in one row, on both sides, and the element
    that differed first."""
    return await flows_of(bench.verifications.one(verification), scan, call, FlowAsked(pou, path))


@router.get("/verifications/{verification}/export", response_class=Response)
async def on_export(bench: Bench, verification: Id, format: Format = "csv") -> Response:
    """All rows that are kept, as a file."""
    return _file(await bench.verifications.export(verification, format))


@router.post("/verifications/{verification}/keep", status_code=201)
async def on_keep(
    bench: Bench, request: Request, verification: Id, keep: wire.KeepVerification
) -> wire.VerificationRecord:
    """Keeps a verification in the project, as it is now."""
    name, author = keep.name.strip(), user_of(request).name
    return translate_verify.record(await bench.verifications.keep(verification, name, author))


# ---- records ---------------------------------------------------------------------------------------------------------


@router.get("/projects/{project}/verification-records")
async def on_records(bench: Bench, project: Id) -> list[wire.VerificationRecord]:
    """The kept verifications of a project, the newest first."""
    return list(map(translate_verify.record, await bench.verifications.records(project)))


@router.get("/verification-records/{record}")
async def on_record(bench: Bench, record: Id) -> wire.VerificationRecord:
    """A kept verification."""
    return translate_verify.record(await bench.verifications.record(record))


@router.delete("/verification-records/{record}", status_code=204)
async def on_delete_record(bench: Bench, record: Id) -> None:
    """Deletes a kept verification."""
    await bench.verifications.delete_record(record)


@router.get("/verification-records/{record}/rows")
async def on_record_rows(
    bench: Bench, record: Id, first: Scan = 0, count: Count = 200, differing: bool = False
) -> RowsPage:
    """Its rows, as those of a verification."""
    return await bench.verifications.record_rows(record, first, count, differing)


@router.get("/verification-records/{record}/export", response_class=Response)
async def on_export_record(bench: Bench, record: Id, format: Format = "csv") -> Response:
    """Its rows as a file."""
    return _file(await bench.verifications.export_record(record, format))


# ---- disturbances ----------------------------------------------------------------------------------------------------


@router.get("/instances/{instance}/disturbances")
async def on_disturbances(bench: Bench, instance: Id) -> tuple[DisturbanceInfo, ...]:
    """Disturbances that are not over, and those that never took effect."""
    session = bench.session(instance)
    await session.forces.now()  # before that is answered, what holds is told
    return session.errors.disturbances


@router.post("/instances/{instance}/disturbances")
async def on_disturb(bench: Bench, request: Request, instance: Id, new: wire.NewDisturbance) -> CommandResult:
    """Disturbs the PLC, now or when its time comes; the journal keeps it."""
    return await entered(bench, request, instance, "disturb", new)


@router.delete("/instances/{instance}/disturbances")
async def on_calm_all(bench: Bench, request: Request, instance: Id) -> CommandResult:
    """Withdraws all disturbances."""
    return await entered(bench, request, instance, "calm", {"ids": None})


@router.delete("/instances/{instance}/disturbances/{disturbance}")
async def on_calm(bench: Bench, request: Request, instance: Id, disturbance: Id) -> CommandResult:
    """Withdraws a disturbance."""
    return await entered(bench, request, instance, "calm", {"ids": [disturbance]})


# ---- controller logs -----------------------------------------------------------------------------------------------


@router.post("/projects/{project}/traces", status_code=201)
async def on_upload(
    bench: Bench, request: Request, project: Id, name: Annotated[str, Query(min_length=1, max_length=200)]
) -> wire.UploadedTrace:
    """A trace file (see docs/trace-format.md); the body is the file."""
    data = await file_body(request, MAX_BYTES)
    built = await bench.projects.built(project)
    return translate_verify.uploaded(await bench.trace_files.upload(project, name, data, built))


@router.post("/projects/{project}/controllers", status_code=201)
async def on_controller(bench: Bench, project: Id, new: wire.NewController) -> wire.UploadedTrace:
    """Asks a controller that runs what it has to read. What comes of it is verified as an uploaded trace is, while the controller runs."""
    connection = Connection(
        new.address.strip(), new.interval_ms, tuple(each.strip() for each in new.nodes), new.user, new.password
    )
    built = await bench.projects.built(project)
    return translate_verify.uploaded(await bench.trace_files.connect(project, connection, built))


@router.post("/instances/{instance}/trace-check")
async def on_check_mapping(bench: Bench, instance: Id, check: wire.CheckTraceMapping) -> Checked:
    """Whether a trace file can be verified with this mapping; if not, the places at which it cannot."""
    file = bench.trace_files.get(check.file)
    mapping = translate_verify.mapping(check.mapping)
    return await bench.trace_files.check(bench.session(instance), file, mapping)


@router.get("/projects/{project}/trace-mappings")
async def on_mappings(bench: Bench, project: Id) -> list[wire.SavedMapping]:
    """The mappings that were saved in a project."""
    return readable(await bench.trace_files.mappings(project), translate_verify.saved_mapping)


@router.post("/projects/{project}/trace-mappings", status_code=201)
async def on_save_mapping(bench: Bench, request: Request, project: Id, save: wire.SaveMapping) -> wire.SavedMapping:
    """Saves a mapping under a name; one of the same name is replaced."""
    mapping, author = translate_verify.mapping(save.mapping), user_of(request).name
    return translate_verify.saved_mapping(
        await bench.trace_files.save_mapping(project, save.name.strip(), mapping, author)
    )


@router.delete("/trace-mappings/{mapping}", status_code=204)
async def on_delete_mapping(bench: Bench, mapping: Id) -> None:
    """Deletes a mapping."""
    await bench.trace_files.delete_mapping(mapping)


def _file(exported: Exported) -> Response:
    plain = re.sub(r"[^A-Za-z0-9._ -]", "_", exported.name)
    headers = {"Content-Disposition": f"attachment; filename=\"{plain}\"; filename*=UTF-8''{quote(exported.name)}"}
    return Response(exported.text, media_type=exported.media, headers=headers)
