"""Recorded runs for tests: the sources that a run file keeps are the text of one program."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.recording import DEFAULT_LIMIT
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Refusal
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import EngineFactory, Loaded, NoProgram
from scanbench.runtime.resource import Resource
from scanbench.wire.codec import ENTRIES
from tests.runtime.bench import program

COUNTER = """
PROGRAM Main
VAR n, other : DINT; d : DINT := 1; q : DINT; list : ARRAY[0..99] OF DINT; start AT CIO 0.00 : BOOL;
  motor AT CIO 100.00 : BOOL; t : TON; END_VAR
VAR RETAIN kept : DINT; END_VAR
  n := n + 1; kept := kept + n; list[n MOD 100] := kept; motor := start; q := q + 1000 / d;
  t(IN := start, PT := T#50ms);
END_PROGRAM
"""
SECOND = COUNTER.replace("n := n + 1", "n := n + 3").replace("VAR n,", "VAR first : LINT; n,")
THIRD = COUNTER.replace("VAR n, other", "VAR other, n").replace("DINT; t : TON", "DINT; more : STRING[7]; t : TON")


class SourcePrograms:
    """Programs made of what a run file kept."""

    def __init__(self, sources: Mapping[int, str], engine: EngineFactory = ReferenceEngine) -> None:
        self.sources = dict(sources)
        self._engine = engine
        self._loaded: dict[int, Loaded] = {}

    def get(self, version: int) -> Loaded:
        if version not in self.sources:
            raise NoProgram(f"there is no program version {version}")
        if version not in self._loaded:
            self._loaded[version] = Loaded.make(program(self.sources[version]), self._engine, version)
        return self._loaded[version]


def of_file(kept: Mapping[int, KeptProgram]) -> SourcePrograms:
    return SourcePrograms({each.version: each.sources.decode() for each in kept.values()})


def of_file_native(kept: Mapping[int, KeptProgram]) -> SourcePrograms:
    return SourcePrograms({each.version: each.sources.decode() for each in kept.values()}, NativeEngine)


@cache
def spare(engine: EngineFactory) -> SourcePrograms:
    """The programs of these tests by version, made once."""
    return SourcePrograms({1: COUNTER, 2: SECOND, 3: THIRD}, engine)


def begun(
    path: Path, source: str = COUNTER, engine: EngineFactory = ReferenceEngine, limit: int = DEFAULT_LIMIT
) -> Timeline:
    programs = SourcePrograms({1: source, 2: SECOND, 3: THIRD}, engine)
    return Timeline.begin(path, programs, 1, source.encode(), ENTRIES, "Ada", None, limit)


def resumed(path: Path, until: int = 0, limit: int = DEFAULT_LIMIT) -> Timeline:
    return Timeline.resume(path, of_file, ENTRIES, until, None, limit)


def advance(timeline: Timeline, scans: int) -> Resource:
    """So many scans further, however often it comes back; a trap ends it."""
    end = timeline.live_scan + scans
    while timeline.live_scan < end and timeline.resource.runnable:
        timeline.run(end - timeline.live_scan)
    if not timeline.resource.header.halted_by_trap:
        timeline.resource.pass_time(end - timeline.live_scan)
    return timeline.resource


def tidy(timeline: Timeline) -> None:
    """Brings the file back within its bounds, if it is outside."""
    timeline.note()
    timeline.recording.wait()
    timeline.note()


def to_program(timeline: Timeline, version: int, source: str) -> str:
    """Changes to another program; the refusal, if there is one."""
    if version not in timeline.recording.programs:
        refusal = timeline.add_program(version, source.encode())
        assert refusal is None, refusal
    outcome = timeline.submit(ProgramChange("Ada", version))
    return outcome.message if isinstance(outcome, Refusal) else ""
