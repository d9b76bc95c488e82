"""What nests deep, or goes on for long: one answer, and no end of the checker."""

import pytest

from scanbench.check.build import check_sources
from tests.caseformat import MODELS

MAIN = "PROGRAM Main\nVAR x : INT; END_VAR\n{}END_PROGRAM\n"
EMPTY = MAIN.format("")
MANY = 3000
DEEP = {
    "IF": MAIN.format("IF x = 1 THEN\n" * MANY + "x := 2;\n" + "END_IF;\n" * MANY),
    "CASE": MAIN.format("CASE x OF 1:\n" * MANY + "x := 2;\n" + "END_CASE;\n" * MANY),
    "parentheses": MAIN.format("x := " + "(" * MANY + "1" + ")" * MANY + ";\n"),
    "STRUCT": "TYPE T : " + "STRUCT a : " * MANY + "INT" + "; END_STRUCT" * MANY + "; END_TYPE\n" + EMPTY,
    "ARRAY": "TYPE T : " + "ARRAY[0..0] OF " * MANY + "INT; END_TYPE\n" + EMPTY,
    "NAMESPACE": EMPTY + "".join(f"NAMESPACE N{n}\n" for n in range(MANY)) + "END_NAMESPACE\n" * MANY,
    "types": EMPTY.replace("INT", f"T{MANY}") + "TYPE T0 : INT; END_TYPE\n"
    + "".join(f"TYPE T{n} : STRUCT a : T{n - 1}; END_STRUCT END_TYPE\n" for n in range(1, MANY + 1)),
    "EXTENDS": EMPTY.replace("INT", f"B{MANY}")
    + "".join(f"CLASS B{n} EXTENDS B{n - 1}\nEND_CLASS\n" for n in range(MANY, 0, -1)) + "CLASS B0\nEND_CLASS\n",
}  # fmt: skip


@pytest.mark.parametrize("what", DEEP)
def test_what_nests_too_deep_is_told_once(what: str) -> None:
    problems = check_sources({"a.st": DEEP[what]}, MODELS["GENERIC-IEC"]).problems
    assert [each.code for each in problems] == ["S003"]
    assert "nested more than" in problems[0].message


def test_what_follows_is_checked() -> None:
    text = DEEP["IF"] + "FUNCTION F : INT\nF := Missing;\nEND_FUNCTION\n"
    assert [each.code for each in check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems] == ["S003", "T001"]


def test_structures_that_are_written_out_in_one_line_are_different() -> None:
    text = "TYPE T : STRUCT a : STRUCT b : STRUCT c : INT; END_STRUCT; END_STRUCT; END_STRUCT; END_TYPE\n"
    text += "PROGRAM Main\nVAR t : T; END_VAR\nt.a.b.c := 1;\nEND_PROGRAM\n"
    assert not check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems


def test_a_thousand_blocks_extend_each_other_in_any_order() -> None:
    blocks = [
        f"FUNCTION_BLOCK B{n} EXTENDS B{n - 1}\nMETHOD PUBLIC m{n} : INT\nm{n} := {n};\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
        for n in range(1, 1000)
    ]
    text = "".join([*reversed(blocks), "FUNCTION_BLOCK B0\nEND_FUNCTION_BLOCK\n"])
    main = "PROGRAM Main\nVAR b : B999; x : INT; END_VAR\nx := b.m1() + b.m999();\nEND_PROGRAM\n"
    assert not check_sources({"a.st": text + main}, MODELS["GENERIC-IEC"]).problems
