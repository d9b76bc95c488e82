"""What is offered where."""

import pytest

from scanbench.language.complete import complete
from scanbench.language.signature import signature_at
from tests.language.reading import FILE, marked

BLOCK = """\
TYPE Color : (RED, GREEN); END_TYPE
TYPE Point : STRUCT x, y : INT; END_STRUCT; END_TYPE
FUNCTION_BLOCK Inc
VAR_INPUT by : INT; END_VAR
VAR_OUTPUT n : INT; END_VAR
VAR hidden : INT; END_VAR
METHOD PUBLIC Reset : BOOL END_METHOD
METHOD PRIVATE Secret : BOOL END_METHOD
METHOD PROTECTED Adjust : BOOL END_METHOD
END_FUNCTION_BLOCK
FUNCTION Twice : INT
VAR_INPUT value : INT; times : INT; END_VAR
Twice := value * times;
END_FUNCTION
"""
MAIN = "PROGRAM Main\nVAR a : INT; inc : Inc; points : ARRAY[0..3] OF Point; END_VAR\nVAR_TEMP t : INT; END_VAR\n{}\nEND_PROGRAM\n"


def offered(text: str) -> list[str]:
    reading, position = marked(text)
    return [each.label for each in complete(reading, FILE, position)]


@pytest.mark.parametrize(
    ("statement", "members"),
    [
        ("inc.|", ["by", "n", "Reset"]),
        ("a := points[a + 1].|", ["x", "y"]),
        ("a := points[a].x + inc.n|;", ["by", "n", "Reset"]),
        ("IF inc.| THEN", ["by", "n", "Reset"]),
        ("Color.|", ["RED", "GREEN"]),
        ("unknown.|", []),
    ],
)
def test_after_a_point_are_the_members_that_may_be_used(statement: str, members: list[str]) -> None:
    assert offered(BLOCK + MAIN.format(statement)) == members


def test_a_statement_sees_variables_functions_values_and_keywords() -> None:
    found = offered(BLOCK + MAIN.format("|"))
    assert {"a", "inc", "t", "Twice", "RED", "LIMIT", "LEN", "IF", "END_IF"} <= set(found)
    assert found.index("a") < found.index("LIMIT")
    assert "hidden" not in found
    assert "x" not in found


def test_symbols_of_the_model_are_offered() -> None:
    reading, position = marked(MAIN.format("|").replace("inc : Inc; points : ARRAY[0..3] OF Point;", ""), "CJ1M-CPU63")
    assert "P_On" in [each.label for each in complete(reading, FILE, position)]


@pytest.mark.parametrize(
    ("text", "values"),
    [
        (MAIN.format("color := Color#|;"), ["RED", "GREEN"]),
        (MAIN.format("CASE color OF color#G|"), ["RED", "GREEN"]),
        (MAIN.format("a := INT#|;"), []),
        ("PROGRAM Main\nVAR c : Color := Color#|; END_VAR\nEND_PROGRAM", ["RED", "GREEN"]),
        (
            "NAMESPACE Plant TYPE Mode : (ON, OFF); END_TYPE END_NAMESPACE\n" + MAIN.format("a := Plant.Mode#|"),
            ["ON", "OFF"],
        ),
    ],
)
def test_after_a_type_and_its_sign_are_the_values_of_the_type_alone(text: str, values: list[str]) -> None:
    assert offered(BLOCK + text) == values


def test_after_a_colon_are_types_only() -> None:
    found = offered(BLOCK + "PROGRAM Main\nVAR\n  x : |\nEND_VAR\nEND_PROGRAM")
    assert {"INT", "Color", "Point", "Inc", "TON", "ARRAY"} <= set(found)
    assert not {"Twice", "IF", "Main"} & set(found)


def test_a_call_offers_the_arguments_that_are_not_given() -> None:
    assert offered(BLOCK + MAIN.format("inc(by := 1, |);"))[:1] == ["n =>"]
    assert offered(BLOCK + MAIN.format("a := Twice(|);"))[:2] == ["value :=", "times :="]


@pytest.mark.parametrize(
    "text",
    ["// |", "(* a| *) a := 1;", "s := 'in.|';", "// it's x|", "(* (* a *) |", "{ a| }", "s := 'in.|", 's := "a|"'],
)
def test_comments_and_strings_offer_nothing(text: str) -> None:
    assert offered(BLOCK + MAIN.format(text)) == []


@pytest.mark.parametrize("text", ["s := '(*'; |", "s := 'http://x'; |", "(* ' *) |", "s := ''|", "(* a *)|"])
def test_marks_of_comments_in_strings_begin_none(text: str) -> None:
    assert "inc" in offered(BLOCK + MAIN.format(text))


def test_inside_of_a_class_are_its_own_methods_and_those_it_inherits_but_private_ones() -> None:
    found = offered(BLOCK + "FUNCTION_BLOCK More EXTENDS Inc\nMETHOD Own : BOOL\n|\nEND_METHOD\nEND_FUNCTION_BLOCK")
    assert {"Own", "Reset", "Adjust"} <= set(found)
    assert "Secret" not in found


def test_a_function_of_a_namespace_that_is_used_shows_its_parameters() -> None:
    text = "NAMESPACE Plant\nFUNCTION Half : INT\nVAR_INPUT of_what : INT; END_VAR\nEND_FUNCTION\nEND_NAMESPACE\n"
    reading, position = marked(text + "PROGRAM Main\nUSING Plant;\nVAR a : INT; END_VAR\na := Half(|1);\nEND_PROGRAM")
    found = signature_at(reading, FILE, position)
    assert found is not None
    assert found.label == "Half(of_what : INT)"


def test_an_instruction_of_the_vendor_shows_what_a_program_may_give() -> None:
    reading, position = marked("PROGRAM Main\nFAL(|1);\nEND_PROGRAM", "CJ1M-CPU63")
    found = signature_at(reading, FILE, position)
    assert found is not None
    assert found.label == "FAL(N : LINT, M : LINT, M1 : LINT)"


def test_outside_of_a_pou_whole_pous_are_offered() -> None:
    assert offered("|")[:2] == ["PROGRAM", "FUNCTION_BLOCK"]


@pytest.mark.parametrize(
    ("call", "label", "active"),
    [
        ("a := Twice(|", "Twice(value : INT, times : INT)", 0),
        ("a := Twice(Twice(1, 2), |", "Twice(value : INT, times : INT)", 1),
        ("a := Twice(times := |", "Twice(value : INT, times : INT)", 1),
        ("inc(by := 1, n => |", "inc(by : INT, n => INT)", 1),
        ("a := LIMIT(0, MAX(1, 2), |", "LIMIT(MN, IN, MX)", 2),
    ],
)
def test_the_parameter_that_comes_next(call: str, label: str, active: int) -> None:
    reading, position = marked(BLOCK + MAIN.format(call))
    found = signature_at(reading, FILE, position)
    assert found is not None
    assert (found.label, found.active) == (label, active)


def test_outside_of_calls_there_is_no_signature() -> None:
    reading, position = marked(BLOCK + MAIN.format("a := (a + |1);"))
    assert signature_at(reading, FILE, position) is None
