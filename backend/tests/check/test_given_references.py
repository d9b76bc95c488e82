"""What properties and methods of the type REFERENCE TO are refused for, and that nothing untrue is said of them."""

import pytest

from scanbench.check.build import check_sources
from scanbench.syntax.language_file import LANGUAGE_FILE, language_text
from tests.caseformat import MODELS

SOURCE = """TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
FUNCTION_BLOCK Holder
VAR pair : Pair; END_VAR
PROPERTY Both : REFERENCE TO Pair
GET Both REF= pair; END_GET
END_PROPERTY
METHOD Found : REFERENCE TO Pair
Found REF= pair;
END_METHOD
METHOD Copied : Pair
Copied := pair;
END_METHOD
METHOD Count : INT
END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main
VAR holder : Holder; p : POINTER TO Pair; i : POINTER TO INT; r : REFERENCE TO Pair; END_VAR
{}
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("p := holder.Found();", ["T002 `p` is POINTER TO Pair, but this is Pair. Write ADR(variable)."]),
        ("p := holder.Both;", ["T002 `p` is POINTER TO Pair, but this is Pair. Write ADR(variable)."]),
        ("p := ADR(holder.Found());", []),
        ("p := ADR(holder.Both);", []),
        ("r REF= holder.Found();", []),
        ("p := ADR(holder.Copied());", ["T013 Only a variable can be referred to."]),
        ("i := ADR(holder.Count());", ["W006 The result of a call is temporary."]),
    ],
)
def test_what_they_give_is_what_they_refer_to(line: str, said: list[str]) -> None:
    sources = {"main.st": SOURCE.format(line), LANGUAGE_FILE: language_text("codesys")}
    problems = check_sources(sources, MODELS["GENERIC-IEC"]).problems
    assert [f"{each.code} {each.message}"[: len(text)] for each, text in zip(problems, said, strict=True)] == said
