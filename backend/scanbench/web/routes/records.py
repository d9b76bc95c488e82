"""REST: error histories by version, test records out and in."""

import asyncio
import re
from collections.abc import Callable
from typing import Literal
from urllib.parse import quote

from fastapi import APIRouter, Request
from fastapi.responses import Response

from scanbench.reports.record import TestRecord
from scanbench.reports.record_csv import to_csv
from scanbench.reports.record_html import to_html
from scanbench.reports.record_text import Language
from scanbench.reports.record_xml import to_xml
from scanbench.server.test_records import HistoryVersion
from scanbench.store.records import RecordInfo
from scanbench.web import messages_records as wire
from scanbench.web import translate, translate_records
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id, Version, Wire
from scanbench.web.reach import Bench, xml_body

router = APIRouter(prefix="/api", tags=["records"])
Format = Literal["csv", "xml", "html", "json"]
_TYPES = {"csv": "text/csv; charset=utf-8", "xml": "application/xml", "html": "text/html; charset=utf-8"}
STYLE_ONLY = {"Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'"}


@router.get("/instances/{instance}/history/versions")
async def on_versions(bench: Bench, instance: Id) -> list[HistoryVersion]:
    """The versions of the program that have an error history here, the newest first."""
    return await bench.records.versions(bench.session(instance))


@router.get("/instances/{instance}/history")
async def on_history(bench: Bench, instance: Id, version: Version | None = None) -> wire.HistoryOfVersion:
    """The error history of a version, or of the one that runs."""
    session = bench.session(instance)
    rows = await bench.records.rows(session, version)
    of = session.errors.version if version is None else version
    return wire.HistoryOfVersion(
        version=of, running=of == session.errors.version, rows=list(map(translate.error_row, rows))
    )


@router.get("/instances/{instance}/record", response_model=wire.TestRecord)
async def on_record(
    bench: Bench, request: Request, instance: Id, version: Version | None = None, format: Format = "json",
    lang: Language = "en",
) -> Response:  # fmt: skip
    """The test record of a version, or of the one that runs: as a file, or as JSON."""
    record = await bench.records.of_instance(bench.session(instance), version, user_of(request).name, lang)
    return await asyncio.to_thread(_written, format, record, lang, lambda: translate_records.record(record))


@router.get("/projects/{project}/records")
async def on_records(bench: Bench, project: Id) -> list[RecordInfo]:
    """The imported test records, the newest first."""
    return await bench.records.imported(project)


@router.post("/projects/{project}/records", status_code=201)
async def on_import(bench: Bench, request: Request, project: Id) -> RecordInfo:
    """Imports a test record; the body is its XML."""
    text = await xml_body(request)
    return await bench.records.bring_in(project, text, user_of(request).name)


@router.get("/projects/{project}/records/{record}", response_model=wire.ImportedRecord)
async def on_imported(
    bench: Bench, project: Id, record: Id, format: Format = "json", lang: Language = "en"
) -> Response:
    """An imported test record: as a file, or as JSON."""
    info, found = await bench.records.one(project, record)

    def told() -> wire.ImportedRecord:
        return wire.ImportedRecord(info=info, record=translate_records.record(found))

    return await asyncio.to_thread(_written, format, found, lang, told)


@router.delete("/projects/{project}/records/{record}", status_code=204)
async def on_delete(bench: Bench, project: Id, record: Id) -> None:
    """Deletes an imported test record."""
    await bench.records.delete(project, record)


def _written(format: Format, record: TestRecord, language: Language, told: Callable[[], Wire]) -> Response:
    """CSV and XML are saved; HTML is shown, and can do nothing but look good. It takes a while: to be called in a thread."""
    if format == "json":
        return Response(told().model_dump_json(), media_type="application/json")
    if format == "html":
        return Response(to_html(record, language), media_type=_TYPES[format], headers=STYLE_ONLY)
    text = to_csv(record) if format == "csv" else to_xml(record)
    name = f"{record.head.instance}-version-{record.head.program_version}-record.{format}"
    plain = re.sub(r"[^A-Za-z0-9._ -]", "_", name)
    headers = {"Content-Disposition": f"attachment; filename=\"{plain}\"; filename*=UTF-8''{quote(name)}"}
    return Response(text, media_type=_TYPES[format], headers=headers)
