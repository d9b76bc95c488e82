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
    """Of each client a line now and then; all of its writes are in the run."""

    def __init__(self) -> None:
        self._told: dict[str, int] = {}
        """When a line about this client was told last."""
        self._since: dict[str, int] = {}
        """Writes since then that nobody was told of."""

    def text(self, entry: Entry) -> str | None:
        """What the log says of an entry; None: nothing now."""
        if not isinstance(entry.command, WriteAreas | WriteVariables | CopyAreas | NetworkRequest | NetworkAnswer):
            return entry.plan.message
        if isinstance(entry.command, NetworkAnswer) and entry.command.end:
            return entry.plan.message
        author, now = entry.command.author, monotonic_ns()
        if now - self._told.get(author, -_EVERY_NS) < _EVERY_NS:
            self._since[author] = self._since.get(author, 0) + 1
            return None
        if len(self._told) >= _AUTHORS_KEPT:
            self._told.clear()
        self._told[author] = now
        more = self._since.pop(author, 0)
        if not more:
            return entry.plan.message
        if isinstance(entry.command, NetworkRequest | NetworkAnswer):
            return f"{entry.plan.message} ({more} more exchanges before)"
        return f"{entry.plan.message} ({more} more writes before)"
