"""In a job process: one verification. Whatever is wrong with a request is told in its answer."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from scanbench.engines.available import flavours
from scanbench.engines.cache import BlobCache
from scanbench.host.run_files import ProgramOf, programs_by, texts_in
from scanbench.recording.format import RunFileError
from scanbench.recording.programs import on
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.reports.report import stretched
from scanbench.reports.value_text import value_text
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.programs import NoProgram
from scanbench.symbols.symbols import UnknownPath
from scanbench.verify.contract import BadRange, Begun, Column, Row, ScanVerified
from scanbench.verify.run_subject import RunSubject
from scanbench.verify.told_once import ToldOnce
from scanbench.verify.trace.growing import GrowingTrace, controller_table
from scanbench.verify.trace.mapping import BadMapping, TraceMapping
from scanbench.verify.trace.subject import TraceSubject, open_trace
from scanbench.verify.trace.table import BadTraceFile
from scanbench.verify.verifier import BadEdit, Verifier
from scanbench.wire.codec import ENTRIES, pack_body
from scanbench.wire.refused import Refused
from scanbench.wire.verification import (
    BeginController,
    BeginTrace,
    BeginVerify,
    PackedRow,
    RowFlowsAre,
    RowFlowsOf,
    ScansDone,
    ScansVerified,
    SetInputs,
    TakeSamples,
    UseRow,
    UsesAre,
    UsesOf,
    VerifyBegun,
    VerifyScans,
    VerifyStep,
)

S = TypeVar("S", bound=ScansVerified)
_TELL_NS = 100_000_000
Request = (
    BeginVerify
    | BeginTrace
    | BeginController
    | TakeSamples
    | VerifyScans
    | VerifyStep
    | SetInputs
    | UsesOf
    | RowFlowsOf
)
REFUSALS = (Unreadable, NoProgram, RunFileError, BadEdit, BadMapping, BadTraceFile, UnknownPath, OSError)


class VerifyJob:
    """Keeps one verifier."""

    def __init__(
        self, program_of: ProgramOf, cache: BlobCache | None, say: Callable[[object], None], asked: Callable[[], bool]
    ) -> None:  # fmt: skip
        """`asked`: whether a further request waits."""
        self._program_of, self._cache, self._say, self._asked = program_of, cache, say, asked
        self._verifier: Verifier | None = None
        self._growing: GrowingTrace | None = None
        self._once = ToldOnce()

    def answer(self, request: Request) -> VerifyBegun | ScansVerified | UsesAre | RowFlowsAre:
        """The answer; `Refused`."""
        try:
            return self._answer(request)
        except BadRange as bad:
            raise Refused(str(bad), bad.near) from bad
        except REFUSALS as why:
            raise Refused(_words(why)) from why

    def _answer(self, request: Request) -> VerifyBegun | ScansVerified | UsesAre | RowFlowsAre:
        match request:
            case BeginVerify():
                return self._begin(request)
            case BeginTrace():
                return self._begin_trace(request)
            case BeginController():
                return self._begin_controller(request)
            case TakeSamples():
                return self._take(request)
            case VerifyScans():
                verifier = self._begun()
                verifier.follow(request.until)
                return self._scans(request.ref, verifier, range(request.first, request.last + 1))
            case VerifyStep():
                verifier = self._begun()
                verifier.follow(request.until)
                step = verifier.step(request.scan, request.after, request.count)
                for row in step.rows:
                    self._once.stepped(row)
                return _told(ScansDone, request.ref, [step], whole=False)
            case SetInputs():
                rows = self._begun().set_inputs(request.edits)
                return ScansVerified(request.ref, -1, 0, tuple(map(_packed, rows)), (), (), (), 0)
            case UsesOf():
                return self._uses(request)
            case RowFlowsOf():
                return RowFlowsAre(request.ref, self._begun().flows(request.scan, request.call, request.asked))

    def _begun(self) -> Verifier:
        if self._verifier is None:
            raise Unreadable("the verification has not begun")
        return self._verifier

    def _begin(self, ask: BeginVerify) -> VerifyBegun:
        programs = programs_by(self._program_of, on(flavours(self._cache)))
        verifier = Verifier(RunSubject(RunReader(Path(ask.run), programs, ENTRIES, texts_in)))
        self._verifier = verifier
        verifier.follow(ask.until)
        return _begun(ask.ref, verifier.begin(ask.range, ask.limit, ask.first))

    def _begin_trace(self, ask: BeginTrace) -> VerifyBegun:
        data = Path(ask.file).read_bytes()
        verifier = open_trace(data, ask.name, ask.mapping, self._program_of(ask.sources), ask.sources.files)
        self._verifier = verifier
        begun = replace(verifier.begin(ask.range, ask.limit), version=ask.sources.version)
        return _begun(ask.ref, begun)

    def _begin_controller(self, ask: BeginController) -> VerifyBegun:
        program, table = self._program_of(ask.sources), controller_table(ask.address, ask.columns, ask.cells)
        self._growing = GrowingTrace(table, TraceMapping.from_json(ask.mapping), program)
        self._verifier = Verifier(TraceSubject(program, self._growing.trace, ask.sources.files))
        begun = replace(self._verifier.begin(ask.range, ask.limit), version=ask.sources.version)
        return _begun(ask.ref, begun)

    def _take(self, ask: TakeSamples) -> ScansDone:
        verifier, growing = self._begun(), self._growing
        if growing is None:
            raise Unreadable("this is no verification of a controller that runs")
        growing.add(ask.samples)
        until = growing.until(ask.last)
        verifier.follow(until)
        return self._scans(ask.ref, verifier, range(ask.first, until))

    def _scans(self, ref: int, verifier: Verifier, scans: range) -> ScansDone:
        batch: list[ScanVerified] = []
        told = monotonic_ns()
        scan = scans.start
        while scan < scans.stop:
            after = None if self._growing is None else self._growing.after_break(scan)
            last = scan if after is None else min(after, scans.stop) - 1  # a break is told at once, however long it is
            try:
                made = verifier.verify(scan)
                batch.append(replace(made, rows=tuple(map(self._once.rest, made.rows)), last=last))
            except REFUSALS as why:
                return replace(_told(ScansDone, ref, batch), failed=_words(why))
            scan = last + 1
            if self._asked():
                break
            if monotonic_ns() - told > _TELL_NS:
                self._say(_told(ScansVerified, ref, batch))
                batch, told = [], monotonic_ns()
        return replace(_told(ScansDone, ref, batch), coverage=verifier.coverage)

    def _uses(self, ask: UsesOf) -> UsesAre:
        verifier = self._begun()
        columns = verifier.columns
        uses = []
        for use in verifier.uses(ask.scan, ask.call):
            column = columns.get(use.name)
            uses.append(
                UseRow(
                    use.name, use.written, _text(column, use.control), _text(column, use.monitor), use.place.file,
                    use.place.line, use.place.instance,
                )
            )  # fmt: skip
        return UsesAre(ask.ref, tuple(uses))


def _begun(ref: int, begun: Begun) -> VerifyBegun:
    return VerifyBegun(
        ref, begun.title, begun.instances, begun.first, begun.end, begun.interval_ns, begun.version, begun.note
    )  # fmt: skip


def _told(kind: type[S], ref: int, batch: Sequence[ScanVerified], *, whole: bool = True) -> S:
    """`whole`: they are scans, and not steps of one."""
    rows = tuple(_packed(row) for each in batch for row in each.rows)
    skipped: list[tuple[int, int]] = []
    for each in batch if whole else ():
        if not each.compared:
            stretched(skipped, each.scan, max(each.scan, each.last))
    compared = sum(each.compared for each in batch) if whole else 0
    return kind(
        ref, max(batch[-1].scan, batch[-1].last) if batch else -1, compared, rows, _columns(batch),
        tuple(dict.fromkeys(name for each in batch for name in each.inputs)),
        tuple(dict.fromkeys(name for each in batch for name in each.outputs)),
        max((each.used for each in batch), default=0), tuple(skipped), sum(each.idle for each in batch) if whole else 0,
        sum(each.cut and not each.compared for each in batch) if whole else 0,
    )  # fmt: skip


def _packed(row: Row) -> PackedRow:
    return PackedRow(row.scan, row.call, row.count, row.differences[0] if row.differences else None, pack_body(row))


def _columns(batch: Iterable[ScanVerified]) -> tuple[Column, ...]:
    return tuple({column.name: column for each in batch for column in each.columns}.values())


def _text(column: Column | None, value: bytes | None) -> str | None:
    if value is None:
        return None
    return value.hex() if column is None else value_text(column, value)


def _words(why: Exception) -> str:
    if isinstance(why, FileNotFoundError) or isinstance(why.__cause__, FileNotFoundError):
        return "the run has not begun yet: try again when the PLC has started"
    if isinstance(why, BadTraceFile):
        return "; ".join(map(str, why.problems[:3]))
    return why.strerror or str(why) if isinstance(why, OSError) else str(why)
