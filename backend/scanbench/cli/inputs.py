"""Programs from files and folders, models by name; every complaint says what to do and exits with 2."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NoReturn

import typer

from scanbench.check.libraries.catalogue import library_of_file
from scanbench.plcmodel.load import NoModels, NoSuchModel, load_all, model_directory, model_named
from scanbench.plcmodel.model import Model
from scanbench.problems import Problem
from scanbench.recording.format import Damaged
from scanbench.recording.reader import Unreadable
from scanbench.recording.recording import Recording
from scanbench.server.archive import unpack
from scanbench.server.completed import completed, unknown_libraries
from scanbench.server.from_disk import (
    DEFAULT_MODEL,
    package_files,
    program_files,
    project_model,
    read_text,
    twincat_projects,
)
from scanbench.server.twincat_project import TwinCatProject, in_parts
from scanbench.syntax.language_file import (
    DIALECTS,
    LANGUAGE_FILE,
    dialect_named,
    dialect_of,
    with_dialect,
    with_dialect_by_format,
)
from scanbench.wire.refused import Refused

ARCHIVE = ".zip"
DIALECT_HELP = (
    f"Dialect of the programs: {', '.join(DIALECTS)}; else language.json's, else that of the files' format, else iec."
)
NAMED = 5
"""Names in one message."""
PARTLY = 4
"""Exit code where what was looked at is right, but not all could be: a run file is damaged, say, and a part of the run is lost."""


@dataclass(frozen=True, slots=True)
class Sources:
    """Texts by file name as it was given, and the model that a project file names."""

    texts: dict[str, str]
    model: str | None
    missing: tuple[str, ...] = ()
    """Libraries that a project of TwinCAT refers to, of which there is no text."""
    absent: tuple[str, ...] = ()
    """Files that it compiles, and that nobody has."""
    own: frozenset[str] | None = None
    """Where this is one of several programs: its own files, without those of the projects that it refers to."""


def usage(message: str) -> NoReturn:
    """Prints what is wrong with the call, and ends with exit code 2."""
    typer.echo(f"scanbench: {message}", err=True)
    raise typer.Exit(2)


def unreadable(path: Path, error: OSError) -> NoReturn:
    """The same of a file that the system does not give."""
    missing = isinstance(error, FileNotFoundError)
    usage(f"{path} does not exist" if missing else f"{path} cannot be read: {error.strerror or error}")


def unusable(message: str, error: BaseException | None) -> NoReturn:
    """The same of a run file that cannot be used; with `PARTLY` where it is damaged."""
    typer.echo(f"scanbench: {message}", err=True)
    raise typer.Exit(PARTLY if isinstance(error, Damaged) else 2)


def unusable_run(path: Path, error: Unreadable) -> NoReturn:
    """The same of a run file, whatever is wrong with it."""
    cause = error.__cause__
    if isinstance(cause, OSError):
        unreadable(path, cause)
    unusable(f"{path}: {error}", cause)


def tell_damage(path: Path, recording: Recording) -> bool:
    """Says on stderr what is wrong with a run file that was opened; whether something of it is lost."""
    if recording.damage:
        typer.echo(f"scanbench: {path}: {'' if recording.lost else 'note: '}{recording.damage}", err=True)
    return recording.lost


@dataclass(frozen=True, slots=True)
class _Read:
    """What was read, before anything is added to it."""

    texts: dict[str, str]
    model: str | None
    folder: Path
    projects: dict[str, TwinCatProject]
    """By path; those of a zip file by numbers."""


def read_sources(paths: list[Path], dialect: str | None = None, libraries: bool = True) -> Sources:
    """A file is taken whatever its ending; a folder or zip file gives every program file in it, and its own errors.

    `dialect` goes before what the project itself says. With `libraries`, the texts of those that the programs use are among them.
    """
    read = _read(paths, dialect)
    return _completed(read.texts, read, [*read.projects.values()], libraries)


def read_programs(paths: list[Path], dialect: str | None = None) -> list[Sources]:
    """The same, but projects of TwinCAT that are no program together one by one, each with the projects that it refers to."""
    read = _read(paths, dialect)
    parts = in_parts(read.texts, read.projects)
    if not parts:
        return [_completed(read.texts, read, [*read.projects.values()], True)]
    made = []
    for own, files, projects in parts:
        part = _completed({name: text for name, text in read.texts.items() if name in files}, read, projects, True)
        made.append(replace(part, own=own))
    return made


def _completed(texts: dict[str, str], read: _Read, projects: list[TwinCatProject], libraries: bool) -> Sources:
    made = completed(texts, projects, str(read.folder)) if libraries else texts
    absent = tuple(file for project in projects for file in project.absent)
    return Sources(made, read.model, tuple(unknown_libraries(projects, made)), absent)


def _read(paths: list[Path], dialect: str | None) -> _Read:
    texts: dict[str, str] = {}
    projects: dict[str, TwinCatProject] = {}
    packages: list[str] = []
    model = None
    try:
        for path in paths:
            if path.suffix.lower() == ARCHIVE:
                archive = unpack(_bytes(path))
                texts |= {str(path / each): text for each, text in archive.files.items()}
                model = model or archive.model or None
                packages += archive.left_out
                projects |= {str(path / str(number)): each for number, each in enumerate(archive.twincat)}
                continue
            texts |= {str(each): read_text(each) for each in program_files(path)}
            model = model or project_model(path)
            packages += package_files(path)
            found = twincat_projects(path) if path.is_dir() else {}
            _tell_absent(found)
            projects |= found
    except Refused as error:
        usage(str(error))
    folder = paths[0] if paths[0].is_dir() or paths[0].suffix.lower() == ARCHIVE else paths[0].parent
    if dialect is not None:
        named = dialect_named(dialect)
        if named is None:
            usage(f"there is no dialect {dialect}: write one of {', '.join(DIALECTS)}")
        texts = with_dialect(texts, named, str(folder / LANGUAGE_FILE))
    elif (in_dialect := with_dialect_by_format(texts, str(folder / LANGUAGE_FILE), packages)) != texts:
        texts = in_dialect
        of_format = dialect_of(texts)[0]
        typer.echo(
            f"scanbench: {of_format} programs by the format of their files (--dialect names a different one)", err=True
        )
    return _Read(texts, model, folder, projects)


def _tell_absent(projects: Mapping[str, TwinCatProject]) -> None:
    for path, project in projects.items():
        if count := len(project.absent):
            files = "a file that is" if count == 1 else f"{count} files that are"
            named = ", ".join(project.absent[:NAMED]) + (f" and {count - NAMED} more" if count > NAMED else "")
            typer.echo(
                f"scanbench: {path} lists {files} not there: {named}. What is declared in such a file is only inferred from its use",
                err=True,
            )


def _bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        unreadable(path, error)


def below(path: Path, texts: Mapping[str, str]) -> dict[str, str]:
    """The texts by the names that they have in a project: below the folder that was given, wherever that is."""
    if not path.is_dir():
        return {_in_project(name): text for name, text in texts.items()}
    return {Path(name).relative_to(path).as_posix(): text for name, text in texts.items()}


def _in_project(name: str) -> str:
    """The name of a single file, and of a library, which is in a folder of its own."""
    library = library_of_file(name)
    return Path(name).name if library is None else str(Path(name).relative_to(Path(name).parents[1]))


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
