"""The examples on the pages of the problems of model files."""

import pytest

from scanbench.problems import TABLE
from tests.docs.test_problem_pages import examples

from .conftest import Load
from .test_load import SMALL


@pytest.mark.parametrize("code", sorted(code for code in TABLE if code.startswith("M")))
def test_the_failing_example_fails(code: str, load: Load) -> None:
    """They are parts of a small model that has no problems."""
    failing, corrected = examples(code)
    assert SMALL.count(corrected) == 1, corrected
    problems = load(SMALL.replace(corrected, failing))[1]
    assert code in {problem.code for problem in problems}, problems
