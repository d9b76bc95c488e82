"""States, sweeps, accepted findings, imported records; on SQLite and on PostgreSQL alike."""

from dataclasses import replace

import pytest

from scanbench.faults.reaction.reaction import RequiredResult
from scanbench.store.records import CellRow, NameTaken, NotFound, NotStorable, SweepProblem, SweepRow, SweptError
from scanbench.store.store import Store

BATTERY = SweptError("battery-error", "Battery error", "00F7", "nonfatal", "PLC")
MEMORY = SweptError("memory-error", "Memory error", "80F1", "fatal", "PLC")


@pytest.fixture
def project(store: Store) -> int:
    return store.projects.create("conveyor", "CJ1M-CPU63").id


def begin(store: Store, project: int, instance: int | None = None) -> SweepRow:
    return store.sweeps.create(
        project, instance_id=instance, instance="line-1", model="CJ1M-CPU63", program_version=4, by="ada", window=200,
        states=("filled", "empty"), errors=(MEMORY, BATTERY),
    )  # fmt: skip


def test_states(store: Store, project: int) -> None:
    filled = store.states.create(project, "filled", instance="line-1", scan=2**40, program_version=4, by="ada")
    empty = store.states.create(project, "empty", instance="line-1", scan=0, program_version=4, by="bob")
    assert (filled.scan, filled.by, empty.by) == (2**40, "ada", "bob")
    assert store.states.all(project) == [empty, filled]
    with pytest.raises(NameTaken, match="'filled' in this project already"):
        store.states.create(project, "filled", instance="line-1", scan=1, program_version=4, by="ada")
    other = store.projects.create("other", "CJ1M-CPU63").id
    assert store.states.create(other, "filled", instance="x", scan=1, program_version=1, by="ada").project == other
    store.states.delete(empty.id)
    assert store.states.all(project) == [filled]
    with pytest.raises(NotFound, match="no state 99"):
        store.states.delete(99)


def test_a_sweep_fills_and_counts(store: Store, project: int) -> None:
    sweep = begin(store, project)
    assert (sweep.status, sweep.total, sweep.done, sweep.counts) == ("running", 4, 0, {})
    reaction = {"verdict": "reacted", "readers": []}
    battery = CellRow("battery-error", "filled", 2**40, "reacted", 1, 2, 17, "", reaction)
    refused = CellRow("memory-error", "empty", 5, None, note="it could not be raised")
    store.sweeps.add_cells(sweep.id, [battery, refused])
    store.sweeps.add_cells(sweep.id, [CellRow("memory-error", "filled", 6, "stopped")])
    listed = store.sweeps.cells(sweep.id)
    assert [(cell.error, cell.state) for cell in listed] == [
        ("memory-error", "filled"), ("memory-error", "empty"), ("battery-error", "filled"),
    ]  # fmt: skip
    assert listed[2] == replace(battery, reaction=None)
    assert store.sweeps.reaction(sweep.id, "battery-error", "filled") == reaction
    assert store.sweeps.reaction(sweep.id, "memory-error", "empty") is None
    with pytest.raises(NotFound, match="no cell for battery-error from 'empty'"):
        store.sweeps.reaction(sweep.id, "battery-error", "empty")
    now = store.sweeps.get(sweep.id)
    assert (now.done, now.counts, now.errors) == (3, {"reacted": 1, "stopped": 1}, (MEMORY, BATTERY))
    store.sweeps.add_cells(sweep.id, [replace(refused, verdict="never_read", note="")])  # tried again
    assert store.sweeps.get(sweep.id).counts == {"reacted": 1, "stopped": 1, "never_read": 1}
    ended = store.sweeps.change(sweep.id, status="done", message="fine", seconds=1.5)
    assert (ended.status, ended.message, ended.seconds, ended.done) == ("done", "fine", 1.5, 3)
    store.sweeps.delete(sweep.id)
    for ask in (store.sweeps.get, store.sweeps.cells, store.sweeps.delete):
        with pytest.raises(NotFound, match=f"no sweep {sweep.id}"):
            ask(sweep.id)


def test_what_is_required_is_counted_without_the_reactions(store: Store, project: int) -> None:
    sweep = begin(store, project)
    untried = (RequiredResult("lamp", 3, "not_checked", reason="not_raised", note="it is not fitted"),)
    failed = CellRow(
        "battery-error", "filled", 7, "acted", reaction={"required": "of a newer version"}, required=3, unmet=2
    )
    refused = CellRow("memory-error", "filled", 7, None, note="it is not fitted", required=1, unmet=1, untried=untried)
    store.sweeps.add_cells(sweep.id, [failed, refused, CellRow("memory-error", "empty", 7, "stopped", required=1)])
    assert store.sweeps.cells(sweep.id)[0] == refused
    assert store.sweeps.cells(sweep.id)[2] == replace(failed, reaction=None)
    problem = SweepProblem(4, 1, "there is no error batery-error")
    planned = store.sweeps.plan(sweep.id, [MEMORY, BATTERY], [problem])
    (listed,) = store.sweeps.all(project)
    assert (planned.unmet, planned.problems) == (listed.unmet, listed.problems) == (3, (problem,))


def test_a_sweep_outlives_its_plc_but_not_its_project(store: Store, project: int) -> None:
    instance = store.instances.create(project, "line-1").id
    first, second = begin(store, project, instance), begin(store, project)
    store.sweeps.add_cells(first.id, [CellRow("battery-error", "filled", 1, "reacted")])
    assert store.sweeps.get(first.id).instance_id == instance
    store.instances.delete(instance)
    assert store.sweeps.get(first.id).instance_id is None
    assert [sweep.id for sweep in store.sweeps.all(project)] == [second.id, first.id]
    store.projects.delete(project)
    with pytest.raises(NotFound):
        store.sweeps.get(first.id)


def test_sweeps_that_ran_when_the_server_ended(store: Store, project: int) -> None:
    running, done = begin(store, project), begin(store, project)
    store.sweeps.change(done.id, status="done", message="", seconds=1.0)
    assert store.sweeps.interrupt("the server ended: resume it") == 1
    assert store.sweeps.get(running.id).status == "interrupted"
    assert store.sweeps.get(running.id).message == "the server ended: resume it"
    assert store.sweeps.get(done.id).status == "done"
    assert store.sweeps.interrupt("") == 0


def test_findings_that_are_accepted(store: Store, project: int) -> None:
    first = store.findings.accept(
        project, error="battery-error", state="filled", reason="no battery in this line", by="ada"
    )
    assert store.findings.accepted(project) == [first]
    again = store.findings.accept(project, error="battery-error", state="filled", reason="電池なし", by="bob")
    assert store.findings.accepted(project) == [again]
    with pytest.raises(NotStorable, match="the reason has 501 characters"):
        store.findings.accept(project, error="battery-error", state="filled", reason="x" * 501, by="ada")
    store.findings.withdraw(project, error="battery-error", state="filled")
    assert store.findings.accepted(project) == []
    with pytest.raises(NotFound, match="nobody accepted battery-error from 'filled'"):
        store.findings.withdraw(project, error="battery-error", state="filled")


def test_imported_records(store: Store, project: int) -> None:
    text = "<TestRecord>" + "日本語 " * 10_000 + "</TestRecord>"
    first = store.records.add(project, title="line-1, version 3", text=text, by="ada")
    second = store.records.add(project, title="line-2", text="x", by="bob")
    assert store.records.all(project) == [second, first]
    whole = store.records.get(first.id)
    assert (whole.text, whole.title, whole.by, whole.at) == (text, first.title, "ada", first.at)
    store.records.delete(first.id)
    assert store.records.all(project) == [second]
    for ask in (store.records.get, store.records.delete):
        with pytest.raises(NotFound, match="no record 99"):
            ask(99)
