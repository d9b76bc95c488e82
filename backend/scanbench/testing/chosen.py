"""Which program the tests of pytest are of."""

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:  # what is not asked for must not make the start of other tests slow
    from scanbench.testing.project import Project


def named_project(config: pytest.Config) -> Path | None:
    """The folder or file of the program that the option names, else pytest.ini; None where neither does."""
    if config.getoption("--scanbench-project"):
        return config.invocation_params.dir / str(config.getoption("--scanbench-project"))
    if config.getini("scanbench_project"):
        return config.rootpath / str(config.getini("scanbench_project"))
    return None


@cache
def read_project(path: Path, engine: str) -> "Project":
    """Compiled once for all tests; without a program the test fails with its problems."""
    from scanbench.testing.project import BrokenProject, Project

    try:
        return Project.read(path, engine)
    except BrokenProject as error:
        told = str(error)
    pytest.fail(f"{path} cannot be tested:\n{told}", pytrace=False)
