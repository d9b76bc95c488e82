"""Traces and kept records of them in the store, on each database."""

import pytest

from scanbench.store.records import NotFound, NotStorable
from scanbench.store.store import Store

CONTENT = {"definition": {"name": "T", "signals": ["Main.n"], "trigger": None}, "by": "Ada", "on": True}


def made(store: Store) -> tuple[int, int]:
    project = store.create_project("P", "CJ1M-CPU63", ())
    return project.id, store.create_instance(project.id, "line").id


def test_the_traces_of_an_instance_are_replaced_as_a_whole(store: Store) -> None:
    _, instance = made(store)
    assert store.traces(instance) == {}
    store.keep_traces(instance, {1: CONTENT, 4: {**CONTENT, "on": False}})
    assert store.traces(instance) == {1: CONTENT, 4: {**CONTENT, "on": False}}
    store.keep_traces(instance, {4: CONTENT})
    assert store.traces(instance) == {4: CONTENT}
    store.delete_instance(instance)
    with pytest.raises(NotFound):
        store.traces(instance)
    with pytest.raises(NotFound):
        store.keep_traces(instance, {1: CONTENT})


def test_records_are_kept_for_a_project_and_outlive_the_instance(store: Store) -> None:
    project, instance = made(store)
    first = store.keep("trace", project, name="before", instance="line", content=CONTENT, by="Ada")
    second = store.keep("trace", project, name="after", instance="line", content=CONTENT, by="Bob")
    store.delete_instance(instance)
    assert [row.id for row in store.kept("trace", project)] == [second.id, first.id]
    assert store.kept_one("trace", first.id) == first
    assert (first.name, first.instance, first.content, first.by) == ("before", "line", CONTENT, "Ada")
    store.forget("trace", first.id)
    with pytest.raises(NotFound, match=str(first.id)):
        store.kept_one("trace", first.id)
    with pytest.raises(NotFound):
        store.forget("trace", first.id)
    store.delete_project(project)
    with pytest.raises(NotFound):
        store.kept_one("trace", second.id)


def test_what_cannot_be_stored(store: Store) -> None:
    project, _ = made(store)
    for name in ("", "x" * 101, "a\x00b"):
        with pytest.raises(NotStorable):
            store.keep("trace", project, name=name, instance="line", content=CONTENT, by="Ada")
