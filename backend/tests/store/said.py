"""What a database says, and the files of records beside it: all of it read as a server reads it, and told as JSON."""

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import asdict, is_dataclass
from datetime import datetime
from pathlib import Path
from typing import TypeVar

from scanbench.reports.reaction_json import from_json
from scanbench.reports.record import TestRecord
from scanbench.reports.record_read import from_xml
from scanbench.server.draft import Draft
from scanbench.server.missing import stand_in
from scanbench.server.trace_records import TraceRecords
from scanbench.server.uploads import mapping_of
from scanbench.server.verifications import Verifications
from scanbench.server.write_behind import line_of, row_of
from scanbench.session.debugging import breakpoint_of
from scanbench.session.tracing import Tracing
from scanbench.store.records import InstanceRow, ProjectRow
from scanbench.store.store import Store
from scanbench.taps.trace_csv import to_csv

A = TypeVar("A")
BESIDE = ("traces", "verifications")
"""Folders of a data directory whose files belong to rows of the database."""
USER = "Bob Noyce"
_GONE = object()
"""In place of a field that is not there: one that is there may say None."""


def said(data: Path) -> object:
    """All that a data directory says."""
    store = Store(f"sqlite:///{data / 'scanbench.db'}")
    try:
        return plain([_project(store, data, each) for each in store.projects.all()])
    finally:
        store.close()


def _draft(store: Store, project: int, path: str) -> object:
    row = store.drafts.get(project, path)
    return None if row is None else {"key": row.key, "text": Draft(row.key, row.parts).text}


def _project(store: Store, data: Path, project: ProjectRow) -> object:
    id = project.id
    errors = [
        {"cells": store.sweeps.cells(each.id), "reactions": _reactions(store, each.id)} for each in store.sweeps.all(id)
    ]
    return {
        "project": project,
        "files": [store.files.get(id, each.path) for each in store.files.all(id)],
        "drafts": [_draft(store, id, each.path) for each in store.files.all(id)],
        "builds": [store.builds.get(id, version + 1) for version in range(project.version)],
        "versions": store.builds.all(id),
        "instances": [_instance(store, each) for each in store.instances.all() if each.project == id],
        "states": store.states.all(id),
        "sweeps": store.sweeps.all(id),
        "cells": errors,
        "accepted": store.findings.accepted(id),
        "records": [_record(store, each.id) for each in store.records.all(id)],
        "watch_lists": store.watch_lists.seen(id, USER),
        "mappings": [{"row": each, "mapping": mapping_of(each)} for each in store.mappings.all(id)],
        "traces": asyncio.run(_traces(TraceRecords(store, data / "traces", data / "cache"), id)),
        "verifications": asyncio.run(_verifications(Verifications(store, data / "verifications", data / "cache"), id)),
    }


def _instance(store: Store, instance: InstanceRow) -> object:
    model = stand_in("any")  # what errors are called is a model's affair
    tracing = Tracing(nobody, lambda _: None, lambda _: None, store.traces.all(instance.id))
    return {
        "instance": instance,
        "errors": [row_of(model, each) for each in store.errors.history(instance.id)],
        "log": [line_of(each) for each in store.log.last(instance.id, 1000)],
        "breakpoints": [breakpoint_of(each) for each in store.breakpoints.all(instance.id)],
        "traces": [{"definition": each.definition, "by": each.by} for each in tracing.traces],
    }


async def nobody(_make: Callable[[int], object], _answer: type[A], /) -> A:
    """Asks no PLC."""
    raise AssertionError("there is no PLC to ask")


def _reactions(store: Store, sweep: int) -> object:
    told = ((cell, store.sweeps.reaction(sweep, cell.error, cell.state)) for cell in store.sweeps.cells(sweep))
    return {f"{cell.error} from {cell.state}": from_json(reaction) for cell, reaction in told if reaction is not None}


def _record(store: Store, id: int) -> object:
    row = store.records.get(id)
    found = from_xml(row.text)
    assert isinstance(found, TestRecord), found
    return {"title": row.title, "by": row.by, "at": row.at, "record": found, "summary": found.summary}


async def _traces(records: TraceRecords, project: int) -> object:
    async def one(id: int) -> object:
        record, pages = await records.pages(id, 0, None)
        kept = {"name": record.row.name, "by": record.row.by, "origin": record.origin, "signals": record.signals}
        return {"record": kept, "csv": "".join(to_csv(pages, record.signals, record.interval_ns)).splitlines()}

    return [await one(each.row.id) for each in await records.of_project(project)]


async def _verifications(verifications: Verifications, project: int) -> object:
    async def one(id: int) -> object:
        kept = await verifications.record(id)
        page = await verifications.record_rows(id, 0, 1000, False)
        return {"name": kept.row.name, "by": kept.row.by, "status": kept.status, "page": page}

    return [await one(each.row.id) for each in await verifications.records(project)]


def plain(value: object) -> object:
    """As JSON has it."""
    if is_dataclass(value) and not isinstance(value, type):
        return plain(asdict(value))
    if isinstance(value, Mapping):
        return {str(name): plain(each) for name, each in value.items()}
    if isinstance(value, tuple | list):
        return [plain(each) for each in value]
    if isinstance(value, bytes):
        return value.hex()
    return value.isoformat() if isinstance(value, datetime) else value


def missing(then: object, now: object, at: str = "") -> list[str]:
    """Where it does not say any more what it said; what it says besides is new, and may be."""
    if now is _GONE:
        return [f"{at}: {then!r} is gone"]
    if isinstance(then, Mapping) and isinstance(now, Mapping):
        return [line for name, each in then.items() for line in missing(each, now.get(name, _GONE), f"{at}.{name}")]
    if isinstance(then, list) and isinstance(now, list) and len(then) == len(now):
        pairs = enumerate(zip(then, now, strict=True))
        return [line for index, (each, other) in pairs for line in missing(each, other, f"{at}[{index}]")]
    return [] if then == now else [f"{at}: {then!r} is now {now!r}"]
