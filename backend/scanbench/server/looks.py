"""Looks at the past of one person: each is a PLC of its own, which ends when nobody has been there for a while."""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Sized
from typing import Protocol

from scanbench.store.records import InstanceRow, NotFound, StoreError

log = logging.getLogger("scanbench")
LEFT_S = 60.0
"""Who reloads the page, or loses the connection for a moment, finds the look again."""


class Attended(Protocol):
    """A session, as far as this needs it."""

    row: InstanceRow

    @property
    def id(self) -> int:
        """Of its PLC."""

    @property
    def users(self) -> Sized:
        """Who is there."""


class Looks:
    """Waits beside each look that nobody is at."""

    def __init__(self, end: Callable[[int], Awaitable[None]], left_s: float = LEFT_S) -> None:
        """`end` deletes a PLC."""
        self._end, self._left_s = end, left_s
        self._waiting: dict[int, asyncio.Task[None]] = {}

    def left(self, session: Attended) -> None:
        """Somebody went, or it has just begun: when nobody comes, it ends."""
        if not session.row.look or session.users:
            return
        self.came(session)
        self._waiting[session.id] = asyncio.get_running_loop().create_task(self._wait(session))

    def came(self, session: Attended) -> None:
        """Somebody is there."""
        waiting = self._waiting.pop(session.id, None)
        if waiting is not None:
            waiting.cancel()

    async def close(self) -> None:
        """The server ends: looks are waited for again when it starts."""
        waiting, self._waiting = list(self._waiting.values()), {}
        for task in waiting:
            task.cancel()
        await asyncio.gather(*waiting, return_exceptions=True)

    async def _wait(self, session: Attended) -> None:
        await asyncio.sleep(self._left_s)
        if self._waiting.get(session.id) is asyncio.current_task():
            del self._waiting[session.id]  # from here on it is not cancelled any more
        if session.users:
            return
        try:
            await self._end(session.id)
        except NotFound:
            pass  # somebody ended it
        except StoreError as error:
            log.error("%s, a look at the past, could not be ended: %s", session.row.name, error)
