"""Writes history and log behind the back of the live path: a command never waits for the database."""

import asyncio
import logging
from collections.abc import Callable, Sequence

from scanbench.faults.history import ErrorRow, RowReaction
from scanbench.faults.reaction_json import from_json, to_json
from scanbench.plcmodel.model import Model
from scanbench.session.events import LogEntry
from scanbench.store.records import HistoryRow, LogRow
from scanbench.store.store import Store

log = logging.getLogger("scanbench")
LOG_KEPT = 20_000
"""Lines of each instance; older ones go."""
LOG_TRIMMED_EVERY = 1000


class Keeper:
    """One task that writes in the order in which things happened."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._jobs: asyncio.Queue[Callable[[], object]] = asyncio.Queue()
        self._task: asyncio.Task[None] | None = None
        self._lines: dict[int, int] = {}

    def start(self) -> None:
        """Begins to write."""
        self._task = asyncio.get_running_loop().create_task(self._work())

    async def flush(self) -> None:
        """Waits until everything so far is written."""
        await self._jobs.join()

    async def close(self) -> None:
        """Writes the rest, and ends."""
        if self._task is not None:
            await self.flush()
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)

    def keep_rows(self, instance: int, rows: Sequence[ErrorRow]) -> None:
        """Error history rows that changed, of whatever version."""
        for row in rows:
            self._jobs.put_nowait(_row_job(self._store, instance, row))

    def keep_line(self, instance: int, line: LogEntry, version: int) -> None:
        """A line of the log, while this version of the program runs."""
        at, scan, author, kind, text = line.at, line.scan, line.author, line.kind, line.text
        self._jobs.put_nowait(lambda: self._store.add_log(instance, at, scan, author, kind, text, version))
        self._lines[instance] = self._lines.get(instance, 0) + 1
        if self._lines[instance] % LOG_TRIMMED_EVERY == 0:
            self._jobs.put_nowait(lambda: self._store.trim_log(instance, LOG_KEPT))

    async def _work(self) -> None:
        while True:
            jobs = [await self._jobs.get()]
            while not self._jobs.empty():
                jobs.append(self._jobs.get_nowait())
            await asyncio.to_thread(_run_all, jobs)
            for _ in jobs:
                self._jobs.task_done()


def row_of(model: Model, kept: HistoryRow) -> ErrorRow:
    """A row as the store has it. An error of another version's catalogue keeps its id for a name."""
    error = model.error(kept.error)
    name = kept.error if error is None else error.name
    return ErrorRow(
        kept.error, name, "nonfatal" if error is None else error.severity, kept.status, kept.code, kept.details, kept.generated_at, kept.recovered_at,
        kept.generated_scan, kept.recovered_scan, kept.by, kept.origin, kept.count, _reaction_of(kept),
        kept.program_version,
    )  # fmt: skip


def _reaction_of(kept: HistoryRow) -> RowReaction | None:
    if kept.reaction_state is None:
        return None
    if kept.reaction_state == "done" and kept.reaction is not None:
        try:
            return RowReaction("done", from_json(kept.reaction))
        except ValueError as error:
            return RowReaction("failed", None, f"the database has no reaction that can be read: {error}")
    if kept.reaction_state == "recording":
        return RowReaction("recording", scan=kept.generated_scan)
    return RowReaction("failed", None, kept.reaction_message)


def line_of(kept: LogRow) -> LogEntry:
    """A line as the store has it."""
    return LogEntry(kept.at, kept.scan, kept.author, kept.text, kept.kind)


def _row_job(store: Store, instance: int, row: ErrorRow) -> Callable[[], object]:
    def job() -> None:
        assert row.generated_at is not None
        version, reaction = row.program_version, row.reaction
        store.record_generated(
            instance, row.id, program_version=version, code=row.code, details=row.details,
            at=row.generated_at, scan=row.generated_scan or 0, by=row.by or "", origin=row.origin or "simulator",
            count=row.count,
        )  # fmt: skip
        if row.status == "cleared" and row.recovered_at is not None:
            store.record_cleared(
                instance, row.id, program_version=version, at=row.recovered_at, scan=row.recovered_scan or 0
            )
        store.set_reaction(
            instance, version, row.id, state=None if reaction is None else reaction.state,
            reaction=None if reaction is None or reaction.found is None else to_json(reaction.found),
            message="" if reaction is None else reaction.message,
        )  # fmt: skip

    return job


def _run_all(jobs: Sequence[Callable[[], object]]) -> None:
    for job in jobs:
        try:
            job()
        except Exception:  # the PLC goes on; the next lines may be written again
            log.exception("a line of history or log could not be written")
