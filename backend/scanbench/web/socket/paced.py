"""What may change in each scan, for somebody who reads: the newest of it, no more often than a page can be drawn."""

from dataclasses import replace

from scanbench.runtime.clock import monotonic_ns
from scanbench.wire.events import ErrorsChanged, StateChanged

EVERY_NS = 50_000_000


class Paced:
    """The newest state and the newest rows of errors that were not sent yet."""

    def __init__(self) -> None:
        self._state: StateChanged | None = None
        self._errors: ErrorsChanged | None = None
        self._due = 0

    def state(self, event: StateChanged) -> None:
        """Replaces the one before."""
        self._state = event

    def errors(self, event: ErrorsChanged) -> None:
        """Rows that replace those of the same errors, or all."""
        if self._errors is None or event.whole:
            self._errors = event
            return
        rows = {row.key: row for row in self._errors.rows}
        rows.update((row.key, row) for row in event.rows)
        self._errors = replace(self._errors, rows=tuple(rows.values()))

    def take_errors(self) -> ErrorsChanged | None:
        """The rows, whether it is time or not: an answer is to come after them."""
        taken, self._errors = self._errors, None
        return taken

    def take_state(self) -> StateChanged | None:
        """The state; from now on it takes a while until anything is due."""
        self._due = monotonic_ns() + EVERY_NS
        taken, self._state = self._state, None
        return taken

    def wait_s(self) -> float | None:
        """In how many seconds something is due; 0: now; None: there is nothing."""
        if self._state is None and self._errors is None:
            return None
        return max(0, self._due - monotonic_ns()) / 1e9
