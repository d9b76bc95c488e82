"""Writes history and log in the background: a command never waits for the database.

A PLC can do more in a second than a database writes in one. So what waits is state, not jobs: of an error's row only the
newest counts, and of lines only so many are kept anyway. While the database cannot be used (its disk is full, say) it waits,
and is written when it can.
"""

import asyncio
import logging
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from datetime import datetime
from typing import TypeVar, get_args

from scanbench.faults.acknowledge import Acknowledged
from scanbench.faults.history import ErrorRow, RowReaction, instance_of
from scanbench.faults.reference import error_of
from scanbench.plcmodel.model import Model
from scanbench.reports.reaction_json import from_json, to_json
from scanbench.session.keeper import Keeper
from scanbench.store.records import HistoryRow, Json, LogRow, NotFound, StoreError
from scanbench.store.store import Store
from scanbench.wire.events import LogEntry
from scanbench.wire.host import MarkKind

log = logging.getLogger("scanbench")
LOG_KEPT = 1_000_000
"""Lines of each instance; older ones go, which the page of the log says."""
LOG_WAITING = 200_000
"""Lines of each instance that wait while the database cannot be used; older ones are lost, and the log says how many."""
LOG_TRIMMED_EVERY = 1000
AGAIN_S = 1.0
"""When it is tried again what the database refused."""
_Rows = dict[int, dict[tuple[int, str], ErrorRow]]
_Lines = dict[int, deque[LogRow]]
_Breakpoints = dict[int, Sequence[Json]]
_Traces = dict[int, Mapping[int, Json]]
_T = TypeVar("_T")
_KINDS: dict[str, MarkKind] = {kind: kind for kind in get_args(MarkKind)}


class WriteBehind(Keeper):
    """One task that writes what has changed since its last turn, over and over."""

    def __init__(self, store: Store, kept: int = LOG_KEPT, waiting: int = LOG_WAITING) -> None:
        self._store, self._kept, self._most = store, kept, waiting
        self._lost: dict[int, int] = {}
        self._rows: _Rows = {}
        self._lines: _Lines = {}
        self._breakpoints: _Breakpoints = {}
        self._traces: _Traces = {}
        self._refused = False
        self._untrimmed: dict[int, int] = {}
        """Lines of an instance since old ones were deleted; only the thread that writes uses it."""
        self._wake, self._written = asyncio.Event(), asyncio.Event()
        self._task: asyncio.Task[None] | None = None

    def start(self) -> None:
        """Begins to write."""
        self._task = asyncio.get_running_loop().create_task(self._work())

    async def flush(self) -> None:
        """Waits until everything so far is written: for the turn that begins next, whatever comes meanwhile."""
        if self._task is not None:
            written = self._written
            self._wake.set()
            await written.wait()

    async def close(self) -> None:
        """Writes the rest, and ends."""
        await self.flush()
        task, self._task = self._task, None
        if task is not None:
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)

    def keep_rows(self, instance: int, rows: Sequence[ErrorRow]) -> None:
        """Error history rows that changed, of whatever version."""
        if rows:
            self._rows.setdefault(instance, {}).update(((row.program_version, row.key), row) for row in rows)
            self._wake.set()

    def keep_line(self, instance: int, line: LogEntry, version: int) -> None:
        """A line of the log, while this version of the program runs."""
        lines = self._lines.setdefault(instance, deque())
        lines.append(LogRow(line.at, line.scan, line.author, line.kind, line.text, version))
        self._bound(instance, lines)
        self._wake.set()

    def _bound(self, instance: int, lines: deque[LogRow]) -> None:
        """No more than may wait, and how many were lost."""
        while len(lines) > self._most:
            lines.popleft()
            self._lost[instance] = self._lost.get(instance, 0) + 1

    def keep_breakpoints(self, instance: int, breakpoints: Sequence[Json]) -> None:
        """The breakpoints that everybody shares, all of them."""
        self._breakpoints[instance] = breakpoints
        self._wake.set()

    def keep_traces(self, instance: int, traces: Mapping[int, Json]) -> None:
        """The traces of an instance, all of them."""
        self._traces[instance] = traces
        self._wake.set()

    async def _work(self) -> None:
        while True:
            await self._wake.wait()
            self._wake.clear()
            rows, lines, breakpoints, written = self._rows, self._lines, self._breakpoints, self._written
            self._rows, self._lines, self._breakpoints, self._written = {}, {}, {}, asyncio.Event()
            traces, self._traces = self._traces, {}
            try:
                await asyncio.to_thread(self._write, rows, lines, breakpoints, traces)
                self._refused = False
            except StoreError as error:
                if not self._refused:
                    log.error("history, log, breakpoints and traces wait to be written: %s", error)
                self._refused = True
                self._put_back(rows, lines, breakpoints, traces)
                asyncio.get_running_loop().call_later(AGAIN_S, self._wake.set)
            written.set()

    def _write(self, rows: _Rows, lines: _Lines, breakpoints: _Breakpoints, traces: _Traces) -> None:
        """What is written is taken out; `StoreError` when the rest cannot be written now."""
        while rows:
            instance, changed = next(iter(rows.items()))
            self._keep_rows(instance, list(changed.values()))
            del rows[instance]
        while lines:
            instance, more = next(iter(lines.items()))
            self._keep_lines(instance, more)
            del lines[instance]
        while breakpoints:
            instance, shared = next(iter(breakpoints.items()))
            self._keep_breakpoints(instance, shared)
            del breakpoints[instance]
        while traces:
            instance, contents = next(iter(traces.items()))
            self._keep_traces(instance, contents)
            del traces[instance]

    def _put_back(self, rows: _Rows, lines: _Lines, breakpoints: _Breakpoints, traces: _Traces) -> None:
        """Before what has come meanwhile."""
        for instance, changed in rows.items():
            self._rows[instance] = changed | self._rows.get(instance, {})
        for instance, more in lines.items():
            self._lines[instance] = deque([*more, *self._lines.get(instance, ())])
            self._bound(instance, self._lines[instance])
        self._breakpoints = breakpoints | self._breakpoints
        self._traces = traces | self._traces

    def _keep_breakpoints(self, instance: int, shared: Sequence[Json]) -> None:
        def write(_all: Sequence[object]) -> None:
            self._store.breakpoints.keep(instance, shared)

        _write_most(f"the breakpoints of instance {instance}", [shared], write)

    def _keep_traces(self, instance: int, contents: Mapping[int, Json]) -> None:
        def write(_all: Sequence[object]) -> None:
            self._store.traces.keep(instance, contents)

        _write_most(f"the traces of instance {instance}", [contents], write)

    def _keep_rows(self, instance: int, rows: Sequence[ErrorRow]) -> None:
        def write(some: Sequence[ErrorRow]) -> None:
            self._store.errors.keep(instance, list(map(_kept, some)))

        _write_most(f"the error history of instance {instance}", list(rows), write)

    def _keep_lines(self, instance: int, lines: deque[LogRow]) -> None:
        """What is written is taken out of the lines: a line would otherwise be there twice when it is tried again."""
        untrimmed = self._untrimmed.get(instance, LOG_TRIMMED_EVERY) + len(lines)
        due = untrimmed > LOG_TRIMMED_EVERY

        def write(some: Sequence[LogRow]) -> None:
            self._store.log.add(instance, some, self._kept if due else None)

        if lost := self._lost.pop(instance, 0):
            first = lines[0]
            said = f"{lost:,} lines before this one could not be kept, as the database could not be used"
            lines.appendleft(LogRow(first.at, first.scan, "server", "system", said, first.program_version))
        left = list(lines)
        try:
            _write_most(f"the log of instance {instance}", left, write)
        finally:
            lines.clear()
            lines.extend(left)
        self._untrimmed[instance] = 0 if due else untrimmed


def _write_most(what: str, items: list[_T], write: Callable[[Sequence[_T]], None]) -> None:
    """All of them at once; where one cannot be written, all others, in their order. The PLC goes on in any case.

    `items` keeps what is neither written nor given up: nothing, or after a `StoreError` what is to be tried again.
    """
    count = len(items)
    while items:
        some = items[:count]
        try:
            write(some)
        except StoreError:  # no database: none of them can be written now
            raise
        except NotFound as error:  # deleted meanwhile: none of them ever
            log.error("%s could not be written, %d of it: %s", what, len(items), error)
            items.clear()
            return
        except Exception:
            if len(some) > 1:
                count = len(some) // 2
                continue
            log.exception("a line of %s could not be written: %r", what, some[0])
        del items[: len(some)]
        count = len(items)


def _kept(row: ErrorRow) -> HistoryRow:
    """A row for the store. Only errors that were raised have one."""
    assert row.generated_at is not None
    cleared = row.status == "cleared" and row.recovered_at is not None
    reaction = row.reaction
    found = None if reaction is None else reaction.found
    return HistoryRow(
        row.key, row.program_version, "cleared" if cleared else "generated", row.code, row.details, row.generated_at,
        row.recovered_at if cleared else None, row.generated_scan or 0,
        (row.recovered_scan or 0) if cleared else None, row.by or "", row.origin or "simulator", row.count,
        None if reaction is None else reaction.state, None if found is None else to_json(found),
        "" if reaction is None else reaction.message,
        row.recovered_by if cleared else "", row.recovered_way if cleared else None,
        None if row.acknowledged is None else {**asdict(row.acknowledged), "at": row.acknowledged.at.isoformat()},
    )  # fmt: skip


def row_of(model: Model, kept: HistoryRow) -> ErrorRow:
    """A row as the store has it. An error that only the catalogue of a different version has is shown by its id."""
    id = error_of(kept.error)
    error = model.error(id)
    name = id if error is None else error.name
    instance = kept.error if ":" in kept.error else instance_of(error, id, kept.details)
    return ErrorRow(
        id, name, "nonfatal" if error is None else error.severity, kept.status, kept.code, kept.details, kept.generated_at, kept.recovered_at,
        kept.generated_scan, kept.recovered_scan, kept.by, kept.origin, kept.count, _reaction_of(kept),
        kept.program_version, recovered_by=kept.recovered_by, recovered_way=kept.recovered_way,
        acknowledged=_acknowledged(kept.acknowledged), instance=instance,
    )  # fmt: skip


def _acknowledged(kept: Json | None) -> Acknowledged | None:
    """What cannot be understood is taken for not acknowledged."""
    match kept:
        case {"by": str(by), "at": str(at), "scan": int(scan), "remark": str(remark)}:
            try:
                return Acknowledged(by, datetime.fromisoformat(at), scan, remark)
            except ValueError:
                return None
    return None


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
    return LogEntry(kept.at, kept.scan, kept.author, kept.text, _KINDS.get(kept.kind, "system"))
