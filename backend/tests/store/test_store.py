"""What the store promises, on SQLite and on PostgreSQL alike."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta, timezone

import pytest

from scanbench.store.records import Conflict, HistoryRow, Limits, LogRow, NameTaken, NotFound, NotStorable
from scanbench.store.store import Store

NOON = datetime(2026, 11, 21, 12, 0, 0, 123456, tzinfo=UTC)


def test_projects(store: Store) -> None:
    assert store.projects.all() == []
    made = store.projects.create("conveyor", "CJ1M-CPU63")
    assert (made.name, made.model, made.version) == ("conveyor", "CJ1M-CPU63", 0)
    assert made.created.tzinfo is UTC
    other = store.projects.create("a mixer", "GENERIC-IEC")
    assert store.projects.all() == [other, made]
    assert store.projects.get(made.id) == made
    with pytest.raises(NameTaken, match="'conveyor' already"):
        store.projects.create("conveyor", "GENERIC-IEC")
    store.projects.delete(other.id)
    assert store.projects.all() == [made]
    with pytest.raises(NotFound, match=f"no project {other.id}"):
        store.projects.delete(other.id)


def test_what_is_saved_is_read_again(store: Store) -> None:
    project = store.projects.create("conveyor", "CJ1M-CPU63").id
    text = "(* コンベヤ µ × 🏭 *)\r\nPROGRAM Main\n\tEND_PROGRAM\n" * 5000
    saved = store.files.save(project, "src/main.st", text, 0, "ada")
    assert (saved.version, saved.author, saved.text) == (1, "ada", text)
    assert store.files.get(project, "src/main.st") == saved
    again = store.files.save(project, "src/main.st", "", 1, "bob")
    assert (again.version, again.author, again.text) == (2, "bob", "")
    store.files.save(project, "a.st", "A", 0, "ada")
    assert [(file.path, file.version, file.author) for file in store.files.all(project)] == [
        ("a.st", 1, "ada"),
        ("src/main.st", 2, "bob"),
    ]
    assert store.files.sources(project) == {"a.st": "A", "src/main.st": ""}


def test_who_saves_second_gets_the_other_text_and_writes_nothing(store: Store) -> None:
    project = store.projects.create("conveyor", "CJ1M-CPU63").id
    first = store.files.save(project, "main.st", "first", 0, "ada")
    theirs = store.files.save(project, "main.st", "ada's", first.version, "ada")
    for version in (first.version, 0, 17):
        with pytest.raises(Conflict, match=r"saved by ada in the meantime; nothing was written") as conflict:
            store.files.save(project, "main.st", "bob's", version, "bob")
        assert conflict.value.theirs == theirs
    assert store.files.get(project, "main.st") == theirs


def test_saving_what_was_deleted_is_a_conflict_too(store: Store) -> None:
    project = store.projects.create("conveyor", "CJ1M-CPU63").id
    saved = store.files.save(project, "main.st", "text", 0, "ada")
    with pytest.raises(Conflict):
        store.files.delete(project, "main.st", 7)
    store.files.delete(project, "main.st", saved.version)
    with pytest.raises(Conflict, match="was deleted in the meantime") as conflict:
        store.files.save(project, "main.st", "more", saved.version, "bob")
    assert conflict.value.theirs is None
    with pytest.raises(NotFound, match=r"no file 'main\.st'"):
        store.files.delete(project, "main.st")
    assert store.files.save(project, "main.st", "again", 0, "bob").version == 1


def test_accepted_builds_keep_their_sources(store: Store) -> None:
    project = store.projects.create("conveyor", "CJ1M-CPU63").id
    assert store.builds.last(project) is None
    assert store.builds.accept(project, {"main.st": "one"}, "ada") == 1
    assert store.builds.accept(project, {"main.st": "two", "b.st": "ä"}, "bob") == 2
    assert store.builds.last(project) == {"main.st": "two", "b.st": "ä"}
    first, second = store.builds.get(project, 1), store.builds.get(project)
    assert first is not None
    assert second is not None
    assert (first.sources, first.author, second.version) == ({"main.st": "one"}, "ada", 2)
    assert first.hash != second.hash
    assert store.builds.get(project, 3) is None
    assert store.projects.get(project).version == 2
    assert store.builds.accept(project, {"main.st": "one"}, "ada") == 3
    third = store.builds.get(project)
    assert third is not None
    assert third.hash == first.hash


def test_instances(store: Store) -> None:
    project = store.projects.create("conveyor", "CJ1M-CPU63").id
    made = store.instances.create(project, "line 1")
    assert (made.project, made.name) == (project, "line 1")
    assert store.instances.all() == [made]
    with pytest.raises(NameTaken, match="'line 1' already"):
        store.instances.create(project, "line 1")
    with pytest.raises(NotFound, match="no project 99"):
        store.instances.create(99, "line 2")
    store.instances.delete(made.id)
    assert store.instances.all() == []
    with pytest.raises(NotFound):
        store.instances.delete(made.id)


def test_an_instance_changes(store: Store) -> None:
    project = store.projects.create("changing", "GENERIC-IEC").id
    one, other = store.instances.create(project, "one"), store.instances.create(project, "other")
    assert (one.powered, one.limits) == (True, Limits())
    changed = store.instances.change(one.id, name="first", powered=False, limits=Limits(128, 50, 16))
    assert (changed.name, changed.powered, changed.limits) == ("first", False, Limits(128, 50, 16))
    assert store.instances.change(one.id) == changed  # nothing given, nothing changed
    assert next(each for each in store.instances.all() if each.id == one.id) == changed
    with pytest.raises(NameTaken, match="other"):
        store.instances.change(one.id, name=other.name)
    with pytest.raises(NotFound):
        store.instances.change(999, powered=True)


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
    project = store.projects.create("p", "CJ1M-CPU63").id
    instance, other = store.instances.create(project, "i").id, store.instances.create(project, "j").id
    assert store.errors.history(instance) == []
    store.errors.keep(instance, [])
    store.errors.keep(instance, [ROW])
    assert store.errors.history(instance) == [ROW]
    cleared = replace(
        ROW, status="cleared", recovered_at=NOON + timedelta(minutes=1), recovered_scan=5000, recovered_by="Ada", recovered_way="tool",
        acknowledged={"by": "Ada", "at": "2026-11-29T12:00:00+00:00", "scan": 5001, "remark": "seen"},
    )  # fmt: skip
    battery = replace(ROW, error="battery-error", generated_scan=2**40, by="bob", origin="program", count=7)
    store.errors.keep(other, [battery])
    store.errors.keep(instance, [cleared, battery])
    assert store.errors.history(instance) == [battery, cleared]
    again = replace(ROW, code="80F5", details="", generated_scan=9000, count=2)
    store.errors.keep(instance, [again])
    assert store.errors.history(instance) == [battery, again]
    assert store.errors.history(other) == [battery]
    with pytest.raises(NotFound, match="no instance 4711"):
        store.errors.keep(4711, [ROW])


def test_every_version_of_the_program_has_rows_of_its_own(store: Store) -> None:
    instance = store.instances.create(store.projects.create("p", "CJ1M-CPU63").id, "i").id
    new = replace(ROW, program_version=4, by="bob")
    store.errors.keep(instance, [new, ROW])
    assert store.errors.history(instance) == [ROW, new]
    cleared = replace(new, status="cleared", recovered_at=NOON, recovered_scan=5)
    store.errors.keep(instance, [cleared])
    assert store.errors.history(instance) == [ROW, cleared]


def test_reactions_are_kept_as_they_came(store: Store) -> None:
    instance = store.instances.create(store.projects.create("p", "CJ1M-CPU63").id, "i").id
    told = {"verdict": "reacted", "differences": [{"path": "Main.灯", "output": True}], "first_read": None}
    done = replace(ROW, reaction_state="done", reaction=told)
    failed = replace(ROW, reaction_state="failed", reaction_message="it died")
    for row in (replace(ROW, reaction_state="recording"), done, failed, done, ROW):
        store.errors.keep(instance, [row])
        assert store.errors.history(instance) == [row]


def test_of_a_batch_with_a_row_that_cannot_be_kept_nothing_is(store: Store) -> None:
    instance = store.instances.create(store.projects.create("p", "CJ1M-CPU63").id, "i").id
    bad = replace(ROW, error="battery-error", generated_at=NOON.replace(tzinfo=None))
    with pytest.raises(Exception, match="has no time zone"):
        store.errors.keep(instance, [ROW, bad])
    assert store.errors.history(instance) == []


def test_moments_are_utc_whatever_they_came_as(store: Store) -> None:
    instance = store.instances.create(store.projects.create("p", "CJ1M-CPU63").id, "i").id
    store.errors.keep(instance, [replace(ROW, generated_at=NOON.astimezone(timezone(timedelta(hours=9))))])
    assert store.errors.history(instance)[0].generated_at == NOON
    assert store.errors.history(instance)[0].generated_at.utcoffset() == timedelta(0)


def test_the_log_gives_the_last_lines(store: Store) -> None:
    project = store.projects.create("p", "CJ1M-CPU63").id
    instance, other = store.instances.create(project, "i").id, store.instances.create(project, "j").id
    told = lines(*(f"line {number}" for number in range(10)))
    store.log.add(instance, told[:4])
    store.log.add(other, lines("RUN", "PROGRAM", author="b" * 300))
    store.log.add(instance, told[4:])
    assert store.log.last(instance, 3) == told[7:]
    assert store.log.last(instance, 100) == told
    assert {line.author for line in store.log.last(other, 100)} == {"b" * 100}
    with pytest.raises(NotFound, match="no instance 4711"):
        store.log.add(4711, told)


def test_the_log_is_read_page_by_page(store: Store) -> None:
    instance = store.instances.create(store.projects.create("p", "CJ1M-CPU63").id, "i").id
    told = lines(*(f"line {number}" for number in range(25)))
    store.log.add(instance, told)
    assert store.log.page(instance, None, 10) == (15, 25, told[15:])
    assert store.log.page(instance, 5, 10) == (5, 25, told[5:15])
    assert store.log.page(instance, 20, 10) == (20, 25, told[20:])
    assert store.log.page(instance, None, 10, "mode") == (0, 0, [])
    assert store.log.page(instance, 90, 10) == (90, 25, [])


def test_the_log_keeps_so_many_lines(store: Store) -> None:
    project = store.projects.create("p", "CJ1M-CPU63").id
    instance, other = store.instances.create(project, "i").id, store.instances.create(project, "j").id
    store.log.add(other, lines("RUN"))
    store.log.add(instance, lines("a", "b", "c"), keep=5)
    assert [line.text for line in store.log.last(instance, 100)] == ["a", "b", "c"]
    store.log.add(instance, lines("d", "e", "f"), keep=5)
    assert [line.text for line in store.log.last(instance, 100)] == ["b", "c", "d", "e", "f"]
    store.log.add(instance, [], keep=2)
    assert [line.text for line in store.log.last(instance, 100)] == ["e", "f"]
    assert len(store.log.last(other, 100)) == 1


def test_deleting_a_project_takes_everything_with_it(store: Store) -> None:
    project = store.projects.create("p", "CJ1M-CPU63").id
    store.files.save(project, "main.st", "text", 0, "ada")
    store.builds.accept(project, {"main.st": "text"}, "ada")
    instance = store.instances.create(project, "i").id
    store.errors.keep(instance, [ROW])
    store.log.add(instance, lines("x"))
    store.projects.delete(project)
    assert store.instances.all() == []
    again = store.projects.create("p", "CJ1M-CPU63").id
    assert store.files.all(again) == []
    for ask in (
        store.files.all,
        store.builds.last,
        store.errors.history,
        store.sweeps.all,
        store.states.all,
        lambda id: store.log.last(id, 1),
    ):
        with pytest.raises(NotFound):
            ask(4711)


def test_what_no_database_keeps_is_refused_with_words(store: Store) -> None:
    project = store.projects.create("p", "CJ1M-CPU63").id
    with pytest.raises(NotStorable, match=r"main\.st contains a NUL character"):
        store.files.save(project, "main.st", "a\x00b", 0, "ada")
    with pytest.raises(NotStorable, match="the path has 256 characters, 1 to 255"):
        store.files.save(project, "x" * 256, "", 0, "ada")
    with pytest.raises(NotStorable, match="the name has 0 characters"):
        store.projects.create("", "CJ1M-CPU63")
    with pytest.raises(NotStorable, match="the name has 101 characters"):
        store.instances.create(project, "x" * 101)
    assert store.files.save(project, "a.st", "", 0, "x" * 300).author == "x" * 100
    for number in (2**31, 2**64, 10**400):
        with pytest.raises((NotFound, NotStorable)):
            store.projects.get(number)
    assert store.projects.create("日" * 100, "CJ1M-CPU63").name == "日" * 100


def test_names_are_data_not_sql(store: Store) -> None:
    name = "'; DROP TABLE project; --"
    made = store.projects.create(name, "CJ1M-CPU63")
    store.files.save(made.id, "../%_'\".st", name, 0, name)
    assert store.files.get(made.id, "../%_'\".st").text == name
    assert [project.name for project in store.projects.all()] == [name]
