"""Who is at a project, and where."""

import asyncio
from pathlib import Path

from scanbench.server.people import People
from scanbench.store.people import COLOURS
from scanbench.store.records import StoreError
from scanbench.store.store import Store
from scanbench.wire.events import Event, User
from scanbench.wire.together import PeopleChanged


class Window:
    def __init__(self, name: str) -> None:
        self.user = User(name)
        self.told: list[PeopleChanged] = []

    def on_event(self, event: Event) -> None:
        assert isinstance(event, PeopleChanged)
        self.told.append(event)

    def on_frame(self, frame: bytes) -> None: ...
    def on_snapshot(self, frame: bytes) -> None: ...


def test_everybody_at_the_project_is_told_who_is_where_and_nobody_else() -> None:
    people, ada, grace, other = People(lambda *_: 0), Window("Ada Lovelace"), Window("Grace"), Window("Jo")
    people.come(2, 9, other, 0)
    first, second = people.come(1, 3, ada, 0), people.come(1, 4, grace, 1)
    people.move(second, "Main.st", 12, "a", "h")
    assert ada.told[-1].you == first
    assert [(each.name, each.initials, each.instance, each.file, each.line, each.head) for each in ada.told[-1].people] == [
        ("Ada Lovelace", "AL", 3, None, None, None), ("Grace", "G", 4, "Main.st", 12, "h"),
    ]  # fmt: skip
    people.leave(first)
    people.leave(first)
    people.move(first, "Main.st", 1)
    assert (grace.told[-1].you, [each.name for each in grace.told[-1].people]) == (second, ["Grace"])
    assert len(other.told) == 1


def test_a_person_keeps_the_colour_whoever_comes_first_after_a_restart(tmp_path: Path) -> None:
    store = Store(f"sqlite:///{tmp_path / 'scanbench.db'}")
    project = store.projects.create("conveyor", "CJ1M-CPU63").id

    def colours(*names: str) -> dict[str, int]:
        """Of people who come in this order to a server that has just started."""
        people = People(store.people.colour)
        last = Window("")
        for name in names:
            last = Window(name)
            people.come(project, 1, last, asyncio.run(people.colour(project, name)))
        return {each.name: each.colour for each in last.told[-1].people}

    first = colours("Ada", "Grace", "Ada", "Jo")
    assert len(set(first.values())) == 3
    assert colours("Jo", "Kim", "Grace", "Ada") == {**first, "Kim": 3}
    assert set(colours(*map(str, range(COLOURS))).values()) == set(range(COLOURS))
    store.close()


def test_without_a_database_people_have_colours_all_the_same() -> None:
    def broken(project: int, name: str, taken: object) -> int:
        raise StoreError("no database")

    people, ada, grace = People(broken), Window("Ada"), Window("Grace")
    for each in (ada, grace):
        people.come(1, 1, each, asyncio.run(people.colour(1, each.user.name)))
    assert [each.colour for each in grace.told[-1].people] == [0, 1]
