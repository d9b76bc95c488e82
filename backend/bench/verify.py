"""Verification and questions about the past: how fast they are.

`python -m bench.verify [--scans N] [--long N] [--json]`: a run of the conveyor sample is verified, the whole scan and a
range of it, and held against what its task needs and against the reference interpreter alone; then somebody goes to scans
all over a long run, and asks who wrote a variable last.
"""

import argparse
import json
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from functools import partial
from importlib.resources import files
from pathlib import Path
from statistics import median
from time import perf_counter_ns
from tracemalloc import get_traced_memory, start, stop

from bench.reverse import FIRST, SOURCE
from bench.run import INTERVAL_NS, MODEL
from scanbench.check.build import check_sources
from scanbench.engines.available import flavours
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.probed import ProbedBuilds
from scanbench.history.writer import find_writer
from scanbench.host.run_files import sources_in
from scanbench.jobs.starting import checked_program, model_of
from scanbench.plcmodel.load import model_named
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.headless import run_headless
from scanbench.recording.programs import on, programs_of
from scanbench.recording.reader import RunReader
from scanbench.recording.recording import Recording
from scanbench.runtime.programs import Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.server.from_disk import program_files, project_model, read_text
from scanbench.verify.contract import Row
from scanbench.verify.ranges import parse_range
from scanbench.verify.run_subject import RunSubject
from scanbench.verify.verifier import Verifier
from scanbench.wire.codec import ENTRIES, pack_body
from scanbench.wire.host import Sources

SCANS = 3_000
LONG = 1_000_000
SAMPLES = 100
TASK_NS = 10_000_000
RANGE = "Belt"
_STRIDE = 61_803_399
"""From one scan that is gone to to the next: everywhere, in no order."""
_STARTED = (("start", "TRUE", 5), ("start", "FALSE", 10))


@dataclass(frozen=True, slots=True)
class Verified:
    """Scans a second; `task` and `interpreter`: as a ratio to what a task of 10 ms needs, and to the interpreter alone."""

    per_second: float
    task: float
    interpreter: float
    rows: int
    kib_per_10000_rows: float


@dataclass(frozen=True, slots=True)
class Past:
    """Times in ms."""

    scans: int
    open: float
    goto_median: float
    goto_worst: float
    writer_first: float
    """Of a variable written in the first scans only: code for it is made, and all scans are searched."""
    writer_again: float


@dataclass(frozen=True, slots=True)
class Result:
    """What was measured."""

    scans: int
    interpreter_per_second: float
    whole: Verified
    range: Verified
    past: Past


def run_verify(scans: int = SCANS, long: int = LONG) -> Result:
    """Measures it in a directory of its own."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "conveyor")
        program = _conveyor(path, scans)
        plain = _interpreter(program, scans)
        whole, part = (_verified(path, scans, range, plain) for range in ("", RANGE))
        return Result(scans, plain, whole, part, _past(Path(folder, "long"), long))


def _conveyor(path: Path, scans: int) -> Program:
    """The sample, running, recorded."""
    folder = Path(str(files("scanbench").joinpath("samples/conveyor")))
    model = project_model(folder) or MODEL
    texts = {each.relative_to(folder).as_posix(): read_text(each) for each in program_files(folder)}
    program = _built(texts, model, TASK_NS)
    sources = pack_body(Sources(model, texts, TASK_NS, 1))
    with Recording.begin(path, program, 1, sources, ENTRIES, "bench") as recording:
        commands = [(scan, Write("bench", name, value)) for name, value, scan in _STARTED]
        run_headless(program, scans, NativeEngine, commands, recording=recording)
    return program


def _interpreter(program: Program, scans: int) -> float:
    """Scans a second of the reference interpreter alone."""
    resource = Resource(Loaded.make(program, ReferenceEngine))
    resource.run(10)
    begin = perf_counter_ns()
    resource.run(scans)
    return scans / (perf_counter_ns() - begin) * 1e9


def _verified(path: Path, scans: int, range_: str, plain: float) -> Verified:
    with Verifier(_subject(path)) as verifier:
        verifier.begin(parse_range(range_))
        verifier.verify(0)  # code is made
        begin = perf_counter_ns()
        for scan in range(1, scans):
            if any(row.differs for row in verifier.verify(scan).rows):
                raise RuntimeError(f"the sample differs in scan {scan}")
        per_second = (scans - 1) / (perf_counter_ns() - begin) * 1e9
    rows, kib = _memory(path, min(scans, 1000), range_)
    return Verified(per_second, per_second * TASK_NS / 1e9, per_second / plain, rows, kib)


def _subject(path: Path) -> RunSubject:
    return RunSubject(RunReader(path, programs_of(_program_of, on(flavours())), ENTRIES))


def _memory(path: Path, scans: int, range_: str) -> tuple[int, float]:
    """Rows of so many scans, and KiB that 10,000 of them take."""
    with Verifier(_subject(path)) as verifier:
        verifier.begin(parse_range(range_))
        verifier.verify(0)
        start()
        rows: list[Row] = []
        for scan in range(1, scans):
            rows += verifier.verify(scan).rows
        kept, _ = get_traced_memory()
        stop()
    return len(rows), kept / 1024 / max(len(rows), 1) * 10_000


def _past(path: Path, scans: int) -> Past:
    program = _built({"main.st": SOURCE}, MODEL, INTERVAL_NS)
    sources = pack_body(Sources(MODEL, {"main.st": SOURCE}, INTERVAL_NS, 1))
    with Recording.begin(path, program, 1, sources, ENTRIES, "bench") as recording:
        run_headless(program, scans, NativeEngine, recording=recording)
    with RunReader(path, _programs_of, ENTRIES) as reader:
        opened = _ms(lambda: reader.follow(scans))
        goes = [_ms(partial(reader.goto, index * _STRIDE % scans)) for index in range(1, SAMPLES + 1)]
        prober = ProbedBuilds().engine

        def ask(path: str, scan: int) -> None:
            found = find_writer(reader, path, scan, prober)
            if found.by != "program":
                raise RuntimeError(f"{path} was written by {found}")

        first = _ms(lambda: ask("Main.mark", scans))
        again = max(_ms(partial(ask, "Main.mark", FIRST + index * _STRIDE % scans)) for index in range(1, 11))
    return Past(scans, opened, median(goes), max(goes), first, again)


def _programs_of(kept: Mapping[int, KeptProgram]) -> LoadedPrograms:
    programs = LoadedPrograms()
    for version, each in kept.items():
        loaded = Loaded.make(_program_of(each), NativeEngine, version)
        loaded.debug = DebugBuilds().engine(loaded.program, loaded.memory)
        programs.add(loaded)
    return programs


def _program_of(kept: KeptProgram) -> Program:
    sources = sources_in(kept)
    return checked_program(sources, model_of(sources))


def _built(texts: dict[str, str], model: str, interval_ns: int) -> Program:
    checked = check_sources(texts, model_named(model), interval_ns)
    if checked.program is None:
        raise RuntimeError(f"the program of the bench does not build: {checked.problems[0]}")
    return checked.program


def _ms(action: Callable[[], object]) -> float:
    begin = perf_counter_ns()
    action()
    return (perf_counter_ns() - begin) / 1e6


def _report(result: Result) -> str:
    past = result.past
    lines = [
        f"conveyor sample, {result.scans:,} scans; the interpreter alone runs {result.interpreter_per_second:,.0f} a second"
    ]
    for name, each in (("the whole scan", result.whole), (f"the range {RANGE}", result.range)):
        lines.append(
            f"verified, {name}: {each.per_second:,.0f} scans a second ({each.task:.1f} times a 10 ms task, "
            f"{each.interpreter:.2f} of the interpreter); 10,000 rows take {each.kib_per_10000_rows / 1024:.1f} MiB"
        )
    lines += [
        f"a run of {past.scans:,} scans: opened in {past.open:.0f} ms",
        f"goto any scan: median {past.goto_median:.1f} ms, worst of {SAMPLES} {past.goto_worst:.1f} ms",
        f"who wrote last, {past.scans - FIRST:,} scans back: {past.writer_first:.0f} ms; again, worst of 10: {past.writer_again:.0f} ms",
    ]
    return "\n".join(lines)


def main() -> None:
    """Prints it."""
    parser = argparse.ArgumentParser(description="how fast verification and questions about the past are")
    parser.add_argument("--scans", type=int, default=SCANS)
    parser.add_argument("--long", type=int, default=LONG, help="scans of the run that is asked about")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    result = run_verify(options.scans, options.long)
    print(json.dumps(asdict(result)) if options.json else _report(result))  # noqa: T201


if __name__ == "__main__":
    main()
