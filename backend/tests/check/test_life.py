"""FB_init and what belongs to it: what is told and what is refused."""

import pytest

from scanbench.check.build import check_sources
from scanbench.problems import Severity
from scanbench.syntax.language_file import DialectName, with_dialect
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
INPUTS = "bInitRetains : BOOL; bInCopyCode : BOOL;"


def block(inputs: str, more: str = "", head: str = "Unit", attribute: str = "") -> str:
    return (
        f"FUNCTION_BLOCK {head}\nVAR level : INT; END_VAR\n{attribute}METHOD FB_init : BOOL\nVAR_INPUT {inputs} END_VAR\n"
        f"{more}END_METHOD\nEND_FUNCTION_BLOCK\n"
    )


def main(declared: str, body: str = "") -> str:
    return f"PROGRAM Main\nVAR {declared} END_VAR\n{body}\nEND_PROGRAM\n"


def found(text: str, dialect: DialectName = "codesys") -> list[tuple[str, str]]:
    problems = check_sources(with_dialect({"a.st": text}, dialect), MODEL).problems
    return [(each.code, each.message) for each in problems if each.severity is Severity.ERROR]


@pytest.mark.parametrize(
    ("text", "code", "said"),
    [
        (block("bInitRetains : BOOL;") + main("u : Unit;"), "D014", "`bInCopyCode : BOOL`"),
        (block(INPUTS + "nr : INT;") + main("u : Unit;"), "T004", "`Unit.FB_init` needs `nr`: `Unit(nr := ...)`"),
        (block(INPUTS + "number : INT;") + main("u : Unit(numbr := 3);"), "T004", "has no input `numbr`. Did you mean `number`?"),
        (block(INPUTS + "nr : INT;") + main("u : Unit(3, 4);"), "T004", "takes 1 further arguments, not 2"),
        (block(INPUTS + "nr : INT;") + main("u : ARRAY[1..2] OF Unit[(1)];"), "D004", "has 2 elements, but arguments for 1"),
        (block(INPUTS + "nr : INT;") + main("u : Unit('a');"), "T002", "`nr"),
        (block(INPUTS) + main("u : Unit;", "u.FB_init(TRUE, FALSE);"), "X001", "a method of another name"),
        (
            block(INPUTS) + block(INPUTS, "SUPER^.FB_init(TRUE, FALSE);\n", "Next EXTENDS Unit").replace("VAR level : INT; END_VAR\n", "") + main("u : Next;"),
            "X001", "has run already",
        ),
        (
            block(INPUTS + "nr : INT;") + block(INPUTS, "", "Next EXTENDS Unit").replace("VAR level : INT; END_VAR\n", "") + main("u : Next;"),
            "D014", "`Next.FB_init` needs the input `nr` as well",
        ),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_once(text: str, code: str, said: str) -> None:
    problems = [each for each in found(text) if "level" not in each[1]]
    assert [each for each, _ in problems] == [code], problems
    assert said in problems[0][1]


def test_the_strict_language_says_what_it_said_before() -> None:
    problems = found(block(INPUTS) + main("u : Unit(level := 3);"), "iec")
    assert [code for code, _ in problems] == ["X001"]
    assert "would never be called" in problems[0][1]


def test_a_method_after_the_initialisation_has_no_inputs() -> None:
    text = block(
        INPUTS, "END_METHOD\n{attribute 'call_after_init'}\nMETHOD begin\nVAR_INPUT x : INT; END_VAR\n"
    ) + main("u : Unit;")
    assert [code for code, _ in found(text)] == ["D014"]


def test_fb_exit_is_told_to_be_called_by_delete_alone() -> None:
    text = block("bInCopyCode : BOOL;").replace("FB_init", "FB_exit") + main("u : Unit;")
    problems = check_sources(with_dialect({"a.st": text}, "twincat"), MODEL).problems
    assert [each.code for each in problems] == ["W006"]
    assert "is called by `__DELETE` alone here" in problems[0].message


def test_what_a_function_and_a_method_cannot_keep_is_refused_in_the_strict_language() -> None:
    text = (
        "FUNCTION f : INT\nVAR_STAT n : INT; END_VAR\nVAR_STAT CONSTANT c : INT := 1; END_VAR\nEND_FUNCTION\n"
        + main("")
    )
    assert found(text, "iec") == [("X001", "A FUNCTION keeps no variables; move them into the block or VAR_GLOBAL.")]
    text = "CLASS c\nMETHOD m\nVAR_INST n : INT; END_VAR\nEND_METHOD\nEND_CLASS\n" + main("")
    assert found(text, "iec") == [("X001", "A METHOD keeps no variables; move them into the block or VAR_GLOBAL.")]
    assert found(text, "codesys") == []


def test_a_block_whose_references_have_start_values_lasts_longer_than_a_call() -> None:
    text = "FUNCTION_BLOCK Inner\nVAR x : INT; p : REF_TO INT := REF(x); END_VAR\nEND_FUNCTION_BLOCK\n"
    text += "FUNCTION f : INT\nVAR inner : Inner; END_VAR\nEND_FUNCTION\n" + main("")
    assert [code for code, _ in found(text, "codesys")] == ["D008"]


@pytest.mark.parametrize(
    ("body", "dialect", "code", "said"),
    [
        ("JMP there;", "iec", "X001", "JMP is not supported; use IF and loops."),
        ("there: n := 1;", "iec", "X001", "`there:` is a label to jump to, which is not supported; use IF and loops."),
        ("JMP there;", "codesys", "T001", "There is no label `there` to jump to"),
        ("IF n > 1 THEN there: n := 1; END_IF JMP there;", "twincat", "X001", "The label `there` is inside of an IF"),
        ("there: n := 1; there: n := 2;", "twincat", "D001", "`there` is declared already"),
        ("n := __QUERYINTERFACE(n);", "twincat", "T004", "takes two arguments"),
        ("n := __QUERYINTERFACE(n, n);", "iec", "X001", "`__QUERYINTERFACE` is not supported: use `?=`."),
    ],
)
def test_jumps_and_operators_that_are_refused(body: str, dialect: DialectName, code: str, said: str) -> None:
    problems = found(main("n : INT;", body), dialect)
    assert problems[0][0] == code, problems
    assert said in problems[0][1]
