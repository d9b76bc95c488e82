"""One test a row of the table of problems: the code, and where it points."""

import pytest

from scanbench.check.build import check_sources
from scanbench.problems import TABLE
from scanbench.syntax.language_file import with_dialect
from tests.caseformat import MODELS

MAIN = "PROGRAM Main\nVAR x : INT; b : BOOL; a : ARRAY[1..3] OF INT; r : REAL; t : TON; s : STRING; END_VAR\n{}\nEND_PROGRAM\n"

BODIES = [
    ("S001", "x := 1 ? 2;", 3),
    ("S002", "x := 1; (* never closed", 3),
    ("S002", "x := LEN('open);", 3),
    ("S003", "x := ;", 3),
    ("S003", "x = 1;", 3),
    ("S003", "IF b THEN x := 1;", 4),
    ("S004", "x := 40000;", 3),
    ("S004", "t(PT := T#5q);", 3),
    ("S004", "x := x / 0;", 3),
    ("T001", "y := 1;", 3),
    ("T001", "x := Foo(1);", 3),
    ("T002", "x := r;", 3),
    ("T002", "b := x + 1;", 3),
    ("T002", "x := x AND 1;", 3),
    ("T003", "t.Q := TRUE;", 3),
    ("T012", "s[81] := 'x';", 3),
    ("T012", "b := s[-1] = 'x';", 3),
    ("W003", "r := DWORD_TO_REAL(16#3F800000);", 3),
    ("W005", "b := s[0] = 'x';", 3),
    ("W006", "x := DINT#5;", 3),
    ("X001", "x := a[1] := 5;", 3),
    ("W007", "RETURN; x := 1;", 3),
    ("W007", "WHILE b DO EXIT; x := 1; END_WHILE;", 3),
    ("W007", "IF b THEN x := 1; ELSIF FALSE THEN x := 2; END_IF;", 3),
    ("T004", "t(IM := b);", 3),
    ("T004", "x := ABS();", 3),
    ("T006", "IF x THEN x := 1; END_IF;", 3),
    ("T007", "CASE x OF 1: x := 2; 1: x := 3; END_CASE;", 3),
    ("T008", "FOR r := 1 TO 2 DO x := 1; END_FOR;", 3),
    ("T008", "FOR x := 1 TO 2 DO x := 1; END_FOR;", 3),
    ("T009", "EXIT;", 3),
    ("T010", "x := t();", 3),
    ("T010", "x := x[1];", 3),
    ("T010", "b := t.running;", 3),
    ("T012", "x := a[4];", 3),
    ("W001", "x + 1;", 3),
    ("T009", "CONTINUE;", 3),
    ("T012", "b := x.20;", 3),
    ("X001", "x := __NEW(INT);", 3),
]

FILES = [
    ("W008", "FUNCTION F : INT\n{stub}\nF := 1;\nEND_FUNCTION\nPROGRAM P VAR x : INT; END_VAR x := F(); END_PROGRAM", 5),
    ("W008", "FUNCTION_BLOCK F\n{stub}\nEND_FUNCTION_BLOCK\nPROGRAM P VAR x : F; END_VAR x(); END_PROGRAM", 4),
    ("D001", "PROGRAM Main\nVAR x : INT;\nX : INT; END_VAR\nEND_PROGRAM", 3),
    ("D001", "PROGRAM Main\nEND_PROGRAM\nFUNCTION_BLOCK main\nEND_FUNCTION_BLOCK", 3),
    ("D002", "PROGRAM Main\nVAR x : INTT; END_VAR\nEND_PROGRAM", 2),
    ("D003", "FUNCTION_BLOCK A\nVAR b : B; END_VAR\nEND_FUNCTION_BLOCK\nFUNCTION_BLOCK B\nVAR a : A; END_VAR\nEND_FUNCTION_BLOCK", 5),
    ("D004", "PROGRAM Main\nVAR y : INT;\nx : INT := y; END_VAR\nEND_PROGRAM", 3),
    ("D004", "PROGRAM Main\nVAR s : STRUCT n : INT; END_STRUCT := (n := 1,\nN := 3); END_VAR\nEND_PROGRAM", 3),
    ("D005", "PROGRAM Main\nVAR x AT %MW9999999 : INT; END_VAR\nEND_PROGRAM", 2),
    ("D005", "PROGRAM Main\nVAR x AT %MX0.0 : INT; END_VAR\nEND_PROGRAM", 2),
    ("D006", "PROGRAM Main\nVAR x : ARRAY[3..1] OF INT; END_VAR\nEND_PROGRAM", 2),
    ("D006", "PROGRAM Main\nVAR x : STRING[0]; END_VAR\nEND_PROGRAM", 2),
    ("D007", "PROGRAM Main\nVAR_EXTERNAL g : INT; END_VAR\nEND_PROGRAM", 2),
    ("D007", "CLASS Meter\nVAR_EXTERNAL g : INT; END_VAR\nEND_CLASS", 2),
    ("D008", "PROGRAM Main\nVAR_IN_OUT g : INT; END_VAR\nEND_PROGRAM", 2),
    ("D008", "FUNCTION_BLOCK F\nVAR_INPUT a : ARRAY[*] OF INT; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM Main\nEND_PROGRAM", 2),
    ("T003", "FUNCTION F : INT\nVAR_INPUT a : ARRAY[*] OF INT; END_VAR\na[1] := 2;\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM", 3),
    ("T005", "FUNCTION F : INT\nVAR_INPUT a : ARRAY[*] OF INT; END_VAR\nEND_FUNCTION\nPROGRAM Main\nVAR x : INT; END_VAR\nx := F();\nEND_PROGRAM", 6),
    ("D009", "FUNCTION F : INT\nVAR_INPUT x : INT; END_VAR\nF := F(x);\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM", 1),
    ("D009", "INTERFACE I\nMETHOD m\nVAR_IN_OUT x : INT; END_VAR\nEND_METHOD\nEND_INTERFACE\nCLASS A IMPLEMENTS I\nVAR PUBLIC i : I; END_VAR\nMETHOD PUBLIC m\nVAR_IN_OUT x : INT; END_VAR\nVAR own : INT; END_VAR\ni.m(own);\nEND_METHOD\nEND_CLASS\nPROGRAM Main\nEND_PROGRAM", 8),
    ("D009", "INTERFACE I\nMETHOD m\nEND_METHOD\nEND_INTERFACE\nCLASS A IMPLEMENTS I\nVAR PUBLIC i : I; END_VAR\nMETHOD PUBLIC m\nVAR own : ARRAY[0..9999] OF INT; END_VAR\ni.m();\nEND_METHOD\nEND_CLASS\nPROGRAM Main\nEND_PROGRAM", 7),
    ("D009", "CLASS A\nMETHOD PUBLIC m : INT\nm := THIS.m();\nEND_METHOD\nEND_CLASS\nCLASS B EXTENDS A\nMETHOD PUBLIC OVERRIDE m : INT\nm := 1;\nEND_METHOD\nEND_CLASS\nPROGRAM Main\nEND_PROGRAM", 2),
    ("D010", "PROGRAM Main\nEND_PROGRAM\nCONFIGURATION C\nRESOURCE R ON P\nPROGRAM m : Mein;\nEND_RESOURCE\nEND_CONFIGURATION", 5),
    ("D011", "FUNCTION F : INT\nF := 1;\nEND_FUNCTION", 1),
    ("D012", "PROGRAM Main\nVAR x : ARRAY[0..99999999] OF LINT; END_VAR\nEND_PROGRAM", 2),
    ("D001", "PROGRAM Main\nVAR x : INT; END_VAR\nVAR_TEMP x : INT; END_VAR\nEND_PROGRAM", 3),
    ("D001", "FUNCTION G : INT\nVAR g : INT; END_VAR\nG := 1;\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM", 2),
    ("D001", "VAR_GLOBAL main : INT; END_VAR\nPROGRAM Main\nEND_PROGRAM", 2),
    ("D001", "VAR_GLOBAL v : INT; END_VAR\nPROGRAM Main\nVAR v : INT; END_VAR\nVAR_EXTERNAL v : INT; END_VAR\nEND_PROGRAM", 4),
    ("D001", "TYPE DINT : INT; END_TYPE\nPROGRAM Main\nEND_PROGRAM", 1),
    ("D006", "PROGRAM Main\nVAR x : ARRAY[18446744073709551614..18446744073709551615] OF INT; END_VAR\nEND_PROGRAM", 2),
    ("D008", "PROGRAM Main\nVAR_TEMP t : ARRAY[0..1] OF TON; END_VAR\nEND_PROGRAM", 2),
    ("D014", "CLASS A\nMETHOD PUBLIC OVERRIDE m\nEND_METHOD\nEND_CLASS\nPROGRAM Main\nEND_PROGRAM", 2),
    ("T014", "CLASS A\nMETHOD PRIVATE m\nEND_METHOD\nEND_CLASS\nPROGRAM Main\nVAR a : A; END_VAR\na.m();\nEND_PROGRAM", 7),
    ("D013", "".join(f"FUNCTION F{n} : INT\nF{n} := " + (f"F{n + 1}() + F{n + 1}()" if n < 30 else "1") + ";\nEND_FUNCTION\n" for n in range(31)) + "PROGRAM Main\nEND_PROGRAM", 34),
    ("S004", "PROGRAM Main\nVAR x : ULINT; END_VAR\nx := 18446744073709551617;\nEND_PROGRAM", 3),
    ("S004", "PROGRAM Main\nVAR x : REAL; END_VAR\nx := " + "1" * 5000 + ";\nEND_PROGRAM", 3),
    ("S004", "PROGRAM Main\nVAR x : REAL; END_VAR\nx := 1.0E39;\nEND_PROGRAM", 3),
    ("S004", "PROGRAM Main\nVAR x : LREAL; END_VAR\nx := 1E400;\nEND_PROGRAM", 3),
    ("T003", "TYPE S : STRUCT t : TON; END_STRUCT; END_TYPE\nPROGRAM Main\nVAR a, b : S; END_VAR\na := b;\nEND_PROGRAM", 4),
    ("T008", "PROGRAM Main\nVAR i, x : INT; END_VAR\nFOR i := 1 TO 2 DO\nFOR i := 1 TO 2 DO x := i; END_FOR; END_FOR;\nEND_PROGRAM", 4),
    ("T005", "FUNCTION_BLOCK B\nVAR_IN_OUT x : INT; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b : B; END_VAR\nb();\nEND_PROGRAM", 6),
    ("T005", "FUNCTION_BLOCK B\nVAR_IN_OUT x : INT; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b : B; END_VAR\nb(x := 5);\nEND_PROGRAM", 6),
    ("T013", "FUNCTION F : INT\nVAR t : INT; p : REF_TO INT; END_VAR\np := REF(t);\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM", 3),
    ("S004", "PROGRAM Main\nVAR x : INT (0..9);\ny : INT (0..9) := 10; END_VAR\nEND_PROGRAM", 3),
    ("S004", "TYPE C : (A, B := 300) SINT; END_TYPE\nPROGRAM Main\nEND_PROGRAM", 1),
    ("T001", "TYPE C : (A, B); D : (B, E); END_TYPE\nPROGRAM Main\nVAR n : INT; END_VAR\nn := B;\nEND_PROGRAM", 4),
    ("T002", "TYPE C : (A, B); D : (F, E); END_TYPE\nPROGRAM Main\nVAR c : C; b : BOOL; END_VAR\nb := c = E;\nEND_PROGRAM", 4),
    ("T002", "TYPE C : (A, B); END_TYPE\nPROGRAM Main\nVAR c : C; END_VAR\nc := 1;\nEND_PROGRAM", 4),
    ("T002", "TYPE A : STRUCT x : INT; END_STRUCT; B : STRUCT x : INT; END_STRUCT; END_TYPE\nPROGRAM Main\nVAR a : A; b : B; END_VAR\nb := a;\nEND_PROGRAM", 4),
    ("T002", "TYPE A : STRUCT x : INT; END_STRUCT; B : STRUCT x : INT; END_STRUCT; END_TYPE\nPROGRAM Main\nVAR a : ARRAY[0..1] OF A; b : ARRAY[0..1] OF B; END_VAR\nb := a;\nEND_PROGRAM", 4),
    ("T002", "TYPE A : STRUCT x : INT; END_STRUCT; END_TYPE\nPROGRAM Main\nVAR a : A; b : STRUCT x : INT; END_STRUCT; END_VAR\nb := a;\nEND_PROGRAM", 4),
    ("D002", "PROGRAM Main\nVAR x : REAL (0..9); END_VAR\nEND_PROGRAM", 2),
    ("D005", "TYPE S : STRUCT a AT %B0 : INT; b AT %B1 : INT; END_STRUCT; END_TYPE\nPROGRAM Main\nEND_PROGRAM", 1),
    ("D006", "PROGRAM Main\nVAR x : INT (9..0); END_VAR\nEND_PROGRAM", 2),
    ("D008", "PROGRAM Main\nVAR x : ARRAY[*] OF INT; END_VAR\nEND_PROGRAM", 2),
    ("X001", "PROGRAM Main\nVAR x : INT; END_VAR\nEND_PROGRAM\nVAR_CONFIG Main.x : INT := 1; END_VAR", 4),
    ("D008", "TYPE U : UNION t : TON; x : INT; END_UNION; END_TYPE\nPROGRAM Main\nEND_PROGRAM", 1),
    ("W003", "PROGRAM Main\nVAR l : LREAL; w : LWORD; END_VAR\nw := LREAL_TO_LWORD(l);\nEND_PROGRAM", 3),
    ("W004", "PROGRAM Main\nVAR s : STRING; p : POINTER TO BYTE; END_VAR\np := ADR(s);\nEND_PROGRAM", 3),
    ("W002", "PROGRAM Main\nVAR x AT %I* : INT; END_VAR\nEND_PROGRAM", 2),
    ("T011", "PROGRAM Main\nVAR f AT A402.12 : BOOL; END_VAR\nf := TRUE;\nEND_PROGRAM", 3),
]  # fmt: skip


@pytest.mark.parametrize(("code", "body", "line"), BODIES, ids=[f"{code} {body}" for code, body, _ in BODIES])
def test_statement(code: str, body: str, line: int) -> None:
    expect(code, MAIN.format(body), line)


@pytest.mark.parametrize(("code", "text", "line"), FILES)
def test_declaration(code: str, text: str, line: int) -> None:
    expect(code, text, line)


def expect(code: str, text: str, line: int) -> None:
    sources = with_dialect({"a.st": text}, "codesys" if code == "W006" else "iec")
    checked = check_sources(sources, MODELS["CJ1M-CPU63" if code == "T011" else "GENERIC-IEC"])
    found = [(problem.code, problem.span.line) for problem in checked.problems]
    assert (code, line) in found, "\n".join(map(str, checked.problems))
    assert (checked.program is None) == any(not each.startswith("W") for each, _ in found)


def test_every_problem_has_a_test() -> None:
    """M-codes are tested with the models, R-codes with the requirements."""
    tested = {code for code, _, _ in [*BODIES, *FILES]}
    assert {code for code in TABLE if code[0] not in "MR"} == tested


def test_many_problems_at_once() -> None:
    text = MAIN.format("x := ;\nb := 5;\ny := 1;\nIF x THEN\nx := 1\nEND_IF\nx := a[9];")
    lines = [problem.span.line for problem in check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems]
    assert lines == [3, 4, 5, 6, 7, 9]


def test_did_you_mean() -> None:
    problems = check_sources({"a.st": MAIN.format("x := tt.Q;")}, MODELS["GENERIC-IEC"]).problems
    assert "Did you mean `t`?" in problems[0].message


def test_nothing_crashes_on_half_a_program() -> None:
    """Every prefix of a program is read to its end."""
    text = MAIN.format("IF b THEN\n a[x] := 3;\nELSE t(IN := b, PT := T#3s); END_IF\nCASE x OF 1: x := 2; END_CASE;")
    for end in range(len(text)):
        check_sources({"a.st": text[:end]}, MODELS["GENERIC-IEC"])


def test_deep_nesting_is_refused_not_a_crash() -> None:
    for text in ("(" * 3000 + "1" + ")" * 3000, "-" * 3000 + "1", "1" + "+x" * 3000, "NOT " * 3000 + "b"):
        problems = check_sources({"a.st": MAIN.format(f"x := {text};")}, MODELS["GENERIC-IEC"]).problems
        assert problems[0].code == "S003"
    nested = "IF b THEN " * 3000
    assert check_sources({"a.st": MAIN.format(nested)}, MODELS["GENERIC-IEC"]).program is None


def test_bounds_of_temporaries_use_constants_of_the_block() -> None:
    text = "PROGRAM Main\nVAR CONSTANT N : INT := 3; END_VAR\nVAR_TEMP a : ARRAY[1..N] OF INT; END_VAR\na[N] := 1;\nEND_PROGRAM"
    assert check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems == ()


def test_only_line_feeds_make_lines() -> None:
    text = "PROGRAM Main (* \f \v \u2028 *)\nx := 1;\nEND_PROGRAM"
    assert [each.span.line for each in check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems] == [2]


def test_a_call_of_what_has_no_type_is_reported_once() -> None:
    text = "PROGRAM Main\nVAR fb : Missing; END_VAR\nfb(a := 1);\nEND_PROGRAM"
    assert [each.code for each in check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems] == ["D002"]


@pytest.mark.parametrize(
    ("line", "code", "words"),
    [
        ("x AT D100 : WORD; END_VAR", "", ""),
        ("x AT %D100 : WORD; END_VAR", "", ""),
        ("x AT E100 : WORD; END_VAR", "D005", "'E100' is not an address of this model: its areas are %I, %Q, %M, CIO"),
        ("x AT D40000 : WORD; END_VAR", "D005", "is the bit D400.00; a whole word is written like `D400`"),
        ("x AT D100 : BOOL; END_VAR", "D005", "needs a bit, e.g. `D100.00`"),
        ("x AT %Q9999.0 : BOOL; END_VAR", "D005", "'%Q9999.0' is outside of the area: the last one is %QX119.7 (CJ1M"),
        ("x : WORD; END_VAR x := D100;", "T001", "is written `%D100` in statements"),
        ("x : WORD; END_VAR x := E100;", "T001", "`E100` is not declared."),
    ],
)
def test_what_is_said_of_an_address(line: str, code: str, words: str) -> None:
    checked = check_sources({"main.st": f"PROGRAM Main VAR {line} END_PROGRAM"}, MODELS["CJ1M-CPU63"])
    found = [problem for problem in checked.problems if problem.code != "W004"]
    assert [problem.code for problem in found] == ([code] if code else [])
    assert all(words in problem.message for problem in found)


@pytest.mark.parametrize(
    "body",
    [
        "IF b THEN RETURN; END_IF; x := 1;",
        "CASE x OF 1: RETURN; 2: x := 1; END_CASE;",
        "IF OFF THEN x := 1; END_IF;",
        "IF NOT FALSE THEN x := 1; END_IF;",
        "IF x := THEN x := 1; END_IF;",
        "IF FALSE THEN ; END_IF; RETURN;",
    ],
)
def test_what_may_be_reached_is_not_said_to_be_unreached(body: str) -> None:
    text = MAIN.replace("VAR x", "VAR CONSTANT OFF : BOOL := FALSE; END_VAR VAR x").format(body)
    assert "W007" not in [each.code for each in check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems]


def test_two_structures_that_are_written_out_are_told_apart() -> None:
    text = "PROGRAM Main\nVAR a : STRUCT x : INT; END_STRUCT; b : STRUCT x : INT; END_STRUCT; END_VAR\na := b;\nEND_PROGRAM\n"
    (problem,) = check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems
    assert problem.message == (
        "`a` and the value are of two STRUCTs, each written out in a declaration. Declare one TYPE, and both variables of it."
    )
