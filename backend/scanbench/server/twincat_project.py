"""The project file of TwinCAT (`.plcproj`): which files it compiles, what it is called, and which libraries it refers to."""

import posixpath
import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from html import unescape
from urllib.parse import unquote

from scanbench.server.twincat_tasks import Task, read_task
from scanbench.syntax.parse_file import XML_ENDINGS

ENDING = ".plcproj"
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_COMPILED = re.compile(r"<Compile\s[^>]*Include\s*=\s*[\"']([^\"']*)[\"']")
_REFERENCE = re.compile(
    r"<(?:Placeholder|Library)Reference\s[^>]*Include\s*=\s*[\"']([^\"',]*)[^\"']*[\"'][^>]*?(?:/>|>(.*?)</(?:Placeholder|Library)Reference>)",
    re.DOTALL,
)
_NAMES = re.compile(r"<(?:Name|Title|DefaultNamespace)>\s*([^<]*?)\s*</")
_DEFINES = re.compile(r"<CompilerDefines>([^<]*)</CompilerDefines>")
_NAMESPACE = re.compile(r"<Namespace>\s*([^<]*?)\s*</Namespace>")


@dataclass(frozen=True, slots=True)
class TwinCatProject:
    """What such a file says."""

    compiled: tuple[str, ...]
    """Paths from where the file is, with `/`."""
    names: tuple[str, ...]
    """What others write before the names of this project, when it is their library."""
    references: tuple[tuple[str, str], ...]
    """Libraries: how each is called, and what is written before its names."""
    defines: tuple[str, ...] = ()
    """Names that are defined for conditional pragmas."""
    tasks: tuple[Task, ...] = ()
    """Those whose files were given."""
    absent: tuple[str, ...] = ()
    """Of the compiled paths, those of program files that nobody has."""


def is_twincat_project(path: str) -> bool:
    """Whether a file of this path is one."""
    return path.lower().endswith(ENDING)


def read_twincat_project(text: str) -> TwinCatProject:
    """What the text of the file says; of one that is damaged what can still be found."""
    text = _COMMENT.sub("", text)
    # MSBuild writes `%28` for `(`, as its own syntax has that: learn.microsoft.com/visualstudio/msbuild/msbuild-special-characters
    compiled = tuple(unquote(unescape(path)).replace("\\", "/") for path in _COMPILED.findall(text))
    references = [(unescape(name).strip(), inside) for name, inside in _REFERENCE.findall(text)]
    named = {name: (_NAMESPACE.findall(inside) or [name])[0] for name, inside in references if name}
    names = dict.fromkeys(unescape(name) for name in _NAMES.findall(_REFERENCE.sub("", text)) if name)
    defines = re.findall(r"[A-Za-z_]\w*", " ".join(_DEFINES.findall(text)))
    return TwinCatProject(compiled, tuple(names), tuple(named.items()), tuple(dict.fromkeys(defines)))


def with_tasks(path: str, project: TwinCatProject, texts: Mapping[str, str]) -> TwinCatProject:
    """The project of this path with the tasks that it compiles, whose texts are given by their paths."""
    folder = posixpath.dirname(path.replace("\\", "/"))
    known = {each.replace("\\", "/").lower(): text for each, text in texts.items()}
    paths = (posixpath.normpath(posixpath.join(folder, each)).lower() for each in project.compiled)
    found = (read_task(known[each]) for each in paths if each in known)
    return replace(project, tasks=tuple(each for each in found if each is not None))


def with_absent(path: str, project: TwinCatProject, files: Iterable[str]) -> TwinCatProject:
    """The project of this path, which says what it compiles that is not among these files."""
    folder = posixpath.dirname(path.replace("\\", "/"))
    known = {each.replace("\\", "/").lower() for each in files}
    wanted = (each for each in project.compiled if each.lower().endswith(XML_ENDINGS))
    absent = (each for each in wanted if posixpath.normpath(posixpath.join(folder, each)).lower() not in known)
    return replace(project, absent=tuple(dict.fromkeys(absent)))


def left_out(paths: Collection[str], projects: Mapping[str, TwinCatProject]) -> set[str]:
    """The exported files at and below these projects that none of them compiles; Windows does not tell capitals apart."""
    compiled = {
        posixpath.normpath(posixpath.join(posixpath.dirname(path), each)).lower()
        for path, project in projects.items()
        for each in project.compiled
    }
    folders = [posixpath.dirname(path) for path, project in projects.items() if project.compiled]
    below = [f"{folder}/" if folder else "" for folder in folders]
    return {
        path
        for path in paths
        if path.lower().endswith(XML_ENDINGS)
        and path.lower() not in compiled
        and any(path.startswith(folder) for folder in below)
    }


def missing_libraries(projects: Collection[TwinCatProject], known: Collection[str]) -> list[str]:
    """Libraries that these projects refer to, of which there is no text: not among themselves, nor `known`."""
    own = {name.lower() for project in projects for name in project.names} | {name.lower() for name in known}
    wanted = {name for project in projects for name, _ in project.references if name.lower() not in own}
    return sorted(wanted, key=str.lower)


def in_parts(
    files: Collection[str], projects: Mapping[str, TwinCatProject]
) -> list[tuple[frozenset[str], frozenset[str], list[TwinCatProject]]]:
    """The programs of these projects, where they are several: with two of them that compile a file of one name, which is that of what it
    declares, there is no program of them all. Of each its own files; these, and those of the projects that it refers to, by whatever
    way; and these projects. Empty where all of them are one program."""
    compiled = {path: _files_of(path, each, files) for path, each in projects.items()}
    names = [posixpath.basename(each).lower() for own in compiled.values() for each in own]
    if len(names) == len(set(names)):
        return []
    made = []
    for path, project in projects.items():
        used, open_ = {path: project}, [project]
        while open_:
            wanted = {name.lower() for name, _ in open_.pop().references}
            fresh = {
                other: each
                for other, each in projects.items()
                if other not in used and wanted & {name.lower() for name in (*each.names, _stem(other))}
            }
            used |= fresh
            open_ += fresh.values()
        shared = {each for own in compiled.values() for each in own}
        own = {
            posixpath.basename(each).lower() for each in compiled[path]
        }  # its names go before those of its libraries
        with_used = {
            each
            for other in used
            for each in compiled[other]
            if other == path or posixpath.basename(each).lower() not in own
        }
        loose = {each for each in files if each not in shared and not each.lower().endswith(XML_ENDINGS)}
        if compiled[path]:
            made.append((frozenset(compiled[path]), frozenset(with_used | loose), list(used.values())))
    return made


def _stem(path: str) -> str:
    return posixpath.basename(path.replace("\\", "/")).rpartition(".")[0]


def _files_of(path: str, project: TwinCatProject, files: Collection[str]) -> list[str]:
    folder = posixpath.dirname(path.replace("\\", "/"))
    wanted = {posixpath.normpath(posixpath.join(folder, each)).lower() for each in project.compiled}
    return [each for each in files if each.replace("\\", "/").lower() in wanted and each.lower().endswith(XML_ENDINGS)]
