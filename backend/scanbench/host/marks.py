"""The points of a run's timeline: which entries of its journal leave one."""

from collections.abc import Sequence

from scanbench.runtime.command import Entry
from scanbench.wire.host import RunMark

LIMIT = 5000
"""Marks that are kept to be shown."""
LONGEST = 200


def marks_of(entries: Sequence[Entry]) -> tuple[RunMark, ...]:
    """A mark for each entry."""
    return tuple(
        RunMark(entry.scan, entry.command.category, entry.command.author, entry.plan.message[:LONGEST])
        for entry in entries[-LIMIT:]
    )
