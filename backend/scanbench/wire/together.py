"""What people at one project are told of each other."""

from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.public import Public


@dataclass(frozen=True, slots=True)
class DraftEdited(Public):
    """Somebody edited a file that this subscriber has open: Yjs changes in base64."""

    PUBLIC: ClassVar = "DraftEdited"

    path: str
    draft: str
    update: str
    type: Literal["draft_edited"] = "draft_edited"


@dataclass(frozen=True, slots=True)
class Person(Public):
    """Somebody at a browser, and where they are in the project. Two windows of somebody are two of them."""

    PUBLIC: ClassVar = "Person"

    id: int
    name: str
    initials: str
    colour: int
    """From 0 to 7: the same in every browser, and of different people different ones while there are enough."""
    instance: int
    file: str | None = None
    line: int | None = None
    anchor: str | None = None
    """Where their selection begins and where its caret is: places of the draft (Yjs), which stay where they are when others type."""
    head: str | None = None


@dataclass(frozen=True, slots=True)
class PeopleChanged(Public):
    """All who are at the project, whenever somebody comes, moves or goes. `you` is the one who is told."""

    PUBLIC: ClassVar = "People"

    you: int
    people: tuple[Person, ...]
    type: Literal["people"] = "people"
