"""`scanbench run`: a program headless, on virtual time: the same call prints the same on every machine."""

from collections.abc import Callable, Sequence
from enum import StrEnum
from pathlib import Path
from typing import NoReturn

import typer

from scanbench.check.build import check_sources
from scanbench.cli import INTERRUPTED
from scanbench.cli.inputs import DIALECT_HELP, Sources, below, find_model, problem_json, read_sources, usage
from scanbench.cli.interrupt import interruptible, leaving
from scanbench.cli.outputs import must_be_writable, write_text
from scanbench.cli.progress import progress
from scanbench.cli.record import check_whole, recorded
from scanbench.cli.run_options import Options, find_symbol, read_commands, read_condition, read_interval
from scanbench.cli.run_report import (
    Result,
    differ_junit,
    nothing_ran,
    report_json,
    report_text,
    run_junit,
    texts,
    trap_text,
    unvalued,
    values,
)
from scanbench.engines.engine import Engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.engines.native.emit_body import TooLarge
from scanbench.engines.native.engine import NativeEngine, engine_for
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.engines.observe import MakeObserved
from scanbench.engines.pair import Differs, PairEngine
from scanbench.faults.agenda import agenda_of_faults
from scanbench.faults.arm import Arm
from scanbench.faults.detect import Detection
from scanbench.plcmodel.model import Model
from scanbench.program.program import Program
from scanbench.recording.headless import run_headless
from scanbench.runtime.command import Command
from scanbench.runtime.resource import Resource
from scanbench.testing.said import with_near


class EngineChoice(StrEnum):
    """Which engine runs the program."""

    NATIVE = "native"
    REFERENCE = "reference"
    BOTH = "both"


ENGINES: dict[EngineChoice, Callable[[Program, bytearray], Engine]] = {
    EngineChoice.NATIVE: leaving(NativeEngine),
    EngineChoice.REFERENCE: ReferenceEngine,
    EngineChoice.BOTH: leaving(PairEngine),
}


OBSERVED: dict[EngineChoice, MakeObserved] = {
    EngineChoice.NATIVE: leaving(ObservedBuilds().engine),
    EngineChoice.REFERENCE: observed_engine,
    EngineChoice.BOTH: observed_engine,
}


def run(
    path: Path = typer.Argument(metavar="FILE|DIR|ZIP", help="A program file (.st, .TcPOU, ...), or a folder or zip file with some."),
    scans: int = typer.Option(..., min=0, help="How many scans to run."),
    model: str | None = typer.Option(None, metavar="NAME", help="PLC model; else project.json's, else GENERIC-IEC."),
    dialect: str | None = typer.Option(None, metavar="NAME", help=DIALECT_HELP),
    interval: str = typer.Option("10ms", help="Task interval if no CONFIGURATION sets one."),
    set: list[str] = typer.Option([], "--set", metavar="PATH=VALUE[@SCAN]", help="Write before a scan (0 if none is named). Text with an @ in it: PATH='a@1'."),
    force: list[str] = typer.Option([], "--force", metavar="PATH=VALUE[@SCAN]", help="Force from a scan on."),
    generate: list[str] = typer.Option([], "--raise", metavar="ERROR[@SCAN]", help="Raise an error of the model, e.g. io-bus-error:rack=1,slot=3@5; 'E for 5@100', 'E every 100 on 10 times 3 seed 7', 'E chatter times 4', 'E chance 0.5% on 3 seed 7', 'E while OTHER', 'E for 9 unless CONDITION', 'E when CONDITION', 'E when FILE:LINE', 'E + F gap 3'."),
    clear: list[str] = typer.Option([], "--clear", metavar="ERROR|all[@SCAN]", help="Recover an error."),
    show: list[str] = typer.Option([], "--print", metavar="PATH", help="Print this variable or address at the end."),
    mode: list[str] = typer.Option([], "--mode", metavar="MODE[@SCAN]", help="Change to PROGRAM, MONITOR or RUN."),
    restart: list[str] = typer.Option([], "--restart", metavar="KIND[@SCAN]", help="Restart: cold, warm or power."),
    until: str | None = typer.Option(None, metavar="CONDITION", help="End after the first scan after which it holds, e.g. 'Main.n > 10'."),
    record: Path | None = typer.Option(None, metavar="FILE", help="Record the run, for `replay` or to import in the browser."),
    every: int = typer.Option(0, min=0, metavar="K", help="Print the variables every K scans too."),
    engine: EngineChoice = typer.Option(EngineChoice.NATIVE, help="both: run both and compare whole images every scan."),
    hash: bool = typer.Option(False, "--hash", help="Print the SHA-256 of the image."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
    junit: Path | None = typer.Option(None, metavar="FILE", help="Write a JUnit report too: that the program ran without a run-time error, and that each command was taken."),
) -> None:  # fmt: skip
    """Run a program. A command @SCAN is applied before that scan; scans count from 0.

    Exit 0 when it ran; 1: it does not compile; 2: wrong usage, a command was refused, or --until was never met; 3: the
    engines differ; 4: the PLC trapped; 130: interrupted by Ctrl-C, what is printed is of the scans that ran.
    """
    must_be_writable(junit)
    sources = read_sources([path], dialect)
    program, problems = _compiled(sources, find_model(model, sources), read_interval(interval), as_json)
    commands = _commands(program, Options(set, force, generate, clear, mode, restart), engine, scans)
    shown = [(each, find_symbol(program, each)) for each in show]
    begun: list[Resource] = []
    condition = None if until is None else read_condition(program, until)
    try:
        with (
            recorded(record, program, below(path, sources.texts), read_interval(interval)) as recording,
            interruptible() as interrupt,
            progress(scans, lambda: _scans(begun), lambda: f"{_scans(begun):,} of {scans:,} scans"),
        ):
            result = run_headless(
                program, scans, _engine(engine, scans), commands, every, lambda plc: (values if as_json else texts)(plc, shown),
                detect=Detection(), agenda=agenda_of_faults(OBSERVED[engine]), recording=recording, until=condition,
                interrupt=interrupt, on_begin=begun.append,
            )  # fmt: skip
            if recording is not None:
                check_whole(recording)
    except (TooLarge, Differs) as error:
        _fail(error, path, problems, as_json, junit)
    report_json(result, shown, problems, hash) if as_json else report_text(result, shown, hash)
    _end(result, _untaken(result, commands), until, interrupt.asked, junit, path.name)


def _engine(choice: EngineChoice, scans: int) -> Callable[[Program, bytearray], Engine]:
    return leaving(engine_for(scans)) if choice is EngineChoice.NATIVE else ENGINES[choice]


def _write(junit: Path | None, text: str) -> None:
    if junit is not None:
        write_text(junit, text)


def _fail(
    error: TooLarge | Differs, path: Path, problems: list[dict[str, str | int]], as_json: bool, junit: Path | None
) -> NoReturn:
    """The program is too large, or the engines came to a different image: says so, and ends the command."""
    if isinstance(error, TooLarge):
        usage(f"{path}: {error}")
    _write(junit, differ_junit(path.name, str(error)))
    if as_json:
        typer.echo(nothing_ran(problems, difference=str(error)))
    typer.echo(f"scanbench: {error}", err=True)
    raise typer.Exit(3) from None


def _scans(begun: Sequence[Resource]) -> int:
    """That have run so far, asked while they run."""
    return begun[0].header.scan if begun else 0


def _compiled(
    sources: Sources, model: Model, interval_ns: int, as_json: bool
) -> tuple[Program, list[dict[str, str | int]]]:
    """The program and its warnings; exit code 1 where there is none."""
    checked = check_sources(sources.texts, model, interval_ns)
    problems = [problem_json(problem) for problem in checked.problems]
    if checked.program is not None:
        for problem in checked.problems:
            if problem.code == "W008" and not as_json:  # its results are nobody's but the user's
                typer.echo(f"scanbench: {problem}", err=True)
        return checked.program, problems
    if as_json:
        typer.echo(nothing_ran(problems))
    for problem in checked.problems:
        typer.echo(str(problem), err=True)
    raise typer.Exit(1)


def _commands(program: Program, options: Options, engine: EngineChoice, scans: int) -> list[tuple[int, Command]]:
    commands = read_commands(program, options, scans)
    lines = any(isinstance(each, Arm) and each.wanted.start.kind == "line" for _, each in commands)
    if lines and engine is EngineChoice.BOTH:
        usage("--engine both cannot wait for a line: code that notes statements runs on one engine")
    return commands


def _untaken(result: Result, commands: Sequence[tuple[int, Command]]) -> list[str]:
    """What of the commands did not come to pass, a sentence each."""
    late = [
        f"the command for scan {scan} was not applied: the run ended before it"
        for scan, _ in commands if scan > result.scans
    ]  # fmt: skip
    return late + [
        f"refused before scan {each.scan}: {with_near(each.refusal.message, each.refusal.near)}"
        for each in result.refused
    ]


def _end(
    result: Result, untaken: Sequence[str], until: str | None, interrupted: bool, junit: Path | None, name: str
) -> None:
    """What did not go as it was asked for, on stderr and as JUnit, and the exit code."""
    _write(junit, run_junit(name, result, untaken, until, interrupted))
    for each in untaken:
        typer.echo(f"scanbench: {each}", err=True)
    trap = result.resource.trap
    if trap is not None:
        typer.echo(trap_text(trap), err=True)
        raise typer.Exit(4)
    if interrupted:
        typer.echo(f"scanbench: interrupted after {result.scans:,} scans", err=True)
        raise typer.Exit(INTERRUPTED)
    if until is not None and result.unvalued is not None:
        typer.echo(f"scanbench: {unvalued(result, until)}", err=True)
    if until is not None and not result.met:
        typer.echo(f"scanbench: after {result.scans} scans it was not so that {until}", err=True)
        raise typer.Exit(2)
    if result.refused:
        raise typer.Exit(2)
