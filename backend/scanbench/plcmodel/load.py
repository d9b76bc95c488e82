"""Model files to models. Whatever is wrong with one file is told with its place; the other files still load."""

import os
from collections.abc import Sequence
from difflib import get_close_matches
from pathlib import Path

from scanbench.plcmodel.document import SCHEMA
from scanbench.plcmodel.library import Library, duplicate
from scanbench.plcmodel.model import Model
from scanbench.problems import Problem, perhaps


class NoModels(Exception):
    """There is no directory of models to load; the message says where it was looked for."""


class NoSuchModel(Exception):
    """There is no model of this name; the message says which there are."""


def model_directory() -> Path:
    """Where the models are: SCANBENCH_MODELS, what a wheel brings, or `models` next to `backend`."""
    named, here = os.environ.get("SCANBENCH_MODELS"), Path(__file__).resolve()
    brought = here.parents[1] / "share" / "models"
    directory = Path(named) if named else brought if brought.is_dir() else here.parents[3] / "models"
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


def model_named(name: str, models: Sequence[Model] | None = None) -> Model:
    """The model of this name, in any case, of these or of all that there are; `NoSuchModel` says what there is instead.

    Without `models` only its file and those it is based on are read, as a rule.
    """
    if models is None:
        library = Library(model_directory())
        file = library.named(name)
        model = library.load(file)[0] if file is not None else None
        if model is not None:
            return model
        models = load_all(library.directory)[0]
    by_name = {model.name.upper(): model for model in models}
    if (found := by_name.get(name.upper())) is not None:
        return found
    near = get_close_matches(name.upper(), by_name, n=1)
    known = ", ".join(each.name for each in models)
    hint = f".{perhaps(by_name[each].name for each in near)}" if near else f"; there are {known}"
    raise NoSuchModel(f"there is no model {name}{hint}")


def load_file(path: Path, directory: Path) -> tuple[Model | None, list[Problem]]:
    """One model file from anywhere; the schema, and the model it may be based on, come from `directory`."""
    return Library(directory, (path,)).load(str(path))
