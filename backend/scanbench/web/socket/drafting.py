"""What one browser has open of the drafts of its project."""

import asyncio
from base64 import b64encode
from collections.abc import Callable
from contextlib import suppress
from weakref import WeakValueDictionary

from scanbench.server.drafts import Drafts
from scanbench.store.records import NotFound, NotStorable, StoreError
from scanbench.web import messages_together as together
from scanbench.wire.events import Subscriber
from scanbench.wire.refused import Refused

Asked = together.OpenDraft | together.EditDraft | together.CloseDraft


class Drafting:
    """Opens, edits and closes for a browser; at its end everything is closed."""

    def __init__(self, drafts: Drafts, project: int, who: Subscriber, say: Callable[[together.Draft], None]) -> None:
        self._drafts, self._project, self._who, self._say = drafts, project, who, say
        self._open: set[str] = set()
        self._locks: WeakValueDictionary[str, asyncio.Lock] = WeakValueDictionary()

    async def serve(self, asked: Asked) -> None:
        """Does it; `Refused` says why not. To open and to close a file do not overtake each other."""
        try:
            if isinstance(asked, together.EditDraft):
                await self._drafts.edit(self._project, asked.path, asked.draft, asked.update, self._who)
                return
            async with self._lock(asked.path):
                await self._serve(asked)
        except (NotFound, NotStorable, StoreError) as error:
            raise Refused(str(error)) from error

    async def end(self) -> None:
        """The browser is gone."""
        for path in tuple(self._open):
            with suppress(NotFound, StoreError):
                async with self._lock(path):
                    await self._drafts.close(self._project, path, self._who)

    def _lock(self, path: str) -> asyncio.Lock:
        return self._locks.setdefault(path, asyncio.Lock())

    async def _serve(self, asked: together.OpenDraft | together.CloseDraft) -> None:
        match asked:
            case together.OpenDraft():
                self._open.add(asked.path)
                found = await self._drafts.open(self._project, asked.path, self._who, asked.draft, asked.vector)
                self._say(
                    together.Draft(
                        path=asked.path, draft=found.draft, update=b64encode(found.update).decode(),
                        vector=b64encode(found.vector).decode(), version=found.version,
                    )
                )  # fmt: skip
            case together.CloseDraft():
                self._open.discard(asked.path)
                await self._drafts.close(self._project, asked.path, self._who)
