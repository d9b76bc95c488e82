"""Every problem has a page, and the examples on it do what the page says."""

import re
from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.problems import TABLE, Severity
from scanbench.syntax.language_file import DialectName, with_dialect
from tests.caseformat import MODELS

PAGES = Path(__file__).parents[3] / "docs/problems"
FENCE = re.compile(r"```(\w+)\n(.*?)\n```", re.DOTALL)
LANGUAGE = sorted(code for code in TABLE if code[0] not in "MR")


def examples(code: str) -> tuple[str, str]:
    """The failing and the corrected example of a page."""
    failing, corrected = FENCE.findall((PAGES / f"{code}.md").read_text("utf-8"))
    return failing[1], corrected[1]


def test_every_problem_has_a_page_with_its_title() -> None:
    titles = {path.stem: path.read_text("utf-8").splitlines()[0] for path in PAGES.glob("????.md")}
    assert titles == {code: f"# {code}: {title}" for code, title in TABLE.items()}


@pytest.mark.parametrize("code", LANGUAGE)
def test_the_failing_example_fails_and_the_corrected_one_does_not(code: str) -> None:
    model = MODELS["CJ1M-CPU63" if code == "T011" else "GENERIC-IEC"]
    dialect: DialectName = "codesys" if code == "W006" else "iec"
    sources = (with_dialect({"a.st": text}, dialect) for text in examples(code))
    failing, corrected = (check_sources(each, model).problems for each in sources)
    assert code in {problem.code for problem in failing}, failing
    assert [problem for problem in corrected if problem.severity is Severity.ERROR or problem.code == code] == []


def test_the_index_lists_every_page() -> None:
    index = (PAGES / "README.md").read_text("utf-8")
    assert [line for line in index.splitlines() if line.startswith("| [")] == [
        f"| [{code}]({code}.md) | {title} |" for code, title in TABLE.items()
    ]
