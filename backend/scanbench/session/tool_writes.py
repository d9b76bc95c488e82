"""Lines of the log about what protocol clients write, and what PLCs exchange: no more than somebody can read."""

from scanbench.faults.network import NetworkAnswer, NetworkRequest
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Entry
from scanbench.runtime.copy_areas import CopyAreas
from scanbench.runtime.write_areas import WriteAreas
from scanbench.runtime.write_variables import WriteVariables

_EVERY_NS = 5_000_000_000
_AUTHORS_KEPT = 256


class ToolWrites:
    """Of each client a line now and then, and one about the last of what it wrote; all of its writes are in the run."""

    def __init__(self) -> None:
        self._told: dict[str, int] = {}
        """When a line about this client was told last."""
        self._untold: dict[str, tuple[Entry, int]] = {}
        """Its last write since then, and how many others before that one nobody was told of."""

    def text(self, entry: Entry) -> str | None:
        """What the log says of an entry; None: nothing now."""
        if not isinstance(entry.command, WriteAreas | WriteVariables | CopyAreas | NetworkRequest | NetworkAnswer):
            return entry.plan.message
        if isinstance(entry.command, NetworkAnswer) and entry.command.end:
            return entry.plan.message
        author, now = entry.command.author, monotonic_ns()
        more = self._more(author)
        if now - self._told.get(author, -_EVERY_NS) < _EVERY_NS:
            self._untold[author] = entry, more
            return None
        return self._tell(entry, more, now)

    def due(self) -> list[tuple[Entry, str]]:
        """The last writes of clients that have written nothing since, and what the log says of them now."""
        if not self._untold:
            return []
        now = monotonic_ns()
        quiet = [author for author in self._untold if now - self._told.get(author, -_EVERY_NS) >= _EVERY_NS]
        found = [self._untold[author] for author in quiet]
        return [(entry, self._tell(entry, more, now)) for entry, more in found]

    def _more(self, author: str) -> int:
        """Writes of this client that nobody was told of yet."""
        untold = self._untold.get(author)
        return 0 if untold is None else untold[1] + 1

    def _tell(self, entry: Entry, more: int, now: int) -> str:
        author = entry.command.author
        if len(self._told) >= _AUTHORS_KEPT:
            self._told.clear()
        self._told[author] = now
        self._untold.pop(author, None)
        if not more:
            return entry.plan.message
        if isinstance(entry.command, NetworkRequest | NetworkAnswer):
            return f"{entry.plan.message} ({more} more exchanges before)"
        return f"{entry.plan.message} ({more} more writes before)"
