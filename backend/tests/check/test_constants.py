"""Constants: their order means nothing, and one that has no value says why."""

import pytest

from scanbench.check.build import check_sources
from scanbench.check.declare.later import MAX_CONSTANTS
from tests.caseformat import MODELS

MAIN = "PROGRAM Main\nVAR a : INT; END_VAR\nEND_PROGRAM\n"
LIST = (
    '<?xml version="1.0" encoding="utf-8"?><TcPlcObject Version="1.1.0.1"><GVL Name="{}" Id="{{1}}"><Declaration>'
    "<![CDATA[VAR_GLOBAL CONSTANT\n{}\nEND_VAR]]></Declaration></GVL></TcPlcObject>"
)
NEEDS_ITSELF = "The value of `{}` needs itself: {}. Give one of them a value that needs none of the others."
VARIABLE = "A constant is needed here; `v` is a variable, and no CONSTANT."


def messages(*texts: str) -> list[str]:
    sources = {f"{number}.st": text for number, text in enumerate(texts)}
    return [each.message for each in check_sources(sources, MODELS["GENERIC-IEC"]).problems]


def test_a_circle_is_told_once_with_its_path() -> None:
    text = "VAR_GLOBAL CONSTANT a : INT := b; b : INT := c + 1; c : INT := 2 * a; d : INT := c; END_VAR\n"
    assert messages(text, MAIN) == [NEEDS_ITSELF.format("a", "a -> b -> c -> a")]
    assert messages("VAR_GLOBAL CONSTANT a : INT := a + 1; END_VAR\n", MAIN) == [NEEDS_ITSELF.format("a", "a -> a")]


def test_a_circle_through_lists_has_their_names() -> None:
    sources = {
        "A.TcGVL": LIST.format("GA", "N : INT := GB.M;"),
        "B.TcGVL": LIST.format("GB", "M : INT := GA.N;"),
        "m.st": MAIN,
    }
    found = check_sources(sources, MODELS["GENERIC-IEC"]).problems
    assert [each.message for each in found] == [NEEDS_ITSELF.format("N", "GA.N -> GB.M -> GA.N")]


@pytest.mark.parametrize(
    "text",
    [
        "VAR_GLOBAL CONSTANT x : INT := v; END_VAR VAR_GLOBAL v : INT := 3; END_VAR\n" + MAIN,
        "VAR_GLOBAL w : INT := v; v : INT := 3; END_VAR\n" + MAIN,
        MAIN.replace("a : INT;", "a : INT := v; v : INT;"),
        "FUNCTION_BLOCK F\nVAR CONSTANT x : INT := v; END_VAR VAR v : INT; END_VAR\nEND_FUNCTION_BLOCK\n" + MAIN,
    ],
)
def test_a_variable_is_no_constant(text: str) -> None:
    assert messages(text) == [VARIABLE]


def test_what_needs_a_constant_whose_declaration_is_wrong_says_nothing() -> None:
    text = "PROGRAM Main\nVAR CONSTANT a : INT := b; b : Missing := 3; c : INT := b; END_VAR\nEND_PROGRAM\n"
    assert messages(text) == ["There is no type `Missing`."]


@pytest.mark.parametrize(("many", "codes"), [(MAX_CONSTANTS - 1, []), (MAX_CONSTANTS, ["S003"])])
def test_a_chain_of_constants_is_as_long_as_is_said(many: int, codes: list[str]) -> None:
    deep = "(" * 190, ")" * 190
    chain = "".join(f"c{n} : INT := {deep[0]}c{n + 1}{deep[1]};" for n in range(many))
    text = f"VAR_GLOBAL CONSTANT {chain} c{many} : INT := 1; END_VAR\n"
    found = check_sources({"a.st": text + MAIN}, MODELS["GENERIC-IEC"]).problems
    assert [each.code for each in found] == codes


def test_a_local_constant_is_not_known_to_the_blocks_that_variables_use() -> None:
    block = "FUNCTION_BLOCK F\nVAR list : ARRAY[1..K] OF INT; END_VAR\nEND_FUNCTION_BLOCK\n"
    assert messages(MAIN.replace("a : INT;", "f : F; END_VAR VAR CONSTANT K : INT := 2;"), block) == [
        "`K` is not declared."
    ]
