"""Breakpoints at errors: what was entered since somebody last looked, and whose errors are wanted."""

from collections.abc import Callable

from scanbench.debug.breakpoints import Breakpoints
from scanbench.debug.halt import Found
from scanbench.debug.placed import error_names
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry


class RaisedErrors:
    """Looks through new entries of the journal."""

    def __init__(
        self, timeline: Timeline, breakpoints: Breakpoints, raised: Callable[[Entry], tuple[str, ...]]
    ) -> None:
        """`raised` names the errors that an entry raises."""
        self._timeline, self._breakpoints, self._raised = timeline, breakpoints, raised
        self._last: Entry | None = None
        self.counted = False
        """Whether the last look counted a hit."""
        self._new()

    def look(self) -> Found | None:
        """The last breakpoint at an error that was raised since; each counts its hits."""
        new, self.counted = self._new(), False
        kinds = [each for each in self._breakpoints.placed if each.active and each.breakpoint.kind == "error"]
        found: Found | None = None
        for error in (error for entry in new for error in self._raised(entry)) if kinds else ():
            for placed in kinds:
                names = error_names(placed.breakpoint)
                if names and error not in names:
                    continue
                placed.hits += 1
                self.counted = True
                if placed.rule is None or placed.rule.holds(placed.hits):
                    found = Found("error", f"{error} was raised", placed.breakpoint.author, (placed.breakpoint.id,))
        return found

    def _new(self) -> list[Entry]:
        """Entries of the journal since the last time."""
        journal, last = self._timeline.live_journal, self._last
        index = len(journal)
        while index and journal[index - 1] is not last:
            index -= 1
        self._last = journal[-1] if journal else None
        return journal[index:] if index or last is None else []
