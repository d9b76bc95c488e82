"""Which checkpoints go when a run file is over its limit: the older, the fewer are left."""

from collections.abc import Sequence, Set
from dataclasses import dataclass

from scanbench.recording.format import Block

FLOOR = 64
"""So many checkpoints are always left to be gone back to quickly: rather than thin them the oldest part is dropped."""
FRESH = 8
"""The latest are never thinned."""


@dataclass(frozen=True, slots=True)
class Checkpoint:
    """The state before `scan`, after the first `entries` entries of the file."""

    scan: int
    entries: int
    version: int
    block: Block
    base: Block
    """The keyframe that a delta refers to; of a keyframe, itself."""

    @property
    def at(self) -> tuple[int, int]:
        """Where in the run."""
        return self.scan, self.entries

    @property
    def whole(self) -> bool:
        """Whether it is a keyframe."""
        return self.block.offset == self.base.offset


@dataclass(frozen=True, slots=True)
class Thinning:
    """What has to go: checkpoints one by one, and everything before `cut`."""

    dropped: frozenset[int]
    """Offsets of checkpoints."""
    thinned_before: int
    cut: Checkpoint | None


def plan_thinning(
    checkpoints: Sequence[Checkpoint], excess: int, excess_entries: int, needed: Set[int] = frozenset()
) -> Thinning:  # fmt: skip
    """Frees `excess` bytes: every other checkpoint of the older half, again and again; then the oldest part.

    Checkpoints at the offsets `needed` stay: those on both sides of what was lost. `excess_entries` of the entries must go as well, which only dropping can do.
    """
    left = list(checkpoints)
    dropped: set[int] = set()
    freed, thinned_before = 0, 0
    while freed < excess and len(left) > FLOOR:
        gone = _thin_once(left, len(left) - FLOOR, needed)
        if not gone:
            break
        for each in gone:
            freed += each.block.size
            dropped.add(each.block.offset)
            thinned_before = max(thinned_before, each.scan)
        left = [each for each in left if each.block.offset not in dropped]
    cut = None
    if freed < excess or excess_entries > 0:
        cut = _place_of_cut(checkpoints, dropped, excess - freed, excess_entries)
    if cut is not None:
        dropped.discard(cut.block.offset)
    return Thinning(frozenset(dropped), thinned_before, cut)


def _thin_once(left: Sequence[Checkpoint], most: int, wanted: Set[int]) -> list[Checkpoint]:
    """Every other one of the older half. The first stays, and so does a keyframe that something refers to."""
    older = left[: max(0, min(len(left) // 2, len(left) - FRESH))]
    needed = {each.base.offset for each in left if not each.whole} | {left[-1].base.offset} | wanted
    gone: list[Checkpoint] = []
    previous_stays = True
    for each in older[1:]:
        stays = not previous_stays or each.block.offset in needed or len(gone) == most
        if not stays:
            gone.append(each)
        previous_stays = stays
    return gone


def _place_of_cut(
    checkpoints: Sequence[Checkpoint], dropped: Set[int], excess: int, excess_entries: int
) -> Checkpoint | None:
    """The first keyframe with enough before it besides what is dropped anyway; else the last one, unless it is the first."""
    begin, thinned = checkpoints[0], 0
    last = None
    for each in checkpoints:
        if each.whole and each is not begin:
            last = each
            before = each.block.offset - begin.block.offset - thinned
            if before >= excess and each.entries - begin.entries >= excess_entries:
                return each
        if each.block.offset in dropped:
            thinned += each.block.size
    return last
