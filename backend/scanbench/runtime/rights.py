"""What each operating mode permits from outside, in one place.

The error simulator's own door is no tool: it is open in every mode, and asks nobody here.
"""

from enum import StrEnum

from scanbench.runtime.command import Refusal
from scanbench.runtime.header import Mode


class Right(StrEnum):
    """Something that a tool may want to do."""

    WRITE = "write"
    FORCE = "force"
    CHANGE = "change the program"
    """Online change: the program goes on with new code."""
    TRANSFER = "transfer a program"
    """A new program while the old one does not run."""
    MODE = "change the mode"
    CLEAR = "clear errors"
    RESTART = "restart"


_ALWAYS = frozenset({Right.MODE, Right.CLEAR, Right.RESTART})
_WHILE_CHANGEABLE = _ALWAYS | {Right.WRITE, Right.FORCE}
_PERMITTED = {
    Mode.PROGRAM: _WHILE_CHANGEABLE | {Right.TRANSFER},
    Mode.MONITOR: _WHILE_CHANGEABLE | {Right.CHANGE},
    Mode.RUN: _ALWAYS,
}


def may(mode: Mode, right: Right, what: str = "") -> Refusal | None:
    """None where the mode permits it, else the refusal that names a mode which does; `what` is the object: a path."""
    if right in _PERMITTED[mode]:
        return None
    better = next(each for each in (Mode.MONITOR, Mode.PROGRAM) if right in _PERMITTED[each])
    wish = f"{right} {what}".strip()
    if mode is Mode.RUN:
        return Refusal(f"in RUN mode nothing can be changed from outside: change to {better.name} to {wish}")
    return Refusal(f"{mode.name} mode does not permit it: change to {better.name} to {wish}")
