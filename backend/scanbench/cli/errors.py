"""`scanbench errors`: the errors of a model, and what a program does about each of them."""

import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from enum import StrEnum
from pathlib import Path

import typer

from scanbench.check.build import check_sources
from scanbench.cli import INTERRUPTED
from scanbench.cli.device import clear, log, present
from scanbench.cli.inputs import (
    DIALECT_HELP,
    PARTLY,
    below,
    find_model,
    find_model_named,
    problem_json,
    read_sources,
    tell_damage,
    unreadable,
    usage,
)
from scanbench.cli.interrupt import leaving
from scanbench.cli.outputs import must_be_writable, write_text
from scanbench.cli.progress import progress
from scanbench.cli.requirements import BadRequirements, Grades, read_requirements, wanted_of
from scanbench.cli.run_options import read_interval
from scanbench.cli.sweep_states import START, BadStates, FromRun, State, read_states, run_state, while_present
from scanbench.engines.observe import MakeObserved
from scanbench.faults.reaction.choices import Choices
from scanbench.faults.reaction.compare import Outcome, compare
from scanbench.faults.reaction.reaction import UNTRIED, WINDOW
from scanbench.faults.reaction.required import Required
from scanbench.faults.reaction.required_rules import Rules, rules_of
from scanbench.faults.reaction.side_by_side import sweep_side_by_side
from scanbench.faults.reaction.steps import Point
from scanbench.faults.reaction.sweep import Cell
from scanbench.faults.reference import ErrorRef, error_of, find_error
from scanbench.jobs.starting import checked_program, model_of, point_in
from scanbench.plcmodel.catalogue import ErrorEntry, ErrorGroup, Severity, path_text
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import extended
from scanbench.program.program import Program
from scanbench.public import iso
from scanbench.recording.programs import cached, observed
from scanbench.recording.reader import RunReader, Unreadable, no_programs
from scanbench.reports.sweep_page import sweep_page
from scanbench.reports.sweep_report import (
    NO_SWEEP,
    SweepResult,
    compare_text,
    conditions_apart,
    count,
    is_sweep,
    outcomes_in,
    sweep_json,
    sweep_junit,
    sweep_text,
    table,
)
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Refusal
from scanbench.runtime.header import Header
from scanbench.runtime.programs import NoProgram, Programs
from scanbench.server.from_disk import DEFAULT_MODEL
from scanbench.syntax.requirements import REQUIREMENTS, RequirementsText
from scanbench.wire.codec import ENTRIES
from scanbench.wire.host import Sources

errors = typer.Typer(
    no_args_is_help=True, rich_markup_mode=None, help="Errors of a PLC: list them, and find out what a program does about each."
)  # fmt: skip
_VERSION = 1


class Severities(StrEnum):
    """Which errors a program has to handle."""

    FATAL = "fatal"
    NONFATAL = "nonfatal"
    ALL = "all"


class Require(StrEnum):
    """What an error has to do at least."""

    ACTED = "acted"
    DECIDED = "decided"
    DISPLAYED = "displayed"
    STORED = "stored"
    NO_EFFECT = "no_effect"
    NOT_REACHED = "not_reached"
    NONE = "none"


class SweepEngine(StrEnum):
    """Which engine runs the program."""

    NATIVE = "native"
    REFERENCE = "reference"


# ---- list ----------------------------------------------------------------------------------------------------------


@errors.command("list")
def list_errors(
    project: Path | None = typer.Argument(None, metavar="[PROJECT]", help="A project, for its model and its own errors."),
    model: str | None = typer.Option(None, metavar="NAME", help="PLC model; else the project's, else GENERIC-IEC."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
) -> None:  # fmt: skip
    """List the errors that a model knows: id, code, flag, severity, details. Exit 1: the project's own are not right."""
    if project is None:
        plc = find_model_named(model or DEFAULT_MODEL)
    else:
        sources = read_sources([project])
        plc, problems = extended(find_model(model, sources), below(project, sources.texts))
        for problem in problems:
            typer.echo(str(problem), err=True)
        if problems:
            raise typer.Exit(1)
    entries = list(plc.errors_with_groups())
    if as_json:
        told = {"model": plc.name, "errors": [_entry_json(groups, entry) for groups, entry in entries]}
        typer.echo(json.dumps(told, ensure_ascii=False))
        return
    rows = [("ERROR", "CODE", "FLAG", "SEVERITY", "DETAILS", "NAME")]
    for _, entry in entries:
        details = ", ".join(detail.name for detail in entry.details) or "-"
        rows.append((entry.id, entry.code_text or "-", entry.flag_text, entry.severity, details, entry.name))
    typer.echo("\n".join(table(rows)))


def _entry_json(groups: Iterable[ErrorGroup], entry: ErrorEntry) -> dict[str, object]:
    details = [
        {"name": each.name, "control": each.control, "description": each.description,
         "choices": [choice.id for choice in each.addresses] if each.control == "List" else [],
         "addresses": [place.text for place in each.addresses]}
        for each in entry.details
    ]  # fmt: skip
    return {
        "id": entry.id, "name": entry.name, "description": entry.description, "code": entry.code_text,
        "flag": entry.flag_text, "severity": entry.severity, "priority": entry.priority,
        "group": path_text(group.name for group in groups),
        "verified": entry.verified, "source": entry.source, "user": entry.user, "details": details,
    }  # fmt: skip


# ---- sweep ---------------------------------------------------------------------------------------------------------


@errors.command("sweep")
def sweep_errors(
    project: Path = typer.Argument(metavar="PROJECT", help="A folder with a program, or a program file."),
    model: str | None = typer.Option(None, metavar="NAME", help="PLC model; else project.json's, else GENERIC-IEC."),
    dialect: str | None = typer.Option(None, metavar="NAME", help=DIALECT_HELP),
    states: Path | None = typer.Option(None, metavar="FILE", help="States to begin from (JSON, docs/error-sweep.md); else 100 scans from a cold start."),
    window: int = typer.Option(WINDOW, min=1, max=100_000, metavar="N", help="Scans that the program gets to react."),
    present: list[str] = typer.Option([], "--while", metavar="ERROR", help="Also from each state with this error present; may be given several times: with --only for both, a pair is tried in both orders."),
    severity: list[Severities] = typer.Option([Severities.ALL], help="Which errors count for exit code 1; may be given several times."),
    only: list[str] = typer.Option([], metavar="ID", help="Only this error; may be given several times."),
    interval: str = typer.Option("10ms", help="Task interval if no CONFIGURATION sets one."),
    engine: SweepEngine = typer.Option(SweepEngine.NATIVE, help="native is fast; reference is the interpreter."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object, for `errors compare` too."),
    junit: Path | None = typer.Option(None, metavar="FILE", help="Write a JUnit report too: a test case for each error and state."),
    html: Path | None = typer.Option(None, metavar="FILE", help="Write a page to print too."),
    require: Require = typer.Option(Require.DECIDED, help="What an error has to do at least; less is a finding."),
    requirements: Path | None = typer.Option(None, metavar="FILE", help="What must happen, instead of the project's required.reactions (docs/error-sweep.md); or grades as JSON."),
) -> None:  # fmt: skip
    """Raise every error alone, from each state, and find out what the program does about it.

    Each run is compared with the same run without the error. Exit 0; 1: an error did less than --require says, or the
    program does not compile; 2: wrong usage; 130: interrupted, no finding so far.
    """
    must_be_writable(junit, html)
    sources = read_sources([project], dialect)
    plc = find_model(model, sources)
    given = Sources(plc.name, below(project, sources.texts), read_interval(interval), _VERSION)
    program = _program(given, plc, as_json)
    chosen = _chosen(program.layout.model, only)
    required, rules, grades = _required(require, requirements, program, given)
    make = _engine(engine)
    points = _points(states, present, program, given, make)
    asked = [each.id for each in chosen]
    raised = rules.raised(Choices(program).expand(map(ErrorRef, asked)), asked)
    _tell_unused(grades, raised)
    cells, whole = _swept(points, raised, window, cached({_VERSION: program}, observed(make)), rules)
    tried = {error_of(cell.error) for cell in cells}
    begun = tuple((name, Header(point.state).scan) for name, point in points.items())
    listed = tuple(each for each in chosen if each.id in tried)
    result = SweepResult(project.resolve().name, plc.name, window, begun, listed, cells, tuple(rules.problems))
    severities = _severities(severity)
    unhandled = result.unhandled(severities, required)
    _tell(result, unhandled, as_json)
    _write(result, severities, required, junit, html)
    if not whole:
        typer.echo(f"scanbench: interrupted after {len(tried)} of {count(len(chosen), 'error')}", err=True)
    raise typer.Exit(1 if unhandled or rules.problems else 0 if whole else INTERRUPTED)


def _write(
    result: SweepResult, severities: Sequence[Severity], required: Required, junit: Path | None, html: Path | None
) -> None:
    if junit is not None:
        write_text(junit, sweep_junit(result, severities, required))
    if html is not None:
        write_text(html, sweep_page(result, iso(wall_time()), required))


def _swept(
    points: dict[str, Point], raised: Sequence[ErrorRef], window: int, programs: Programs, rules: Rules
) -> tuple[tuple[Cell, ...], bool]:
    """The cells, and whether they are all; after Ctrl-C those of the errors that were raised in every state."""
    cells: list[Cell] = []
    try:
        of = len(points) * len(raised)
        with progress(of, lambda: len(cells), lambda: f"{len(cells):,} of {of:,} cases"):
            cells.extend(sweep_side_by_side(points, raised, window, programs, rules=rules))
    except KeyboardInterrupt:
        return tuple(cells[: len(cells) - len(cells) % len(points)]), False
    return tuple(cells), True


def _tell(result: SweepResult, unhandled: Sequence[Cell], as_json: bool) -> None:
    if as_json:
        told = sweep_json(result) | {"unhandled": list(dict.fromkeys(cell.error for cell in unhandled))}
        typer.echo(json.dumps(told, ensure_ascii=False))
    else:
        typer.echo("\n".join(sweep_text(result)))
    untried = sum(cell.reaction is None for cell in result.cells)
    if untried:
        some = f"{untried} of {count(len(result.cells), 'case')}"
        typer.echo(f"scanbench: {some}: the error could not be raised, so nothing is known of it there", err=True)
    missing = [each for cell in result.cells for each in cell.required if each.reason in UNTRIED and each.is_finding]
    if missing:
        each = "each" if len(missing) > 1 else "that"
        typer.echo(
            f"scanbench: {count(len(missing), 'requirement')} of {REQUIREMENTS} could not be tried: {each} is a finding",
            err=True,
        )
    if unhandled and not as_json:
        typer.echo(
            f"scanbench: {count(len(unhandled), 'finding')}: the error did less than is required (see --require), or not "
            f"what {REQUIREMENTS} says",
            err=True,
        )


def _engine(choice: SweepEngine) -> MakeObserved:
    if choice is SweepEngine.NATIVE:
        from scanbench.engines.native.observed import ObservedBuilds

        return leaving(ObservedBuilds(None).engine)
    from scanbench.engines.interpreter.observed import observed_engine

    return observed_engine


def _program(sources: Sources, model: Model, as_json: bool) -> Program:
    checked = check_sources(sources.files, model, sources.interval_ns)
    if checked.program is not None:
        return checked.program
    if as_json:
        typer.echo(json.dumps({"problems": [problem_json(each) for each in checked.problems]}, ensure_ascii=False))
    for problem in checked.problems:
        typer.echo(str(problem), err=True)
    raise typer.Exit(1)


def _chosen(model: Model, only: list[str]) -> list[ErrorEntry]:
    """The errors asked for, in the order of the catalogue."""
    for id in only:
        known = find_error(model, id)
        if isinstance(known, Refusal):
            usage(f"--only {id}: {known.message}")
    return [each for each in model.errors() if not only or each.id in only]


def _points(
    path: Path | None, present: Sequence[str], program: Program, sources: Sources, make: MakeObserved
) -> dict[str, Point]:
    try:
        wanted: list[State] = [START] if path is None else read_states(path)
        wanted += map(while_present, present)
        return {each.name: _point(each, path, program, sources, make) for each in wanted}
    except (BadStates, Unreadable) as why:
        usage(str(why) if path is None else f"--states {path}: {why}")


def _point(state: State, path: Path | None, program: Program, sources: Sources, make: MakeObserved) -> Point:
    if not isinstance(state, FromRun):
        return run_state(state, program, make, _VERSION)
    run = Path(state.run) if path is None else path.parent / state.run
    try:
        point = point_in(run, state.scan, sources, _program_of(sources, program), make)
    except Unreadable as why:
        raise Unreadable(f"state {state.name}: {why}") from why
    with RunReader(run, no_programs, ENTRIES) as reader:
        reader.follow()
        tell_damage(run, reader.recording)  # the state itself is whole
    return point


def _program_of(sources: Sources, program: Program) -> Callable[[Sources], Program]:
    def get(wanted: Sources) -> Program:
        if wanted == sources:
            return program
        try:
            return checked_program(wanted, model_of(wanted))
        except NoProgram as why:
            raise NoProgram(f"of the run's own program: {why}") from why

    return get


def _tell_unused(grades: Grades | None, raised: Sequence[ErrorRef]) -> None:
    """What is required of what this sweep does not try: a typing error, perhaps."""
    for row in () if grades is None else grades.unused(raised):
        typer.echo(f"scanbench: --requirements names {row}, which this sweep does not raise", err=True)


def _required(
    all: Require, path: Path | None, program: Program, sources: Sources
) -> tuple[Required, Rules, Grades | None]:
    """The grades, and what else must happen. What a file says replaces what the project says; the grades of JSON come on top."""
    wanted = wanted_of(all.value)
    assert wanted is not None
    try:
        told = None if path is None else read_requirements(path, program)
    except BadRequirements as why:
        usage(f"--requirements {path}: {why}")
    rules = Rules(program, told) if isinstance(told, RequirementsText) else rules_of(program, sources.files)
    for problem in rules.problems:
        typer.echo(str(problem), err=True)
    grades = told if isinstance(told, Grades) else None
    return Required(wanted, None if grades is None else grades.of, rules.grade), rules, grades


def _severities(asked: list[Severities]) -> tuple[Severity, ...]:
    known: tuple[Severity, ...] = ("fatal", "nonfatal")
    return known if Severities.ALL in asked else tuple(each for each in known if each in asked)


# ---- compare -------------------------------------------------------------------------------------------------------


@errors.command("compare")
def compare_sweeps(
    before: Path = typer.Argument(metavar="BEFORE", help="What `errors sweep --json` printed."),
    after: Path = typer.Argument(metavar="AFTER", help="A later one: of a different version, or on a different model."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
) -> None:
    """Compare two sweeps, by error and state.

    Exit 0; 1: something is worse or gone; 2: wrong usage, or neither has an error; 4: nothing is, but the sweeps
    were not made alike: on different models, with different windows, or from states at other scans.
    """
    sweeps = _read_sweep(before), _read_sweep(after)
    changes = compare(sweeps[0][1], sweeps[1][1])
    if not changes:
        usage("neither sweep has an error: nothing was compared")
    apart = conditions_apart(sweeps[0][0], sweeps[1][0])
    if as_json:
        told = [asdict(each) for each in changes]
        typer.echo(json.dumps({"changes": told, "apart": apart}, ensure_ascii=False))
    else:
        typer.echo("\n".join([*(f"not made alike: {each}" for each in apart), *compare_text(changes)]))
    if any(each.change in ("worse", "gone") for each in changes):
        raise typer.Exit(1)
    raise typer.Exit(PARTLY if apart else 0)


def _read_sweep(path: Path) -> tuple[dict[str, object], list[Outcome]]:
    try:
        told = json.loads(path.read_text("utf-8"))
    except OSError as error:
        unreadable(path, error)
    except (ValueError, RecursionError):
        usage(f"{path} {NO_SWEEP}")
    if not is_sweep(told):
        usage(f"{path} {NO_SWEEP}")
    try:
        return told, outcomes_in(told)
    except ValueError as error:
        usage(f"{path}: {error}")


for command in (present, log, clear):
    errors.command()(command)
