"""Files that are made of a run file, in the recording's own thread: a smaller one, and copies."""

import errno
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, takewhile
from pathlib import Path

from scanbench.recording.alike import Slots
from scanbench.recording.blocks import About, Codec, entry_of, keyframe
from scanbench.recording.format import Block, Kind, RunFile, RunFileError
from scanbench.recording.gaps import Gap
from scanbench.recording.journal_roots import journal_roots
from scanbench.recording.rewriting import Rewritten, rewrite
from scanbench.recording.thinning import Checkpoint, plan_thinning

_CUTS = 16
"""So many places there are at least at which a file that is full can be cut."""
ENTRY_LIMIT = 50_000
"""Entries are in memory too, so that there is a bound of them besides the file's."""


class Bounds:
    """When a run file is too large. After each attempt to make it smaller it may grow by an eighth before the next."""

    def __init__(self, limit: int) -> None:
        self.limit = limit
        self._enough, self._enough_entries = limit, ENTRY_LIMIT

    def set_limit(self, limit: int) -> None:
        """Sets a new bound for the file, in bytes."""
        self.limit = self._enough = limit

    def over(self, bytes: int, entries: int) -> bool:
        """Whether it is time."""
        return bytes > self._enough or entries > self._enough_entries

    def far(self, bytes: int, entries: int) -> bool:
        """Whether so much after a keyframe the next one is due: a file is cut at keyframes, so there have to be enough of them."""
        return bytes > self.limit // _CUTS or entries > ENTRY_LIMIT // _CUTS

    def tried(self, bytes: int, entries: int) -> None:
        """It is as small as it gets now, or could not be made smaller."""
        self._enough = max(self.limit, bytes + self.limit // 8)
        self._enough_entries = max(ENTRY_LIMIT, entries + ENTRY_LIMIT // 8)


@dataclass(frozen=True, slots=True)
class Seen:
    """A run file as it was at one moment."""

    file: RunFile
    end: int
    about: About
    checkpoints: Sequence[Checkpoint]
    entries: int
    gaps: Sequence[Gap] = ()


@dataclass(frozen=True, slots=True)
class Smaller:
    """A smaller file, and what is not in it: of the entries before `cut` only `roots` are left."""

    rewritten: Rewritten
    about: About
    roots: tuple[int, ...]
    cut: int


def make_smaller(seen: Seen, limit: int, codec: Codec) -> Smaller | None:
    """Makes a smaller file; None when it cannot be written."""
    file = seen.file
    excess_entries = seen.entries - ENTRY_LIMIT * 3 // 4 if seen.entries > ENTRY_LIMIT else 0
    ends = {each.at for each in seen.gaps}
    edges = [each for pair in pairwise(seen.checkpoints) if pair[1].at in ends for each in pair]
    needed = frozenset(each.block.offset for each in edges)
    plan = plan_thinning(seen.checkpoints, seen.end - limit * 3 // 4, excess_entries, needed)
    cut, kept = plan.cut, tuple[int, ...]()

    states = _states(seen)
    after = cut is None
    """A disk may have mixed up the blocks: where one lies does not say whether it is before the cut."""

    def keep(block: Block, before: int) -> bool:
        nonlocal after
        after = after or (cut is not None and block.offset == cut.block.offset)
        if block.offset in plan.dropped or (block.kind in STATES and block.offset not in states):
            return False
        if after:
            return True
        return block.kind is Kind.ENTRY and before in kept

    try:
        if cut is not None:
            kept = _roots(seen, cut, codec)
        about = replace(
            seen.about,
            marks=True,
            thinned_before=max(seen.about.thinned_before, plan.thinned_before),
            dropped_before=cut.scan if cut is not None else seen.about.dropped_before,
            roots=len(kept) if cut is not None else seen.about.roots,
        )
        made = rewrite(file, seen.end, part_of(file.path), about.packed(), keep)
    except (OSError, RunFileError, MemoryError):
        return None
    try:
        os.fdatasync(made.file.fd)
        made.follow(file.end)  # what came meanwhile: all but the very last is on the disk before the names change
        os.fdatasync(made.file.fd)
    except (OSError, MemoryError):
        made.abandon()
        return None
    return Smaller(made, about, kept, cut.entries if cut is not None else 0)


STATES = (Kind.KEYFRAME, Kind.DELTA)


def _states(seen: Seen) -> frozenset[int]:
    """Where the states are that can be read; of a damaged file others may be left, whose keyframe or program is lost."""
    return frozenset(block.offset for each in seen.checkpoints for block in (each.block, each.base))


def _roots(seen: Seen, cut: Checkpoint, codec: Codec) -> tuple[int, ...]:
    """Which of the entries before the cut stay."""
    before = takewhile(lambda block: block.offset != cut.block.offset, seen.file.walk(seen.end))
    slots = Slots()
    entries = [entry_of(seen.file, block, codec, slots) for block in before if block.kind is Kind.ENTRY]
    return journal_roots(entries, codec.folds)


@dataclass(frozen=True, slots=True)
class Ending:
    """Where a copy of a run ends: the state before `scan`, and how many entries led there."""

    scan: int
    entries: int
    version: int
    state: bytes


def write_copy(seen: Seen, path: Path, ending: Ending) -> None:
    """Writes a new run file with all that led to this state, and the state at its end; `OSError`, `RunFileError`."""
    refuse_existing(path)
    states = _states(seen)

    def keep(block: Block, before: int) -> bool:
        if block.kind in STATES and block.offset not in states:
            return False
        if block.kind is Kind.ENTRY:
            return before < ending.entries
        if block.kind is Kind.MARK:  # how the original is driven
            return False
        return block.scan <= ending.scan and before <= ending.entries

    made = rewrite(seen.file, seen.end, part_of(path), seen.about.packed(), keep)
    try:
        made.file.append(Kind.KEYFRAME, ending.scan, keyframe(ending.version, ending.state))
        made.repeat()
        made.file.mark(ending.scan)
        os.fsync(made.file.fd)
        os.replace(made.file.path, path)
    except (OSError, MemoryError):
        made.abandon()
        raise
    made.file.close()


def refuse_existing(path: Path) -> None:
    """Nothing is overwritten."""
    if path.exists():
        raise FileExistsError(errno.EEXIST, "there is a file of this name already", str(path))


def part_of(path: Path) -> Path:
    """Where a file is written that gets this name in the end."""
    part = path.with_name(path.name + ".part")
    part.unlink(missing_ok=True)
    return part
