"""When a checkpoint is due, so that no scan is further than a moment of re-running from one."""

from scanbench.recording.recording import Recording
from scanbench.recording.replay import BETWEEN
from scanbench.runtime.resource import Measured, Resource

EVERY_NS = 60_000_000
"""Of time spent inside scans: going to any scan costs no more than that, whatever the program costs."""
ENTRIES = 2_000
"""Entries have to be entered again too."""
_FIRST = 1_000
"""Scans, when nothing was measured yet."""
_SHARE = 64
"""A checkpoint is taken at least every 1/64 of the file's limit, so that the file can always be cut at a checkpoint."""


class Checkpoints:
    """Takes the checkpoints of one run."""

    def __init__(self, recording: Recording) -> None:
        self._recording = recording
        self._measured: Measured | None = None
        self._busy_ns = self._scans = 0

    def take(self, resource: Resource) -> bool:
        """One more, now; false when it cannot be written, or a scan is halted. The next is tried when it would be due anyway."""
        if resource.begun:
            return False
        self._measured = resource.measured
        self._busy_ns, self._scans = resource.measured.busy_ns, resource.measured.scans
        return self._recording.checkpoint(resource.header.scan, resource.version, resource.state)

    def take_due(self, resource: Resource) -> None:
        """One more if it is time."""
        busy_ns, scans = self._since(resource)
        recording = self._recording
        if (
            busy_ns >= EVERY_NS
            or scans >= BETWEEN
            or recording.entries_since >= ENTRIES
            or (recording.entries_since and recording.grown > recording.bounds.limit // _SHARE)
        ):
            self.take(resource)

    def slice(self, resource: Resource) -> int:
        """Scans until the next one is due, as far as the last ones tell what they cost."""
        busy_ns, scans = self._since(resource)
        left = BETWEEN - scans
        if not scans:
            left_ns, busy_ns, scans = EVERY_NS, resource.measured.busy_ns, resource.measured.scans
        else:
            left_ns = EVERY_NS - busy_ns
        if not scans:
            return _FIRST
        return max(1, min(left, left_ns * scans // max(1, busy_ns)))

    def _since(self, resource: Resource) -> tuple[int, int]:
        """Time in scans and scans since the last checkpoint."""
        measured = resource.measured
        if measured is not self._measured:  # a new program: measurement starts from 0
            return measured.busy_ns, measured.scans
        return measured.busy_ns - self._busy_ns, measured.scans - self._scans
