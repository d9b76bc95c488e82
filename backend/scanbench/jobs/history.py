"""In a job process: questions about the past of runs. Run files stay open between questions."""

from pathlib import Path

from scanbench.engines.available import flavours
from scanbench.engines.cache import BlobCache
from scanbench.engines.observe import MakeObserved
from scanbench.faults.agenda import agenda_of_faults
from scanbench.history.changes import find_changes
from scanbench.history.divergence import OnProgress, find_divergence
from scanbench.history.rerun import rerun
from scanbench.history.scenario import write_scenario
from scanbench.history.scenario_of_run import scenario_of
from scanbench.history.writer import find_writer
from scanbench.host.run_files import ProgramOf, programs_by, texts_in
from scanbench.recording.programs import on
from scanbench.recording.reader import RunReader
from scanbench.wire.codec import ENTRIES
from scanbench.wire.verification import (
    NOW,
    ChangesFound,
    CompareRuns,
    FindChanges,
    FindWriter,
    MakeScenario,
    RerunDone,
    RerunRun,
    RunsCompared,
    ScenarioMade,
    WriterFound,
)

_OPEN = 3
"""Run files that stay open."""
Request = FindWriter | FindChanges | CompareRuns | RerunRun | MakeScenario
Answer = WriterFound | ChangesFound | RunsCompared | RerunDone | ScenarioMade


class HistoryJob:
    """Keeps the run files that were asked about."""

    def __init__(self, program_of: ProgramOf, cache: BlobCache | None, observed: MakeObserved) -> None:
        self._observed = observed
        code = flavours(cache)
        self._prober = code.probed(aside=False)
        self._programs_of = programs_by(program_of, on(code))
        self._open: dict[str, RunReader] = {}

    def answer(self, ask: Request, on_progress: OnProgress) -> Answer:
        """The answer; raises what is wrong with it."""
        reader = self._reader(ask.run, ask.until)
        match ask:
            case FindWriter():
                scan = reader.end if ask.scan == NOW else ask.scan
                return WriterFound(ask.ref, find_writer(reader, ask.path, scan, self._prober))
            case MakeScenario():
                scan = reader.end if ask.scan == NOW else ask.scan
                return ScenarioMade(ask.ref, write_scenario(scenario_of(reader, scan)))
            case FindChanges():
                other = self._reader(ask.other, ask.other_until) if ask.other else None
                return ChangesFound(ask.ref, find_changes(reader, ask.first, ask.last, other))
            case CompareRuns():
                other = self._reader(ask.other, ask.other_until)
                return RunsCompared(ask.ref, find_divergence(reader, other, on_progress))
            case RerunRun():
                agenda = agenda_of_faults(self._observed)
                made = rerun(
                    reader, Path(ask.to), ask.change, ask.author, self._programs_of, ENTRIES, agenda, on_progress
                )
                return RerunDone(ask.ref, made.scan, made.refused)

    def _reader(self, run: str, until: int) -> RunReader:
        reader = self._open.pop(run, None) or RunReader(Path(run), self._programs_of, ENTRIES, texts_in)
        self._open[run] = reader  # the dict keeps the order of use: the last one used is last
        while len(self._open) > _OPEN:
            self._open.pop(next(iter(self._open))).close()
        reader.follow(until or None)
        return reader
