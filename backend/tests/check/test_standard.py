"""What calls of standard functions are refused, and what is said then."""

import pytest

from scanbench.check.build import check_sources
from tests.caseformat import MODELS
from tests.standard_page import PAGE, page

MAIN = """PROGRAM Main
VAR x : INT; r : REAL; w : WORD; s : STRING; ws : WSTRING; d : DATE; t : TOD; b : BOOL; a : ARRAY[1..3] OF INT; END_VAR
{}
END_PROGRAM
"""

REFUSED = [
    ("x := ABS();", "T004", "`ABS` takes 1 argument (IN), not 0. `IN` is missing."),
    ("x := ABS(1, 2);", "T004", "`ABS` takes 1 argument (IN), not 2."),
    ("x := ABS(INN := 3);", "T004", "`ABS` has no argument `INN`. Did you mean `IN`?"),
    ("x := ADD(IN1 := 1, IN1 := 2);", "T004", "`IN1` of `ADD` is given twice."),
    ("x := ADD(IN1 := 1, IN3 := 2);", "T004", "`IN2` is missing."),
    ("x := LIMIT(1, MX := 2);", "T004", "`LIMIT` takes 3 arguments (MN, IN, MX), not 2. `IN` is missing."),
    ("x := ABS(IN => x);", "T004", "`ABS` has no output `IN`."),
    ("x := SHL(x, 2);", "T002", "Convert it with INT_TO_WORD"),
    ("w := SHL(w, r);", "T002", "`SHL` needs an integer here, not REAL."),
    ("r := SIN(x);", "T002", "`SIN` cannot work on INT. Convert it with INT_TO_REAL."),
    ("r := SIN(w);", "T002", "It takes REAL and LREAL."),
    ("s := CONCAT(s, ws);", "T002", "`CONCAT` cannot join STRING and WSTRING"),
    ("s := CONCAT(s, 3);", "T002", "`CONCAT` needs a STRING, not DINT."),
    ("x := MAX(x, s);", "T002", "The arguments of `MAX` have no common type: INT and STRING[80]."),
    ("x := MAX(a, a);", "T002", "`MAX` cannot work on ARRAY[1..3] OF INT."),
    ("x := MUX(s, 1, 2);", "T002", "`MUX` needs an integer here"),
    ("x := SEL(x, 1, 2);", "T002", "`G` is BOOL, but this is INT."),
    ("b := GT(x, s, 1);", "T002", "`>` cannot join INT and STRING[80]."),
    ("x := ADD_INT(r, 1);", "T002", "Each argument of `ADD_INT` is INT, but this is REAL."),
    ("t := ADD_TOD_TIME(d, T#1s);", "T002", "`IN1` of `ADD_TOD_TIME` is TIME_OF_DAY, but this is DATE."),
    ("t := DATE_TO_TOD(d);", "T002", "There is no conversion DATE_TO_TOD: it has no meaning."),
    ("x := REAL_TO_INT(w);", "T002", "What REAL_TO_INT takes is REAL, but this is WORD."),
    ("x := TRUNC(x);", "T002", "TRUNC needs a REAL or LREAL, not INT."),
    ("w := REAL_TRUNC_WORD(r);", "T002", "TRUNC gives an integer."),
    ("x := REAL_BCD_TO_INT(r);", "T002", "BCD is read from a BYTE, WORD, DWORD or LWORD, not from REAL."),
    ("w := REAL_TO_BCD_WORD(r);", "T002", "only an integer becomes BCD, not REAL."),
    ("x := INT_TO_BCD_INT(x);", "T002", "BCD is a BYTE, WORD, DWORD or LWORD."),
    ("x := TO_INT(a);", "T002", "ARRAY[1..3] OF INT is not elementary."),
    ("r := TO_BIG_ENDIAN(r);", "T002", "Take its bits with REAL_TO_DWORD first."),
    ("b := IS_VALID(x);", "T002", "`IS_VALID` needs a REAL or LREAL, not INT."),
    ("x := INT_TO_FOO(3);", "T001", "`FOO` is no type to convert."),
    (
        "x := UPPER_BOUND(B := 1, A := a);",
        "T004",
        "`UPPER_BOUND` takes an array, ARR, and the number of a dimension, DIM.",
    ),
    ("x := LOWER_BOUND(FOO := a, ZOO := 1);", "T004", "`LOWER_BOUND` takes an array, ARR, and"),
    ("x := LOWER_BOUND(DIM := 1, 1);", "T004", "`LOWER_BOUND` takes an array, ARR, and"),
    ("x := MAXX(1, 2);", "T001", "Did you mean `MAX`?"),
    ("x := __CODE_AT(s, 1);", "T001", "There is no function `__CODE_AT`."),
    ("b := LEN(s) > 3 AND IS_VALID_BCD(LEN(s));", "T002", "LWORD"),
]


@pytest.mark.parametrize(("statement", "code", "message"), REFUSED, ids=[each[0] for each in REFUSED])
def test_refused(statement: str, code: str, message: str) -> None:
    checked = check_sources({"a.st": MAIN.format(statement)}, MODELS["GENERIC-IEC"])
    assert checked.program is None
    problems = [each for each in checked.problems if each.code == code]
    assert any(message in each.message for each in problems), checked.problems
    assert problems[0].span.line == 3


def test_a_function_of_the_user_goes_before_the_standard_one() -> None:
    own = "FUNCTION TON_DOUBLE : INT\nVAR_INPUT a : INT; END_VAR\nTON_DOUBLE := a * 2;\nEND_FUNCTION\n"
    mine = "FUNCTION CONCAT_DATE : INT\nVAR_INPUT a : INT; END_VAR\nCONCAT_DATE := a;\nEND_FUNCTION\n"
    text = own + mine + MAIN.format("x := TON_DOUBLE(CONCAT_DATE(4));")
    assert check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).program is not None


def test_the_page_is_up_to_date() -> None:
    assert PAGE.read_text("utf-8") == page(), "docs/standard-library.md is out of date: python -m tests.standard_page"


def test_a_folder_of_the_user_is_not_the_library() -> None:
    source = "FUNCTION Twice : INT\nVAR_INPUT x : INT; END_VAR\nTwice := x * 2;\nEND_FUNCTION\n" + MAIN.format(
        "x := Twice(2);"
    )
    program = check_sources({"standard/a.st": source}, MODELS["GENERIC-IEC"]).program
    assert program is not None
    own = {pou.name: pou.inline for pou in program.pous if pou.name != "__System"}
    assert own == {"Twice": False, "Main": False}


def test_a_program_is_not_called() -> None:
    other = "PROGRAM Other\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
    problems = check_sources({"a.st": other + MAIN.format("Other(); x := Other.n;")}, MODELS["GENERIC-IEC"]).problems
    assert [problem.code for problem in problems] == ["X001", "T010"]
    assert all("`Other` is a PROGRAM" in problem.message for problem in problems)
