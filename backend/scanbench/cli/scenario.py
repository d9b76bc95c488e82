"""`scanbench scenario`: scenario files made of recorded runs, played, and made as short as they can be."""

from collections.abc import Mapping
from pathlib import Path

import typer

from scanbench.check.build import check_sources
from scanbench.cli.inputs import find_model_named, unreadable, unusable_run, usage
from scanbench.engines.native.engine import NativeEngine
from scanbench.history.scenario import BadScenario, Scenario, project_of, read_scenario, write_scenario
from scanbench.history.scenario_steps import from_run
from scanbench.host.run_files import sources_in
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.programs import Loaded, LoadedPrograms
from scanbench.symbols.symbols import UnknownPath, resolve
from scanbench.symbols.whole import worth_text
from scanbench.testing.attempts import Attempts
from scanbench.testing.project import BrokenProject, Project
from scanbench.testing.said import with_near
from scanbench.testing.shrink import shrink
from scanbench.wire.codec import ENTRIES

scenario = typer.Typer(
    no_args_is_help=True, rich_markup_mode=None, help="Scenario files: steps at scans, and what is to hold."
)


@scenario.command()
def record(
    path: Path = typer.Argument(metavar="RUNFILE", help="A run as the bench exports it (.scanrun), or --record wrote it."),
    expect: list[str] = typer.Option([], "--expect", metavar="PATH", help="What this variable is worth at the end is to be so again."),
    project: str = typer.Option(".", metavar="DIR", help="Where the program is, from the folder of the scenario."),
) -> None:  # fmt: skip
    """Print the scenario of what people did in a run."""
    try:
        with RunReader(path, _programs, ENTRIES) as reader:
            reader.follow()
            if reader.first:
                usage(f"{path}: the run begins with scan {reader.first}: a scenario begins with a cold start")
            plc = reader.at(reader.end)
            told = [(each, _worth(plc.program, plc.memory, each)) for each in expect]
            made = from_run(reader.entries, reader.end, plc.program.layout.model, told, project)
    except Unreadable as error:
        unusable_run(path, error)
    typer.echo(write_scenario(made), nl=False)


def _programs(kept: Mapping[int, KeptProgram]) -> LoadedPrograms:
    made: list[Loaded] = []
    for each in kept.values():
        sources = sources_in(each)
        checked = check_sources(sources.files, find_model_named(sources.model), sources.interval_ns)
        if checked.program is None:
            usage(f"program version {each.version} does not compile any more: {checked.problems[0]}")
        made.append(Loaded.make(checked.program, NativeEngine, each.version))
    return LoadedPrograms(*made)


def _worth(program: Program, memory: bytearray, path: str) -> str:
    try:
        return worth_text(program, memory, resolve(program, path))
    except UnknownPath as error:
        usage(f"--expect {path}: {with_near(error.message, error.near)}")


@scenario.command("run")
def run_scenarios(
    paths: list[Path] = typer.Argument(metavar="FILE", help="Scenario files."),
) -> None:  # fmt: skip
    """Play scenarios. Exit 0 when all of them were as expected, 1 when one was not, 2: wrong usage."""
    failures = 0
    for path in paths:
        found = _read(path)
        with Attempts(_project(path, found)) as attempt:
            failed = attempt(found)
        typer.echo(f"{path}: {'as expected' if failed is None else failed.message}")
        failures += failed is not None
    if failures:
        raise typer.Exit(1)


@scenario.command("shrink")
def shrink_scenario(
    path: Path = typer.Argument(metavar="FILE", help="A scenario that fails."),
) -> None:  # fmt: skip
    """Print a failing scenario with the fewest steps that still fails in the same way. Exit 1 when it does not fail."""
    found = _read(path)
    with Attempts(_project(path, found)) as attempt:
        failed = attempt(found)
        if failed is None:
            typer.echo(f"scanbench: {path} does not fail: there is nothing to make shorter", err=True)
            raise typer.Exit(1)
        short = shrink(found, failed, attempt)
    typer.echo(f"# {failed.message}\n# {len(short.steps)} of {len(found.steps)} steps are left", nl=True)
    typer.echo(write_scenario(short), nl=False)


def _project(path: Path, found: Scenario) -> Project:
    try:
        return Project.read(project_of(path, found))
    except BrokenProject as error:
        usage(f"{path}: {error}")


def _read(path: Path) -> Scenario:
    try:
        return read_scenario(path.read_text("utf-8"))
    except OSError as error:
        unreadable(path, error)
    except (BadScenario, UnicodeDecodeError) as error:
        usage(f"{path}: {error}")
