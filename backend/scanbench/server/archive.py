"""A project as one zip file: `project.json`, the program files in their folders, operator panels, and the project's own errors.

What other tools have packed is read, too: a folder of program files, also within folders, and a TwinCAT project, of which the
`.plcproj` says which files are compiled.
"""

import io
import json
import posixpath
import re
import zipfile
import zlib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import PurePosixPath
from uuid import NAMESPACE_URL, uuid5

from scanbench.server.foreign_archive import is_foreign, notes, read_foreign
from scanbench.server.from_disk import PROJECT_FILE, project_file
from scanbench.server.project_files import OWN_FILES, is_beside
from scanbench.server.twincat_project import (
    ENDING,
    TwinCatProject,
    is_twincat_project,
    read_twincat_project,
    with_tasks,
)
from scanbench.server.twincat_tasks import ENDING as TASKS
from scanbench.syntax.imported import Project
from scanbench.syntax.language_file import STRICT, DialectName, guess_dialect, language_of
from scanbench.syntax.parse_file import ENDINGS, XML_ENDINGS, is_program_file
from scanbench.syntax.source import decode
from scanbench.wire.refused import Refused

LARGEST = 64 << 20
"""Bytes, packed or not."""
MOST_FILES = 5000
_NO_FILE_NAME = re.compile(r'[<>:"/\\|?*\x00-\x1f]')
_NEITHER = (
    "this is neither a zip file nor XML that can be read. Choose a zip file of program files, or a PLCopen or L5X file"
)
NOTES_FILE = "ImportNotes.st"
"""Of comments alone: what a project that was taken in lacks."""
_WHEN = (1980, 1, 1, 0, 0, 0)
"""The same project makes the same bytes."""


@dataclass(frozen=True, slots=True)
class Archive:
    """What an archive has of a project."""

    name: str
    """As its project file says; empty without one."""
    model: str
    """The same."""
    watch: tuple[str, ...]
    """What a fresh watch list begins with."""
    files: dict[str, str]
    """Path and text of each program file."""
    panels: dict[str, str]
    """The same of each operator panel."""
    left_out: tuple[str, ...]
    """Files that are no programs, or not compiled by their TwinCAT project."""
    dialect: DialectName = STRICT
    """The one that its programs are probably written in, where no file of it says so; of what Scanbench packed the strict one."""
    notes: tuple[str, ...] = ()
    """Of a PLCopen or L5X file what could not be kept as it was."""
    twincat: tuple[TwinCatProject, ...] = ()
    """What the project files of TwinCAT say that are in it; of what Scanbench packed none."""


def pack(name: str, model: str, watch: Sequence[str], files: Mapping[str, str]) -> bytes:
    """The archive of a project; with files of TwinCAT also the project file by which that takes them."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, text in {
            PROJECT_FILE: project_file(name, model, watch),
            **_twincat_project(name, files),
            **files,
        }.items():
            archive.writestr(zipfile.ZipInfo(path, _WHEN), text.encode(), zipfile.ZIP_DEFLATED)
    return made.getvalue()


def _twincat_project(name: str, files: Mapping[str, str]) -> dict[str, str]:
    """The `.plcproj` that lists the files of TwinCAT, with their folders; none where there are no such files."""
    defines = language_of(files)[0].defines
    listed = sorted(path for path in files if path.lower().endswith(XML_ENDINGS))
    if not listed:
        return {}
    folders = sorted({str(folder) for path in listed for folder in PurePosixPath(path).parents} - {"."})
    compiled = [
        f'    <Compile Include="{_windows(path)}">\n      <SubType>Code</SubType>\n    </Compile>' for path in listed
    ]
    lines = [
        '<?xml version="1.0" encoding="utf-8"?>',
        '<Project DefaultTargets="Build" xmlns="http://schemas.microsoft.com/developer/msbuild/2003">',
        "  <PropertyGroup>",
        "    <FileVersion>1.0.0.0</FileVersion>",
        "    <SchemaVersion>2.0</SchemaVersion>",
        f"    <ProjectGuid>{{{uuid5(NAMESPACE_URL, name)}}}</ProjectGuid>",
        f"    <Name>{escape(name)}</Name>",
        *(f"    <CompilerDefines>{escape(', '.join(each))}</CompilerDefines>" for each in [defines] if each),
        "  </PropertyGroup>",
        "  <ItemGroup>",
        *compiled,
        "  </ItemGroup>",
        "  <ItemGroup>",
        *(f'    <Folder Include="{_windows(folder)}" />' for folder in folders),
        "  </ItemGroup>",
        "</Project>",
    ]
    plain = _NO_FILE_NAME.sub("_", name)
    return {f"{plain}{ENDING}": "\n".join(lines) + "\n"}


def _windows(path: str) -> str:
    """With `%28` and the like for the signs that MSBuild has a meaning for."""
    return escape(re.sub(r"[%$@'();?*]", lambda sign: f"%{ord(sign[0]):02X}", path.replace("/", "\\")))


def unpack(data: bytes) -> Archive:
    """What an archive, or a PLCopen or L5X file, has; `Refused` where it is none, too large, or without a program."""
    if is_foreign(data):
        return _of_foreign(read_foreign(data))
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return _unpacked(archive)
    except (
        zipfile.BadZipFile,
        zlib.error,
        EOFError,
        OSError,
        RuntimeError,
        NotImplementedError,
        UnicodeError,
    ) as error:
        if not data.startswith(b"PK"):
            raise Refused(_NEITHER) from error
        raise Refused(f"this is no zip file that can be read: {error}") from error


def notes_file(archive: Archive) -> dict[str, str]:
    """What is not in a project as it was in its archive, as a file that can be read later; none where all is."""
    told = [*archive.notes, *(f"{path}: left out" for path in archive.left_out)]
    if not told or NOTES_FILE in archive.files:
        return {}
    head = "What is not here as it was in the file from which this project was made. Delete this when nobody needs it."
    return {NOTES_FILE: "".join(f"// {' '.join(each.split())}\n" for each in (head, *told))}


def _of_foreign(made: Project) -> Archive:
    return Archive(made.name, "", (), made.files, {}, (), guess_dialect(made.files), notes=tuple(notes(made)))


def _unpacked(archive: zipfile.ZipFile) -> Archive:
    entries = [each for each in archive.infolist() if not each.is_dir()]
    if len(entries) > MOST_FILES or sum(each.file_size for each in entries) > LARGEST:
        raise Refused(f"this archive has more than {MOST_FILES:,} files, or {LARGEST >> 20} MiB of text")
    named = {path: each for each in entries if (path := _path(each.filename)) is not None}
    left_out = [each.filename for each in entries if _path(each.filename) is None]
    if len(named) + len(left_out) < len(entries):
        raise Refused("this archive has two files of the same name")
    root = _root(named)
    inside = {path.removeprefix(root): each for path, each in named.items() if path.startswith(root)}
    left_out += [path for path in named if not path.startswith(root)]
    # of an archive of Scanbench all files are the project's, whatever its project file for TwinCAT lists
    projects = {} if PROJECT_FILE in inside else _twincat_projects(archive, inside)
    compiled, missing = _compiled(projects, inside)
    files, panels = {}, {}
    for path, each in sorted(inside.items()):
        if path in OWN_FILES or (is_program_file(path) and (compiled is None or path in compiled)):
            data = _read(archive, each)
            if path.lower().endswith(".db") and b"\0" in data[:512]:  # a database, and no data block
                left_out.append(path)
                continue
            files[path] = decode(data)
        elif is_beside(path):
            panels[path] = decode(_read(archive, each))
        elif path != PROJECT_FILE and not is_twincat_project(path) and not (projects and path.lower().endswith(TASKS)):
            left_out.append(path)
    if missing:
        raise Refused(f"the TwinCAT project compiles files that are not in this archive: {', '.join(missing)}")
    if not any(map(is_program_file, files)):
        raise Refused(f"there is no program file ({', '.join(ENDINGS)}) in this archive")
    about = _about(_read(archive, inside[PROJECT_FILE]) if PROJECT_FILE in inside else None)
    name, model, watch = about.get("name"), about.get("model"), about.get("watch")
    return Archive(
        name if isinstance(name, str) else "",
        model if isinstance(model, str) else "",
        tuple(each for each in watch if isinstance(each, str)) if isinstance(watch, list) else (),
        files,
        panels,
        tuple(left_out),
        STRICT if PROJECT_FILE in inside else guess_dialect(files, named),
        twincat=tuple(projects.values()),
    )


def _path(name: str) -> str | None:
    """The path in the archive, with `/`; None of one that leads out of it, and of what a Mac adds to each file."""
    path = posixpath.normpath(name.replace("\\", "/"))
    outside = path.startswith(("/", "../")) or ":" in path or path == ".."
    return None if outside or path.startswith("__MACOSX/") or posixpath.basename(path).startswith("._") else path


def _read(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> bytes:
    if entry.flag_bits & 1:
        raise Refused(f"{entry.filename} in this archive is encrypted: pack it without a password")
    return archive.read(entry)


def _root(texts: Collection[str]) -> str:
    """The folder that the project is in, with `/`: that of its project file, else what all programs have in common."""
    marks = [path for path in texts if posixpath.basename(path) == PROJECT_FILE or is_twincat_project(path)]
    if len(marks) > 1 and not any(path == PROJECT_FILE for path in marks):
        raise Refused(f"this archive has several projects: {', '.join(sorted(marks))}. Pack one of their folders")
    if marks:
        folder = posixpath.dirname(min(marks, key=len))
    else:
        folders = [posixpath.dirname(path) for path in texts if is_program_file(path)]
        folder = posixpath.commonpath(folders) if folders and all(folders) else ""
        folder = posixpath.dirname(folder) if posixpath.basename(folder) == "plant" else folder
    return f"{folder}/" if folder else ""


def _twincat_projects(archive: zipfile.ZipFile, files: Mapping[str, zipfile.ZipInfo]) -> dict[str, TwinCatProject]:
    tasks = {path: decode(_read(archive, each)) for path, each in files.items() if path.lower().endswith(TASKS)}
    return {
        path: with_tasks(path, read_twincat_project(decode(_read(archive, each))), tasks)
        for path, each in files.items()
        if is_twincat_project(path)
    }


def _compiled(projects: Mapping[str, TwinCatProject], files: Collection[str]) -> tuple[set[str] | None, list[str]]:
    """The files that a TwinCAT project compiles, whose names Windows does not tell apart by capitals, and those that are missing;
    None where there is none."""
    if not any(project.compiled for project in projects.values()):
        return None, []
    wanted = [path for project in projects.values() for path in project.compiled]
    known = {path.lower(): path for path in files}
    found = {known[each.lower()] for each in wanted if each.lower() in known}
    return found, [each for each in wanted if each.lower() not in known and is_program_file(each)]


def _about(text: bytes | None) -> dict[str, object]:
    if text is None:
        return {}
    try:
        found = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise Refused(f"{PROJECT_FILE} cannot be read: {error}") from error
    return found if isinstance(found, dict) else {}
