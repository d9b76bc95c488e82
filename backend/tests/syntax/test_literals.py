"""Literals in all their forms: value, kind and type; and what is said about those that are none."""

import pytest

from scanbench.syntax import tree
from tests.syntax.shown import body, complaints

S, MS, H, DAY = 10**9, 10**6, 3600 * 10**9, 86400 * 10**9

LITERALS: list[tuple[str, str, int | float | bytes, str | None]] = [
    ("12", "int", 12, None),
    ("1_000_000", "int", 1000000, None),
    ("2#1010_1010", "int", 0xAA, None),
    ("8#377", "int", 255, None),
    ("16#fF_e0", "int", 0xFFE0, None),
    ("16#FFFF_FFFF_FFFF_FFFF", "int", 2**64 - 1, None),
    ("INT#-5", "int", -5, "INT"),
    ("uint#16#FF", "int", 255, "uint"),
    ("WORD#2#11", "int", 3, "WORD"),
    ("BOOL#1", "int", 1, "BOOL"),
    ("BOOL#true", "bool", 1, "BOOL"),
    ("FALSE", "bool", 0, None),
    ("1.5", "real", 1.5, None),
    ("1_0.2_5e-1_0".replace("1_0", "10"), "real", 10.25e-10, None),
    ("3E4", "real", 3e4, None),
    ("LREAL#1.5E+3", "real", 1500.0, "LREAL"),
    ("REAL#5", "int", 5, "REAL"),
    ("T#14ms", "time", 14 * MS, "TIME"),
    ("t#-14.7s", "time", -14_700 * MS, "TIME"),
    ("TIME#25h_15m", "time", 25 * H + 900 * S, "TIME"),
    ("T#1d2h_3m4.5s5ms", "time", DAY + 2 * H + 180 * S + 4505 * MS, "TIME"),
    ("T#1.5h", "time", 5400 * S, "TIME"),
    ("LTIME#1us5ns", "time", 1005, "LTIME"),
    ("lt#1s", "time", S, "LTIME"),
    ("D#1984-06-25", "date", 5289 * DAY, "DATE"),
    ("date#1969-12-31", "date", -DAY, "DATE"),
    ("LDATE#2000-02-29", "date", 11016 * DAY, "LDATE"),
    ("LD#1970-01-01", "date", 0, "LDATE"),
    ("TOD#15:36:55.36", "tod", 15 * H + 36 * 60 * S + 55_360 * MS, "TIME_OF_DAY"),
    ("TIME_OF_DAY#0:0", "tod", 0, "TIME_OF_DAY"),
    ("LTOD#23:59:59.999_999_999", "tod", DAY - 1, "LTIME_OF_DAY"),
    ("DT#1984-06-25-15:36:55.360", "dt", 5289 * DAY + 15 * H + 36 * 60 * S + 55_360 * MS, "DATE_AND_TIME"),
    ("LDATE_AND_TIME#1970-01-01-00:00:00.000000001", "dt", 1, "LDATE_AND_TIME"),
    ("'it$'s $$ $0A$n'", "string", b"it's $ \n\n", None),
    ("''", "string", b"", None),
    ("'\u00e4'", "string", b"\xe4", None),
    ("STRING#'a'", "string", b"a", "STRING"),
    ("CHAR#'x'", "string", b"x", "CHAR"),
    ('"a$"$0041$N"', "wstring", "a\"A\n".encode("utf-16-le"), None),
    ('"\U0001f600"', "wstring", "\U0001f600".encode("utf-16-le"), None),
    ('WCHAR#"\u20ac"', "wstring", "\u20ac".encode("utf-16-le"), "WCHAR"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "kind", "value", "type_name"), LITERALS)
def test_literal(text: str, kind: str, value: int | float | bytes, type_name: str | None) -> None:
    (statement,) = body(f"x := {text};")
    assert isinstance(statement, tree.Assignment)
    literal = statement.value
    assert isinstance(literal, tree.Literal)
    assert (literal.kind, literal.value, literal.type_name) == (kind, value, type_name)
    assert (literal.span.column, literal.span.end_column) == (6, 6 + len(text))


BROKEN = [
    ("16#", "S003"),
    ("16#GG", "S004"),
    ("3#12", "S004"),
    ("2#3", "S004"),
    ("1" * 100, "S004"),
    ("1E999", "S004"),
    ("T#5q", "S004"),
    ("T#5", "S004"),
    ("T#1000000d", "S004"),
    ("D#2023-02-29", "S004"),
    ("D#2023-13-01", "S004"),
    ("D#0000-01-01", "S004"),
    ("D#3000-01-01", "S004"),
    ("D#2023-01", "S004"),
    ("TOD#24:00:00", "S004"),
    ("TOD#23:60:00", "S004"),
    ("TOD#23", "S004"),
    ("DT#2023-02-28", "S004"),
    ("DT#2023-02-30-00:00:00", "S004"),
    ("'$4'", "S004"),
    ("'\u20ac'", "S004"),
    ('"$00"', "S004"),
    ("'open", "S002"),
]


@pytest.mark.parametrize(("text", "code"), BROKEN)
def test_broken_literal(text: str, code: str) -> None:
    found = complaints(f"PROGRAM p\nx := {text};\ny := 1;\nEND_PROGRAM")
    assert found[0].startswith(f"{code} 2:"), found
    assert all(each.split()[1].startswith("2:") for each in found), found


def test_a_number_next_to_an_operator() -> None:
    found = body("x := INT#5+3; y := D#2000-01-02-D#2000-01-01; z := 1..2;".replace("z := 1..2;", ""))
    assert [type(each.value).__name__ for each in found if isinstance(each, tree.Assignment)] == [
        "BinaryOp",
        "BinaryOp",
    ]
