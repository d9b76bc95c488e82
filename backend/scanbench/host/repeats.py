"""What machines enter again and again - clients that write, PLCs that exchange, a program that raises the same error each scan - as a few
lines for people: all of it is in the run."""

from dataclasses import dataclass
from typing import Literal

from scanbench.faults.inject import Generate, Recover
from scanbench.faults.network import NetworkAnswer, NetworkRequest
from scanbench.runtime.command import Entry
from scanbench.runtime.copy_areas import CopyAreas
from scanbench.runtime.write_areas import WriteAreas
from scanbench.runtime.write_variables import WriteVariables

WINDOW_NS = 5_000_000_000
_KEPT = 1024
"""Sources that are remembered."""
_BURST = 5
"""Times in a window that get a line each: an error that is raised, recovered and raised again is told as it happens."""


@dataclass(frozen=True, slots=True)
class _Source:
    """What repeats itself."""

    author: str
    kind: Literal["write", "exchange", "time"]
    what: object = None
    burst: int = 1
    """Lines in a window before the rest is summed up."""


@dataclass(slots=True)
class _Told:
    """What was told of a source."""

    since: int
    """When its window began, ns."""
    lines: int = 0
    last: Entry | None = None
    """The last entry that nobody was told of yet."""
    more: int = 0
    """How many others before that one nobody was told of."""


class Repeats:
    """Of each source some lines now and then, and one about the last time; in the order in which things happened.

    `now` is of any clock, ns: the same one in all calls."""

    def __init__(self) -> None:
        self._told: dict[_Source, _Told] = {}
        """The last ones have the newest entries."""

    def text(self, entry: Entry, now: int) -> str | None:
        """What is said of an entry; None: nothing now. What `held` gives is said before."""
        source = _source_of(entry)
        if source is None:
            return entry.plan.message
        told = self._told.pop(source, None) or _Told(now)
        if len(self._told) >= _KEPT and not any(each.last for each in self._told.values()):
            self._told.clear()
        self._told[source] = told
        if now - told.since >= WINDOW_NS:
            told.since, told.lines = now, source.burst - 1 if told.last is not None else 0
        if told.lines >= source.burst:
            told.more += told.last is not None
            told.last = entry
            return None
        told.lines += 1
        more = told.more + (told.last is not None)
        told.last, told.more = None, 0
        return _said(entry, source, more)

    def due(self, now: int) -> list[tuple[Entry, str]]:
        """As soon as the window of one of them is over: all entries that nobody was told of, and what is said of them."""
        over = (each.last is not None and now - each.since >= WINDOW_NS for each in self._told.values())
        return self.held(now) if any(over) else []

    def held(self, now: int) -> list[tuple[Entry, str]]:
        """All entries that nobody was told of, and what is said of them: something later is to be told."""
        found = []
        for source, told in self._told.items():
            if told.last is not None:
                found.append((told.last, _said(told.last, source, told.more)))
                told.last, told.more, told.since, told.lines = None, 0, now, source.burst
        return found


def _source_of(entry: Entry) -> _Source | None:
    command = entry.command
    match command:
        case WriteAreas() | WriteVariables() | CopyAreas():
            return _Source(command.author, "write")
        case NetworkAnswer() if command.end:
            return _Source(command.author, "exchange", (command.port, command.end), _BURST)
        case NetworkRequest() | NetworkAnswer():
            return _Source(command.author, "exchange")
        case Generate() if command.origin != "simulator":
            return _Source(command.author, "time", command.errors, _BURST)
        case Recover() if command.way != "simulator":
            return _Source(command.author, "time", (command.ids, command.numbers), _BURST)
    return None


def _said(entry: Entry, source: _Source, more: int) -> str:
    message = entry.plan.message
    if not more:
        return message
    many = "s" * (more != 1)
    match source.kind:
        case "write":
            return f"{message} ({more} more write{many} before)"
        case "exchange":
            return f"{message} ({more} more exchange{many} before)"
        case _:
            return f"{message} ({more} more time{many} before)"
