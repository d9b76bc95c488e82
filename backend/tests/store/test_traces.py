"""Traces and kept records of them in the store, on each database."""

import pytest

from scanbench.store.records import NotFound, NotStorable
from scanbench.store.store import Store

CONTENT = {"definition": {"name": "T", "signals": ["Main.n"], "trigger": None}, "by": "Ada", "on": True}


def made(store: Store) -> tuple[int, int]:
    project = store.projects.create("P", "CJ1M-CPU63", ())
    return project.id, store.instances.create(project.id, "line").id


def test_the_traces_of_an_instance_are_replaced_as_a_whole(store: Store) -> None:
    _, instance = made(store)
    assert store.traces.all(instance) == {}
    store.traces.keep(instance, {1: CONTENT, 4: {**CONTENT, "on": False}})
    assert store.traces.all(instance) == {1: CONTENT, 4: {**CONTENT, "on": False}}
    store.traces.keep(instance, {4: CONTENT})
    assert store.traces.all(instance) == {4: CONTENT}
    store.instances.delete(instance)
    with pytest.raises(NotFound):
        store.traces.all(instance)
    with pytest.raises(NotFound):
        store.traces.keep(instance, {1: CONTENT})


def test_records_are_kept_for_a_project_and_outlive_the_instance(store: Store) -> None:
    project, instance = made(store)
    first = store.kept.keep("trace", project, name="before", instance="line", content=CONTENT, by="Ada")
    second = store.kept.keep("trace", project, name="after", instance="line", content=CONTENT, by="Bob")
    store.instances.delete(instance)
    assert [row.id for row in store.kept.all("trace", project)] == [second.id, first.id]
    assert store.kept.get("trace", first.id) == first
    assert (first.name, first.instance, first.content, first.by) == ("before", "line", CONTENT, "Ada")
    store.kept.forget("trace", first.id)
    with pytest.raises(NotFound, match=str(first.id)):
        store.kept.get("trace", first.id)
    with pytest.raises(NotFound):
        store.kept.forget("trace", first.id)
    store.projects.delete(project)
    with pytest.raises(NotFound):
        store.kept.get("trace", second.id)


def test_what_cannot_be_stored(store: Store) -> None:
    project, _ = made(store)
    for name in ("", "x" * 101, "a\x00b"):
        with pytest.raises(NotStorable):
            store.kept.keep("trace", project, name=name, instance="line", content=CONTENT, by="Ada")
