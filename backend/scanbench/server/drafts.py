"""Files as people edit them together. Everybody who has a file open is told each change of its draft; all of them are kept, so that nothing
typed is lost when the server ends."""

import asyncio
from base64 import b64encode
from contextlib import suppress
from dataclasses import dataclass
from weakref import WeakValueDictionary

from scanbench.server.draft import Draft, update_of, with_line_feeds
from scanbench.store.drafts import DraftRow
from scanbench.store.records import FileRow, NotFound
from scanbench.store.store import Store
from scanbench.wire.events import Subscriber
from scanbench.wire.refused import Refused
from scanbench.wire.together import DraftEdited

MOST_PARTS = 200
"""So many changes kept one by one: with the next one the draft is kept as a whole again."""


class Shared:
    """A draft that somebody has open. What is changed is written one after the other, all that waits at once."""

    def __init__(self, store: Store, project: int, path: str, row: DraftRow) -> None:
        self.draft, self.people = Draft(row.key, row.parts), set[Subscriber]()
        self._parts, self._stored = list(row.parts), len(row.parts)
        self._store, self._project, self._path = store, project, path
        self._unkept: list[bytes] = []
        self._writing: asyncio.Task[None] | None = None
        self.storing = asyncio.Lock()
        """Who has it is alone with what is stored of the draft."""

    def edit(self, update: bytes, by: Subscriber) -> None:
        """Somebody typed: everybody else is told, and it is to be written. `Refused` why it is no such change."""
        try:
            fresh = self.draft.apply_foreign(update)
        except Refused:
            self.draft = Draft(self.draft.key, self._parts)
            raise
        if fresh:
            self._tell(fresh, by)
            self._unkept.append(fresh)

    def saved(self, update: bytes) -> None:
        """A change from elsewhere, which is stored."""
        self._stored += 1
        self._tell(self.draft.apply(update), None)

    def _tell(self, update: bytes, by: Subscriber | None) -> None:
        self._parts.append(update)
        if len(self._parts) > MOST_PARTS:
            self._parts = [self.draft.lacking(None)]
        event = DraftEdited(self._path, self.draft.key, b64encode(update).decode())
        for person in tuple(self.people):
            if person is not by:
                person.on_event(event)

    async def kept(self) -> None:
        """Waits until all changes are kept; `StoreError` why they cannot be, then the next call tries again."""
        if self._unkept and (self._writing is None or self._writing.done()):
            self._writing = asyncio.get_running_loop().create_task(self._write())
        if self._writing is not None:
            await asyncio.shield(self._writing)

    async def _write(self) -> None:
        while self._unkept:
            async with self.storing:
                batch, self._unkept = self._unkept, []
                too_many = self._stored + len(batch) > MOST_PARTS
                store = self._store.drafts.replace if too_many else self._store.drafts.append
                parts = [self.draft.lacking(None)] if too_many else batch
                try:
                    await asyncio.to_thread(store, self._project, self._path, self.draft.key, parts)
                    self._stored = len(parts) + (0 if too_many else self._stored)
                except BaseException:
                    self._unkept = [*batch, *self._unkept]
                    raise


@dataclass(frozen=True, slots=True)
class Opened:
    """What somebody gets who opens a file."""

    draft: str
    update: bytes
    """What they have not."""
    vector: bytes
    """What the server has: the rest is theirs to send."""
    version: int
    """Of the saved file."""


class Drafts:
    """The drafts of a server, by project and path."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._shared: dict[tuple[int, str], Shared] = {}
        self._locks: WeakValueDictionary[tuple[int, str], asyncio.Lock] = WeakValueDictionary()

    async def open(
        self, project: int, path: str, who: Subscriber, draft: str | None = None, vector: bytes | None = None
    ) -> Opened:
        """Somebody begins to edit a file together with the others. `draft` and `vector` are what they have of it already."""
        async with self._lock(project, path):
            file = await asyncio.to_thread(self._store.files.get, project, path)
            shared = self._shared.get((project, path))
            if shared is None:
                shared = self._shared[project, path] = await self._load(project, path, file.text)
            known = vector if draft == shared.draft.key else None
            update = shared.draft.lacking(known)
            shared.people.add(who)
            return Opened(shared.draft.key, update, shared.draft.vector, file.version)

    async def close(self, project: int, path: str, who: Subscriber) -> None:
        """They do not edit it any more."""
        shared = self._shared.get((project, path))
        if shared is None:
            return
        shared.people.discard(who)
        await shared.kept()
        async with self._lock(project, path):
            if not shared.people and self._shared.get((project, path)) is shared:
                del self._shared[project, path]

    async def edit(self, project: int, path: str, draft: str, update: bytes, by: Subscriber) -> None:
        """Takes a change in; at the end it is kept. `Refused` where this is not the draft of the file."""
        shared = self._shared.get((project, path))
        if shared is None or shared.draft.key != draft or by not in shared.people:
            raise Refused(f"nothing was changed: open {path} first")
        shared.edit(update, by)
        await shared.kept()

    async def unsaved(self, project: int) -> list[str]:
        """The files whose draft says something else than what is saved, whoever has them open, or nobody."""
        return sorted(await self.unsaved_texts(project))

    async def unsaved_texts(self, project: int) -> dict[str, str]:
        """The same files with the texts of their drafts."""
        found = await asyncio.to_thread(self._unsaved_of, project)
        live = {path: shared.draft.text for (of, path), shared in self._shared.items() if of == project}
        now = {path: (saved, live.get(path, draft)) for path, (saved, draft) in found.items()}
        return {path: draft for path, (saved, draft) in now.items() if draft != saved}

    def _unsaved_of(self, project: int) -> dict[str, tuple[str, str]]:
        """Of each file with a draft the saved text, and the draft as it is stored."""
        drafts = self._store.drafts.all(project)
        return {
            path: (with_line_feeds(text), Draft(drafts[path].key, drafts[path].parts).text)
            for path, text in self._store.files.sources(project).items()
            if path in drafts
        }

    async def save(self, project: int, path: str, text: str, version: int, author: str, draft: str | None) -> FileRow:
        """Saves a file (see `store.Files.save`). A text that is not of `draft` was made elsewhere, of the text before: its change
        is made in the draft as well. Both are kept, or neither."""
        async with self._lock(project, path):
            shared = await self._known(project, path) if version > 0 else None
            if shared is None or shared.draft.key == draft:  # what the draft lacks of it comes from who typed it
                return await self._save(project, path, text, version, author)
            async with shared.storing:
                update = b""
                with suppress(NotFound):  # it was deleted: to save it is a conflict
                    file = await asyncio.to_thread(self._store.files.get, project, path)
                    if file.version == version:
                        update = await update_of(shared.draft, file.text, text)
                change = (shared.draft.key, update) if update else None
                saved = await self._save(project, path, text, version, author, change)
                if update:
                    shared.saved(update)
                return saved

    async def _save(
        self, project: int, path: str, text: str, version: int, author: str, change: tuple[str, bytes] | None = None
    ) -> FileRow:
        return await asyncio.to_thread(self._store.files.save, project, path, text, version, author, change)

    async def _known(self, project: int, path: str) -> Shared | None:
        """A draft that somebody has open, or had; None where nobody edited the file yet."""
        shared = self._shared.get((project, path))
        if shared is None:
            row = await asyncio.to_thread(self._store.drafts.get, project, path)
            return None if row is None else Shared(self._store, project, path, row)
        return shared

    def _lock(self, project: int, path: str) -> asyncio.Lock:
        """Who has it is alone with what is stored of a file."""
        return self._locks.setdefault((project, path), asyncio.Lock())

    def forget(self, project: int, path: str | None = None) -> None:
        """A file was deleted, or all of a project."""
        for key in [key for key in self._shared if key[0] == project and path in (None, key[1])]:
            del self._shared[key]

    async def end(self) -> None:
        """Writes what is still to be written."""
        await asyncio.gather(*(shared.kept() for shared in self._shared.values()), return_exceptions=True)

    async def _load(self, project: int, path: str, text: str) -> Shared:
        row = await asyncio.to_thread(self._store.drafts.get, project, path)
        if row is None:
            begun = Draft.begun(text)
            row = await asyncio.to_thread(self._store.drafts.create, project, path, begun.key, begun.lacking(None))
        return Shared(self._store, project, path, row)
