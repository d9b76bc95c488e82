"""What somebody wants verified, and how far that is."""

from dataclasses import dataclass
from typing import Literal

from scanbench.verify.contract import DEFAULT_LIMIT, Memory, Mismatch, Range, VerifyCoverage
from scanbench.verify.verdict import Verdict, verdict

VerifyPace = Literal["free", "scan", "step"]
"""How a verification goes on: by itself, scan by scan, statement by statement."""


@dataclass(frozen=True, slots=True)
class VerifyWish:
    """What somebody wants verified."""

    range: Range
    pace: VerifyPace = "free"
    first: int | None = None
    """The first scan of a stretch of the past; None: live."""
    last: int | None = None
    limit: int = DEFAULT_LIMIT


@dataclass(frozen=True, slots=True)
class VerificationStatus:
    """The state of a verification."""

    id: int
    instance: int
    by: str
    wanted: VerifyWish
    source: Literal["live", "past", "trace"]
    pace: VerifyPace
    auto: bool = False
    memory: Memory = "recorded"
    state: Literal["starting", "verifying", "waiting", "stopped", "done", "failed"] = "starting"
    message: str = ""
    title: str = ""
    trace: str = ""
    """Name of the trace's file."""
    instances: tuple[str, ...] = ()
    version: int = 0
    interval_ns: int = 0
    first: int = 0
    last: int | None = None
    scan: int | None = None
    """Verified last."""
    compared: int = 0
    skipped: int = 0
    """Scans of which nothing was compared: left out, not in a trace, or the program stood still."""
    stretches: tuple[tuple[int, int], ...] = ()
    """Those scans, the last ones, both ends included."""
    differing: int = 0
    first_difference: Mismatch | None = None
    first_scan: int | None = None
    rows: int = 0
    forgotten: int = 0
    used: int = 0
    generation: int = 0
    note: str = ""
    """What is not quite as it was asked for."""
    coverage: VerifyCoverage | None = None
    not_run: int = 0
    """Scans of `compared` in which the range did not run: there was nothing of it to compare."""
    full: int = 0
    """Scans of `skipped` in which uses found no room in the record."""
    sampled: bool = False
    """Of a log or a controller, of which only some scans are known."""

    @property
    def unfinished(self) -> bool:
        """Whether something of what was asked for is still to come, or never will. What goes on until somebody stops it is over then."""
        without_end = self.source == "live" or (self.source == "trace" and self.last is None)
        return self.state not in (("done", "stopped") if without_end else ("done",))

    @property
    def verdict(self) -> Verdict:
        """What it came to until now."""
        return verdict(self, self.compared == self.not_run)

    @property
    def not_reached(self) -> int:
        """Scans of the past that were wanted, and did not run until now."""
        wanted = self.wanted.last
        return 0 if self.source != "past" or wanted is None or self.last is None else max(0, wanted - self.last)
