"""Two sweeps side by side: of two versions of a program, or on two models."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Literal

from scanbench.faults.reaction.reaction import (
    UNGRADED,
    OutputRestart,
    Reaction,
    RequiredResult,
    Verdict,
    ungraded,
    went_on,
)

Change = Literal["same", "better", "worse", "fewer", "slower", "faster", "new", "gone"]
"""worse: what is required, the grade, or an output differs no longer. fewer: only some other variable does not."""
_RANKS: dict[Verdict | None, int] = {
    "never_read": 0, None: 0, "not_reached": 1, "no_effect": 2, "stored_only": 3, "stored": 3, "displayed": 4, "decided": 5,
    "reacted": 6, "acted": 6, "stopped": 6,
}  # fmt: skip
"""No verdict, and a PLC that stopped, are neither better nor worse than the end of the scale."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """One cell of a sweep. Without a verdict it could not be tried."""

    error: str
    state: str
    verdict: Verdict | None
    scans: int | None
    """Until the first effect, from 1."""
    outputs: frozenset[str] | None = None
    """The outputs that differed; None where that is not known."""
    others: frozenset[str] | None = None
    """The other variables that differed; None where not all are known."""
    required: Mapping[str, bool] = field(default_factory=dict)
    """By what was required and looked at: whether it is so."""


def judged(
    required: Iterable[RequiredResult], restarts: Iterable[OutputRestart], recovery: int, outputs: Iterable[str]
) -> dict[str, bool]:
    """What `Outcome.required` holds. After a recovery each output that the error changed is looked at, too."""
    found = {each.text: not each.is_finding for each in required if each.outcome != "not_checked" or each.is_finding}
    on = {each.path: bool(each.allowed_by) for each in restarts}
    return found | {went_on(path): on.get(path, True) for path in ({*outputs, *on} if recovery else on)}


def outcome(error: str, state: str, reaction: Reaction) -> Outcome:
    """Of a reaction with all that is known of it."""
    outputs = frozenset(each.path for each in reaction.differences if each.output)
    others = frozenset(each.path for each in reaction.differences if not each.output)
    whole = reaction.difference_count <= len(reaction.differences)
    return Outcome(
        error, state, reaction.verdict, reaction.first_effect, outputs if whole else None, others if whole else None,
        judged(reaction.required, reaction.restarts, reaction.recovery, outputs),
    )  # fmt: skip


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
    lost: tuple[str, ...] = ()
    """What differed because of the error in the earlier sweep, and does not in the later one; outputs first."""
    unmet: tuple[str, ...] = ()
    """What is required and was so in the earlier sweep, and is not in the later one."""


def compare(before: Iterable[Outcome], after: Iterable[Outcome]) -> tuple[SweepChange, ...]:
    """Every cell that one of them has, in the order of the later one, then what is gone."""
    old = {(cell.error, cell.state): cell for cell in before}
    new = {(cell.error, cell.state): cell for cell in after}
    return tuple(_change(pair, old.get(pair), new.get(pair)) for pair in {**new, **old})


def _change(pair: tuple[str, str], old: Outcome | None, new: Outcome | None) -> SweepChange:
    outputs, others = _lost(old, new)
    unmet = _turned(old, new, False)
    return SweepChange(
        *pair,
        None if old is None else old.verdict, None if new is None else new.verdict,
        None if old is None else old.scans, None if new is None else new.scans,
        "worse" if unmet else _kind(old, new, bool(outputs), bool(others)), (*outputs, *others), unmet,
    )  # fmt: skip


def _lost(old: Outcome | None, new: Outcome | None) -> tuple[list[str], list[str]]:
    """Outputs and others that only the earlier one has."""
    if old is None or new is None or old.outputs is None or new.outputs is None:
        return [], []
    now = new.outputs | (new.others or frozenset())
    return sorted(old.outputs - now), sorted((old.others or frozenset()) - now)


def _turned(old: Outcome | None, new: Outcome | None, to: bool) -> tuple[str, ...]:
    """What was looked at in both, and became so, or is so no longer. What only one of them looked at says nothing."""
    if old is None or new is None:
        return ()
    return tuple(text for text, now in new.required.items() if now is to and old.required.get(text) is (not to))


def _kind(old: Outcome | None, new: Outcome | None, outputs: bool, others: bool) -> Change:
    if old is None:
        return "new"
    if new is None:
        return "gone"
    was, now = _alike(old.verdict, new.verdict)
    if was != now and _RANKS[was] != _RANKS[now]:
        return "better" if _RANKS[now] > _RANKS[was] else "worse"
    if outputs:
        return "worse"
    if _turned(old, new, True):
        return "better"
    if others:
        return "fewer"
    if was != now or old.scans is None or new.scans is None or old.scans == new.scans:
        return "same"
    return "slower" if new.scans > old.scans else "faster"


def _alike(old: Verdict | None, new: Verdict | None) -> tuple[Verdict | None, Verdict | None]:
    """Both as they were called before there were grades, if one of them was made then."""
    if old not in UNGRADED and new not in UNGRADED:
        return old, new
    return None if old is None else ungraded(old), None if new is None else ungraded(new)
