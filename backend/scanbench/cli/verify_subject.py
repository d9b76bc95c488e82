"""What `scanbench verify` verifies: the scans of a run file, a project's run that is made on the spot, or a trace."""

import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import NoReturn

import typer

from scanbench.check.build import check_sources
from scanbench.cli.inputs import below, find_model, read_sources, tell_damage, unreadable, unusable, unusable_run, usage
from scanbench.cli.interrupt import leaving
from scanbench.cli.record import check_whole, recorded
from scanbench.cli.run_options import Options, read_commands, read_interval
from scanbench.cli.verify_controller import Controller, read_controller
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.faults.detect import Detection
from scanbench.faults.schedule import Schedule
from scanbench.host.run_files import RUN_SUFFIX, programs_by, sources_in, sources_of, texts_in
from scanbench.jobs.starting import checked_program, model_of
from scanbench.program.program import Program
from scanbench.recording.format import is_run_file
from scanbench.recording.headless import HeadlessRun, run_headless
from scanbench.recording.programs import Make
from scanbench.recording.reader import RunReader, Unreadable, no_programs
from scanbench.recording.recording import Recording
from scanbench.reports.report import Source
from scanbench.runtime.programs import NoProgram
from scanbench.testing.said import with_near
from scanbench.verify.run_subject import RunSubject
from scanbench.verify.trace.bind import check
from scanbench.verify.trace.mapping import BadMapping, TraceMapping
from scanbench.verify.trace.propose import propose
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.subject import TraceSubject
from scanbench.verify.trace.table import BadTraceFile, Table, TraceProblem
from scanbench.verify.verifier import Verifier
from scanbench.wire.codec import ENTRIES
from scanbench.wire.host import Sources

PROBLEMS_SHOWN = 20
_SUFFIXES = (".scanrun", RUN_SUFFIX)
"""What is called like a run is one, however damaged: it is no program text."""


@dataclass(frozen=True, slots=True)
class Subject:
    """Something to verify, and what a report says of it."""

    verifier: Verifier
    project: str
    instance: str
    model: str
    source: Source
    trace: str = ""
    note: str = ""
    trapped: bool = False
    """Of a project: a run-time error ended the run, so scans that were wanted are not there; the note says so."""
    lost: bool = False
    """The run file is damaged: a part of its run is not there to be verified."""
    sampled: bool = False
    """Of a trace: only some scans are known, and inputs are held in between."""


@dataclass(frozen=True, slots=True)
class Given:
    """Options of the command that say what to verify."""

    path: Path
    model: str | None
    interval: str
    options: Options
    scans: int
    """How many a project runs."""
    trace: Path | None
    mapping: Path | None
    controller: Controller | None = None


@contextmanager
def opened(given: Given, make: Make) -> Iterator[Subject]:
    """What was asked for. Ends with exit code 2 where that cannot be."""
    _refuse_what_says_nothing(given)
    if given.trace is not None:
        yield _trace(given, given.trace)
    elif given.controller is not None:
        yield _controller(given, given.controller)
    elif is_run(given.path):
        with _run_file(given.path, make) as (verifier, recording):
            lost = tell_damage(given.path, recording)
            yield Subject(verifier, given.path.stem, given.path.name, recording.about.model, "past", lost=lost)
    else:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "run")
            program, note = ran(given, path)
            with _run_file(path, make) as (verifier, _):
                name = given.path.resolve().name
                yield Subject(
                    verifier, name, "command line", program.layout.model.name, "past", note=note, trapped=bool(note)
                )


def _refuse_what_says_nothing(given: Given) -> None:
    """Options that a project's run has, and what ran already has not."""
    elsewhere = given.trace is not None or given.controller is not None
    if any(asdict(given.options).values()) and (elsewhere or is_run(given.path)):
        what = "what a controller does" if elsewhere else "a recorded run"
        usage(f"--set, --force, --raise, --clear, --mode and --restart are for a project: {what} is taken as it is")
    if given.model is not None and is_run(given.path):
        usage(f"--model is for a project: {given.path.name} was recorded on a model of its own")


def is_run(path: Path) -> bool:
    """Whether this is a run file, and no program."""
    try:
        return path.suffix in _SUFFIXES or (path.is_file() and is_run_file(path))
    except OSError as error:
        unreadable(path, error)


# ---- run files -----------------------------------------------------------------------------------------------------


@contextmanager
def _run_file(path: Path, make: Make) -> Iterator[tuple[Verifier, Recording]]:
    reader = RunReader(path, programs_by(program_of, make), ENTRIES, texts_in)
    try:
        with Verifier(RunSubject(reader)) as verifier:
            yield verifier, reader.recording
    except Unreadable as error:
        unusable_run(path, error)


def program_of(sources: Sources) -> Program:
    """The program of a run file; `NoProgram`."""
    return checked_program(sources, model_of(sources))


# ---- projects ------------------------------------------------------------------------------------------------------


def _program(given: Given) -> tuple[Program, dict[str, str]]:
    """The program of a project, and its files by their names in the project."""
    sources = read_sources([given.path])
    checked = check_sources(
        below(given.path, sources.texts), find_model(given.model, sources), read_interval(given.interval)
    )
    if checked.program is None:
        for problem in checked.problems:
            typer.echo(str(problem), err=True)
        usage(f"{given.path} does not compile, so there is nothing to verify")
    return checked.program, below(given.path, sources.texts)


def ran(given: Given, path: Path) -> tuple[Program, str]:
    """Runs the project and records it; gives the program, and what a report should say about the run."""
    program, files = _program(given)
    commands = read_commands(program, given.options, given.scans)
    with recorded(path, program, files, read_interval(given.interval)) as recording:
        result: HeadlessRun[None] = run_headless(
            program, given.scans, leaving(NativeEngine), commands, detect=Detection(),
            agenda=Schedule(ObservedBuilds().engine), recording=recording,
        )  # fmt: skip
        if recording is not None:
            check_whole(recording)
    for refused in result.refused:
        typer.echo(
            f"scanbench: refused before scan {refused.scan}: {with_near(refused.refusal.message, refused.refusal.near)}",
            err=True,
        )
    if result.refused:
        usage("nothing was verified, as the run is not the one that was asked for")
    trap = result.resource.trap
    if trap is None:
        return program, ""
    return (
        program,
        f"The run ended by a trap in scan {trap.scan}: {trap.message}. No scan after it was run or compared.",
    )


# ---- traces --------------------------------------------------------------------------------------------------------


def _trace(given: Given, path: Path) -> Subject:
    program, files = _program_for_trace(given)
    try:
        table = read_trace(path.read_bytes(), path.name)
    except OSError as error:
        unreadable(path, error)
    except BadTraceFile as error:
        _refuse(path, error.problems)
    if table.layout:
        typer.echo(f"scanbench: {path.name} is read as: {table.layout}. {' '.join(table.left_out)}".rstrip(), err=True)
    mapping, note = _mapping(given.mapping, table, program)
    checked = check(table, mapping, program)
    for problem in checked.problems:
        if problem.warning and checked.trace is not None:
            typer.echo(f"{_where(path, problem)}: {problem.message}", err=True)
    if checked.trace is None:
        _refuse(path, checked.problems)
    verifier = Verifier(TraceSubject(program, checked.trace, files))
    notes = " ".join(filter(None, (table.note, note)))
    return Subject(
        verifier, given.path.resolve().name, "real controller", program.layout.model.name, "trace", path.name, notes,
        sampled=mapping.gaps == "hold",
    )  # fmt: skip


def _controller(given: Given, controller: Controller) -> Subject:
    program, files = _program_for_trace(given)
    notes: list[str] = []

    def mapping_of(table: Table) -> tuple[TraceMapping, bool]:
        mapping, note = _mapping(given.mapping, table, program)
        notes.append(note)
        return mapping, given.mapping is not None

    growing = read_controller(controller, program, mapping_of)
    verifier = Verifier(TraceSubject(program, growing.trace, files))
    verifier.follow(growing.until(last=True))
    notes.append(f"Sampled every {controller.interval_ms:,} ms: what is shorter than that was not seen.")
    return Subject(
        verifier, given.path.resolve().name, "real controller", program.layout.model.name, "trace", controller.address,
        " ".join(filter(None, notes)), sampled=True,
    )  # fmt: skip


def _program_for_trace(given: Given) -> tuple[Program, Mapping[str, str]]:
    """The project's program, or the last one of a run, and its files."""
    if not is_run(given.path):
        return _program(given)
    try:
        with RunReader(given.path, no_programs, ENTRIES) as reader:
            reader.follow()
            tell_damage(given.path, reader.recording)
            with reader.reading():
                model = model_of(sources_in(reader.kept[max(reader.kept)]))
        sources = sources_of(given.path, {model.name: model})
        return checked_program(sources, model), sources.files
    except Unreadable as error:
        unusable_run(given.path, error)
    except NoProgram as error:
        unusable(f"{given.path}: {error}", error)


def _mapping(path: Path | None, table: Table, program: Program) -> tuple[TraceMapping, str]:
    """How the columns are meant, and a note where nobody has said it."""
    if path is not None:
        try:
            return TraceMapping.from_json(path.read_text("utf-8")), ""
        except OSError as error:
            unreadable(path, error)
        except ValueError as error:  # `BadMapping`, and bytes that are no text
            usage(f"{path}: {error}" if isinstance(error, BadMapping) else f"{path} is not UTF-8: {error}")
    made = propose(table, program)
    proposal, sure = made.mapping, {each.column: each.score for each in made.guesses}
    said = "; ".join(
        f"{each.column} is {each.path} ({each.role}{_sure(sure.get(each.column, 1.0))})"
        if each.path
        else f"{each.column} is nothing (ignored)"
        for each in proposal.columns
    )
    note = f"Mapped by names: {said}."
    typer.echo(f"scanbench: no --map, so columns are taken by their names. {note}", err=True)
    return proposal, note


def _sure(score: float) -> str:
    """What is said of a variable that is only likely."""
    return "" if score >= 1 else f", {score:.0%} sure"


def _refuse(path: Path, problems: tuple[TraceProblem, ...]) -> NoReturn:
    wrong = [each for each in problems if not each.warning]
    for problem in wrong[:PROBLEMS_SHOWN]:
        again = f" (the same in {problem.more:,} more rows, the last one is {problem.last})" if problem.more else ""
        typer.echo(f"{_where(path, problem)}: {problem.message}{again}", err=True)
    more = len(wrong) - PROBLEMS_SHOWN
    usage("nothing was verified: the trace cannot be used" + (f" ({more} more problems)" if more > 0 else ""))


def _where(path: Path, problem: TraceProblem) -> str:
    row = "" if problem.row is None else f":{problem.row}"
    return f"{path}{row}" + (f": column {problem.column}" if problem.column else "")
