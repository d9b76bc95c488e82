"""A project in a folder, compiled once for all tests."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from scanbench.check.build import check_sources
from scanbench.check.typed.condition import Condition
from scanbench.engines.engine import Engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.pair import PairEngine
from scanbench.plcmodel.load import NoSuchModel, model_named
from scanbench.program.program import Program
from scanbench.runtime.programs import Loaded
from scanbench.server.completed import completed
from scanbench.server.from_disk import (
    DEFAULT_MODEL,
    package_files,
    program_files,
    project_model,
    read_text,
    twincat_projects,
)
from scanbench.syntax.language_file import LANGUAGE_FILE, with_dialect_by_format
from scanbench.wire.refused import Refused

ENGINES: dict[str, Callable[[Program, bytearray], Engine]] = {
    "native": NativeEngine,
    "reference": ReferenceEngine,
    "both": PairEngine,
}
"""By which a program is run: quick; the interpreter; both, compared after every scan."""
INTERVAL_NS = 10_000_000
"""Of a task, where the program sets none."""


class BrokenProject(Exception):
    """There is no program to test; the message says why, a line for each problem."""


@dataclass(frozen=True, slots=True)
class Project:
    """A program that can run at once. Its memory is that of one PLC after the other: of one test at a time."""

    path: Path
    model: str
    files: dict[str, str]
    """Texts by their names in the project."""
    loaded: Loaded
    conditions: dict[tuple[str, bool], Condition] = field(default_factory=dict)
    """Those that were asked for, by their texts."""

    @staticmethod
    def read(path: Path, engine: str = "native") -> "Project":
        """A folder with program files and perhaps a project.json, or a single file; `BrokenProject`."""
        try:
            texts = {str(each): read_text(each) for each in program_files(path)}
            name = project_model(path) or DEFAULT_MODEL
            projects = twincat_projects(path).values() if path.is_dir() else ()
        except Refused as error:
            raise BrokenProject(str(error)) from error
        try:
            model = model_named(name)
        except NoSuchModel as error:
            raise BrokenProject(str(error)) from error
        folder = path if path.is_dir() else path.parent
        texts = with_dialect_by_format(texts, str(folder / LANGUAGE_FILE), package_files(path))
        made = {_below(folder, each): text for each, text in completed(texts, projects, str(folder)).items()}
        checked = check_sources(made, model, INTERVAL_NS)
        if checked.program is None:
            raise BrokenProject("\n".join(map(str, checked.problems)))
        return Project(path, model.name, made, Loaded.make(checked.program, ENGINES[engine]))


def _below(folder: Path, name: str) -> str:
    """Its name in the project: that of a library is in no folder of this machine."""
    path = Path(name)
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else name
