"""Stretches of a run of which its file lost what was entered: nobody can go there, and the run is taken up again after them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from scanbench.public import Public
from scanbench.recording.format import RunFileError


@dataclass(frozen=True, slots=True)
class LostScans(Public):
    """Scans that a damaged run file lost; none where only commands between two scans are lost."""

    PUBLIC: ClassVar = "LostScans"

    first: int
    until: int
    """The first scan after them that can be gone to again."""


@dataclass(frozen=True, slots=True)
class Gap:
    """The scans from `first` on, up to the one before `until`. Where both are the same only entries are lost."""

    first: int
    until: int
    """The scan of the checkpoint after it."""
    entries: int
    """So many of the entries that are left lead to that checkpoint."""
    version: int
    """The program that runs there."""

    @property
    def at(self) -> tuple[int, int]:
        """Where in the run the checkpoint after it is."""
        return self.until, self.entries

    @property
    def last(self) -> int:
        """The last scan whose beginning is known without doubt: where only entries are lost, it looks the same before and after."""
        return self.first if self.first < self.until else self.first - 1

    @property
    def public(self) -> LostScans:
        """For people."""
        return LostScans(self.first, self.until)

    @property
    def lost(self) -> str:
        """What is lost, without a full stop."""
        if self.first == self.until:
            return f"Commands that were entered before scan {self.first} are lost"
        if self.until == self.first + 1:
            return f"Scan {self.first} is lost"
        return f"Scans {self.first} to {self.until - 1} are lost"

    def __str__(self) -> str:
        return f"the run file is damaged. {self.lost}; it can be read again from scan {self.until} on"


class Lost(RunFileError):
    """A replay would have to go through a gap."""


def gap_of(gaps: Sequence[Gap], scan: int) -> Gap | None:
    """The gap in which a scan is."""
    return next((each for each in gaps if each.first <= scan < each.until), None)


def gap_between(gaps: Sequence[Gap], now: int, scan: int) -> Gap | None:
    """The first gap through which one would have to go from the seam before scan `now` to the one before `scan`."""
    for each in gaps:
        if (now <= each.last < scan and now < each.first) or each.first <= now < min(each.until, scan):
            return each
    return None


def gap_before(gaps: Sequence[Gap], scan: int) -> Gap | None:
    """The last gap that is over where a scan begins."""
    return next((each for each in reversed(gaps) if each.until <= scan), None)
