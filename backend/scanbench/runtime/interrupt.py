"""Somebody wants a run to end before its time; it ends after the scan that is running, with what it has so far."""

from collections.abc import Callable


class Interrupt:
    """Asked once, from any thread or from a signal's handler."""

    def __init__(self) -> None:
        self.asked = False
        self._interrupt: Callable[[], None] | None = None

    def ask(self) -> None:
        """Ends the run soon."""
        self.asked = True
        if self._interrupt is not None:
            self._interrupt()

    def reaches(self, interrupt: Callable[[], None]) -> None:
        """What makes the engine come back that runs now."""
        self._interrupt = interrupt
