"""Test records of a PLC: bounded, and made where nobody waits for it."""

import asyncio
import threading
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import cast

import pytest

from scanbench.faults.history import ErrorRow, History
from scanbench.plcmodel.model import Model
from scanbench.reports import record as record_room
from scanbench.reports.record import TestRecord
from scanbench.reports.record_xml import to_xml
from scanbench.server import test_records as records
from scanbench.server.test_records import Records
from scanbench.server.write_behind import WriteBehind
from scanbench.session.session import Session
from scanbench.store.records import CellRow, LogRow, SweptError
from scanbench.store.store import Store
from scanbench.wire.refused import Refused
from tests.runtime.bench import model

NOON = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
BATTERY = SweptError("battery-error", "Battery error", "00F7", "nonfatal", "CPU")


@dataclass
class Plc:
    """As much of a session as a record needs; notes in which thread its rows are read."""

    id: int
    project_id: int
    model: Model
    name: str = "line-1"
    version: int = 1
    why_not: str = ""
    threads: set[int] = field(default_factory=set)

    @property
    def errors(self) -> "Plc":
        return self

    @property
    def instance(self) -> "Plc":
        return self

    @property
    def versions(self) -> list[int]:
        return [1]

    def rows_of(self, version: int, of: Model) -> list[ErrorRow]:
        self.threads.add(threading.get_ident())
        return History(of, version).rows


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    opened = Store(f"sqlite:///{tmp_path / 'bench.db'}")
    yield opened
    opened.close()


@pytest.fixture
def plc(store: Store) -> Plc:
    project = store.projects.create("p", "CJ1M-CPU63").id
    return Plc(store.instances.create(project, "line-1").id, project, model())


@asynccontextmanager
async def opened(store: Store) -> AsyncIterator[Records]:
    write_behind = WriteBehind(store)
    try:
        yield Records(store, write_behind, "Scanbench 0.1")
    finally:
        await write_behind.close()


def made(store: Store, plc: Plc) -> TestRecord:
    async def make() -> TestRecord:
        async with opened(store) as known:
            return await known.of_instance(cast(Session, plc), None, "Ada", "en")

    return asyncio.run(make())


def test_a_record_has_the_last_lines_and_the_newest_sweeps(
    store: Store, plc: Plc, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(records, "LOG_LINES", 3)
    monkeypatch.setattr(records, "SWEEPS", 2)
    kinds = ["error", "recover", "write", "error"] * 3
    store.log.add(
        plc.id, [LogRow(NOON + timedelta(seconds=n), n, "Ada", kind, f"line {n}", 1) for n, kind in enumerate(kinds)]
    )
    store.log.add(plc.id, [LogRow(NOON, 99, "Ada", "error", "of another version", 2)])
    for window in (10, 20, 30, 40):
        sweep = store.sweeps.create(
            plc.project_id, instance_id=plc.id, instance=plc.name, model=plc.model.name, program_version=1, by="Ada",
            window=window, states=["A"], errors=[BATTERY],
        )  # fmt: skip
        if window != 40:  # it has not begun yet
            store.sweeps.add_cells(sweep.id, [CellRow("battery-error", "A", 5, "reacted")])
    record = made(store, plc)
    assert [line.text for line in record.log] == [
        "6 earlier lines are not in this record; the event log of the PLC has them", "line 8", "line 9", "line 11",
    ]  # fmt: skip
    assert [sweep.window for sweep in record.sweeps] == [30, 20]


def test_nobody_waits_for_a_record(store: Store, plc: Plc, monkeypatch: pytest.MonkeyPatch) -> None:
    """The event loop drives every PLC and browser: rows are read and the record is made in other threads."""
    made_in = []

    class Noted(TestRecord):
        def __post_init__(self) -> None:
            made_in.append(threading.get_ident())
            super().__post_init__()

    monkeypatch.setattr(record_room, "TestRecord", Noted)
    record = made(store, plc)
    assert len(record.errors) == len(list(plc.model.errors()))
    assert len(made_in) == 1
    assert threading.get_ident() not in {*made_in, *plc.threads}
    assert plc.threads


def test_a_project_keeps_so_many_records_from_elsewhere(
    store: Store, plc: Plc, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(records, "IMPORTED", 2)
    text = to_xml(made(store, plc))

    async def bring() -> None:
        async with opened(store) as known:
            await known.bring_in(plc.project_id, text, "Ada")

    asyncio.run(bring())
    asyncio.run(bring())
    with pytest.raises(Refused, match="the project has 2 records already, delete one of them first"):
        asyncio.run(bring())
    store.records.delete(store.records.all(plc.project_id)[0].id)
    asyncio.run(bring())
    assert len(store.records.all(plc.project_id)) == 2
