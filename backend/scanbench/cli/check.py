"""`scanbench check`: every problem of a program, without running it."""

import json
from collections.abc import Mapping, Sequence
from enum import StrEnum
from pathlib import Path

import typer

from scanbench.check.build import check_sources, program_files
from scanbench.check.libraries.catalogue import library_of_file
from scanbench.cli.inputs import DIALECT_HELP, Sources, find_model, problem_json, read_programs
from scanbench.cli.outputs import must_be_writable, write_text
from scanbench.faults.reaction.required_rules import problems_of
from scanbench.problems import Problem, Severity
from scanbench.reports.junit import Case
from scanbench.reports.junit import junit as junit_text
from scanbench.reports.program_page import program_page
from scanbench.reports.program_report import ProgramReport, joined, program_report, report_json, report_lines
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
    report: bool = typer.Option(False, help="Tell how much of the programs runs, and what stops the rest, instead."),
    html: Path | None = typer.Option(None, metavar="FILE", help="Write that report as a page."),
    junit: Path | None = typer.Option(
        None, metavar="FILE", help="Write a JUnit report too: a test case for each file."
    ),
) -> None:
    """Check programs. Exit 0 without errors, 1 with, 2 for wrong usage. All files given are one program."""
    must_be_writable(html, junit)
    programs = read_programs(paths, dialect)
    texts = {name: text for each in programs for name, text in each.texts.items()}
    problems, reports = _checked(programs, model, bool(report or html))
    errors = sum(problem.severity is Severity.ERROR for problem in problems)
    told = joined(reports) if len(reports) > 1 else next(iter(reports), None)
    if html is not None and told is not None:
        write_text(html, program_page(told, ", ".join(path.name or str(path) for path in paths)))
    if junit is not None:
        write_text(junit, _junit(texts, problems))
    if report and told is not None:
        if format is Format.JSON:
            typer.echo(json.dumps({**report_json(told), "errors": errors}, ensure_ascii=False))
        else:
            typer.echo("\n".join(report_lines(told)))
    elif format is Format.JSON:
        shown = {"problems": [problem_json(problem) for problem in problems], "errors": errors}
        typer.echo(json.dumps(shown, ensure_ascii=False))
    else:
        for problem in problems:
            severity = "" if problem.severity is Severity.ERROR else f"{problem.severity.value}: "
            typer.echo(f"{problem.span}: {problem.code} {severity}{problem.message}")
        others = len(problems) - errors
        note = f" ({others} warning{'s' * (others != 1)})" if others else ""
        typer.echo(f"{errors} error{'s' * (errors != 1)}{note} in {_count(texts)} file(s)", err=True)
        if errors:
            _tell_dialect(texts)
    raise typer.Exit(1 if errors else 0)


def _checked(
    programs: Sequence[Sources], model: str | None, report: bool
) -> tuple[tuple[Problem, ...], list[ProgramReport]]:
    """What is told of them, once where several programs have a file; and the report of each, if wanted."""
    found: dict[Problem, None] = {}
    reports = []
    for program in programs:
        checked = check_sources(program.texts, find_model(model, program))
        problems = (*checked.problems, *problems_of(checked.program, program.texts))
        # what is wrong in the files of a project that this one refers to is told of that project
        found |= dict.fromkeys(each for each in problems if program.own is None or _of(program.own, each.span.file))
        if report:
            reports.append(program_report(program.texts, problems, program.missing, program.own, program.absent))
    return tuple(found), reports


def _of(own: frozenset[str], file: str) -> bool:
    return file in own or library_of_file(file) is not None


def _junit(texts: Mapping[str, str], problems: Sequence[Problem]) -> str:
    """Each file of the program, and each other one in which there is an error."""
    lines: dict[str, list[str]] = {name: [] for name in program_files(texts) if library_of_file(name) is None}
    for each in problems:
        if each.severity is Severity.ERROR:
            lines.setdefault(each.span.file, []).append(f"{each.span}: {each.code} {each.message}")
    cases = [
        Case("check", name, "failure", told[0], "error", "\n".join(told)) if told else Case("check", name)
        for name, told in lines.items()
    ]
    return junit_text("check", cases)


def _count(texts: Mapping[str, str]) -> int:
    """The files of the program, without the libraries that are added to it."""
    return sum(library_of_file(name) is None for name in program_files(texts))


def _tell_dialect(texts: Mapping[str, str]) -> None:
    """Says in which dialect programs are probably written that name none."""
    likely = guess_dialect(texts)
    if likely != STRICT and not any(map(is_language_file, texts)):
        typer.echo(
            f"scanbench: this looks like {likely}: with --dialect {likely}, what it allows is no error", err=True
        )
