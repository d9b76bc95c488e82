"""From a name to where it is declared, what it is made of, who uses it; and what is said of it."""

import pytest

from scanbench.check.uses import Symbol
from scanbench.language.declared import Declared
from scanbench.language.describe import describe
from scanbench.language.navigate import definitions, implementations, named_at, references, type_definitions
from scanbench.language.reading import Reading
from tests.language.reading import FILE, marked

SHAPES = """\
INTERFACE Shape
METHOD area : REAL END_METHOD
END_INTERFACE
CLASS Square IMPLEMENTS Shape
VAR side : REAL := 2.0; END_VAR
METHOD area : REAL
area := side * side;
END_METHOD
END_CLASS
CLASS Big EXTENDS Square
METHOD OVERRIDE area : REAL
area := SUPER.area() * 10.0;
END_METHOD
END_CLASS
PROGRAM Main
VAR big : Big; a : REAL; END_VAR
a := big.area();
END_PROGRAM
"""


def places(found: list[Declared]) -> list[str]:
    return [f"{each.span.file}:{each.span.line}" for each in found]


def symbol_at(text: str, **others: str) -> tuple[Reading, Symbol]:
    reading, position = marked(text, **others)
    found = named_at(reading, FILE, position)
    assert found is not None
    return reading, found.symbol


def test_a_definition_may_be_in_a_different_file() -> None:
    block = "FUNCTION_BLOCK Inc\nVAR_OUTPUT n : INT; END_VAR\nn := n + 1;\nEND_FUNCTION_BLOCK"
    reading, symbol = symbol_at("PROGRAM Main VAR i : Inc; x : INT; END_VAR\ni();\nx := i.|n;\nEND_PROGRAM", inc=block)
    assert places(definitions(reading, symbol)) == ["inc.st:2"]
    assert [each.span.line for each in references(reading, symbol, True)] == [2, 3, 3, 3]
    reading, symbol = symbol_at("PROGRAM Main VAR |i : Inc; x : INT; END_VAR\ni();\nEND_PROGRAM", inc=block)
    assert places(type_definitions(reading, symbol)) == ["inc.st:1"]


def test_text_that_does_not_compile_is_understood_as_far_as_it_goes() -> None:
    reading, symbol = symbol_at(
        "PROGRAM Main VAR n : INT; END_VAR\nIF n > THEN\nn := ;\nn := undeclared + |n;\nEND_PROGRAM"
    )
    assert symbol == Symbol("variable", "MAIN", "N")
    assert [each.span.line for each in references(reading, symbol, False)][-1] == 4


def test_a_method_is_all_that_override_it() -> None:
    reading, symbol = symbol_at(SHAPES.replace("big.area", "big.|area"))
    assert [each.span.line for each in references(reading, symbol, True)] == [2, 6, 7, 11, 12, 12, 17]
    reading, symbol = symbol_at(SHAPES.replace("METHOD area : REAL END", "METHOD |area : REAL END"))
    assert places(implementations(reading, symbol)) == ["main.st:6", "main.st:11"]


@pytest.mark.parametrize(
    ("text", "code", "comment"),
    [
        (
            "PROGRAM Main\nVAR\n  speed AT %MW4 : INT; // in rpm\nEND_VAR\n|speed := 1;\nEND_PROGRAM",
            "VAR speed AT %MW4 : INT", "in rpm",
        ),
        (
            "(* Twice its value. *)\nFUNCTION Twice : INT\nVAR_INPUT v : INT; END_VAR\nTwice := v * 2;\nEND_FUNCTION\n"
            "PROGRAM Main VAR n : INT; END_VAR\nn := |Twice(n);\nEND_PROGRAM",
            "FUNCTION Twice : INT\n  VAR_INPUT v : INT", "Twice its value.",
        ),
        ("PROGRAM Main\nVAR a : INT; // of a\n|s : STRING := 'http://x';\nEND_VAR\nEND_PROGRAM", "VAR s : STRING", ""),
        ("PROGRAM Main\nVAR\n// one\n(* two *)\n|s : INT;\nEND_VAR\nEND_PROGRAM", "VAR s : INT", "one\ntwo"),
        ("PROGRAM Main VAR t : |TON; END_VAR\nt();\nEND_PROGRAM", "FUNCTION_BLOCK TON", "On-delay timer"),
        ("PROGRAM Main VAR n : INT; END_VAR\nn := |LIMIT(0, n, 5);\nEND_PROGRAM", "LIMIT(MN, IN, MX)", "- MX: the largest"),
        ("PROGRAM Main VAR n : INT; END_VAR\nn := |MAX_INT(n, 5);\nEND_PROGRAM", "MAX_INT(IN1, IN2, ...)", "The largest"),
        ("PROGRAM Main VAR n : INT; END_VAR\nn := |REAL_TO_INT(1.5);\nEND_PROGRAM", "REAL_TO_INT", "rounded"),
        ("PROGRAM Main VAR t : TON; END_VAR\nt(|PT := T#1s);\nEND_PROGRAM", "VAR_INPUT PT : TIME", "how long it takes"),
        ("PROGRAM Main VAR c : CTU_DINT; END_VAR\nc(|RESET := TRUE);\nEND_PROGRAM", "VAR_INPUT RESET : BOOL", "sets CV to 0"),
        ("TYPE C : (RED, GREEN); END_TYPE\nPROGRAM Main VAR c : C; END_VAR\nc := C#|GREEN;\nEND_PROGRAM", "C#GREEN = 1", ""),
    ],
)  # fmt: skip
def test_what_is_said_of_a_name(text: str, code: str, comment: str) -> None:
    told = describe(*symbol_at(text))
    assert told is not None
    assert told.code.startswith(code)
    assert comment in told.comment if comment else not told.comment


def test_an_in_out_says_how_it_is_passed() -> None:
    told = describe(*symbol_at("FUNCTION_BLOCK F VAR_IN_OUT x : INT; END_VAR\n|x := 1;\nEND_FUNCTION_BLOCK"))
    assert told is not None
    assert told.notes == ("in-out by reference",)
