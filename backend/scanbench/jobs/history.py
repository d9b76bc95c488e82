"""In a job process: questions about the past of runs. Run files stay open between questions."""

from collections.abc import Callable
from pathlib import Path

from scanbench.engines.available import flavours
from scanbench.engines.cache import BlobCache
from scanbench.engines.observe import MakeObserved
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.faults.schedule import Schedule
from scanbench.history.changes import find_changes
from scanbench.history.divergence import find_divergence
from scanbench.history.rerun import rerun
from scanbench.history.writer import find_writer
from scanbench.host.run_files import ProgramOf, programs_by, texts_in
from scanbench.recording.format import RunFileError
from scanbench.recording.programs import on
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.joined import Joined
from scanbench.runtime.programs import NoProgram
from scanbench.wire.codec import ENTRIES
from scanbench.wire.verification import (
    NOW,
    ChangesFound,
    CompareRuns,
    FindChanges,
    FindWriter,
    PastAt,
    RerunDone,
    RerunRun,
    RunsCompared,
    WriterFound,
)

_TELL_NS = 250_000_000
_OPEN = 3
"""Run files that stay open."""
Request = FindWriter | FindChanges | CompareRuns | RerunRun
REFUSALS = (Unreadable, NoProgram, RunFileError, OSError)


class HistoryJob:
    """Keeps the run files that were asked about."""

    def __init__(
        self, program_of: ProgramOf, cache: BlobCache | None, observed: MakeObserved, say: Callable[[object], None]
    ) -> None:  # fmt: skip
        self._observed, self._say = observed, say
        code = flavours(cache)
        self._prober = code.probed(aside=False)
        self._programs_of = programs_by(program_of, on(code))
        self._open: dict[str, RunReader] = {}

    def on_request(self, ask: Request) -> None:
        """Answers it; whatever is wrong with it is told in the answer."""
        match ask:
            case FindWriter():
                self._say(self._writer(ask))
            case FindChanges():
                self._say(self._changes(ask))
            case CompareRuns():
                self._say(self._compared(ask))
            case RerunRun():
                self._say(self._rerun(ask))

    def _writer(self, ask: FindWriter) -> WriterFound:
        try:
            reader = self._reader(ask.run, ask.until)
            scan = reader.end if ask.scan == NOW else ask.scan
            return WriterFound(ask.ref, find_writer(reader, ask.path, scan, self._prober))
        except REFUSALS as why:
            return WriterFound(ask.ref, None, _words(why), getattr(why, "near", ()))

    def _changes(self, ask: FindChanges) -> ChangesFound:
        try:
            other = self._reader(ask.other, ask.other_until) if ask.other else None
            return ChangesFound(ask.ref, find_changes(self._reader(ask.run, ask.until), ask.first, ask.last, other))
        except REFUSALS as why:
            return ChangesFound(ask.ref, None, _words(why))

    def _compared(self, ask: CompareRuns) -> RunsCompared:
        try:
            first, other = self._reader(ask.run, ask.until), self._reader(ask.other, ask.other_until)
            return RunsCompared(ask.ref, find_divergence(first, other, self._telling(ask.ref)))
        except REFUSALS as why:
            return RunsCompared(ask.ref, None, _words(why))

    def _rerun(self, ask: RerunRun) -> RerunDone:
        agenda = Joined(Schedule(self._observed), DisturbanceSchedule())
        try:
            made = rerun(
                self._reader(ask.run, ask.until), Path(ask.to), ask.change, ask.author, self._programs_of, ENTRIES, agenda,
                self._telling(ask.ref),
            )  # fmt: skip
        except REFUSALS as why:
            return RerunDone(ask.ref, False, 0, (), _words(why))
        return RerunDone(ask.ref, True, made.scan, made.refused)

    def _reader(self, run: str, until: int) -> RunReader:
        reader = self._open.pop(run, None) or RunReader(Path(run), self._programs_of, ENTRIES, texts_in)
        self._open[run] = reader  # the last one used stands last
        while len(self._open) > _OPEN:
            self._open.pop(next(iter(self._open))).close()
        reader.follow(until or None)
        return reader

    def _telling(self, ref: int) -> Callable[[int, int], None]:
        told = 0

        def on_progress(done: int, of: int) -> None:
            nonlocal told
            if monotonic_ns() - told > _TELL_NS:
                told = monotonic_ns()
                self._say(PastAt(ref, done, of))

        return on_progress


def _words(why: Exception) -> str:
    return why.strerror or str(why) if isinstance(why, OSError) else str(why)
