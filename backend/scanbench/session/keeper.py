"""What a session gives away to be kept."""

from collections.abc import Mapping, Sequence
from typing import Protocol

from scanbench.faults.history import ErrorRow
from scanbench.store.records import Json
from scanbench.wire.events import LogEntry


class Keeper(Protocol):
    """Takes what is to outlive the process, of the instance with this number; it returns at once."""

    def keep_rows(self, instance: int, rows: Sequence[ErrorRow]) -> None:
        """Error history rows that changed, of whatever version."""

    def keep_line(self, instance: int, line: LogEntry, version: int) -> None:
        """A line of the log, while this version of the program runs."""

    def keep_breakpoints(self, instance: int, breakpoints: Sequence[Json]) -> None:
        """The breakpoints that everybody shares, all of them."""

    def keep_traces(self, instance: int, traces: Mapping[int, Json]) -> None:
        """The traces of an instance, all of them."""


class NothingKept:
    """Of a PLC that goes away with its process: so a debug adapter starts without a database."""

    def keep_rows(self, instance: int, rows: Sequence[ErrorRow]) -> None:
        """Does nothing."""

    def keep_line(self, instance: int, line: LogEntry, version: int) -> None:
        """Does nothing."""

    def keep_breakpoints(self, instance: int, breakpoints: Sequence[Json]) -> None:
        """Does nothing."""

    def keep_traces(self, instance: int, traces: Mapping[int, Json]) -> None:
        """Does nothing."""
