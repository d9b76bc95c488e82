"""Kept verifications and mappings of trace files in the store, on each database."""

import pytest

from scanbench.store.records import NotFound, NotStorable
from scanbench.store.store import Store

CONTENT = {"status": {"title": "Main"}, "model": "CJ1M-CPU63"}
MAPPING = {"axis": "Scan", "unit": "scan", "gaps": "skip", "columns": []}


def test_verifications_and_traces_are_kept_apart(store: Store) -> None:
    project = store.create_project("P", "CJ1M-CPU63", ()).id
    trace = store.keep("trace", project, name="one", instance="line", content={}, by="Ada")
    first = store.keep("verification", project, name="one", instance="line", content=CONTENT, by="Ada")
    second = store.keep("verification", project, name="two", instance="line", content=CONTENT, by="Bob")
    assert [row.id for row in store.kept("verification", project)] == [second.id, first.id]
    assert store.kept_one("verification", first.id).content == CONTENT
    store.forget("verification", first.id)
    with pytest.raises(NotFound, match="verification record"):
        store.forget("verification", first.id)
    assert store.kept_one("trace", trace.id) == trace
    store.delete_project(project)
    with pytest.raises(NotFound):
        store.kept_one("verification", second.id)


def test_a_mapping_of_the_same_name_is_replaced(store: Store) -> None:
    project = store.create_project("P", "CJ1M-CPU63", ()).id
    first = store.save_mapping(project, "line 3", MAPPING, "Ada")
    again = store.save_mapping(project, "line 3", {**MAPPING, "gaps": "hold"}, "Bob")
    other = store.save_mapping(project, "another", MAPPING, "Ada")
    assert again.id == first.id
    assert [(row.name, row.by) for row in store.mappings(project)] == [("another", "Ada"), ("line 3", "Bob")]
    assert store.mappings(project)[1].content["gaps"] == "hold"
    store.delete_mapping(other.id)
    with pytest.raises(NotFound):
        store.delete_mapping(other.id)
    for name in ("", "x" * 101):
        with pytest.raises(NotStorable):
            store.save_mapping(project, name, MAPPING, "Ada")
    with pytest.raises(NotFound):
        store.save_mapping(project + 1, "line 3", MAPPING, "Ada")
