"""What the store promises, on SQLite and on PostgreSQL alike."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta, timezone

import pytest

from scanbench.store.records import Conflict, HistoryRow, Limits, LogRow, NameTaken, NotFound, NotStorable
from scanbench.store.store import Store

NOON = datetime(2026, 11, 21, 12, 0, 0, 123456, tzinfo=UTC)


def test_projects(store: Store) -> None:
    assert store.projects() == []
    made = store.create_project("conveyor", "CJ1M-CPU63")
    assert (made.name, made.model, made.version) == ("conveyor", "CJ1M-CPU63", 0)
    assert made.created.tzinfo is UTC
    other = store.create_project("a mixer", "GENERIC-IEC")
    assert store.projects() == [other, made]
    assert store.project(made.id) == made
    with pytest.raises(NameTaken, match="'conveyor' already"):
        store.create_project("conveyor", "GENERIC-IEC")
    store.delete_project(other.id)
    assert store.projects() == [made]
    with pytest.raises(NotFound, match=f"no project {other.id}"):
        store.delete_project(other.id)


def test_what_is_saved_is_read_again(store: Store) -> None:
    project = store.create_project("conveyor", "CJ1M-CPU63").id
    text = "(* コンベヤ µ × 🏭 *)\r\nPROGRAM Main\n\tEND_PROGRAM\n" * 5000
    saved = store.save_file(project, "src/main.st", text, 0, "ada")
    assert (saved.version, saved.author, saved.text) == (1, "ada", text)
    assert store.file(project, "src/main.st") == saved
    again = store.save_file(project, "src/main.st", "", 1, "bob")
    assert (again.version, again.author, again.text) == (2, "bob", "")
    store.save_file(project, "a.st", "A", 0, "ada")
    assert [(file.path, file.version, file.author) for file in store.files(project)] == [
        ("a.st", 1, "ada"),
        ("src/main.st", 2, "bob"),
    ]
    assert store.sources(project) == {"a.st": "A", "src/main.st": ""}


def test_who_saves_second_gets_the_other_text_and_writes_nothing(store: Store) -> None:
    project = store.create_project("conveyor", "CJ1M-CPU63").id
    first = store.save_file(project, "main.st", "first", 0, "ada")
    theirs = store.save_file(project, "main.st", "ada's", first.version, "ada")
    for version in (first.version, 0, 17):
        with pytest.raises(Conflict, match=r"saved by ada in the meantime; nothing was written") as conflict:
            store.save_file(project, "main.st", "bob's", version, "bob")
        assert conflict.value.theirs == theirs
    assert store.file(project, "main.st") == theirs


def test_saving_what_was_deleted_is_a_conflict_too(store: Store) -> None:
    project = store.create_project("conveyor", "CJ1M-CPU63").id
    saved = store.save_file(project, "main.st", "text", 0, "ada")
    with pytest.raises(Conflict):
        store.delete_file(project, "main.st", 7)
    store.delete_file(project, "main.st", saved.version)
    with pytest.raises(Conflict, match="was deleted in the meantime") as conflict:
        store.save_file(project, "main.st", "more", saved.version, "bob")
    assert conflict.value.theirs is None
    with pytest.raises(NotFound, match=r"no file 'main\.st'"):
        store.delete_file(project, "main.st")
    assert store.save_file(project, "main.st", "again", 0, "bob").version == 1


def test_accepted_builds_keep_their_sources(store: Store) -> None:
    project = store.create_project("conveyor", "CJ1M-CPU63").id
    assert store.last_build(project) is None
    assert store.accept_build(project, {"main.st": "one"}, "ada") == 1
    assert store.accept_build(project, {"main.st": "two", "b.st": "ä"}, "bob") == 2
    assert store.last_build(project) == {"main.st": "two", "b.st": "ä"}
    first, second = store.build(project, 1), store.build(project)
    assert first is not None
    assert second is not None
    assert (first.sources, first.author, second.version) == ({"main.st": "one"}, "ada", 2)
    assert first.hash != second.hash
    assert store.build(project, 3) is None
    assert store.project(project).version == 2
    assert store.accept_build(project, {"main.st": "one"}, "ada") == 3
    third = store.build(project)
    assert third is not None
    assert third.hash == first.hash


def test_instances(store: Store) -> None:
    project = store.create_project("conveyor", "CJ1M-CPU63").id
    made = store.create_instance(project, "line 1")
    assert (made.project, made.name) == (project, "line 1")
    assert store.instances() == [made]
    with pytest.raises(NameTaken, match="'line 1' already"):
        store.create_instance(project, "line 1")
    with pytest.raises(NotFound, match="no project 99"):
        store.create_instance(99, "line 2")
    store.delete_instance(made.id)
    assert store.instances() == []
    with pytest.raises(NotFound):
        store.delete_instance(made.id)


def test_an_instance_changes(store: Store) -> None:
    project = store.create_project("changing", "GENERIC-IEC").id
    one, other = store.create_instance(project, "one"), store.create_instance(project, "other")
    assert (one.powered, one.limits) == (True, Limits())
    changed = store.change_instance(one.id, name="first", powered=False, limits=Limits(128, 50, 16))
    assert (changed.name, changed.powered, changed.limits) == ("first", False, Limits(128, 50, 16))
    assert store.change_instance(one.id) == changed  # nothing given, nothing changed
    assert next(each for each in store.instances() if each.id == one.id) == changed
    with pytest.raises(NameTaken, match="other"):
        store.change_instance(one.id, name=other.name)
    with pytest.raises(NotFound):
        store.change_instance(999, powered=True)


ROW = HistoryRow(
    error="memory-error",
    program_version=3,
    status="generated",
    code="80F4",
    details="location=io-table-checksum",
    generated_at=NOON,
    recovered_at=None,
    generated_scan=4711,
    recovered_scan=None,
    by="ada",
    origin="simulator",
    count=1,
)


def lines(*texts: str, author: str = "ada") -> list[LogRow]:
    return [LogRow(NOON + timedelta(seconds=at), at, author, "write", text, 3) for at, text in enumerate(texts)]


def test_a_row_of_the_history_takes_the_place_of_the_one_before(store: Store) -> None:
    project = store.create_project("p", "CJ1M-CPU63").id
    instance, other = store.create_instance(project, "i").id, store.create_instance(project, "j").id
    assert store.history(instance) == []
    store.keep_history(instance, [])
    store.keep_history(instance, [ROW])
    assert store.history(instance) == [ROW]
    cleared = replace(ROW, status="cleared", recovered_at=NOON + timedelta(minutes=1), recovered_scan=5000)
    battery = replace(ROW, error="battery-error", generated_scan=2**40, by="bob", origin="program", count=7)
    store.keep_history(other, [battery])
    store.keep_history(instance, [cleared, battery])
    assert store.history(instance) == [battery, cleared]
    again = replace(ROW, code="80F5", details="", generated_scan=9000, count=2)
    store.keep_history(instance, [again])
    assert store.history(instance) == [battery, again]
    assert store.history(other) == [battery]
    with pytest.raises(NotFound, match="no instance 4711"):
        store.keep_history(4711, [ROW])


def test_every_version_of_the_program_has_rows_of_its_own(store: Store) -> None:
    instance = store.create_instance(store.create_project("p", "CJ1M-CPU63").id, "i").id
    new = replace(ROW, program_version=4, by="bob")
    store.keep_history(instance, [new, ROW])
    assert store.history(instance) == [ROW, new]
    cleared = replace(new, status="cleared", recovered_at=NOON, recovered_scan=5)
    store.keep_history(instance, [cleared])
    assert store.history(instance) == [ROW, cleared]


def test_reactions_are_kept_as_they_came(store: Store) -> None:
    instance = store.create_instance(store.create_project("p", "CJ1M-CPU63").id, "i").id
    told = {"verdict": "reacted", "differences": [{"path": "Main.灯", "output": True}], "first_read": None}
    done = replace(ROW, reaction_state="done", reaction=told)
    failed = replace(ROW, reaction_state="failed", reaction_message="it died")
    for row in (replace(ROW, reaction_state="recording"), done, failed, done, ROW):
        store.keep_history(instance, [row])
        assert store.history(instance) == [row]


def test_of_a_batch_with_a_row_that_cannot_be_kept_nothing_is(store: Store) -> None:
    instance = store.create_instance(store.create_project("p", "CJ1M-CPU63").id, "i").id
    bad = replace(ROW, error="battery-error", generated_at=NOON.replace(tzinfo=None))
    with pytest.raises(Exception, match="has no time zone"):
        store.keep_history(instance, [ROW, bad])
    assert store.history(instance) == []


def test_moments_are_utc_whatever_they_came_as(store: Store) -> None:
    instance = store.create_instance(store.create_project("p", "CJ1M-CPU63").id, "i").id
    store.keep_history(instance, [replace(ROW, generated_at=NOON.astimezone(timezone(timedelta(hours=9))))])
    assert store.history(instance)[0].generated_at == NOON
    assert store.history(instance)[0].generated_at.utcoffset() == timedelta(0)


def test_the_log_gives_the_last_lines(store: Store) -> None:
    project = store.create_project("p", "CJ1M-CPU63").id
    instance, other = store.create_instance(project, "i").id, store.create_instance(project, "j").id
    told = lines(*(f"line {number}" for number in range(10)))
    store.add_log(instance, told[:4])
    store.add_log(other, lines("RUN", "PROGRAM", author="b" * 300))
    store.add_log(instance, told[4:])
    assert store.log(instance, 3) == told[7:]
    assert store.log(instance, 100) == told
    assert {line.author for line in store.log(other, 100)} == {"b" * 100}
    with pytest.raises(NotFound, match="no instance 4711"):
        store.add_log(4711, told)


def test_the_log_keeps_so_many_lines(store: Store) -> None:
    project = store.create_project("p", "CJ1M-CPU63").id
    instance, other = store.create_instance(project, "i").id, store.create_instance(project, "j").id
    store.add_log(other, lines("RUN"))
    store.add_log(instance, lines("a", "b", "c"), keep=5)
    assert [line.text for line in store.log(instance, 100)] == ["a", "b", "c"]
    store.add_log(instance, lines("d", "e", "f"), keep=5)
    assert [line.text for line in store.log(instance, 100)] == ["b", "c", "d", "e", "f"]
    store.add_log(instance, [], keep=2)
    assert [line.text for line in store.log(instance, 100)] == ["e", "f"]
    assert len(store.log(other, 100)) == 1


def test_deleting_a_project_takes_everything_with_it(store: Store) -> None:
    project = store.create_project("p", "CJ1M-CPU63").id
    store.save_file(project, "main.st", "text", 0, "ada")
    store.accept_build(project, {"main.st": "text"}, "ada")
    instance = store.create_instance(project, "i").id
    store.keep_history(instance, [ROW])
    store.add_log(instance, lines("x"))
    store.delete_project(project)
    assert store.instances() == []
    again = store.create_project("p", "CJ1M-CPU63").id
    assert store.files(again) == []
    for ask in (store.files, store.last_build, store.history, store.sweeps, store.states, lambda id: store.log(id, 1)):
        with pytest.raises(NotFound):
            ask(4711)


def test_what_no_database_keeps_is_refused_with_words(store: Store) -> None:
    project = store.create_project("p", "CJ1M-CPU63").id
    with pytest.raises(NotStorable, match=r"main\.st contains a NUL character"):
        store.save_file(project, "main.st", "a\x00b", 0, "ada")
    with pytest.raises(NotStorable, match="the path has 256 characters, 1 to 255"):
        store.save_file(project, "x" * 256, "", 0, "ada")
    with pytest.raises(NotStorable, match="the name has 0 characters"):
        store.create_project("", "CJ1M-CPU63")
    with pytest.raises(NotStorable, match="the name has 101 characters"):
        store.create_instance(project, "x" * 101)
    assert store.save_file(project, "a.st", "", 0, "x" * 300).author == "x" * 100
    for number in (2**31, 2**64, 10**400):
        with pytest.raises((NotFound, NotStorable)):
            store.project(number)
    assert store.create_project("日" * 100, "CJ1M-CPU63").name == "日" * 100


def test_names_are_data_not_sql(store: Store) -> None:
    name = "'; DROP TABLE project; --"
    made = store.create_project(name, "CJ1M-CPU63")
    store.save_file(made.id, "../%_'\".st", name, 0, name)
    assert store.file(made.id, "../%_'\".st").text == name
    assert [project.name for project in store.projects()] == [name]
