"""Trace files of real controllers that somebody uploaded, and the mappings that were saved for them."""

import asyncio
import json
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from scanbench.comm.controller.contract import Connection, Unreachable
from scanbench.comm.controller.opening import for_program, open_source
from scanbench.comm.controller.sampling import Sampler
from scanbench.engines.cache import BlobCache
from scanbench.host.program_cache import key_of, recall
from scanbench.jobs.starting import checked_program, model_of
from scanbench.program.program import Program
from scanbench.public import Public
from scanbench.runtime.clock import fresh_token, monotonic_ns
from scanbench.runtime.programs import NoProgram
from scanbench.server.kept import readable, unreadable
from scanbench.session.session import Session
from scanbench.store.records import MappingRow, NotFound
from scanbench.store.store import Store
from scanbench.typed import BadValue, make_kept
from scanbench.verify.trace.bind import check
from scanbench.verify.trace.growing import TIME, controller_table
from scanbench.verify.trace.mapping import BadMapping, TraceMapping, fits
from scanbench.verify.trace.propose import Guess, Proposal, propose, sampled
from scanbench.verify.trace.read import MAX_BYTES, read_trace
from scanbench.verify.trace.table import BadTraceFile, Table, TraceProblem
from scanbench.wire.host import Sources
from scanbench.wire.refused import Refused

KEPT_NS = 3600 * 1_000_000_000
MOST = 20
"""Files at a time; the oldest go."""
LAST = "Last import"
"""Name of the mapping with which somebody verified last: what was put right once is proposed the next time."""
SAMPLE = 20
"""Rows that are shown."""


@dataclass(frozen=True, slots=True)
class TraceFile:
    """A file that was read. One with problems has no handle: nothing is kept of it."""

    handle: str
    name: str
    path: Path
    columns: tuple[str, ...]
    rows: int
    sample: tuple[tuple[str, ...], ...]
    proposal: TraceMapping
    problems: tuple[TraceProblem, ...]
    guesses: tuple[Guess, ...] = ()
    layout: str = ""
    """Whose layout it has; empty: ours."""
    left_out: tuple[str, ...] = ()
    """What the file has besides its columns."""
    at: int = 0
    connection: Connection | None = None
    """It is no file, but a controller that is read while it is verified."""
    table: Table | None = None
    """Its first sample."""


@dataclass(frozen=True, slots=True)
class Checked(Public):
    """Whether a file can be verified with a mapping."""

    PUBLIC: ClassVar = "TraceMappingChecked"

    ok: bool
    """Whether it can; warnings do not prevent it."""
    problems: tuple[TraceProblem, ...]
    """The first 200."""
    first: int | None
    """Scans `first` to `last`."""
    last: int | None
    missing: int
    """Scans in between that the file does not have."""


class TraceFiles:
    """`directory` has the files, for an hour."""

    def __init__(self, store: Store, directory: Path, cache: Path) -> None:
        self._store, self._directory, self._cache = store, directory, BlobCache(cache)
        self._files: dict[str, TraceFile] = {}
        self._reading = asyncio.Lock()

    def tidy(self) -> None:
        """Removes what an earlier server has left."""
        self._directory.mkdir(parents=True, exist_ok=True)
        for path in self._directory.iterdir():
            path.unlink(missing_ok=True)

    def get(self, handle: str) -> TraceFile:
        """A file that was uploaded."""
        file = self._files.get(handle)
        if file is None:
            raise NotFound("this trace file is not here any more: choose it again")
        return file

    async def upload(self, project: int, name: str, data: bytes, sources: Sources | None) -> TraceFile:
        """Reads a file; a mapping of the project that fits is proposed, else one by names of the program."""
        if len(data) > MAX_BYTES:
            raise Refused(f"nothing was imported: the file is larger than {MAX_BYTES >> 20} MiB")
        saved = await self.mappings(project)
        async with self._reading:  # one at a time, as they are large
            try:
                table = await asyncio.to_thread(read_trace, data, name)
            except BadTraceFile as bad:
                return TraceFile("", name, Path(), (), 0, (), TraceMapping(), bad.problems)
            proposal = await asyncio.to_thread(self._proposal, table, saved, sources)
            handle = fresh_token()
            path = self._directory / handle
            try:
                await asyncio.to_thread(path.write_bytes, data)
            except OSError as error:
                raise Refused(f"the file cannot be kept: {error.strerror}") from error
        await self._forget()
        file = self._files[handle] = TraceFile(
            handle, name, path, table.columns, len(table.rows), tuple(table.rows[:SAMPLE]), proposal.mapping, (),
            proposal.guesses, table.layout, table.left_out, monotonic_ns(),
        )  # fmt: skip
        return file

    async def connect(self, project: int, connection: Connection, sources: Sources | None) -> TraceFile:
        """Asks a controller what there is to read, and reads it once; a mapping is proposed as for a file."""
        try:
            connection = await self._wanted(connection, sources)
        except Unreachable as error:
            raise Refused(error.message) from error
        sampler = Sampler(connection, open_source, lambda _: None)
        try:
            found = await sampler.begin()
            first = await sampler.once(range(len(found.columns)))
        except Unreachable as error:
            raise Refused(error.message) from error
        finally:
            await sampler.close()
        table = controller_table(connection.address, (TIME, *found.columns), ("0", *first.cells))
        saved = await self.mappings(project)
        async with self._reading:
            proposal = await asyncio.to_thread(self._proposal, table, saved, sources)
        await self._forget()
        handle = fresh_token()
        file = self._files[handle] = TraceFile(
            handle, connection.address, self._directory / handle, table.columns, 1, tuple(table.rows),
            sampled(proposal.mapping, connection.interval_ms, TIME), (), proposal.guesses, connection.protocol, found.left_out,
            monotonic_ns(), connection, table,
        )  # fmt: skip
        return file

    async def _wanted(self, connection: Connection, sources: Sources | None) -> Connection:
        """With what is read of it where nobody said so; `Unreachable`."""
        if not connection.by_fins or sources is None:
            return connection
        try:
            return for_program(connection, await asyncio.to_thread(self._program, sources))
        except NoProgram:
            return connection

    async def check(self, session: Session, file: TraceFile, mapping: TraceMapping) -> Checked:
        """Whether it can be verified with this mapping, and if not, where it cannot."""
        sources = session.instance.sources

        def work() -> Checked:
            try:
                table = file.table or read_trace(file.path.read_bytes(), file.name)
                found = check(table, mapping, self._program(sources))
            except OSError as error:
                raise Refused(f"the file cannot be read: {error.strerror}: choose it again") from error
            except (NoProgram, BadMapping) as error:
                raise Refused(str(error)) from error
            return Checked(found.ok, found.problems, found.first, found.last, found.missing)

        async with self._reading:
            return await asyncio.to_thread(work)

    def _proposal(self, table: Table, saved: list[MappingRow], sources: Sources | None) -> Proposal:
        """A saved mapping that fits; else by names, where columns that any of them knows are what they were."""
        learned: dict[str, str] = {}
        for mapping in readable(sorted(saved, key=lambda each: each.name != LAST), mapping_of):
            if fits(mapping, table):
                return Proposal(mapping, ())
            known = {each.column: each.path for each in mapping.columns if each.path and each.role != "ignore"}
            learned = known | learned
        if sources is None:
            return Proposal(TraceMapping(), ())
        try:
            return propose(table, self._program(sources), learned)
        except NoProgram:
            return Proposal(TraceMapping(), ())

    def _program(self, sources: Sources) -> Program:
        model = model_of(sources)
        return recall(self._cache, key_of(sources, model)) or checked_program(sources, model)

    async def _forget(self) -> None:
        now = monotonic_ns()
        old = [handle for handle, file in self._files.items() if now - file.at > KEPT_NS]
        old += list(self._files)[: max(0, len(self._files) - len(old) - MOST + 1)]
        for handle in dict.fromkeys(old):
            file = self._files.pop(handle)
            await asyncio.to_thread(file.path.unlink, True)

    # ---- saved mappings -------------------------------------------------------------------------------------------

    async def mappings(self, project: int) -> list[MappingRow]:
        """Those of a project, by name."""
        return await asyncio.to_thread(self._store.mappings.all, project)

    async def save_mapping(self, project: int, name: str, mapping: TraceMapping, author: str) -> MappingRow:
        """Saves one; it replaces that of the same name."""
        try:
            kept = TraceMapping.from_json(mapping.to_json())
        except BadMapping as bad:
            raise Refused(str(bad)) from bad
        content = json.loads(kept.to_json())
        return await asyncio.to_thread(self._store.mappings.save, project, name, content, author)

    async def delete_mapping(self, mapping: int) -> None:
        """Forgets one."""
        await asyncio.to_thread(self._store.mappings.delete, mapping)


def mapping_of(row: MappingRow) -> TraceMapping:
    """The mapping that was saved."""
    try:
        mapping = make_kept(TraceMapping, {name: _stripped(value) for name, value in row.content.items()})
        if not all(each.column for each in mapping.columns):
            raise BadValue("columns: column must not be empty")
    except BadValue as error:
        raise unreadable(f"the mapping {row.name}", error) from error
    return mapping


def _stripped(value: object) -> object:
    """Without the spaces around texts, with which some mappings were saved."""
    if isinstance(value, str):
        return value.strip()
    if isinstance(value, dict):
        return {name: _stripped(each) for name, each in value.items()}
    return [_stripped(each) for each in value] if isinstance(value, list) else value
