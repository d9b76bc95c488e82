"""The examples on the pages of the problems of model files."""

import pytest

from scanbench.plcmodel.read_hardware import read_hardware
from scanbench.problems import TABLE
from tests.docs.test_problem_pages import examples
from tests.runtime.bench import model

from .conftest import Load
from .test_load import SMALL

OF_HARDWARE = "M011"
"""Of `hardware.json`, no model file."""


def test_the_failing_example_of_hardware_fails() -> None:
    failing, corrected = examples(OF_HARDWARE)
    for item, codes in ((failing, [OF_HARDWARE]), (corrected, [])):
        _, problems = read_hardware(model(), f'{{"version": 1, "fitted": [{item}]}}')
        assert [each.code for each in problems] == codes


@pytest.mark.parametrize("code", sorted(code for code in TABLE if code.startswith("M") and code != OF_HARDWARE))
def test_the_failing_example_fails(code: str, load: Load) -> None:
    """They are parts of a small model that has no problems."""
    failing, corrected = examples(code)
    assert SMALL.count(corrected) == 1, corrected
    problems = load(SMALL.replace(corrected, failing))[1]
    assert code in {problem.code for problem in problems}, problems
