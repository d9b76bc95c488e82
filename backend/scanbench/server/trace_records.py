"""Records of traces that were kept, and retrospective traces, which make them of scans that are over."""

import asyncio
import logging
from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Literal

from scanbench.engines.sample import MAX_SIGNALS
from scanbench.jobs.client import FAULT, Make, alone
from scanbench.runtime.clock import fresh_token
from scanbench.server.kept import readable, unreadable
from scanbench.session.session import Session
from scanbench.store.records import Json, KeptRow, NotFound
from scanbench.store.store import Store
from scanbench.taps.spool import Spool, read_pages
from scanbench.taps.trace import TraceSignal
from scanbench.taps.trace_buffer import Samples, TooMany, TraceBuffer, buffer_of
from scanbench.typed import BadValue, make_kept
from scanbench.wire.events import RetrospectiveChanged
from scanbench.wire.refused import Refused
from scanbench.wire.traces import RecordRetrospective, RetrospectiveAt, RetrospectiveDone, TraceStatus

log = logging.getLogger("scanbench")

SUFFIX = ".trace"
MAX_SCANS = 10_000_000
"""Scans of one retrospective trace."""
MAX_AT_ONCE = 2
"""At a time: each is a process that takes a core and some hundred MB."""
KNOWN = 20
_OPEN_BYTES = 512 << 20
"""Of records that stay in memory."""


@dataclass(frozen=True, slots=True)
class TraceRecord:
    """A kept record: what of, when, and whose."""

    row: KeptRow
    origin: Literal["trace", "retrospective"]
    signals: tuple[TraceSignal, ...]
    every: int
    triggered: int | None
    first: int
    end: int
    rows: int
    interval_ns: int
    version: int


@dataclass
class _Retrospective:
    """A retrospective trace under way."""

    session: Session
    changed: RetrospectiveChanged
    file: Path
    every: int
    known: dict[int, RetrospectiveChanged]
    """Where its state is looked up."""
    task: "asyncio.Task[None] | None" = None

    def tell(self, changed: RetrospectiveChanged) -> None:
        """Reports its present state."""
        self.changed = self.known[changed.id] = changed
        self.session.tell(changed)


class TraceRecords:
    """The records of a server. `directory` has their samples."""

    def __init__(self, store: Store, directory: Path, cache: Path) -> None:
        self._store, self._directory, self._cache = store, directory, cache
        self._open: OrderedDict[int, TraceBuffer] = OrderedDict()
        self._opening = asyncio.Lock()
        self._retrospectives: dict[int, _Retrospective] = {}
        self._known: dict[int, RetrospectiveChanged] = {}
        """The last ones, those that are over included."""
        self._next = 1
        self._tasks: set[asyncio.Task[None]] = set()

    def tidy(self) -> None:
        """Removes files that belong to nothing any more. Waits for the disk."""
        self._directory.mkdir(parents=True, exist_ok=True)
        rows = [row for project in self._store.projects.all() for row in self._store.kept.all("trace", project.id)]
        known = {self._path(row.id) for row in rows}
        for path in self._directory.iterdir():
            if path not in known:
                path.unlink(missing_ok=True)

    async def close(self) -> None:
        """Ends every retrospective trace."""
        for retrospective in self._retrospectives.values():
            if retrospective.task is not None:
                retrospective.task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    # ---- kept records ---------------------------------------------------------------------------------------------

    async def of_project(self, project: int) -> list[TraceRecord]:
        """The newest first."""
        return readable(await asyncio.to_thread(self._store.kept.all, "trace", project), _record)

    async def one(self, id: int) -> TraceRecord:
        """One record."""
        return _record(await asyncio.to_thread(self._store.kept.get, "trace", id))

    async def keep(self, session: Session, trace: int, name: str, author: str) -> TraceRecord:
        """Keeps what a trace has recorded until now."""
        status, spool = await self.gather(session, trace, 0, None)
        try:
            if not spool.rows:
                raise Refused("the trace has recorded nothing yet: start it, then keep it")
            content: Json = {
                "origin": "trace", "signals": [asdict(each) for each in status.signals], "every": status.definition.every,
                "triggered": status.triggered, "first": spool.first, "end": spool.end, "rows": spool.rows,
                "interval_ns": status.interval_ns, "version": session.state.version,
            }  # fmt: skip
            return await self._keep(session, name, content, spool.save, author)
        finally:
            spool.close()

    async def gather(self, session: Session, trace: int, first: int, last: int | None) -> tuple[TraceStatus, Spool]:
        """Every sample of a trace in these scans, and what they are of; whoever asks closes the spool."""
        spool = await asyncio.to_thread(Spool, self._directory)
        try:
            status = session.tracing.trace(trace)
            async for of, page in session.tracing.pages(trace, first, last):
                status = of
                await asyncio.to_thread(spool.add, page)
        except OSError as error:
            spool.close()
            raise Refused(f"the samples cannot be put together: {error.strerror}") from error
        except BaseException:
            spool.close()
            raise
        return status, spool

    async def _keep(
        self, session: Session, name: str, content: Json, write: Callable[[Path], object], author: str
    ) -> TraceRecord:  # fmt: skip
        row = await asyncio.to_thread(
            lambda: self._store.kept.keep(
                "trace", session.project_id, name=name, instance=session.name, content=content, by=author
            )
        )
        try:
            await asyncio.to_thread(write, self._path(row.id))
        except BaseException as error:
            await asyncio.to_thread(self._store.kept.forget, "trace", row.id)
            if isinstance(error, OSError):
                raise Refused(f"the record cannot be kept: {error.strerror}") from error
            raise
        self._open.pop(row.id, None)  # of one that went with its project and had this number
        return _record(row)

    async def delete(self, id: int) -> None:
        """Forgets a record."""
        await asyncio.to_thread(self._store.kept.forget, "trace", id)
        self._open.pop(id, None)
        await asyncio.to_thread(self._path(id).unlink, True)

    async def samples(self, id: int, first: int, last: int | None, points: int | None) -> bytes:
        """Packed samples; see `TraceBuffer.read`."""
        record = await self.one(id)
        buffer = await self._buffer(record)
        end = record.end if last is None else last
        try:
            return await asyncio.to_thread(
                lambda: buffer.read(first, end, points).pack(record.first, record.end, 1)
            )  # fmt: skip
        except TooMany as error:
            raise Refused(str(error)) from error

    async def pages(self, id: int, first: int, last: int | None) -> tuple[TraceRecord, Iterator[Samples]]:
        """Every sample of these scans, the oldest first; the iterator takes a while for each."""
        record = await self.one(id)
        buffer = await self._buffer(record)
        return record, buffer.pieces(first, record.end if last is None else last)

    async def _buffer(self, record: TraceRecord) -> TraceBuffer:
        id = record.row.id
        async with self._opening:  # one at a time, as they are large
            if id not in self._open:
                try:
                    self._open[id] = await asyncio.to_thread(_loaded, self._path(id), record)
                except (OSError, ValueError) as error:
                    raise Refused(f"the samples of {record.row.name} cannot be read: {error}") from error
            self._open.move_to_end(id)
            while len(self._open) > 1 and sum(each.bytes for each in self._open.values()) > _OPEN_BYTES:
                self._open.popitem(last=False)
            return self._open[id]

    # ---- retrospective traces --------------------------------------------------------------------------------------

    def make_retrospective(
        self, session: Session, signals: tuple[str, ...], scans: int, last: int | None, every: int, author: str
    ) -> RetrospectiveChanged:  # fmt: skip
        """Begins to record so many scans that are over, up to `last` (None: the newest); how far it is comes as
        `RetrospectiveChanged` events."""
        live = max(session.state.scan, session.state.live_scan)
        if not 0 < len(signals) <= MAX_SIGNALS or len(set(signals)) < len(signals):
            raise Refused(f"{len(set(signals))} different signals: a record has 1 to {MAX_SIGNALS}")
        if not 0 < scans <= MAX_SCANS:
            raise Refused(f"{scans:,} scans cannot be recorded: from 1 to {MAX_SCANS:,}")
        last = live - 1 if last is None else last
        first = max(0, last - scans + 1)
        if session.state.state == "starting":
            raise Refused("the PLC is still starting: try again when it runs")
        if not 0 <= last < live:
            raise Refused(f"scan {last:,} is not over yet: the PLC is at scan {live:,}")
        if len(self._retrospectives) >= MAX_AT_ONCE:
            raise Refused(
                f"{len(self._retrospectives)} records of earlier scans are being made: wait for one, or cancel it"
            )
        id, self._next = self._next, self._next + 1
        file = self._directory / f"retrospective-{fresh_token()}"
        retrospective = self._retrospectives[id] = _Retrospective(
            session, RetrospectiveChanged(id, author, 0, last - first + 1), file, every, self._known
        )
        if len(self._known) >= KNOWN:
            del self._known[min(self._known)]
        run, to = str(session.instance.run_file), str(file)
        retrospective.task = asyncio.get_running_loop().create_task(
            self._make_record(
                id, retrospective, lambda ref: RecordRetrospective(ref, run, signals, every, first, last, to)
            )
        )
        self._tasks.add(retrospective.task)
        retrospective.task.add_done_callback(self._tasks.discard)
        retrospective.tell(retrospective.changed)
        return retrospective.changed

    def retrospective(self, id: int) -> RetrospectiveChanged:
        """How far one is, and what came of it; the last 20 of the server are known."""
        if id not in self._known:
            raise NotFound(f"there is no retrospective trace {id}: it was forgotten, or the server has started again")
        return self._known[id]

    async def cancel(self, id: int) -> None:
        """Gives a retrospective trace up."""
        retrospective = self._retrospectives.pop(id, None)
        if retrospective is None or retrospective.task is None:
            raise Refused("this record is over already")
        retrospective.tell(replace(retrospective.changed, message="cancelled"))
        retrospective.task.cancel()
        await asyncio.wait((retrospective.task,))

    async def _make_record(self, id: int, retrospective: _Retrospective, make: Make) -> None:
        async def on_part(part: object) -> None:
            if isinstance(part, RetrospectiveAt):
                retrospective.tell(replace(retrospective.changed, done=part.done))

        try:
            try:
                done = await alone(self._cache, make, RetrospectiveDone, on_part)
            finally:
                self._retrospectives.pop(id, None)  # from now on it cannot be cancelled
            kept = await self._finished(retrospective, done)
            retrospective.tell(replace(retrospective.changed, done=retrospective.changed.of, record=kept.row.id))
        except Refused as why:
            retrospective.tell(replace(retrospective.changed, message=why.message))
        except Exception:
            log.exception("earlier scans could not be recorded")
            retrospective.tell(replace(retrospective.changed, message=FAULT))
        finally:
            with suppress(OSError):
                await asyncio.to_thread(retrospective.file.unlink, True)

    async def _finished(self, retrospective: _Retrospective, done: RetrospectiveDone) -> TraceRecord:
        content: Json = {
            "origin": "retrospective", "signals": [asdict(each) for each in done.signals], "every": retrospective.every,
            "triggered": None, "first": done.first, "end": done.end, "rows": done.rows,
            "interval_ns": done.interval_ns, "version": done.version,
        }  # fmt: skip
        name = f"Scans {done.first:,} to {max(done.first, done.end - 1):,}"
        try:
            return await self._keep(
                retrospective.session, name, content, retrospective.file.replace, retrospective.changed.by
            )
        except Exception as error:  # whatever it is, somebody waits for it
            raise Refused(f"the record cannot be kept: {error}") from error

    def _path(self, id: int) -> Path:
        return self._directory / f"{id}{SUFFIX}"


def _loaded(path: Path, record: TraceRecord) -> TraceBuffer:
    pages = read_pages(path, record.rows)
    return buffer_of(pages, [(each.kind, each.size) for each in record.signals], record.rows)


def _record(row: KeptRow) -> TraceRecord:
    content = {**row.content, "row": row}
    if content.get("origin") == "flight":  # what a retrospective trace was called before 0.1.0
        content["origin"] = "retrospective"
    try:
        return make_kept(TraceRecord, content)
    except BadValue as error:
        raise unreadable(f"the record {row.name}", error) from error
