"""Values that come some scans earlier or later than the reference has them, where somebody allows that."""

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Sequence

from scanbench.verify.trace.bind import Trace


class Lateness:
    """What the reference had in the scans before. Of outputs with a tolerance of time only."""

    def __init__(self, trace: Trace) -> None:
        self._trace = trace
        self._timed = [at for at, each in enumerate(trace.outputs) if each.tolerance.scans]
        self._scans: dict[int, list[int]] = {at: [] for at in self._timed}
        self._values: dict[int, list[bytes]] = {at: [] for at in self._timed}
        """Of each output when it changed, and to what."""
        self._until = -1

    def note(self, scan: int, values: Sequence[bytes]) -> None:
        """What the outputs are after a scan. One that is run again has the same."""
        if scan <= self._until:
            return
        self._until = scan
        for at in self._timed:
            if not self._values[at] or self._values[at][-1] != values[at]:
                self._scans[at].append(scan)
                self._values[at].append(values[at])

    def allows(self, at: int, was: bytes, now: bytes, scan: int, ahead: Callable[[], Sequence[bytes]]) -> bool:
        """Whether the reference's value is recorded within so many scans, and the recorded one is the reference's within so
        many. `ahead`: what the reference has in the scans to come."""
        signal = self._trace.outputs[at]
        rows, scans = self._trace.scans.of_rows, signal.tolerance.scans
        near = signal.values[bisect_left(rows, scan - scans) : bisect_right(rows, scan + scans)]
        same = signal.exactness.same
        if not any(value is not None and same(signal.type, value, now) for value in near):
            return False
        return any(same(signal.type, was, each) for each in self._before(at, scan - scans, scan)) or any(
            same(signal.type, was, each) for each in ahead()
        )

    def _before(self, at: int, first: int, scan: int) -> Sequence[bytes]:
        changed = self._scans[at]
        return self._values[at][max(0, bisect_right(changed, first) - 1) : bisect_left(changed, scan)]
