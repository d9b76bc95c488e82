"""The contract of who keeps the entries of a run, ahead of the change."""

from typing import Protocol

from scanbench.runtime.command import Entry


class Recorder(Protocol):
    """A command counts as done when its entry is in here."""

    def entry(self, entry: Entry, must: bool) -> None:
        """Keeps it; OSError when it cannot, and then nothing is changed.

        `must`: what the PLC did itself (a trap, an error it found) has happened in any case. This never raises: what
        cannot be written now is written later, before anything else.
        """

    def why_lost(self, now: int, scan: int) -> str:
        """Why a replay cannot go from one scan to another: what was entered there is lost. Empty where it can."""
