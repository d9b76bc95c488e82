"""Two sweeps side by side: of two versions of a program, or on two models."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from scanbench.faults.reaction.reaction import Verdict, ungraded

Change = Literal["same", "better", "worse", "slower", "faster", "new", "gone"]
_RANKS: dict[Verdict | None, int] = {
    "never_read": 0, None: 0, "not_reached": 1, "no_effect": 2, "stored_only": 3, "stored": 3, "displayed": 4, "decided": 5,
    "reacted": 6, "acted": 6, "stopped": 6,
}  # fmt: skip
"""No verdict, and a PLC that stopped, are neither better nor worse than the end of the scale."""
_BEFORE_GRADES = ("reacted", "stored_only")


@dataclass(frozen=True, slots=True)
class Outcome:
    """One cell of a sweep. Without a verdict it could not be tried."""

    error: str
    state: str
    verdict: Verdict | None
    scans: int | None
    """Until the first effect, from 1."""


@dataclass(frozen=True, slots=True)
class SweepChange:
    """One cell in both; None where a sweep has none, or no verdict."""

    error: str
    state: str
    before: Verdict | None
    after: Verdict | None
    scans_before: int | None
    scans_after: int | None
    change: Change


def compare(before: Iterable[Outcome], after: Iterable[Outcome]) -> tuple[SweepChange, ...]:
    """Every cell that one of them has, in the order of the later one, then what is gone."""
    old = {(cell.error, cell.state): cell for cell in before}
    new = {(cell.error, cell.state): cell for cell in after}
    return tuple(_change(pair, old.get(pair), new.get(pair)) for pair in {**new, **old})


def _change(pair: tuple[str, str], old: Outcome | None, new: Outcome | None) -> SweepChange:
    return SweepChange(
        *pair,
        None if old is None else old.verdict, None if new is None else new.verdict,
        None if old is None else old.scans, None if new is None else new.scans,
        _kind(old, new),
    )  # fmt: skip


def _kind(old: Outcome | None, new: Outcome | None) -> Change:
    if old is None:
        return "new"
    if new is None:
        return "gone"
    was, now = _alike(old.verdict, new.verdict)
    if was != now:
        gained = _RANKS[now] - _RANKS[was]
        return "same" if gained == 0 else "better" if gained > 0 else "worse"
    if old.scans is None or new.scans is None or old.scans == new.scans:
        return "same"
    return "slower" if new.scans > old.scans else "faster"


def _alike(old: Verdict | None, new: Verdict | None) -> tuple[Verdict | None, Verdict | None]:
    """Both as they were called before there were grades, if one of them was made then."""
    if old not in _BEFORE_GRADES and new not in _BEFORE_GRADES:
        return old, new
    return None if old is None else ungraded(old), None if new is None else ungraded(new)
