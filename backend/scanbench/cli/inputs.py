"""Programs from files and folders, models by name; every complaint says what to do and exits with 2."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import typer

from scanbench.plcmodel.load import NoModels, NoSuchModel, load_all, model_directory, model_named
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import USER_ERRORS
from scanbench.problems import Problem
from scanbench.syntax.parse_file import ENDINGS, is_program_file
from scanbench.syntax.source import decode

DEFAULT_MODEL = "GENERIC-IEC"
PROJECT_FILE = "project.json"


@dataclass(frozen=True, slots=True)
class Sources:
    """Texts by file name as it was given, and the model that a project file names."""

    texts: dict[str, str]
    model: str | None


def usage(message: str) -> NoReturn:
    """Prints what is wrong with the call, and ends with exit code 2."""
    typer.echo(f"scanbench: {message}", err=True)
    raise typer.Exit(2)


def with_near(message: str, near: Sequence[str]) -> str:
    """A sentence with one full stop, and behind it what was perhaps meant, unless it says so itself."""
    ended = message if message.endswith((".", "?", "!")) else f"{message}."
    return ended if not near or "id you mean" in message else f"{ended} Near: {', '.join(near)}."


def read_sources(paths: list[Path]) -> Sources:
    """A file is taken whatever its ending; a folder gives every program file in it and below, and its own errors."""
    texts: dict[str, str] = {}
    model = None
    for path in paths:
        if path.is_dir():
            found = sorted(
                each for each in path.rglob("*") if is_program_file(str(each.relative_to(path))) and each.is_file()
            )
            if not found:
                usage(f"there is no program file ({', '.join(ENDINGS)}) in {path}")
            if (errors := path / USER_ERRORS).is_file():
                found.append(errors)
            model = model or _project_model(path / PROJECT_FILE)
        elif path.exists():
            found = [path]
        else:
            usage(f"{path} does not exist")
        for each in found:
            texts[str(each)] = _read(each)
    return Sources(texts, model)


def below(path: Path, texts: Mapping[str, str]) -> dict[str, str]:
    """The texts by the names that they have in a project: below the folder that was given, wherever that is."""
    if not path.is_dir():
        return {Path(name).name: text for name, text in texts.items()}
    return {Path(name).relative_to(path).as_posix(): text for name, text in texts.items()}


def _read(path: Path) -> str:
    try:
        return decode(path.read_bytes())
    except OSError as error:
        usage(f"{path} cannot be read: {error.strerror}")


def _project_model(path: Path) -> str | None:
    if not path.is_file():
        return None
    try:
        content = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as error:
        usage(f"{path} cannot be read: {error}")
    model = content.get("model") if isinstance(content, dict) else None
    return model if isinstance(model, str) else None


def find_model(name: str | None, sources: Sources) -> Model:
    """The model asked for, else the project's, else the plain one."""
    return find_model_named(name or sources.model or DEFAULT_MODEL)


def find_model_named(wanted: str) -> Model:
    """The model of this name, in any case."""
    try:
        models, problems = load_all(model_directory())
    except NoModels as error:
        usage(str(error))
    for problem in problems:
        typer.echo(str(problem), err=True)
    try:
        return model_named(wanted, models)
    except NoSuchModel as error:
        usage(str(error))


def problem_json(problem: Problem) -> dict[str, str | int]:
    """A problem as `--json` prints it."""
    span = problem.span
    return {
        "file": span.file,
        "line": span.line,
        "column": span.column,
        "end_line": span.end_line,
        "end_column": span.end_column,
        "code": problem.code,
        "severity": problem.severity.value,
        "message": problem.message,
    }
