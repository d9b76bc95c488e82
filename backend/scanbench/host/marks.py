"""The points of a run's timeline: which entries of its journal leave one."""

from collections.abc import Sequence

from scanbench.host.repeats import Repeats
from scanbench.runtime.command import Entry
from scanbench.wire.host import RunMark

LIMIT = 5000
"""Marks that are kept to be shown."""
LONGEST = 200
_LOOKED_AT = 20 * LIMIT
"""Entries from the end that are looked at for them."""


def mark_of(entry: Entry, text: str) -> RunMark:
    """The mark of an entry of which this is said."""
    return RunMark(entry.scan, entry.command.category, entry.command.author, text[:LONGEST])


def marks_of(entries: Sequence[Entry]) -> tuple[RunMark, ...]:
    """The last marks: one for each entry, but of what repeats itself only now and then one, as the log tells it."""
    repeats, marks, now = Repeats(), [], 0
    for entry in entries[-_LOOKED_AT:]:
        now = max(now, int(entry.at.timestamp() * 1e9))
        text = repeats.text(entry, now)
        if text is not None:
            marks += [mark_of(*each) for each in repeats.held(now)]
            marks.append(mark_of(entry, text))
    marks += [mark_of(*each) for each in repeats.held(now)]
    return tuple(marks[-LIMIT:])
