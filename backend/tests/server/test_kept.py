"""What a project keeps that nobody here can read: it is told with a sentence, and takes nothing else with it."""

import asyncio
from collections.abc import Iterator
from pathlib import Path

import pytest

from scanbench.server.trace_records import TraceRecords
from scanbench.server.uploads import TraceFiles, mapping_of
from scanbench.server.verifications import Verifications
from scanbench.session.debugging import breakpoint_of
from scanbench.session.tracing import Tracing
from scanbench.store.kept import What
from scanbench.store.records import Json, StoreError, WatchContent, WatchEntry
from scanbench.store.rows import NOTHING, sweep, watch_list
from scanbench.store.store import Store
from scanbench.store.tables import Sweep, WatchList
from scanbench.verify.contract import Range
from scanbench.verify.trace.mapping import ColumnMap, TraceMapping
from scanbench.wire.codec import pack, pack_body
from scanbench.wire.refused import Refused
from scanbench.wire.verification import KeptRows, PackedRow
from scanbench.wire.verifying import VerificationStatus, VerifyWish
from tests.store.said import nobody
from tests.wire.packed import packed_with

RECORD: Json = {
    "origin": "trace", "signals": [{"text": "Main.n"}], "every": 1, "triggered": None, "first": 0, "end": 1, "rows": 1,
    "interval_ns": 1, "version": 1,
}  # fmt: skip
STATUS = VerificationStatus(1, 1, "Ada", VerifyWish(Range()), "past", "free")
SAYS = "cannot be read: .*Open it with the version of Scanbench that kept it"


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    opened = Store(f"sqlite:///{tmp_path / 'scanbench.db'}")
    yield opened
    opened.close()


@pytest.fixture
def project(store: Store) -> int:
    return store.projects.create("P", "GENERIC-IEC").id


def keep(store: Store, project: int, name: str, content: Json, what: What) -> int:
    return store.kept.keep(what, project, name=name, instance="line", content=content, by="Ada").id


def test_a_trace_record(store: Store, project: int, tmp_path: Path) -> None:
    records = TraceRecords(store, tmp_path, tmp_path)
    for bad in ({}, {**RECORD, "signals": [{"text": 7}]}, {**RECORD, "every": "x"}):
        id = keep(store, project, "of a newer version", bad, "trace")
        with pytest.raises(Refused, match=f"the record of a newer version {SAYS}"):
            asyncio.run(records.one(id))
    good = keep(store, project, "good", RECORD, "trace")
    assert [each.row.id for each in asyncio.run(records.of_project(project))] == [good]


def test_a_record_of_earlier_scans_from_before_it_was_called_retrospective(
    store: Store, project: int, tmp_path: Path
) -> None:
    records = TraceRecords(store, tmp_path, tmp_path)
    id = keep(store, project, "old", {**RECORD, "origin": "flight"}, "trace")
    assert asyncio.run(records.one(id)).origin == "retrospective"
    bad = keep(store, project, "unknown", {**RECORD, "origin": "guessed"}, "trace")
    with pytest.raises(Refused, match=SAYS):
        asyncio.run(records.one(bad))


def test_a_verification_record(store: Store, project: int, tmp_path: Path) -> None:
    records = Verifications(store, tmp_path, tmp_path)
    for bad in ({}, {"status": "no hex"}, {"status": "c1"}):
        id = keep(store, project, "of a newer version", bad, "verification")
        with pytest.raises(Refused, match=f"the record of a newer version {SAYS}"):
            asyncio.run(records.record(id))
    good = keep(store, project, "good", {"status": pack_body(STATUS).hex()}, "verification")
    assert [each.row.id for each in asyncio.run(records.records(project))] == [good]
    (tmp_path / f"{good}.rows").write_bytes(b"\1\0\0\0\xc1")
    rows = KeptRows(0, (PackedRow(0, 1, 0, None, packed_with("Row", "weather", 0)),), (), (), (), {})
    for data in (b"\1\0\0\0\xc1", pack(rows)):
        (tmp_path / f"{good}.rows").write_bytes(data)
        with pytest.raises(Refused, match=f"the rows of this record {SAYS}"):
            asyncio.run(records.record_rows(good, 0, 1, False))
        with pytest.raises(Refused, match=f"the rows of this record {SAYS}"):
            asyncio.run(records.export_record(good, "csv"))


def test_a_mapping_is_saved_as_it_is_read(store: Store, project: int, tmp_path: Path) -> None:
    files = TraceFiles(store, tmp_path / "imports", tmp_path)
    files.tidy()
    asyncio.run(files.save_mapping(project, "good", TraceMapping(" scan "), "Ada"))
    store.mappings.save(project, "of a newer version", {"gaps": "bridge"}, "Ada")
    uploaded = asyncio.run(files.upload(project, "t.csv", b"scan\n1\n", None))
    assert uploaded.proposal == TraceMapping("scan")


def test_texts_of_a_mapping_are_stripped_and_no_column_is_empty(store: Store, project: int) -> None:
    column = {"column": " speed", "path": "Main.n ", "role": " input "}
    padded = store.mappings.save(project, "padded", {"axis": " scan ", "columns": [column]}, "Ada")
    assert mapping_of(padded) == TraceMapping("scan", columns=(ColumnMap("speed", "Main.n", "input"),))
    empty = store.mappings.save(project, "empty", {"columns": [column, {"column": " "}]}, "Ada")
    with pytest.raises(Refused, match=f"the mapping empty {SAYS}"):
        mapping_of(empty)


def test_a_trace_and_a_breakpoint(caplog: pytest.LogCaptureFixture) -> None:
    good: Json = {"definition": {"name": "T", "signals": ["Main.n"]}}
    tracing = Tracing(nobody, lambda _: None, lambda _: None, {1: {"definition": {}}, 3: good})
    assert [(each.id, each.definition.signals) for each in tracing.traces] == [(3, ("Main.n",))]
    assert "a trace that another version of Scanbench kept is left out: definition: name is missing" in caplog.text
    assert breakpoint_of({"id": 1, "kind": "weather", "author": "Ada"}) is None
    assert "left out: kind must be one of line, data" in caplog.text
    kept = breakpoint_of({"id": 1, "kind": "line", "author": "Ada", "of a newer version": 1})
    assert kept is not None
    assert (kept.kind, kept.enabled) == ("line", True)


def test_a_sweep() -> None:
    row = Sweep(
        id=3,
        states=["a"],
        errors=[{"id": "x", "name": "X", "code": "1", "severity": "mild", "group": "G"}],
        problems=[],
    )
    with pytest.raises(
        StoreError, match=r"sweep 3 cannot be read: errors: severity must be one of fatal, nonfatal.*Use the version"
    ):
        sweep(row, NOTHING)


def test_the_lines_of_a_watch_list() -> None:
    """Of which an older version knew fewer values, and a newer one knows more."""
    entries = [["D100"], ["Main.n", "g", "hex", "of a newer version"]]
    row = WatchList(
        id=1, project_id=1, owner="", name="L", version=1, by="Ada", content={"entries": entries, "more": 1}
    )
    assert watch_list(row).content == WatchContent((), (WatchEntry("D100"), WatchEntry("Main.n", "g", "hex")))
