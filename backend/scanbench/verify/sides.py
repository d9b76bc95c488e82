"""A side of a verification: a PLC that runs one scan after the other, and tells what the range used."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from scanbench.engines.debug import Frame, Listen
from scanbench.engines.engine import Reason, Stop
from scanbench.runtime.command import Entry
from scanbench.runtime.inside import HaltAt, Onlooker, front
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Begin:
    """Where a scan began, so that it can be run again."""

    loaded: Loaded
    memory: bytes
    journal: Journal
    entries: int
    """Of the journal, with those that are entered inside of the scan: it may have grown since."""


@dataclass(slots=True)
class Side:
    """One of the two."""

    resource: Resource
    _frames: dict[int, tuple[Frame, ...]] = field(default_factory=dict)
    """Open calls at counts of the scan that ran last."""

    @property
    def memory(self) -> bytearray:
        """The whole image."""
        return self.resource.memory

    @property
    def state(self) -> bytes:
        """What is compared."""
        return self.resource.state

    def begin(self) -> Begin:
        """Before a scan, with all that is entered in it."""
        self._frames = {}
        journal = self.resource.journal
        return Begin(self.resource.loaded, bytes(self.memory), journal, len(journal))

    def restore(self, begin: Begin) -> None:
        """Restores the beginning of a scan. Running it again enters nothing, so the journal need not be a copy."""
        journal = begin.journal if len(begin.journal) == begin.entries else begin.journal.prefix(begin.entries)
        self.resource.restore(begin.loaded, begin.memory, journal)

    def run(self, hook: Onlooker | None, listen: Listen | None = None) -> Stop:
        """One scan, in the debug flavour where somebody listens."""
        resource = self.resource
        with resource.listening.instead(hook, listen):
            while (stop := resource.rerun(1)).reason is Reason.INTERRUPTED:
                pass
        return stop

    def wait_for(self, entries: Sequence[Entry]) -> None:
        """Entries of the scan that is next, to be entered inside of it."""
        for entry in entries:
            self.resource.await_step(entry)

    @property
    def waits(self) -> bool:
        """Whether anything is to be entered inside of the scan that is next."""
        journal = self.resource.journal
        return front(journal, self.resource.header.scan) < len(journal)

    def again(self, begin: Begin, run: Callable[[], T]) -> T:
        """Calls `run` at the beginning of a scan, and restores the present state afterwards."""
        resource = self.resource
        here, journal, loaded = bytes(self.memory), resource.journal, resource.loaded
        self.restore(begin)
        try:
            return run()
        finally:
            resource.restore(loaded, here, journal)

    @property
    def count(self) -> int:
        """Statements that have begun in the scan that the debug flavour ran last."""
        return self.resource.loaded.debugged().count

    def frames_at(self, begin: Begin, count: int) -> tuple[Frame, ...]:
        """The open calls before the statement of a count; none where it does not get so far."""
        if count not in self._frames:

            def run() -> tuple[Frame, ...]:
                self.run(HaltAt(count), Listen(count=count))
                inside = self.resource.listening.inside
                return () if inside is None else inside.frames

            self._frames[count] = self.again(begin, run)
        return self._frames[count]
