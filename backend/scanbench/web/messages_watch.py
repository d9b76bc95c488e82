"""Wire shapes of watch lists. See `messages.py`."""

from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from scanbench.web.messages_base import Version, Wire

MOST_ENTRIES = 20_000
Format = Literal[
    "default", "decimal", "signed", "unsigned", "hex", "binary", "bcd", "float", "time", "ascii"
]  # fmt: skip
ListName = Annotated[str, Field(min_length=1, max_length=100)]
GroupName = Annotated[str, Field(max_length=100)]


class WatchEntry(Wire):
    """A line of a watch list."""

    path: Annotated[str, StringConstraints(strip_whitespace=True)] = Field(
        min_length=1, max_length=500, description="instance path, address, or range of addresses (W10:8)"
    )
    group: GroupName = Field(default="", description="one of the list's groups; empty: above them all")
    format: Format = "default"


class NewWatchList(Wire):
    name: ListName
    shared: bool = Field(description="with everybody at the project; else it is the user's own")
    groups: list[GroupName] = Field(default_factory=list, max_length=1000)
    entries: list[WatchEntry] = Field(default_factory=list, max_length=MOST_ENTRIES)


class SaveWatchList(NewWatchList):
    """Optimistic save: `version` is the one the edit began from. A shared list stays shared."""

    version: Version


class WatchListInfo(Wire):
    id: int
    name: str
    shared: bool
    version: int
    author: str = Field(description="who saved this version")
    count: int


class WatchList(WatchListInfo):
    groups: list[str]
    entries: list[WatchEntry]


class WatchListConflict(Wire):
    """Somebody else saved first (status 409): nothing was written; here is theirs."""

    message: str
    theirs: WatchList


class WatchListChanged(Wire):
    """Somebody saved or deleted a watch list that this browser may see."""

    type: Literal["watch_list"] = "watch_list"
    id: int
    version: int = Field(description="0: it is deleted")
    author: str
