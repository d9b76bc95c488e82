"""Watch lists: saves that know their version, and names that are taken."""

import pytest

from scanbench.store.records import ListConflict, NameTaken, NotFound, NotStorable, WatchContent, WatchEntry
from scanbench.store.store import Store

CONTENT = WatchContent(("Belt",), (WatchEntry("Main.x"), WatchEntry("D100", "Belt", "hex")))


def test_a_list_is_kept_as_it_is(url: str) -> None:
    store = Store(url)
    project = store.projects.create("conveyor", "CJ1M-CPU63").id
    made = store.watch_lists.create(project, "Belts", "", CONTENT, "Mika")
    assert (made.version, made.owner, made.by, made.content) == (1, "", "Mika", CONTENT)
    store.close()
    again = Store(url)
    assert again.watch_lists.get(made.id) == made
    saved = again.watch_lists.save(made.id, "Belts 2", "", WatchContent(), 1, "Jo")
    assert (saved.name, saved.version, saved.by, saved.content) == ("Belts 2", 2, "Jo", WatchContent())
    with pytest.raises(ListConflict, match="was saved by Jo") as caught:
        again.watch_lists.save(made.id, "Belts", "", CONTENT, 1, "Mika")
    assert caught.value.theirs == saved
    again.watch_lists.delete(made.id)
    for gone in (
        lambda: again.watch_lists.get(made.id),
        lambda: again.watch_lists.delete(made.id),
        lambda: again.watch_lists.save(made.id, "Belts", "", CONTENT, 2, "Mika"),
    ):
        with pytest.raises(NotFound):
            gone()
    again.close()


def test_who_sees_what_and_which_names_are_taken(url: str) -> None:
    store = Store(url)
    project = store.projects.create("conveyor", "CJ1M-CPU63").id
    other = store.projects.create("dosing", "CJ1M-CPU63").id
    store.watch_lists.create(project, "b", "", CONTENT, "Mika")
    store.watch_lists.create(project, "a", "Mika", CONTENT, "Mika")
    mine = store.watch_lists.create(project, "b", "Jo", CONTENT, "Jo")
    store.watch_lists.create(other, "b", "", CONTENT, "Jo")
    assert [each.name for each in store.watch_lists.seen(project, "Mika")] == ["a", "b"]
    assert [each.owner for each in store.watch_lists.seen(project, "Jo")] == ["", "Jo"]
    with pytest.raises(NameTaken):
        store.watch_lists.create(project, "b", "Jo", CONTENT, "Jo")
    with pytest.raises(NameTaken):
        store.watch_lists.save(mine.id, "b", "", CONTENT, 1, "Jo")
    with pytest.raises(NotStorable):
        store.watch_lists.create(project, "c", "", WatchContent((), (WatchEntry("a\0b"),)), "Jo")
    with pytest.raises(NotFound):
        store.watch_lists.seen(999, "Jo")
    store.projects.delete(other)
    store.close()
