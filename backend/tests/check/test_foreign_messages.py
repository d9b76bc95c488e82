"""What people read whose programs come from another tool: the commonest errors, as they were reviewed.

`foreign_messages.txt` has programs, and all that is said of each but what a dialect allows (W006): what is wrong, where, and what to do.
A mistake that has one cause is told three times at most.
"""

from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.check.libraries.catalogue import used_libraries
from scanbench.syntax.language_file import DialectName, with_dialect
from tests.caseformat import MODELS

TEXT = Path(__file__).with_name("foreign_messages.txt").read_text("utf-8")
ROWS = [each.split("\n", 1) for each in TEXT.split("=== ")[1:]]
FILE = "a.st"
BARE = ", without its libraries"
DIALECTS: dict[str, DialectName] = {"iec": "iec", "codesys": "codesys", "twincat": "twincat"}


@pytest.mark.parametrize(("title", "row"), ROWS, ids=[title for title, _ in ROWS])
def test_what_is_said(title: str, row: str) -> None:
    program, _, expected = row.partition("\n---\n")
    named = title.rpartition(" (")[2].removesuffix(")")
    dialect = DIALECTS[named.removesuffix(BARE)]
    sources = with_dialect({FILE: f"{program}\n"}, dialect)
    if not named.endswith(BARE):
        sources |= {each.path: each.text for each in used_libraries(sources, dialect)}
    found = check_sources(sources, MODELS["GENERIC-IEC"])
    assert found.program is None
    told = [
        f"{each.span.line}:{each.span.column} {each.code} {each.message}"
        for each in found.problems
        if each.code != "W006" and each.span.file == FILE
    ]
    assert told == expected.strip().splitlines()
    assert "None" not in expected


def test_there_are_sixty_of_them() -> None:
    assert len(ROWS) >= 60
    assert len({title for title, _ in ROWS}) == len(ROWS)
