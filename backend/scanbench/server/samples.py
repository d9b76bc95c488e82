"""The projects that a first start finds, `samples/<name>/` of the package, and what a new project can begin with: these, and `templates/<name>/`."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable

from scanbench.plcmodel.user_errors import CATALOGUE_FILES
from scanbench.server.operator_panels import is_panel_file
from scanbench.syntax.language_file import LANGUAGE_FILE
from scanbench.syntax.parse_file import is_program_file
from scanbench.syntax.requirements import REQUIREMENTS

_OTHERS = (*CATALOGUE_FILES, LANGUAGE_FILE, REQUIREMENTS)


@dataclass(frozen=True, slots=True)
class Sample:
    """A project that ships."""

    id: str
    """Name of its folder."""
    name: str
    model: str
    watch: tuple[str, ...]
    files: dict[str, str]


def samples() -> Iterator[Sample]:
    """Every sample that ships, by name."""
    return _projects("samples")


def templates() -> list[Sample]:
    """What a new project can begin with: the templates, then the samples."""
    return [*_projects("templates"), *samples()]


def _projects(room: str) -> Iterator[Sample]:
    root = files("scanbench").joinpath(room)
    for folder in sorted(root.iterdir(), key=lambda each: each.name):
        if not folder.is_dir() or not folder.joinpath("project.json").is_file():
            continue
        about = json.loads(folder.joinpath("project.json").read_text("utf-8"))
        texts = dict(_texts(folder, ""))
        yield Sample(folder.name, about["name"], about["model"], tuple(about.get("watch", ())), texts)


def _texts(folder: Traversable, path: str) -> Iterator[tuple[str, str]]:
    """Path and text of each program file, also of those in folders (`plant/`), and of each operator panel."""
    for each in sorted(folder.iterdir(), key=lambda each: each.name):
        if each.is_dir():
            yield from _texts(each, f"{path}{each.name}/")
        elif is_program_file(f"{path}{each.name}") or is_panel_file(each.name) or f"{path}{each.name}" in _OTHERS:
            yield f"{path}{each.name}", each.read_text("utf-8")
