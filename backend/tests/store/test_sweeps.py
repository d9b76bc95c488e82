"""States, sweeps, accepted findings, imported records; on SQLite and on PostgreSQL alike."""

from dataclasses import replace

import pytest

from scanbench.store.records import CellRow, NameTaken, NotFound, NotStorable, SweepRow, SweptError
from scanbench.store.store import Store

BATTERY = SweptError("battery-error", "Battery error", "00F7", "nonfatal", "PLC")
MEMORY = SweptError("memory-error", "Memory error", "80F1", "fatal", "PLC")


@pytest.fixture
def project(store: Store) -> int:
    return store.create_project("conveyor", "CJ1M-CPU63").id


def begin(store: Store, project: int, instance: int | None = None) -> SweepRow:
    return store.create_sweep(
        project, instance_id=instance, instance="line-1", model="CJ1M-CPU63", program_version=4, by="ada", window=200,
        states=("filled", "empty"), errors=(MEMORY, BATTERY),
    )  # fmt: skip


def test_states(store: Store, project: int) -> None:
    filled = store.create_state(project, "filled", instance="line-1", scan=2**40, program_version=4, by="ada")
    empty = store.create_state(project, "empty", instance="line-1", scan=0, program_version=4, by="bob")
    assert (filled.scan, filled.by, empty.by) == (2**40, "ada", "bob")
    assert store.states(project) == [empty, filled]
    with pytest.raises(NameTaken, match="'filled' in this project already"):
        store.create_state(project, "filled", instance="line-1", scan=1, program_version=4, by="ada")
    other = store.create_project("other", "CJ1M-CPU63").id
    assert store.create_state(other, "filled", instance="x", scan=1, program_version=1, by="ada").project == other
    store.delete_state(empty.id)
    assert store.states(project) == [filled]
    with pytest.raises(NotFound, match="no state 99"):
        store.delete_state(99)


def test_a_sweep_fills_and_counts(store: Store, project: int) -> None:
    sweep = begin(store, project)
    assert (sweep.status, sweep.total, sweep.done, sweep.counts) == ("running", 4, 0, {})
    reaction = {"verdict": "reacted", "readers": []}
    battery = CellRow("battery-error", "filled", 2**40, "reacted", 1, 2, 17, "", reaction)
    refused = CellRow("memory-error", "empty", 5, None, note="it could not be raised")
    store.add_cells(sweep.id, [battery, refused])
    store.add_cells(sweep.id, [CellRow("memory-error", "filled", 6, "stopped")])
    listed = store.cells(sweep.id)
    assert [(cell.error, cell.state) for cell in listed] == [
        ("memory-error", "filled"), ("memory-error", "empty"), ("battery-error", "filled"),
    ]  # fmt: skip
    assert listed[2] == replace(battery, reaction=None)
    assert store.cell_reaction(sweep.id, "battery-error", "filled") == reaction
    assert store.cell_reaction(sweep.id, "memory-error", "empty") is None
    with pytest.raises(NotFound, match="no cell for battery-error from 'empty'"):
        store.cell_reaction(sweep.id, "battery-error", "empty")
    now = store.sweep(sweep.id)
    assert (now.done, now.counts, now.errors) == (3, {"reacted": 1, "stopped": 1}, (MEMORY, BATTERY))
    store.add_cells(sweep.id, [replace(refused, verdict="never_read", note="")])  # tried again
    assert store.sweep(sweep.id).counts == {"reacted": 1, "stopped": 1, "never_read": 1}
    ended = store.change_sweep(sweep.id, status="done", message="fine", seconds=1.5)
    assert (ended.status, ended.message, ended.seconds, ended.done) == ("done", "fine", 1.5, 3)
    store.delete_sweep(sweep.id)
    for ask in (store.sweep, store.cells, store.delete_sweep):
        with pytest.raises(NotFound, match=f"no sweep {sweep.id}"):
            ask(sweep.id)


def test_a_sweep_outlives_its_plc_but_not_its_project(store: Store, project: int) -> None:
    instance = store.create_instance(project, "line-1").id
    first, second = begin(store, project, instance), begin(store, project)
    store.add_cells(first.id, [CellRow("battery-error", "filled", 1, "reacted")])
    assert store.sweep(first.id).instance_id == instance
    store.delete_instance(instance)
    assert store.sweep(first.id).instance_id is None
    assert [sweep.id for sweep in store.sweeps(project)] == [second.id, first.id]
    store.delete_project(project)
    with pytest.raises(NotFound):
        store.sweep(first.id)


def test_sweeps_that_ran_when_the_server_ended(store: Store, project: int) -> None:
    running, done = begin(store, project), begin(store, project)
    store.change_sweep(done.id, status="done", message="", seconds=1.0)
    assert store.interrupt_sweeps("the server ended: resume it") == 1
    assert store.sweep(running.id).status == "interrupted"
    assert store.sweep(running.id).message == "the server ended: resume it"
    assert store.sweep(done.id).status == "done"
    assert store.interrupt_sweeps("") == 0


def test_findings_that_are_accepted(store: Store, project: int) -> None:
    first = store.accept(project, error="battery-error", state="filled", reason="no battery in this line", by="ada")
    assert store.acceptances(project) == [first]
    again = store.accept(project, error="battery-error", state="filled", reason="電池なし", by="bob")
    assert store.acceptances(project) == [again]
    with pytest.raises(NotStorable, match="the reason has 501 characters"):
        store.accept(project, error="battery-error", state="filled", reason="x" * 501, by="ada")
    store.withdraw(project, error="battery-error", state="filled")
    assert store.acceptances(project) == []
    with pytest.raises(NotFound, match="nobody accepted battery-error from 'filled'"):
        store.withdraw(project, error="battery-error", state="filled")


def test_imported_records(store: Store, project: int) -> None:
    text = "<TestRecord>" + "日本語 " * 10_000 + "</TestRecord>"
    first = store.add_record(project, title="line-1, version 3", text=text, by="ada")
    second = store.add_record(project, title="line-2", text="x", by="bob")
    assert store.records(project) == [second, first]
    whole = store.record(first.id)
    assert (whole.text, whole.title, whole.by, whole.at) == (text, first.title, "ada", first.at)
    store.delete_record(first.id)
    assert store.records(project) == [second]
    for ask in (store.record, store.delete_record):
        with pytest.raises(NotFound, match="no record 99"):
            ask(99)
