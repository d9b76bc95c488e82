"""The pace of a run, and where it was asked to stop."""

from collections import deque

from scanbench.check.typed.condition import Condition
from scanbench.engines.engine import Pace
from scanbench.runtime.clock import monotonic_ns

MAX_SPEED = 0.0
_FOREVER = 1 << 40
_WINDOW_NS = 5_000_000_000


class Pacer:
    """Speed, pause, single scans, and a target. Known to the loop's thread alone."""

    def __init__(self, interval_ns: int, speed: float, paused: bool, cpu_percent: int | None) -> None:
        self.speed, self.paused, self.cpu_percent = speed, paused, cpu_percent
        self.reached = ""
        """Why the run stopped by itself, for people; until it goes on."""
        self._interval_ns = interval_ns
        self._left: int | None = None
        self._end = 0
        self.condition: Condition | None = None
        self.pace = Pace(0, 0)
        self._seen: deque[tuple[int, int, int]] = deque()
        self._rest_until = 0
        self.set_pace(interval_ns)

    # ---- what people want -----------------------------------------------------------------------------------------

    def set_pace(self, interval_ns: int) -> None:
        """Real time times `speed`, from now on."""
        self._interval_ns = interval_ns
        period = 0 if self.speed == MAX_SPEED else max(1, round(interval_ns / self.speed))
        self.pace = Pace(period, monotonic_ns())
        self._seen.clear()

    def run_on(self, now: int, scans: int | None, condition: Condition | None) -> None:
        """Goes on from scan `now`: for ever, for so many scans, until the condition holds."""
        self.paused, self.reached = False, ""
        self._left, self._end, self.condition = scans, now + (scans or 0), condition
        self.set_pace(self._interval_ns)

    def go(self) -> None:
        """Goes on to where it was to go, at its pace from now."""
        self.paused, self.reached = False, ""
        self.set_pace(self._interval_ns)

    def pause(self) -> None:
        """Stops after the scan that runs."""
        self.paused = True
        self._left = self.condition = None

    @property
    def end(self) -> int | None:
        """Before which scan the run ends; None when it was not asked to."""
        return self._end if self._left is not None else None

    def lose(self, why: str) -> None:
        """What the run was to end with has no meaning any more: it pauses, and says so."""
        self.pause()
        self.reached = why

    @property
    def target(self) -> str:
        """Where the run ends, for people; empty when it does not."""
        parts = [f"scan {self._end}"] if self._left is not None else []
        parts += [f"until {self.condition.text}"] if self.condition is not None else []
        return ", ".join(parts)

    # ---- what the loop asks ---------------------------------------------------------------------------------------

    @property
    def scans(self) -> int:
        """How many scans may run now."""
        return _FOREVER if self._left is None else self._left

    def ran(self, scans: int, held: bool, now: int) -> None:
        """So many scans were run, to scan `now`; `held`: the condition holds."""
        if self._left is not None:
            self._left -= scans
        if held and self.condition is not None:
            self.reached = f"stopped at scan {now}: {self.condition.text}"
        elif self._left is not None and self._left <= 0:
            self.reached = f"stopped at scan {now}, as asked for"
        else:
            return
        self.pause()

    def worked(self, busy_ns: int) -> None:
        """After so much work a run as fast as possible has to rest, to keep to the limit of the CPU."""
        if self.cpu_percent is not None and self.speed == MAX_SPEED:
            self._rest_until = monotonic_ns() + busy_ns * (100 - self.cpu_percent) // self.cpu_percent

    @property
    def rest_s(self) -> float:
        """How long it has to rest yet, whoever interrupts meanwhile."""
        return max(0.0, (self._rest_until - monotonic_ns()) / 1e9)

    def look(self) -> None:
        """Notes how the pace was kept until now."""
        now = monotonic_ns()
        self._seen.append((now, self.pace.scans, self.pace.late_scans))
        while len(self._seen) > 2 and self._seen[1][0] < now - _WINDOW_NS:
            self._seen.popleft()

    @property
    def late_percent(self) -> float:
        """The share of the last seconds' scans that began after the next one was due."""
        if not self._seen:
            return 0.0
        _, scans, late = self._seen[0]
        ran = self.pace.scans - scans
        return 100 * (self.pace.late_scans - late) / ran if ran else 0.0
