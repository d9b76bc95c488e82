"""`scanbench scenario`: scenario files made of recorded runs, played, and made as short as they can be."""

from collections.abc import Mapping
from pathlib import Path

import typer

from scanbench.cli.inputs import unreadable, unusable_run, usage
from scanbench.cli.outputs import must_be_writable, write_text
from scanbench.cli.replay import load_kept
from scanbench.engines.native.engine import NativeEngine
from scanbench.history.scenario import BadScenario, Scenario, project_of, read_scenario, write_scenario
from scanbench.history.scenario_of_run import scenario_of
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.reports.junit import Case
from scanbench.reports.junit import junit as junit_text
from scanbench.runtime.programs import LoadedPrograms
from scanbench.testing.attempts import Attempts
from scanbench.testing.play import Failed, nothing_expected
from scanbench.testing.project import BrokenProject, Project
from scanbench.testing.shrink import shrink
from scanbench.wire.codec import ENTRIES

scenario = typer.Typer(
    no_args_is_help=True, rich_markup_mode=None, help="Scenario files: steps at scans, and what is to hold."
)

NOTHING_EXPECTED = 3
"""Exit code of scenarios that were played, and expect nothing."""


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
            made = scenario_of(reader, reader.end, expect, project)
    except Unreadable as error:
        unusable_run(path, error)
    typer.echo(write_scenario(made), nl=False)


def _programs(kept: Mapping[int, KeptProgram]) -> LoadedPrograms:
    return LoadedPrograms(*(load_kept(each, NativeEngine) for each in kept.values()))


@scenario.command("run")
def run_scenarios(
    paths: list[Path] = typer.Argument(metavar="FILE", help="Scenario files."),
    junit: Path | None = typer.Option(None, metavar="FILE", help="Write a JUnit report too: a test case for each file."),
) -> None:  # fmt: skip
    """Play scenarios. Exit 0 when all of them were as expected, 1 when one was not, 2: wrong usage, 3: one expects nothing."""
    must_be_writable(junit)
    failures, empty, cases = 0, 0, list[Case]()
    for path in paths:
        found = _read(path)
        with Attempts(_project(path, found)) as attempt:
            failed = attempt(found)
        said = "as expected" if found.expect else nothing_expected(found)
        typer.echo(f"{path}: {said if failed is None else failed.message}")
        failures += failed is not None
        empty += not found.expect
        cases.append(_case(path, found, failed))
    if junit is not None:
        write_text(junit, junit_text("scenarios", cases))
    if failures or empty:
        raise typer.Exit(1 if failures else NOTHING_EXPECTED)


def _case(path: Path, found: Scenario, failed: Failed | None) -> Case:
    if failed is not None:
        return Case(
            "scenario", str(path), "failure", failed.message, "trap" if failed.what == "trap" else "expectation"
        )
    if not found.expect:
        return Case("scenario", str(path), "skipped", nothing_expected(found))
    return Case("scenario", str(path))


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
