"""Watch lists: whose they are, and who is told when one changes."""

import asyncio
from collections.abc import Callable

from scanbench.session.session import Session
from scanbench.store.records import NotFound, WatchContent, WatchListRow
from scanbench.store.store import Store
from scanbench.wire.events import WatchListChanged
from scanbench.wire.refused import Refused

LISTS = 500
"""Lists of a project that one person sees."""


class WatchLists:
    """The watch lists of all projects. A private one is there for its owner only."""

    def __init__(self, store: Store, sessions_of: Callable[[int], list[Session]]) -> None:
        self._store, self._sessions_of = store, sessions_of

    async def all(self, project: int, user: str) -> list[WatchListRow]:
        """The lists that somebody sees."""
        return await asyncio.to_thread(self._store.watch_lists.seen, project, user)

    async def get(self, id: int, user: str) -> WatchListRow:
        """One of them."""
        row = await asyncio.to_thread(self._store.watch_lists.get, id)
        if row.owner not in ("", user):
            raise NotFound(f"there is no watch list {id}")
        return row

    async def create(self, project: int, name: str, shared: bool, content: WatchContent, user: str) -> WatchListRow:
        """A new list, shared with everybody at the project or the user's own."""
        if len(await self.all(project, user)) >= LISTS:
            raise Refused(f"there are {LISTS} watch lists already: delete one first")
        owner = "" if shared else user
        row = await asyncio.to_thread(self._store.watch_lists.create, project, name, owner, content, user)
        self._tell(row, row.version, user)
        return row

    async def save(
        self, id: int, name: str, shared: bool, content: WatchContent, version: int, user: str
    ) -> WatchListRow:
        """Saves what was edited from `version` on; `store.records.ListConflict` when somebody else was first."""
        before = await self.get(id, user)
        if before.owner == "" and not shared:
            raise Refused(f"{before.name} is shared: others may use it. Duplicate it to have one of your own")
        owner = "" if shared else user
        row = await asyncio.to_thread(self._store.watch_lists.save, id, name, owner, content, version, user)
        self._tell(row, row.version, user)
        return row

    async def delete(self, id: int, user: str) -> None:
        """Forgets a list."""
        row = await self.get(id, user)
        await asyncio.to_thread(self._store.watch_lists.delete, id)
        self._tell(row, 0, user)

    def _tell(self, row: WatchListRow, version: int, author: str) -> None:
        for session in self._sessions_of(row.project):
            session.tell(WatchListChanged(row.id, row.owner, version, author))
