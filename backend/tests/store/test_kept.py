"""Kept verifications and mappings of trace files in the store, on each database."""

import pytest

from scanbench.store.records import NotFound, NotStorable
from scanbench.store.store import Store

CONTENT = {"status": {"title": "Main"}, "model": "CJ1M-CPU63"}
MAPPING = {"axis": "Scan", "unit": "scan", "gaps": "skip", "columns": []}


def test_verifications_and_traces_are_kept_apart(store: Store) -> None:
    project = store.projects.create("P", "CJ1M-CPU63", ()).id
    trace = store.kept.keep("trace", project, name="one", instance="line", content={}, by="Ada")
    first = store.kept.keep("verification", project, name="one", instance="line", content=CONTENT, by="Ada")
    second = store.kept.keep("verification", project, name="two", instance="line", content=CONTENT, by="Bob")
    assert [row.id for row in store.kept.all("verification", project)] == [second.id, first.id]
    assert store.kept.get("verification", first.id).content == CONTENT
    store.kept.forget("verification", first.id)
    with pytest.raises(NotFound, match="verification record"):
        store.kept.forget("verification", first.id)
    assert store.kept.get("trace", trace.id) == trace
    store.projects.delete(project)
    with pytest.raises(NotFound):
        store.kept.get("verification", second.id)


def test_a_mapping_of_the_same_name_is_replaced(store: Store) -> None:
    project = store.projects.create("P", "CJ1M-CPU63", ()).id
    first = store.mappings.save(project, "line 3", MAPPING, "Ada")
    again = store.mappings.save(project, "line 3", {**MAPPING, "gaps": "hold"}, "Bob")
    other = store.mappings.save(project, "another", MAPPING, "Ada")
    assert again.id == first.id
    assert [(row.name, row.by) for row in store.mappings.all(project)] == [("another", "Ada"), ("line 3", "Bob")]
    assert store.mappings.all(project)[1].content["gaps"] == "hold"
    store.mappings.delete(other.id)
    with pytest.raises(NotFound):
        store.mappings.delete(other.id)
    for name in ("", "x" * 101):
        with pytest.raises(NotStorable):
            store.mappings.save(project, name, MAPPING, "Ada")
    with pytest.raises(NotFound):
        store.mappings.save(project + 1, "line 3", MAPPING, "Ada")
