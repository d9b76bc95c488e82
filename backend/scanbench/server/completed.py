"""Programs of other tools, with what they need to be checked here: the libraries that they use, and what these are called."""

import re
from collections.abc import Collection, Iterable, Mapping
from pathlib import PurePath

from scanbench.check.dialect_table import DIALECTS, dialect_in
from scanbench.check.libraries.catalogue import catalogue, library_of_file, used_libraries
from scanbench.check.placeholders.placeholders import PATH, placeholders
from scanbench.check.placeholders.quoted import seldom_declared
from scanbench.server.twincat_project import TwinCatProject, missing_libraries
from scanbench.server.twincat_tasks import FILE, configuration
from scanbench.syntax.language_file import LANGUAGE_FILE, dialect_of, is_language_file, with_namespaces

_CONFIGURATION = re.compile(r"^\s*CONFIGURATION\b", re.IGNORECASE | re.MULTILINE)


def completed(files: Mapping[str, str], projects: Iterable[TwinCatProject] = (), folder: str = "") -> dict[str, str]:
    """The files of a project at `folder`, with the texts of the libraries that they use. The names of these TwinCAT projects, whose
    files are among them, may be written before other names, what they define is defined, and their tasks are a CONFIGURATION.
    Where they refer to libraries or compile files that nobody has, or name in quotes of SCL, or as a module of Logix, what no file declares, placeholders take the places of these.

    Nothing is different in the strict language, which has no libraries.
    """
    projects = [*projects]
    names = {name for project in projects for name in project.names if name.isidentifier()}
    defines = {name for project in projects for name in project.defines}
    made = dict(files)
    tasks = configuration([task for project in projects for task in project.tasks], made)
    if tasks and not any(map(_CONFIGURATION.search, made.values())):
        made.setdefault(str(PurePath(folder, FILE)), tasks)
    if (names or defines) and any(map(is_language_file, made)):
        made = with_namespaces(made, names, str(PurePath(folder, LANGUAGE_FILE)), defines)
    made |= _texts_of_libraries(made, projects, folder)
    return _with_placeholders(made, projects, folder)


def _texts_of_libraries(files: Mapping[str, str], projects: Collection[TwinCatProject], folder: str) -> dict[str, str]:
    """Those that the files use. Where these projects refer to a library that nobody has, a name may be of that: then only a library
    to which they refer gives names, and what it needs itself."""
    referred = {name for project in projects for name, _ in project.references}
    only = referred if unknown_libraries(projects, files) else None
    libraries = used_libraries(files, dialect_of(files)[0], only)
    return {str(PurePath(folder, each.path)): each.text for each in libraries}


def _with_placeholders(made: dict[str, str], projects: Collection[TwinCatProject], folder: str) -> dict[str, str]:
    """The files with what their use says of the names of libraries and files that they refer to and nobody has."""
    missing = [*unknown_libraries(projects, made), *(file for project in projects for file in project.absent)]
    quoted = seldom_declared(made, dialect_of(made)[0])
    path = str(PurePath(folder, PATH))
    if not (missing or quoted) or path in made:
        return made
    names = {space for each in projects for name, space in each.references if name in missing and space.isidentifier()}
    found = placeholders(made, missing, names | dialect_in(made).prefixes, None if missing else quoted)
    if found is None:
        return made
    names |= found[1]
    if names and any(map(is_language_file, made)):
        made = with_namespaces(made, names, str(PurePath(folder, LANGUAGE_FILE)))
    made = made | {path: found[0]}
    return made | _texts_of_libraries(made, projects, folder)


def unknown_libraries(projects: Collection[TwinCatProject], files: Iterable[str]) -> list[str]:
    """Libraries that these projects refer to, and that nothing is known of: neither Scanbench nor the files have a text."""
    known = {each.name for each in catalogue()} | {name for each in DIALECTS.values() for name in each.prefixes}
    return missing_libraries(projects, known | {library for file in files if (library := library_of_file(file))})
