"""A thread for whatever waits for a disk, so that neither scans nor people wait for it."""

import logging
import threading
from collections import deque
from collections.abc import Callable

from scanbench.runtime.clock import monotonic_ns

SYNC_NS = 1_000_000_000
"""Between two syncs."""
log = logging.getLogger("scanbench")


class Worker:
    """Jobs one after the other, and a sync now and then. The thread begins when there is something to do first."""

    def __init__(self, name: str, sync: Callable[[], None]) -> None:
        self._name, self._sync = name, sync
        self._jobs: deque[Callable[[], None]] = deque()
        self._changed = threading.Condition()
        self._thread: threading.Thread | None = None
        self._busy = self._closing = False
        self._sync_at = self._synced_at = 0
        """When the next sync is due, 0 while none is wanted; when the last one began."""

    def give(self, job: Callable[[], None]) -> None:
        """One more job; it says itself when it fails."""
        with self._changed:
            self._jobs.append(job)
            self._begin()

    def sync_soon(self) -> None:
        """What was written just now is to be synced. Costs nothing while that is to come anyway."""
        if self._sync_at:  # it is taken back before the sync begins, so that what was written before this is in it
            return
        with self._changed:
            self._sync_at = max(monotonic_ns(), self._synced_at + SYNC_NS)
            self._begin()

    def wait(self) -> None:
        """Until all jobs that were given are done."""
        with self._changed:
            self._changed.wait_for(lambda: not self._jobs and not self._busy)

    def close(self) -> None:
        """Does what is left to do, and ends the thread."""
        with self._changed:
            self._closing = True
            self._changed.notify_all()
        if self._thread is not None:
            self._thread.join()

    def _begin(self) -> None:
        self._changed.notify_all()
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
            self._thread.start()

    def _run(self) -> None:
        while (job := self._next()) is not None:
            try:
                job()
            except Exception:  # the thread is needed for the next ones
                log.exception("%s: what was to be written was not", self._name)

    def _next(self) -> Callable[[], None] | None:
        """Waits for the next thing to do; None at the end."""
        with self._changed:
            self._busy = False
            self._changed.notify_all()
            while True:
                now = monotonic_ns()
                if self._sync_at and (self._closing or now >= self._sync_at):
                    self._sync_at, self._synced_at = 0, now
                    self._busy = True
                    return self._sync
                if self._jobs:
                    self._busy = True
                    return self._jobs.popleft()
                if self._closing:
                    return None
                self._changed.wait((self._sync_at - now) / 1e9 if self._sync_at else None)
