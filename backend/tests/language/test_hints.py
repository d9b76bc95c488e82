"""The names of parameters that are shown before arguments."""

import pytest

from scanbench.language.hints import hints
from tests.language.reading import FILE, at, marked, read

TEXT = """\
FUNCTION Twice : INT
VAR_INPUT value : INT; times : INT; END_VAR
Twice := value * times;
END_FUNCTION
FUNCTION Least : ANY_NUM
VAR_INPUT first, second : ANY_NUM; END_VAR
Least := first;
END_FUNCTION
FUNCTION_BLOCK Inc
VAR_INPUT by : INT; END_VAR
VAR_IN_OUT sum : INT; END_VAR
METHOD PUBLIC Reset : BOOL
VAR_INPUT low, high : INT; END_VAR
END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main
VAR a, sum, times : INT; inc : Inc; incs : ARRAY[0..3] OF Inc; t : TON; b : BOOL; END_VAR
{}
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("statement", "shown"),
    [
        ("a := LIMIT(0, a, 5);", "a := LIMIT(<MN>0, <IN>a, <MX>5);"),
        ("a := LIMIT_INT(0, a, MX := 5);", "a := LIMIT_INT(<MN>0, <IN>a, MX := 5);"),
        ("a := Twice(a, 2);", "a := Twice(<value>a, <times>2);"),
        ("a := Twice((a + 1) * 2, times);", "a := Twice(<value>(a + 1) * 2, times);"),
        ("a := Least(a, 2);", "a := Least(<first>a, <second>2);"),
        ("b := inc.Reset(1, Twice(2, 3));", "b := inc.Reset(<low>1, <high>Twice(<value>2, <times>3));"),
        ("inc(1, a);", "inc(<by>1, <sum>a);"),
        ("incs[1]((1), sum);", "incs[1](<by>(1), sum);"),
        ("t(b, T#1s);", "t(<IN>b, <PT>T#1s);"),
        ("a := MUX(a, 1, 2);", "a := MUX(<K>a, <IN0>1, <IN1>2);"),
        ("a := MAX(a, 1, 2) + ABS(a);", "a := MAX(a, 1, 2) + ABS(a);"),
        ("a := CONCAT_DATE(1, 2, 3);", "a := CONCAT_DATE(<YEAR>1, <MONTH>2, <DAY>3);"),
        (
            "CASE Twice(a, 1) OF 1: IF b THEN a := Twice(a, 2); END_IF; END_CASE;",
            "CASE Twice(<value>a, <times>1) OF 1: IF b THEN a := Twice(<value>a, <times>2); END_IF; END_CASE;",
        ),
    ],
)
def test_arguments_by_position_show_their_parameters(statement: str, shown: str) -> None:
    reading = read(TEXT.format(statement))
    start = at(reading, statement)
    text = statement
    for each in reversed(hints(reading, FILE, 0, len(reading.text(FILE)))):
        place = each.position - start
        text = f"{text[:place]}<{each.name}>{text[place:]}"
    assert text == shown


def test_a_call_in_il_shows_them_too() -> None:
    reading, position = marked("PROGRAM Main VAR t : TON; b : BOOL; END_VAR\nCAL t(|b, T#1s)\nEND_PROGRAM")
    assert [(each.position, each.name) for each in hints(reading, FILE, 0, 99)] == [
        (position, "IN"), (position + 3, "PT"),
    ]  # fmt: skip


def test_only_those_of_the_stretch_are_told() -> None:
    reading = read(TEXT.format("a := Twice(1,\n2);\na := Twice(3, 4);\nIF b THEN\na := Twice(5, 6);\nEND_IF;"))
    start, end = at(reading, "2);"), at(reading, "4);")
    assert [reading.text(FILE)[each.position] for each in hints(reading, FILE, start, end)] == ["2", "3"]
    start, end = at(reading, "5, 6"), at(reading, "END_IF")
    assert [reading.text(FILE)[each.position] for each in hints(reading, FILE, start, end)] == ["5", "6"]
