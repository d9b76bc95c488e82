"""Watch lists: saves that know their version, and names that are taken."""

import pytest

from scanbench.store.records import ListConflict, NameTaken, NotFound, NotStorable, WatchContent, WatchEntry
from scanbench.store.store import Store

CONTENT = WatchContent(("Belt",), (WatchEntry("Main.x"), WatchEntry("D100", "Belt", "hex")))


def test_a_list_is_kept_as_it_is(url: str) -> None:
    store = Store(url)
    project = store.create_project("conveyor", "CJ1M-CPU63").id
    made = store.create_watch_list(project, "Belts", "", CONTENT, "Mika")
    assert (made.version, made.owner, made.by, made.content) == (1, "", "Mika", CONTENT)
    store.close()
    again = Store(url)
    assert again.watch_list(made.id) == made
    saved = again.save_watch_list(made.id, "Belts 2", "", WatchContent(), 1, "Jo")
    assert (saved.name, saved.version, saved.by, saved.content) == ("Belts 2", 2, "Jo", WatchContent())
    with pytest.raises(ListConflict, match="was saved by Jo") as caught:
        again.save_watch_list(made.id, "Belts", "", CONTENT, 1, "Mika")
    assert caught.value.theirs == saved
    again.delete_watch_list(made.id)
    for gone in (
        lambda: again.watch_list(made.id),
        lambda: again.delete_watch_list(made.id),
        lambda: again.save_watch_list(made.id, "Belts", "", CONTENT, 2, "Mika"),
    ):
        with pytest.raises(NotFound):
            gone()
    again.close()


def test_who_sees_what_and_which_names_are_taken(url: str) -> None:
    store = Store(url)
    project = store.create_project("conveyor", "CJ1M-CPU63").id
    other = store.create_project("dosing", "CJ1M-CPU63").id
    store.create_watch_list(project, "b", "", CONTENT, "Mika")
    store.create_watch_list(project, "a", "Mika", CONTENT, "Mika")
    mine = store.create_watch_list(project, "b", "Jo", CONTENT, "Jo")
    store.create_watch_list(other, "b", "", CONTENT, "Jo")
    assert [each.name for each in store.watch_lists(project, "Mika")] == ["a", "b"]
    assert [each.owner for each in store.watch_lists(project, "Jo")] == ["", "Jo"]
    with pytest.raises(NameTaken):
        store.create_watch_list(project, "b", "Jo", CONTENT, "Jo")
    with pytest.raises(NameTaken):
        store.save_watch_list(mine.id, "b", "", CONTENT, 1, "Jo")
    with pytest.raises(NotStorable):
        store.create_watch_list(project, "c", "", WatchContent((), (WatchEntry("a\0b"),)), "Jo")
    with pytest.raises(NotFound):
        store.watch_lists(999, "Jo")
    store.delete_project(other)
    store.close()
