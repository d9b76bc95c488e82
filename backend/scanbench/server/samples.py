"""The projects that a first start finds, `samples/<name>/` of the package, and what a new project can begin with: these, and `templates/<name>/`."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable

from scanbench.server.project_files import is_project_file


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
        elif is_project_file(f"{path}{each.name}"):
            yield f"{path}{each.name}", each.read_text("utf-8")
