"""States of programs that somebody kept: run files that end there, for sweeps to begin from."""

import asyncio
import os
import re
import shutil
from collections.abc import Sequence
from pathlib import Path

from scanbench.host.run_files import discard
from scanbench.session.session import Session
from scanbench.store.records import StateRow, SweepRow
from scanbench.store.store import Store
from scanbench.wire.refused import Refused

_OF_A_SWEEP = re.compile(r"sweep-(\d+)-\d+\.run")
NOW = "Now"
"""How the state of a PLC is called that nobody named."""


class States:
    """The kept states of a server. `directory` has their run files."""

    def __init__(self, store: Store, directory: Path) -> None:
        self._store, self._directory = store, directory

    def tidy(self) -> None:
        """Removes files that belong to nothing any more. Waits for the disk."""
        self._directory.mkdir(parents=True, exist_ok=True)
        sweeps = self._store.sweeps.ids()
        known = {self.path(row.id) for each in self._store.projects.all() for row in self._store.states.all(each.id)}
        for path in self._directory.iterdir():
            if path not in known and _sweep_of(path) not in sweeps:
                discard(path)

    def path(self, id: int) -> Path:
        """The run file of a kept state."""
        return self._directory / f"{id}.run"

    def of_sweep(self, row: SweepRow) -> dict[str, Path]:
        """The run files in which a sweep begins, by the names of the states: its own, whatever becomes of the states."""
        return {name: self._directory / f"sweep-{row.id}-{index}.run" for index, name in enumerate(row.states)}

    async def give(self, row: SweepRow, kept: Sequence[StateRow]) -> None:
        """Gives a sweep its own run files of kept states; `Refused` when one is gone."""
        for state, path in zip(kept, self.of_sweep(row).values(), strict=True):
            try:
                await asyncio.to_thread(_share, self.path(state.id), path)
            except OSError as error:
                raise Refused(f"the state {state.name} cannot be used: {error.strerror}") from error

    async def discard(self, row: SweepRow) -> None:
        """Removes the run files of a sweep."""
        for path in self.of_sweep(row).values():
            await asyncio.to_thread(discard, path)

    async def of_project(self, project: int) -> list[StateRow]:
        """The states that somebody kept."""
        return await asyncio.to_thread(self._store.states.all, project)

    async def keep(self, session: Session, name: str, scan: int | None, author: str) -> StateRow:
        """Keeps the PLC as it was before `scan`, or is now."""
        if not name or name.lower() == NOW.lower():
            raise Refused(f"a state needs a name of its own, other than {NOW}")
        state = session.state
        row = await asyncio.to_thread(
            lambda: self._store.states.create(
                session.project_id, name, instance=session.name, scan=state.scan if scan is None else scan,
                program_version=state.version, by=author,
            )
        )  # fmt: skip
        try:
            await self.take(session, self.path(row.id), scan, author)
        except BaseException:
            await asyncio.to_thread(self._store.states.delete, row.id)
            raise
        session.log.add(author, f"state kept: {name}")
        return row

    async def take(self, session: Session, path: Path, scan: int | None, author: str) -> None:
        """Writes a PLC's run as it was before `scan`, or as it is now. If that fails, no file is left."""
        await asyncio.to_thread(discard, path)
        try:
            await session.copy(path, scan, author)
        except BaseException:
            await asyncio.to_thread(discard, path)
            raise

    async def delete(self, id: int) -> None:
        """Forgets a state."""
        await asyncio.to_thread(self._store.states.delete, id)
        await asyncio.to_thread(discard, self.path(id))


def _sweep_of(path: Path) -> int | None:
    """Whose file it is, by its name alone: what else a sweep that cannot be read says is not known."""
    found = _OF_A_SWEEP.fullmatch(path.name)
    return None if found is None else int(found[1])


def _share(path: Path, other: Path) -> None:
    """Gives the file a second name, as nobody writes into it any more; makes a copy if the disk has no links."""
    discard(other)
    try:
        os.link(path, other)
    except OSError:
        shutil.copyfile(path, other)
