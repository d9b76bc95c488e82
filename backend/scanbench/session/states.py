"""States of programs that somebody kept: run files that end there, for sweeps to begin from."""

import asyncio
from pathlib import Path

from scanbench.session.refused import Refused
from scanbench.session.runs import discard
from scanbench.session.session import Session
from scanbench.store.records import StateRow
from scanbench.store.store import Store

NOW = "Now"
"""How the state of a PLC is called that nobody named."""


class States:
    """The kept states of a server. `directory` has their run files."""

    def __init__(self, store: Store, directory: Path) -> None:
        self._store, self._directory = store, directory

    def tidy(self) -> None:
        """Removes files that belong to nothing any more. Waits for the disk."""
        self._directory.mkdir(parents=True, exist_ok=True)
        known = set[Path]()
        for project in self._store.projects():
            known.update(self.path(row.id) for row in self._store.states(project.id))
            known.update(self.now_path(row.id) for row in self._store.sweeps(project.id))
        for path in self._directory.iterdir():
            if path not in known:
                discard(path)

    def path(self, id: int) -> Path:
        """The run file of a kept state."""
        return self._directory / f"{id}.run"

    def now_path(self, sweep: int) -> Path:
        """The run file of a PLC as it was when a sweep began."""
        return self._directory / f"sweep-{sweep}.run"

    async def of_project(self, project: int) -> list[StateRow]:
        """The states that somebody kept."""
        return await asyncio.to_thread(self._store.states, project)

    async def keep(self, session: Session, name: str, scan: int | None, author: str) -> StateRow:
        """Keeps the PLC as it was before `scan`, or is now."""
        if not name or name.lower() == NOW.lower():
            raise Refused(f"a state needs a name of its own, other than {NOW}")
        state = session.state
        row = await asyncio.to_thread(
            lambda: self._store.create_state(
                session.project_id, name, instance=session.name, scan=state.scan if scan is None else scan,
                program_version=state.version, by=author,
            )
        )  # fmt: skip
        try:
            await self.take(session, self.path(row.id), scan, author)
        except BaseException:
            await asyncio.to_thread(self._store.delete_state, row.id)
            raise
        session.told(author, f"state kept: {name}")
        return row

    async def take(self, session: Session, path: Path, scan: int | None, author: str) -> None:
        """Writes a PLC's run as it was before `scan`, or is now; leaves nothing behind where it cannot."""
        await asyncio.to_thread(discard, path)
        try:
            await session.copy(path, scan, author)
        except BaseException:
            await asyncio.to_thread(discard, path)
            raise

    async def delete(self, id: int) -> None:
        """Forgets a state."""
        await asyncio.to_thread(self._store.delete_state, id)
        await asyncio.to_thread(discard, self.path(id))
