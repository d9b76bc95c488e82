"""What a run appends to its run file, and what it owes: entries that had to be taken while nothing could be written."""

import os

from scanbench.recording.alike import Slots
from scanbench.recording.block import BRIEF
from scanbench.recording.blocks import Codec
from scanbench.recording.format import Block, Kind, RunFile
from scanbench.recording.worker import Worker
from scanbench.runtime.command import Entry


class Appender:
    """Appends in the thread that runs the scans; a thread of its own waits for the disk."""

    def __init__(self, file: RunFile, codec: Codec, entries: int, last_scan: int) -> None:
        self.file, self._codec = file, codec
        self.entries = entries
        """So many are in the file."""
        self.last_scan = last_scan
        """The last scan that the file knew of when it was opened, or that was noted since."""
        self.trouble = ""
        """Why nothing is recorded now."""
        self.worker = Worker("recording", self._sync)
        self._owed: list[Entry] = []
        self._slots = Slots()

    def append(self, kind: Kind, scan: int, payload: bytes, base: int = 0) -> Block:
        """Writes a block after what is owed, see `RunFile.append`; `OSError`, and `trouble` says why."""
        self.pay()
        return self._append(kind, scan, payload, base)

    def entry(self, entry: Entry, must: bool) -> None:
        """Writes an entry. `OSError` when that cannot be done, unless it `must` be taken: then it is owed."""
        try:
            self.pay()
            self._entry(entry)
        except OSError:
            if not must:
                raise
            self._owed.append(entry)

    def pay(self) -> None:
        """Writes the entries that are owed; `OSError`."""
        while self._owed:
            self._entry(self._owed[0])
            del self._owed[0]

    def mark(self, scan: int) -> None:
        """Marks the last known scan at the end of the file, but not before what is owed."""
        if self._owed:
            return
        self.last_scan = scan
        try:
            self.file.mark(scan)
        except OSError as error:
            self._in_trouble(error)

    def _entry(self, entry: Entry) -> None:
        """Appends an entry, in few bytes where it repeats one before it."""
        if not self._append_brief(entry):
            slot = self._slots.take(entry) if self.file.format >= BRIEF else 0
            self._append(Kind.ENTRY, entry.scan, self._codec.pack(entry), slot=slot)
        self.entries += 1

    def _append_brief(self, entry: Entry) -> bool:
        brief = self._slots.brief(entry)
        if brief is None:
            return False
        try:
            written = self.file.append_short(brief[0], entry.scan, brief[1])
        except OSError as error:
            self._in_trouble(error)
            raise
        if written:
            self._written(entry.scan)
        return written

    def _append(self, kind: Kind, scan: int, payload: bytes, base: int = 0, slot: int = 0) -> Block:
        try:
            block = self.file.append(kind, scan, payload, base, slot)
        except OSError as error:
            self._slots.clear()
            self._in_trouble(error)
            raise
        if kind in (Kind.KEYFRAME, Kind.DELTA):
            self._slots.clear()
        self._written(scan)
        return block

    def _written(self, scan: int) -> None:
        self.trouble = ""
        self.last_scan = max(self.last_scan, scan)
        self.worker.sync_soon()

    def _sync(self) -> None:
        """In the thread that waits for disks, which closes files too: so the one it takes stays open."""
        try:
            os.fdatasync(self.file.fd)
        except OSError as error:
            self._in_trouble(error)

    def _in_trouble(self, error: OSError) -> None:
        self.trouble = f"{self.file.path.name} cannot be written: {error.strerror}"
