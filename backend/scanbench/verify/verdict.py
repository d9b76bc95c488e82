"""What a verification came to: one answer, which the command, REST, the client, the page and the reports give alike."""

from collections.abc import Sequence
from typing import Literal, Protocol

from scanbench.verify.contract import VerifyCoverage

Verdict = Literal["differs", "same", "same in what was compared", "nothing compared"]


class Counted(Protocol):
    """What was counted while it went on."""

    @property
    def first(self) -> int:
        """The first scan."""

    @property
    def compared(self) -> int:
        """Scans of which anything was compared."""

    @property
    def skipped(self) -> int:
        """Scans of which nothing was."""

    @property
    def stretches(self) -> Sequence[tuple[int, int]]:
        """The skipped ones, both ends included; perhaps only the last of them."""

    @property
    def full(self) -> int:
        """Skipped scans in which uses of variables found no room in the record."""

    @property
    def sampled(self) -> bool:
        """Of a log or a controller of which only some scans are known, so that those in between were not asked for."""

    @property
    def differing(self) -> int:
        """Rows that differ."""

    @property
    def trace(self) -> str:
        """Name of the log; empty where there is none."""

    @property
    def coverage(self) -> VerifyCoverage | None:
        """Of a log: what was compared."""

    @property
    def not_reached(self) -> int:
        """Scans that were asked for and did not run."""

    @property
    def unfinished(self) -> bool:
        """Whether something of what was asked for is still to come, or never will."""


def partly(of: Counted) -> bool:
    """Whether something of what was asked was not compared, or the verdict depends on values that nobody recorded. The first scan of a
    controller log is taken over in any case."""
    coverage = of.coverage
    unvalued = coverage is not None and (bool(coverage.ungiven) or any(each.missing for each in coverage.outputs))
    return unvalued or skipped(of)


def taken_over(of: Counted) -> bool:
    """Whether the first scan is not compared, as the reference begins with it."""
    return bool(of.trace and of.stretches and of.stretches[0][0] == of.first)


def skipped(of: Counted) -> bool:
    """Whether a scan of what was asked was not compared, but for one that was taken over."""
    left = of.full if of.sampled else of.skipped - taken_over(of)
    return left > 0 or of.not_reached > 0 or of.unfinished


def verdict(of: Counted, idle: bool) -> Verdict:
    """`idle`: the range did not run in any of the scans, so that nothing of it was compared."""
    if of.differing:
        return "differs"
    if idle or not of.compared:
        return "nothing compared"
    return "same in what was compared" if partly(of) else "same"
