"""Model files to models. Whatever is wrong with one file is told with its place; the other files still load."""

import os
from pathlib import Path

from scanbench.plcmodel.document import SCHEMA
from scanbench.plcmodel.library import Library, duplicate
from scanbench.plcmodel.model import Model
from scanbench.problems import Problem


class NoModels(Exception):
    """There is no directory of models to load; the message says where it was looked for."""


def model_directory() -> Path:
    """Where the models are: SCANBENCH_MODELS, or `models` beside `backend`."""
    named = os.environ.get("SCANBENCH_MODELS")
    directory = Path(named) if named else Path(__file__).resolve().parents[3] / "models"
    if not (directory / SCHEMA).is_file():
        origin = "named by SCANBENCH_MODELS" if named else "set SCANBENCH_MODELS to the directory of the model files"
        raise NoModels(f"{directory / SCHEMA} does not exist ({origin})")
    return directory


def load_all(directory: Path) -> tuple[list[Model], list[Problem]]:
    """Every model of `directory/<vendor>/<MODEL>.xml` that is right, and what is wrong with the others."""
    library = Library(directory)
    models: dict[str, Model] = {}
    problems: list[Problem] = []
    for file in library.paths:
        model, found = library.load(file)
        problems += found
        if model is None:
            continue
        first = library.named(model.name)
        if model.name in models:
            problems.append(duplicate(file, model.name, first or file))
            continue
        models[model.name] = model
    return list(models.values()), problems


def load_named(directory: Path, name: str) -> tuple[Model | None, list[Problem]]:
    """The model of this name; only its file and those it is based on are read, as a rule."""
    library = Library(directory)
    file = library.named(name)
    return (None, []) if file is None else library.load(file)


def load_file(path: Path, directory: Path) -> tuple[Model | None, list[Problem]]:
    """One model file from anywhere; the schema, and the model it may be based on, come from `directory`."""
    return Library(directory, (path,)).load(str(path))
