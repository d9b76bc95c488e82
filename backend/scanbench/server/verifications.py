"""The verifications of a server: those that go on, and those that somebody kept."""

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeVar

from scanbench import __version__
from scanbench.comm.controller.contract import Connection
from scanbench.public import iso
from scanbench.reports.report import Report, ReportHead
from scanbench.reports.report_html import to_html
from scanbench.reports.report_json import to_json
from scanbench.reports.report_text import verify_junit
from scanbench.reports.table_csv import to_csv
from scanbench.runtime.clock import monotonic_ns, wall_time
from scanbench.server.controller_verification import ControllerVerification
from scanbench.server.going import GoingFiles
from scanbench.server.kept import readable, unreadable
from scanbench.server.taken_up import before_it, ready, take_up
from scanbench.server.uploads import TraceFile
from scanbench.server.verification import TraceSource, Verification
from scanbench.server.verify_rows import Rows, RowsPage
from scanbench.session.session import Session
from scanbench.store.records import Json, KeptRow, NotFound
from scanbench.store.store import Store
from scanbench.verify.contract import Memory, Range
from scanbench.verify.trace.mapping import TraceMapping
from scanbench.wire.codec import LENGTH, BadMessage, pack, pack_body, unpack_kept
from scanbench.wire.events import VerificationsChanged
from scanbench.wire.refused import Refused
from scanbench.wire.verification import KeptRows
from scanbench.wire.verifying import VerificationStatus, VerifyPace, VerifyWish

A = TypeVar("A")
MOST = 10
"""Verifications that go on at a time: each is a process."""
MOST_OPEN = 30
"""With those that are over: their rows are kept in memory."""
SUFFIX = ".rows"
STARTING_S = 30.0
"""So long a PLC may take to start before one begins."""
_TELL_NS = 200_000_000
Format = Literal["csv", "json", "html", "junit"]
_MEDIA: dict[Format, tuple[str, str]] = {
    "csv": ("csv", "text/csv; charset=utf-8"), "json": ("json", "application/json"), "html": ("html", "text/html; charset=utf-8"),
    "junit": ("xml", "application/xml"),
}  # fmt: skip
"""How a file of a format ends, and its type."""


@dataclass(frozen=True, slots=True)
class Exported:
    """A file for somebody to take away."""

    text: str
    media: str
    name: str


@dataclass(frozen=True, slots=True)
class Kept:
    """A verification that was kept."""

    row: KeptRow
    status: VerificationStatus


class Verifications:
    """`directory` has the rows of what was kept."""

    def __init__(self, store: Store, directory: Path, cache: Path) -> None:
        self._store, self._directory, self._cache = store, directory, cache
        self._all: dict[int, Verification] = {}
        self._next = 1
        self._room = asyncio.Lock()
        self._told: dict[int, tuple[int, VerificationStatus]] = {}
        """Of each when it was told last, and what."""
        self._later: asyncio.TimerHandle | None = None
        self._untold: set[int] = set()
        self._read_last: dict[int, Rows] = {}
        self._going = GoingFiles(directory.with_name("verifying"))
        self._closing = False
        self._taking_up: set[asyncio.Task[None]] = set()

    def tidy(self) -> None:
        """Removes files that belong to nothing any more. Waits for the disk."""
        self._directory.mkdir(parents=True, exist_ok=True)
        projects = self._store.projects.all()
        known = {self._path(row.id) for each in projects for row in self._store.kept.all("verification", each.id)}
        for path in self._directory.iterdir():
            if path not in known:
                path.unlink(missing_ok=True)

    async def close(self) -> None:
        """Ends all of them; they come back when the server starts again."""
        self._closing = True
        for task in self._taking_up:
            task.cancel()
        await asyncio.gather(*self._taking_up, return_exceptions=True)
        if self._later is not None:
            self._later.cancel()
        await asyncio.gather(*(each.end() for each in self._all.values()))
        await self._going.close()

    async def take_up(self, sessions: Mapping[int, Session]) -> None:
        """Those that were there when the server ended: as soon as their PLC has started."""
        for each in await asyncio.to_thread(lambda: list(self._going.all())):
            self._next = max(self._next, each.id + 1)
            status = each.status
            session = sessions.get(status.instance) if isinstance(status, VerificationStatus) else None
            if session is None:
                self._going.forget(each.id)
                continue
            assert isinstance(status, VerificationStatus)
            status = before_it(status)
            trace = TraceSource(each.data, status.trace, each.more["mapping"]) if status.source == "trace" else None
            made = self._all[each.id] = Verification(
                each.id, session, status.wanted, trace, status.by, self._cache, self._on_change, self._hand_over
            )
            work = take_up(made, status, trace, lambda each=made: self._tell(each.session))  # type: ignore[misc]
            task = asyncio.get_running_loop().create_task(work)
            self._taking_up.add(task)
            task.add_done_callback(self._taking_up.discard)

    async def forget_instance(self, instance: int) -> None:
        """Ends those of an instance that goes."""
        for id in [id for id, each in self._all.items() if each.session.id == instance]:
            await self._drop(id)

    # ---- those that go on -----------------------------------------------------------------------------------------

    def of(self, session: Session) -> tuple[VerificationStatus, ...]:
        """Those of an instance, the oldest first."""
        return tuple(each.status for each in self._all.values() if each.session is session)

    async def begin(self, session: Session, wanted: VerifyWish, author: str) -> VerificationStatus:
        """Verifies the run of an instance: a PLC that is starting, as a new branch is, does not know yet which scans it has."""
        try:
            async with asyncio.timeout(STARTING_S):
                await ready(session)
        except TimeoutError:
            raise Refused("the PLC is still starting: try again when it runs") from None
        return await self._begin(session, wanted, None, author)

    async def begin_trace(
        self, session: Session, file: TraceFile, mapping: TraceMapping, range: Range, limit: int, author: str
    ) -> VerificationStatus:  # fmt: skip
        """Verifies a controller log with the program of an instance."""
        trace = TraceSource(file.path, file.name, mapping.to_json())
        return await self._begin(session, VerifyWish(range, "free", 0, None, limit), trace, author, file.connection)

    async def _begin(
        self, session: Session, wanted: VerifyWish, trace: TraceSource | None, author: str,
        connection: Connection | None = None,
    ) -> VerificationStatus:  # fmt: skip
        async with self._room:
            await self._make_room()
            id, self._next = self._next, self._next + 1
            if trace is not None and connection is not None:
                made: Verification = ControllerVerification(
                    id, session, wanted, trace, connection, author, self._cache, self._on_change, self._hand_over
                )
            else:
                made = Verification(id, session, wanted, trace, author, self._cache, self._on_change, self._hand_over)
            self._all[id] = made
        try:
            await made.begin()
        except BaseException:
            await self._drop(id)
            raise
        data = trace.file if trace is not None and connection is None else None
        self._going.keep(id, made.status, {"mapping": "" if trace is None else trace.mapping}, data)
        session.log.add(author, f"verification {id} begins: {made.status.title}")
        return made.status

    async def _make_room(self) -> None:
        """Those that are over give way, the oldest first: their processes at once, their rows when there are many of them."""
        running = [each for each in self._all.values() if each.runs]
        over = [each for each in running if each.over]
        if len(running) >= MOST and not over:
            told = ", ".join(f"{each.status.title} at {each.session.name}" for each in running)
            raise Refused(f"{MOST} verifications go on, and there can be no more: end one of them first ({told})")
        if len(running) >= MOST:
            await over[0].release()
        old = [each for each in self._all.values() if each.over]
        if len(self._all) >= MOST_OPEN and old:
            status = old[0].status
            old[0].session.log.add(status.by, f"verification {status.id} is forgotten, as others began: {status.title}")
            await self._drop(status.id)

    async def drive(
        self, id: int, pace: VerifyPace | None, auto: bool | None, memory: Memory | None, action: str | None, author: str
    ) -> VerificationStatus:  # fmt: skip
        """Changes pace or memory; goes one further; stops or resumes."""
        verification = self.one(id)
        await verification.drive(pace, auto, memory, action, author)
        return verification.status

    async def delete(self, id: int, author: str) -> None:
        """Ends one, and forgets its rows."""
        verification = self.one(id)
        await verification.hold.let_go(author)  # a PLC that waits because of it goes on
        await self._drop(id)

    async def set_cells(self, id: int, edits: tuple[tuple[int, int, str, str], ...], author: str) -> VerificationStatus:
        """Edits inputs of the set data."""
        verification = self.one(id)
        await verification.set_cells(edits)
        return verification.status

    async def rows(self, id: int, first: int, count: int, differing: bool) -> RowsPage:
        """Rows from index `first` on."""
        return await asyncio.to_thread(self.one(id).rows.as_now().page, first, count, differing)

    async def export(self, id: int, format: Format) -> Exported:
        """All rows that are kept, as a file."""
        verification = self.one(id)
        session, status = verification.session, verification.status
        when, rows = iso(wall_time()), verification.rows.as_now()
        project = (await asyncio.to_thread(self._store.projects.get, session.project_id)).name
        head = _head(status, project, session.name, session.instance.sources.model, when)
        return await asyncio.to_thread(_exported, head, rows, format)

    def _hand_over(self, verification: Verification) -> bool:
        others = [each for each in self._all.values() if each is not verification and each.holding]
        heir = next((each for each in others if each.session is verification.session), None)
        if heir is not None:
            heir.hold.held = True
        return heir is not None

    def one(self, id: int) -> Verification:
        """The one of this number; `NotFound`."""
        verification = self._all.get(id)
        if verification is None:
            raise NotFound(f"there is no verification {id}: it was ended, or the server has started again")
        return verification

    async def _drop(self, id: int) -> None:
        verification = self._all.pop(id, None)
        if verification is None:  # two at once
            return
        self._going.forget(id)
        await verification.end()
        self._told.pop(id, None)
        self._tell(verification.session)

    # ---- telling --------------------------------------------------------------------------------------------------

    def _on_change(self, verification: Verification) -> None:
        """At once when something begins or ends, a few times a second while it goes on."""
        id, status, now = verification.status.id, verification.status, monotonic_ns()
        at, before = self._told.get(id, (0, None))
        if before is not None and _phase(status) == _phase(before) and now - at < _TELL_NS:
            self._untold.add(id)
            if self._later is None:
                self._later = asyncio.get_running_loop().call_later(_TELL_NS / 1e9, self._catch_up)
            return
        self._told[id] = now, status
        if status.state not in ("starting", "verifying", "waiting") and not self._closing:
            self._going.keep(id, status, {"mapping": verification.mapping})
        self._untold.discard(id)
        self._tell(verification.session)

    def _catch_up(self) -> None:
        self._later = None
        untold, self._untold = self._untold, set()
        sessions: dict[int, Session] = {}
        for id in untold:
            verification = self._all.get(id)
            if verification is not None:
                self._told[id] = monotonic_ns(), verification.status
                sessions[verification.session.id] = verification.session
        for session in sessions.values():
            self._tell(session)

    def _tell(self, session: Session) -> None:
        session.tell(VerificationsChanged(self.of(session)))

    # ---- those that were kept -------------------------------------------------------------------------------------

    async def records(self, project: int) -> list[Kept]:
        """The newest first."""
        return readable(await asyncio.to_thread(self._store.kept.all, "verification", project), _kept)

    async def record(self, id: int) -> Kept:
        """One that was kept."""
        return _kept(await asyncio.to_thread(self._store.kept.get, "verification", id))

    async def keep(self, id: int, name: str, author: str) -> Kept:
        """Keeps one in the project, as it is now."""
        verification = self.one(id)
        session, status, rows = verification.session, verification.status, verification.rows.as_now()
        if not rows.kept:
            raise Refused("nothing was verified yet: let it run first")
        content: Json = {"status": pack_body(status).hex(), "model": session.instance.sources.model}
        row = await asyncio.to_thread(
            lambda: self._store.kept.keep(
                "verification", session.project_id, name=name, instance=session.name, content=content, by=author
            )
        )
        try:
            await asyncio.to_thread(lambda: self._path(row.id).write_bytes(pack(rows.packed())))
        except OSError as error:
            await asyncio.to_thread(self._store.kept.forget, "verification", row.id)
            raise Refused(f"the record cannot be kept: {error.strerror}") from error
        self._read_last.pop(row.id, None)  # of one that went, also with its project, and had this number
        return _kept(row)

    async def delete_record(self, id: int) -> None:
        """Forgets one that was kept."""
        await asyncio.to_thread(self._store.kept.forget, "verification", id)
        await asyncio.to_thread(self._path(id).unlink, True)

    async def record_rows(self, id: int, first: int, count: int, differing: bool) -> RowsPage:
        """Its rows, as those of a verification."""
        await self.record(id)
        return await self._in_record(id, lambda rows: rows.page(first, count, differing))

    async def export_record(self, id: int, format: Format) -> Exported:
        """Its rows as a file."""
        kept = await self.record(id)
        project = (await asyncio.to_thread(self._store.projects.get, kept.row.project)).name
        head = _head(kept.status, project, kept.row.instance, str(kept.row.content.get("model", "")), iso(kept.row.at))
        return await self._in_record(id, lambda rows: _exported(head, rows, format))

    async def _in_record(self, id: int, find: Callable[[Rows], A]) -> A:
        """What there is in the rows of a record, each of which is read only now."""

        def work() -> A:
            try:
                return find(self._read(id))
            except BadMessage as error:
                raise unreadable("the rows of this record", error) from error

        return await asyncio.to_thread(work)

    def _read(self, id: int) -> Rows:
        """Those that were read last stay in memory: whoever looks at them turns pages."""
        rows = self._read_last.get(id)
        if rows is None:
            try:
                came = unpack_kept(self._path(id).read_bytes()[LENGTH.size :])
            except OSError as error:
                raise Refused(f"the rows of this record cannot be read: {error}") from error
            assert isinstance(came, KeptRows)
            rows = Rows.of(came)
            self._read_last = {id: rows}
        return rows

    def _path(self, id: int) -> Path:
        return self._directory / f"{id}{SUFFIX}"


def _phase(status: VerificationStatus) -> tuple[object, ...]:
    """The part of the status whose changes are reported at once; a live verification waits and goes on many times a second."""
    going = status.state in ("verifying", "waiting") and (status.pace == "free" or status.auto)
    return "going" if going else status.state, status.pace, status.auto, status.memory, status.generation


def _head(status: VerificationStatus, project: str, instance: str, model: str, when: str) -> ReportHead:
    return ReportHead(
        project, instance, model, status.by, when, status.version, status.title, status.source, status.first,
        status.first if status.scan is None else status.scan, status.compared, status.skipped, status.differing,
        f"Scanbench {__version__}", status.trace, status.interval_ns, status.forgotten, status.wanted.limit,
        status.stretches, status.coverage, " ".join(filter(None, (status.note, status.message))),
        full=status.full, not_reached=status.not_reached, sampled=status.sampled, unfinished=status.unfinished,
    )  # fmt: skip


def _exported(head: ReportHead, rows: Rows, format: Format) -> Exported:
    report = Report(head, tuple(rows.columns), tuple(rows.all()), tuple(rows.inputs), tuple(rows.outputs))
    if format == "csv":
        text = "".join(to_csv(report))
    elif format == "json":
        text = to_json(report)
    elif format == "junit":
        text = verify_junit(report)
    else:
        text = to_html(report)
    ending, media = _MEDIA[format]
    return Exported(text, media, f"{head.instance} {head.title}.{ending}".replace("/", "_"))


def _kept(row: KeptRow) -> Kept:
    """The status is kept as the rows are, packed."""
    try:
        status = unpack_kept(bytes.fromhex(str(row.content.get("status"))))
    except (ValueError, BadMessage) as error:
        raise unreadable(f"the record {row.name}", error) from error
    assert isinstance(status, VerificationStatus)
    return Kept(row, status)
