from collections.abc import Callable
from pathlib import Path
from shutil import copy

import pytest

from scanbench.plcmodel.load import load_all, model_directory
from scanbench.plcmodel.model import Model
from scanbench.problems import Problem

Load = Callable[[str], tuple[Model | None, list[Problem]]]


@pytest.fixture(scope="session")
def models() -> dict[str, Model]:
    found, problems = load_all(model_directory())
    assert problems == []
    return {model.name: model for model in found}


@pytest.fixture(scope="session")
def cj1m(models: dict[str, Model]) -> Model:
    return models["CJ1M-CPU63"]


@pytest.fixture(scope="session")
def generic(models: dict[str, Model]) -> Model:
    return models["GENERIC-IEC"]


@pytest.fixture
def directory(tmp_path: Path) -> Path:
    """A directory of models that has only the schema so far."""
    copy(model_directory() / "model.xsd", tmp_path)
    (tmp_path / "maker").mkdir()
    return tmp_path


@pytest.fixture
def load(directory: Path) -> Load:
    """Loads one text as `maker/TEST.xml`."""

    def load_text(text: str) -> tuple[Model | None, list[Problem]]:
        (directory / "maker" / "TEST.xml").write_text(text, encoding="utf-8")
        models, problems = load_all(directory)
        return (models[0] if models else None), problems

    return load_text
