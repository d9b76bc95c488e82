"""The log of a PLC, as the server answers when it is asked for a part of it."""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.public import Public
from scanbench.wire.events import LogEntry


@dataclass(frozen=True, slots=True)
class LogPage(Public):
    """A stretch of the log as it is kept."""

    PUBLIC: ClassVar = "LogPage"

    first: int
    """The number of the first of these lines, counted from 0."""
    total: int
    """Lines that are kept (of the kind that was asked for)."""
    kept: int
    """Lines that are kept at most; older ones go."""
    lines: tuple[LogEntry, ...]
