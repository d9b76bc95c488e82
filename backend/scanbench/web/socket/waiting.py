"""Texts that a WebSocket has yet to send, and the end of a connection whose other side does not read."""

import asyncio
from collections import deque

LIMIT = 20_000


class Waiting:
    """Made in the task that reads from the socket: that one is cancelled when too much waits, and `over` says so.

    The task that writes cannot notice: it waits in a send that never ends.
    """

    def __init__(self, limit: int = LIMIT) -> None:
        self._limit, self._reader = limit, asyncio.current_task()
        self._texts: deque[str] = deque()
        self.over = False

    def __bool__(self) -> bool:
        return bool(self._texts)

    def add(self, text: str) -> None:
        """After all others."""
        if self.over:
            return
        self._texts.append(text)
        if len(self._texts) > self._limit:
            self.over = True
            self._texts.clear()
            if self._reader is not None:
                self._reader.cancel()

    def first(self, text: str) -> None:
        """Before all others."""
        self._texts.appendleft(text)

    def take(self) -> str:
        """The one that waits longest."""
        return self._texts.popleft()
