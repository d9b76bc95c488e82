"""REST: traces of an instance, their samples, kept records, and retrospective traces. Everything changes for everybody."""

import re
from collections.abc import Iterable, Iterator, Sequence
from urllib.parse import quote

from fastapi import APIRouter, Request
from fastapi.responses import Response, StreamingResponse

from scanbench.taps.trace import TraceSignal
from scanbench.taps.trace_buffer import Samples
from scanbench.taps.trace_csv import to_csv
from scanbench.web import messages_trace as wire
from scanbench.web import translate_trace
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id, Scan
from scanbench.web.reach import Bench
from scanbench.wire.events import RetrospectiveChanged
from scanbench.wire.traces import TraceStatus

router = APIRouter(prefix="/api", tags=["traces"])
BYTES = "application/octet-stream"


@router.get("/instances/{instance}/traces")
async def on_traces(bench: Bench, instance: Id) -> tuple[TraceStatus, ...]:
    """The traces of an instance."""
    return bench.session(instance).tracing.traces


@router.post("/instances/{instance}/traces", status_code=201)
async def on_new_trace(bench: Bench, request: Request, instance: Id, new: wire.DefineTrace) -> TraceStatus:
    """A new trace."""
    tracing, author = bench.session(instance).tracing, user_of(request).name
    return await tracing.make(translate_trace.wanted(new), author, new.start)


@router.patch("/instances/{instance}/traces/{trace}")
async def on_change_trace(bench: Bench, request: Request, instance: Id, trace: Id, by: wire.ChangeTrace) -> TraceStatus:
    """Changes the definition of a trace, and discards what it recorded. Without `start`, a change of the signals keeps the
    samples of signals that stay, and a change of the name keeps all samples."""
    tracing, author = bench.session(instance).tracing, user_of(request).name
    return await tracing.change(trace, lambda now: translate_trace.changed(now, by), author, by.start)


@router.post("/instances/{instance}/traces/{trace}/start")
async def on_start_trace(bench: Bench, request: Request, instance: Id, trace: Id) -> TraceStatus:
    """Starts recording again; arms a trace that has a trigger."""
    return await bench.session(instance).tracing.drive(trace, "start", user_of(request).name)


@router.post("/instances/{instance}/traces/{trace}/stop")
async def on_stop_trace(bench: Bench, request: Request, instance: Id, trace: Id) -> TraceStatus:
    """Stops recording; what was recorded is kept."""
    return await bench.session(instance).tracing.drive(trace, "stop", user_of(request).name)


@router.delete("/instances/{instance}/traces/{trace}", status_code=204)
async def on_delete_trace(bench: Bench, request: Request, instance: Id, trace: Id) -> None:
    """Deletes a trace and what it recorded."""
    await bench.session(instance).tracing.delete(trace, user_of(request).name)


@router.get("/instances/{instance}/traces/{trace}/samples", response_class=Response)
async def on_samples(
    bench: Bench, instance: Id, trace: Id, first: Scan = 0, last: Scan | None = None, points: Scan | None = None
) -> Response:
    """Samples of scans `first` to `last`, as bytes; where there are more than `points`, the least and greatest of stretches."""
    return Response(await bench.session(instance).tracing.read(trace, first, last, points), media_type=BYTES)


@router.get("/instances/{instance}/traces/{trace}/csv", response_class=Response)
async def on_csv(bench: Bench, instance: Id, trace: Id, first: Scan = 0, last: Scan | None = None) -> StreamingResponse:
    """Every sample of these scans, as CSV."""
    status, spool = await bench.trace_records.gather(bench.session(instance), trace, first, last)

    def pages() -> Iterator[Samples]:
        try:
            yield from spool.pages()
        finally:
            spool.close()

    return _csv(pages(), status.signals, status.interval_ns, status.definition.name)


@router.post("/instances/{instance}/traces/{trace}/keep", status_code=201)
async def on_keep(
    bench: Bench, request: Request, instance: Id, trace: Id, keep: wire.KeepTrace
) -> wire.TraceRecordInfo:
    """Keeps what a trace has recorded until now, in the project."""
    session, author = bench.session(instance), user_of(request).name
    return translate_trace.record(await bench.trace_records.keep(session, trace, keep.name.strip(), author))


# ---- kept records ----------------------------------------------------------------------------------------------------


@router.get("/projects/{project}/trace-records")
async def on_records(bench: Bench, project: Id) -> list[wire.TraceRecordInfo]:
    """The kept records of a project, the newest first."""
    return list(map(translate_trace.record, await bench.trace_records.of_project(project)))


@router.get("/trace-records/{record}")
async def on_record(bench: Bench, record: Id) -> wire.TraceRecordInfo:
    """A kept record."""
    return translate_trace.record(await bench.trace_records.one(record))


@router.delete("/trace-records/{record}", status_code=204)
async def on_delete_record(bench: Bench, record: Id) -> None:
    """Deletes a kept record."""
    await bench.trace_records.delete(record)


@router.get("/trace-records/{record}/samples", response_class=Response)
async def on_record_samples(
    bench: Bench, record: Id, first: Scan = 0, last: Scan | None = None, points: Scan | None = None
) -> Response:
    """Samples of a kept record, as those of a trace."""
    return Response(await bench.trace_records.samples(record, first, last, points), media_type=BYTES)


@router.get("/trace-records/{record}/csv", response_class=Response)
async def on_record_csv(bench: Bench, record: Id, first: Scan = 0, last: Scan | None = None) -> StreamingResponse:
    """Every sample of these scans of a kept record, as CSV."""
    about, pages = await bench.trace_records.pages(record, first, last)
    return _csv(pages, about.signals, about.interval_ns, about.row.name)


# ---- retrospective traces ---------------------------------------------------------------------------------------------


@router.post("/instances/{instance}/retrospectives", status_code=201)
async def on_new_retrospective(
    bench: Bench, request: Request, instance: Id, new: wire.NewRetrospective
) -> RetrospectiveChanged:
    """Makes a retrospective trace: runs recorded scans again while the PLC runs; progress comes by the instance's WebSocket."""
    signals = tuple(text.strip() for text in new.signals)
    return bench.trace_records.make_retrospective(
        bench.session(instance), signals, new.scans, new.last, new.every, user_of(request).name
    )


@router.get("/retrospectives/{retrospective}")
async def on_retrospective(bench: Bench, retrospective: Id) -> RetrospectiveChanged:
    """A retrospective trace: how far it is, and which record came of it."""
    return bench.trace_records.retrospective(retrospective)


@router.delete("/retrospectives/{retrospective}", status_code=204)
async def on_cancel_retrospective(bench: Bench, retrospective: Id) -> None:
    """Cancels a retrospective trace that is being made."""
    await bench.trace_records.cancel(retrospective)


def _csv(pages: Iterable[Samples], signals: Sequence[TraceSignal], interval_ns: int, name: str) -> StreamingResponse:
    def text() -> Iterator[bytes]:
        for piece in to_csv(pages, signals, interval_ns):
            yield piece.encode()

    plain = re.sub(r"[^A-Za-z0-9._ -]", "_", name)
    headers = {"Content-Disposition": f"attachment; filename=\"{plain}.csv\"; filename*=UTF-8''{quote(name)}.csv"}
    return StreamingResponse(text(), media_type="text/csv; charset=utf-8", headers=headers)
