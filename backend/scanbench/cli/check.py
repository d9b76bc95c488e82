"""`scanbench check`: every problem of a program, without running it."""

import json
from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path

import typer

from scanbench.check.build import check_sources, program_files
from scanbench.cli.check_report import report_files, report_json, report_lines
from scanbench.cli.inputs import DIALECT_HELP, find_model, problem_json, read_sources
from scanbench.faults.reaction.required_rules import problems_of
from scanbench.problems import Severity
from scanbench.syntax.language_file import STRICT, guess_dialect, is_language_file


class Format(StrEnum):
    """How problems are printed."""

    TEXT = "text"
    JSON = "json"


def check(
    paths: list[Path] = typer.Argument(
        metavar="FILE|DIR|ZIP...", help="Program files (.st, .TcPOU, ...); a folder or zip file gives all in it."
    ),
    format: Format = typer.Option(Format.TEXT, help="text: `file:line:column: code message`, one a line."),
    model: str | None = typer.Option(None, metavar="NAME", help="PLC model; else project.json's, else GENERIC-IEC."),
    dialect: str | None = typer.Option(None, metavar="NAME", help=DIALECT_HELP),
    report: bool = typer.Option(False, help="Count supported and refused constructs per file instead."),
) -> None:
    """Check programs. Exit 0 without errors, 1 with, 2 for wrong usage. All files given are one program."""
    sources = read_sources(paths, dialect)
    checked = check_sources(sources.texts, find_model(model, sources))
    problems = (*checked.problems, *problems_of(checked.program, sources.texts))
    errors = sum(problem.severity is Severity.ERROR for problem in problems)
    if report:
        files = report_files(program_files(sources.texts), problems)
        if format is Format.JSON:
            typer.echo(json.dumps({"files": report_json(files), "errors": errors}, ensure_ascii=False))
        else:
            typer.echo("\n".join(report_lines(files)))
    elif format is Format.JSON:
        shown = {"problems": [problem_json(problem) for problem in problems], "errors": errors}
        typer.echo(json.dumps(shown, ensure_ascii=False))
    else:
        for problem in problems:
            severity = "" if problem.severity is Severity.ERROR else f"{problem.severity.value}: "
            typer.echo(f"{problem.span}: {problem.code} {severity}{problem.message}")
        others = len(problems) - errors
        note = f" ({others} warning{'s' * (others != 1)})" if others else ""
        typer.echo(f"{errors} error{'s' * (errors != 1)}{note} in {len(sources.texts)} file(s)", err=True)
        if errors:
            _tell_dialect(sources.texts)
    raise typer.Exit(1 if errors else 0)


def _tell_dialect(texts: Mapping[str, str]) -> None:
    """Says in which dialect programs are probably written that name none."""
    likely = guess_dialect(texts)
    if likely != STRICT and not any(map(is_language_file, texts)):
        typer.echo(
            f"scanbench: this looks like {likely}: with --dialect {likely}, what it allows is no error", err=True
        )
