"""Who is at a project, and where."""

from scanbench.server.people import COLOURS, People
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
    people, ada, grace, other = People(), Window("Ada Lovelace"), Window("Grace"), Window("Jo")
    people.come(2, 9, other)
    first, second = people.come(1, 3, ada), people.come(1, 4, grace)
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


def test_different_people_have_different_colours_two_windows_of_one_the_same() -> None:
    people, last = People(), Window("Jo")
    for name in ("Ada", "Grace", "Ada", *map(str, range(COLOURS))):
        people.come(1, 1, Window(name))
    people.come(1, 1, last)
    colours = [each.colour for each in last.told[-1].people]
    assert colours[:4] == [0, 1, 0, 2]
    assert set(colours) == set(range(COLOURS))
