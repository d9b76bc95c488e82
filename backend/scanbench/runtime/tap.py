"""The contract of taps: they read the image in the seam (phase 7), and never write it."""

from typing import Protocol


class Tap(Protocol):
    """A reader of the image."""

    def sample(self, memory: bytearray, scan: int, time_ns: int) -> bytes | None:
        """Looks at the image between two scans; what it has to say, or None."""
