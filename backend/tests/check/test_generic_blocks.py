"""VAR_GENERIC CONSTANT: what is refused, and that edits and the editor know the blocks that are made."""

import pytest

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from scanbench.problems import Severity
from scanbench.syntax.language_file import DialectName, with_dialect
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
BUFFER = """FUNCTION_BLOCK Buffer
VAR_GENERIC CONSTANT N : INT(1..50); END_VAR
VAR data : ARRAY[1..N] OF INT; k : INT; END_VAR
data[N] := k;
END_FUNCTION_BLOCK
"""


def errors(text: str, dialect: DialectName = "codesys") -> list[str]:
    found = check_sources(with_dialect({"a.st": text}, dialect), MODEL).problems
    return [f"{each.code} {each.span.line} {each.message}" for each in found if each.severity is Severity.ERROR]


def main(declaration: str, constants: str = "") -> str:
    return f"{BUFFER}PROGRAM Main\nVAR CONSTANT five : INT := 5; {constants} END_VAR\nVAR n : INT; {declaration} END_VAR\nEND_PROGRAM\n"


@pytest.mark.parametrize(
    "declaration",
    ["b : Buffer<5>;", "b : Buffer<five>;", "b : ARRAY[1..2] OF Buffer<(five * 2)>;", "p : POINTER TO Buffer<7>;"],
)
def test_values_are_constants(declaration: str) -> None:
    assert not errors(main(declaration))
    assert [each[:4] for each in errors(main(declaration), "iec")] == ["X001"]


@pytest.mark.parametrize(
    ("declaration", "complaint"),
    [
        ("b : Buffer;", "D002 8 `Buffer` has 1 generic constants, not 0: write `Buffer<N>` with a value for each."),
        ("b : Buffer<1, 2>;", "D002 8 `Buffer` has 1 generic constants, not 2"),
        ("b : Buffer<n>;", "D004 8 The value of a generic constant is"),
        ("b : Buffer<(five / 0)>;", "D004 8 The value of a generic constant is"),
        ("b : Buffer<60>;", "S004 8"),
        ("b : TON<3>;", "D002 8 `TON` has no generic constants"),
        ("b : Buffer<five;", "S003 8 `>` expected to close the values"),
    ],
)
def test_what_is_no_value_is_refused(declaration: str, complaint: str) -> None:
    found = errors(main(declaration))
    assert any(each.startswith(complaint) for each in found), found


def test_a_variable_hides_the_constant_of_its_name() -> None:
    text = "VAR_GLOBAL CONSTANT k, n : INT := 9; END_VAR\n" + main("b : Buffer<n>;")
    assert [each[:6] for each in errors(text)] == ["D004 9"]
    assert not errors("VAR_GLOBAL CONSTANT k, n : INT := 9; END_VAR\n" + main("b : Buffer<k>;"))


def test_one_that_contains_itself_with_other_constants_ends() -> None:
    text = main("b : Buffer<1>;").replace("VAR data", "VAR inner : Buffer<(N + 1)>; data")
    assert any(each.startswith("D003") for each in errors(text))


def test_an_error_in_the_block_is_told_once() -> None:
    text = main("a : Buffer<5>; b : Buffer<6>;").replace("data[N] := k;", "data[N] := unknown;")
    assert [each[:6] for each in errors(text)] == ["T001 4"]


def test_an_edit_gives_what_a_fresh_check_gives() -> None:
    checks = Checks()
    texts = [
        main("b : Buffer<5>;"),
        main("b : Buffer<6>;"),
        main("b : Buffer<6>;").replace(":= k", ":= k + 1"),
        main("b : Buffer;"),
    ]
    for text in texts:
        sources = with_dialect({"a.st": text}, "codesys")
        changed, fresh = checks.check(sources, MODEL, 10_000_000), check_sources(sources, MODEL)
        assert changed.problems == fresh.problems
        assert (changed.program is None) == (fresh.program is None)
        if changed.program is not None and fresh.program is not None:
            assert [pou.name for pou in changed.program.pous] == [pou.name for pou in fresh.program.pous]
            assert changed.program.layout.size == fresh.program.layout.size
