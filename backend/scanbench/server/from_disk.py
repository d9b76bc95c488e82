"""Program files from a folder or file on this machine: which they are, what they say, and which model they want."""

import json
from collections.abc import Sequence
from pathlib import Path

from scanbench.server.project_files import OWN_FILES
from scanbench.server.twincat_project import (
    ENDING,
    TwinCatProject,
    left_out,
    read_twincat_project,
    with_absent,
    with_tasks,
)
from scanbench.server.twincat_tasks import ENDING as TASKS
from scanbench.syntax.language_file import PACKAGE_FILE
from scanbench.syntax.parse_file import ENDINGS, is_program_file
from scanbench.syntax.source import decode
from scanbench.wire.refused import Refused

LOOKED_AT = 65_536
"""Bytes of a file that say what it is."""
DEFAULT_MODEL = "GENERIC-IEC"
PROJECT_FILE = "project.json"


def program_files(path: Path) -> list[Path]:
    """A file is taken whatever its ending; a folder gives every program file in it and below, its own errors, what is fitted, and
    what it requires.

    `Refused` when there is none.
    """
    if not path.is_dir():
        if not path.exists():
            raise Refused(f"{path} does not exist")
        return [path]
    found = sorted(each for each in path.rglob("*") if is_program_file(str(each.relative_to(path))) and _is_text(each))
    unused = left_out([str(each) for each in found], twincat_projects(path))
    found = [each for each in found if str(each) not in unused]
    if not found:
        if other := next((each for each in sorted(path.rglob("*")) if each.suffix.lower() == ".l5x"), None):
            raise Refused(
                f"there is no program file in {path}, but {other.name} is one of Studio 5000 (L5X). Import it: `scanbench import "
                f"{other} DIR`, and check DIR."
            )
        raise Refused(f"there is no program file ({', '.join(ENDINGS)}) in {path}")
    return found + [each for name in OWN_FILES if (each := path / name).is_file()]


def _is_text(path: Path) -> bool:
    """Whether it is a file, and none of a database or of EPICS, which may have the ending of Siemens' data blocks."""
    if not path.is_file() or path.suffix.lower() != ".db":
        return path.is_file()
    with path.open("rb") as file:
        begin = file.read(LOOKED_AT)
    return b"\0" not in begin[:512] and (b"DATA_BLOCK" in begin.upper() or b"record(" not in begin)


def twincat_projects(folder: Path) -> dict[str, TwinCatProject]:
    """What the project files of TwinCAT in a folder and below say, by path."""
    files = sorted(each for each in folder.rglob("*") if each.is_file())
    tasks = {str(each): read_text(each) for each in files if each.suffix.lower() == TASKS}
    made = {str(each): read_twincat_project(read_text(each)) for each in files if each.suffix.lower() == ENDING}
    names = [*map(str, files)]
    return {path: with_absent(path, with_tasks(path, each, tasks), names) for path, each in made.items()}


def package_files(path: Path) -> list[str]:
    """Files of a folder, and below, that say that its programs are packages of SIMATIC AX; of a file, the one beside it."""
    folder = path if path.is_dir() else path.parent
    beside = folder / PACKAGE_FILE
    return [str(each) for each in (folder.rglob(PACKAGE_FILE) if path.is_dir() else (beside,)) if each.is_file()]


def read_text(path: Path) -> str:
    """The text of a program file; `Refused` when it cannot be read."""
    try:
        return decode(path.read_bytes())
    except OSError as error:
        raise Refused(f"{path} cannot be read: {error.strerror}") from error


def project_model(folder: Path) -> str | None:
    """The model that the project file of a folder names; None where there is none."""
    path = folder / PROJECT_FILE
    if not path.is_file():
        return None
    try:
        content = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise Refused(f"{path} cannot be read: {error}") from error
    model = content.get("model") if isinstance(content, dict) else None
    return model if isinstance(model, str) else None


def project_file(name: str, model: str, watch: Sequence[str]) -> str:
    """The text of a project file: name, model, and what a fresh watch list begins with."""
    said = {"name": name, "model": model, "watch": list(watch)}
    return json.dumps(said, ensure_ascii=False, indent=2) + "\n"
