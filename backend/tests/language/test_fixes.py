"""Mends of problems: what a quick fix leaves has that problem no more."""

import pytest

from scanbench.language.fixes import fixes
from tests.language.reading import FILE, at, read

PROGRAM = """\
TYPE Point : STRUCT wide : INT; END_STRUCT; END_TYPE
PROGRAM Main
VAR
  n, total : INT; r : REAL; t : TON; p : Point; b, c : BOOL; w, v : WORD; s : STRING;
END_VAR
{}
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("body", "where", "title", "becomes"),
    [
        ("n := tottal;", "tottal", "Change to total", "n := total;"),
        ("n := p.wyde;", "wyde", "Change to wide", "n := p.wide;"),
        ("t(INN := TRUE);", "INN", "Change to IN", "t(IN := TRUE);"),
        ("n := 1\nr := 2.0;", "1", "Insert `;`", "n := 1;\nr := 2.0;"),
        ("n := r * 2.0;", "r *", "Convert with REAL_TO_INT", "n := REAL_TO_INT(r * 2.0);"),
        ("n := (r + 1.0) * r;", "r +", "Convert with REAL_TO_INT", "n := REAL_TO_INT((r + 1.0) * r);"),
        ("n := n + b;", "n +", "Convert with BOOL_TO_INT", "n := n + BOOL_TO_INT(b);"),
        ("n := b + n;", "b +", "Convert with BOOL_TO_INT", "n := BOOL_TO_INT(b) + n;"),
        ("n := n + (b OR c);", "n +", "Convert with BOOL_TO_INT", "n := n + (BOOL_TO_INT(b OR c));"),
        ("n := (n + b) * 2;", "n +", "Convert with BOOL_TO_INT", "n := (n + BOOL_TO_INT(b)) * 2;"),
        ("n := ADD(n, b);", "ADD", "Convert with BOOL_TO_INT", "n := ADD(n, BOOL_TO_INT(b));"),
        ("r := SQRT(n);", "SQRT", "Convert with INT_TO_REAL", "r := SQRT(INT_TO_REAL(n));"),
        ("b := w + v = 0;", "w +", "Convert with WORD_TO_UINT", "b := WORD_TO_UINT(w) + WORD_TO_UINT(v) = 0;"),
        ("n = 1;", "n =", "Write `:=`", "n := 1;"),
        ("n = (1);", "n =", "Write `:=`", "n := (1);"),
        ("IF b\nn := 1;\nEND_IF;", "b\nn", "Insert `THEN`", "IF b THEN\nn := 1;"),
        ("FOR n := 1 TO 2\nw := v;\nEND_FOR;", "2\nw", "Insert `DO`", "FOR n := 1 TO 2 DO\nw := v;"),
        ("n := (n + 1;", ";", "Insert `)`", "n := (n + 1);"),
        ("IF (b THEN n := 1; END_IF;", "THEN", "Insert `)`", "IF (b) THEN n"),
        ("r := SQRT(r (* of it *);", ";", "Insert `)`", "SQRT(r) (* of it *);"),
        ("IF b THEN\n  n := 1;\n\nn := 2;", "END_PROGRAM", "Insert `END_IF`", "  n := 1;\nEND_IF;\n\nn := 2;"),
        ("IF b THEN\nn := 1;\n", "END_PROGRAM", "Insert `END_IF`", "IF b THEN\nn := 1;\nEND_IF;\n"),
        ("IF b THEN n := 1; // note", "END_PROGRAM", "Insert `END_IF`", "n := 1; // note\nEND_IF;\n"),
        ("IF b THEN\n  n := 1;\nELSE\n  n := 2;", "END_PROGRAM", "Insert `END_IF`", "  n := 2;\nEND_IF;\n"),
        (
            "IF b THEN\n  WHILE c DO\n    n := 1;\nEND_IF;", "END_IF", "Insert `END_WHILE`",
            "    n := 1;\n  END_WHILE;\nEND_IF;",
        ),
        ("t(Q := b);", "Q :=", "Write `=>`", "t(Q => b);"),
        ("t(IN => b);", "IN =>", "Write `:=`", "t(IN := b);"),
        ("n := 1; (* note", "(*", "Close the comment at the end of the line", "(* note *)\n"),
        ("s := 'abc;", "'", "Close the string", "s := 'abc';"),
        ("b := n == 1;", "==", "Write `=`", "b := n = 1;"),
        ("b := n != 1;", "!=", "Write `<>`", "b := n <> 1;"),
        ("n := 1;\nRETURN;\nn := 2; // two\nn := 3;", "n := 2", "Remove what is never reached", "n := 1;\nRETURN;\nEND_PROGRAM"),
        (
            "IF b THEN\n  RETURN; n := 2;\nELSE\n  n := 3;\nEND_IF;", "n := 2", "Remove what is never reached",
            "IF b THEN\n  RETURN;\nELSE\n  n := 3;\nEND_IF;",
        ),
        ("IF FALSE THEN\n  n := 2;\nEND_IF;", "n := 2", "Remove what is never reached", "IF FALSE THEN\nEND_IF;"),
        ("b := c&&b;", "&&", "Write `AND`", "b := c AND b;"),
    ],
)  # fmt: skip
def test_a_problem_is_mended_in_its_place(body: str, where: str, title: str, becomes: str) -> None:
    reading = read(PROGRAM.format(body))
    position = at(reading, where, reading.text(FILE)[: reading.text(FILE).index(body)].count(where))
    fix = next(each for each in fixes(reading, FILE, position, position) if each.title == title)
    text = reading.text(FILE)
    made = text[: fix.start] + fix.text + text[fix.end :]
    assert becomes in made
    assert not read(made).checked.problems


@pytest.mark.parametrize(
    ("body", "type"),
    [
        ("fresh := r * 2.0;", "REAL"), ("r := fresh;", "REAL"), ("IF fresh THEN n := 1; END_IF;", "BOOL"),
        ("fresh := p;", "Point"), ("n := 2 + fresh;", "INT"), ("fresh := undeclared;", "INT"),
        ("RUNG\n[b] [P fresh] (c)\nEND_RUNG", "BOOL"), ("RUNG\n[b] (S fresh)\nEND_RUNG", "BOOL"),
        ("RUNG\n[b] t(IN := ~, PT := T#1s).Q (fresh)\nEND_RUNG", "BOOL"),
        ("RUNG\n(b) (R fresh)\nEND_RUNG", "BOOL"), ("RUNG\n[b] t(IN := ~, PT := T#1s).Q [/fresh] (c)\nEND_RUNG", "BOOL"),
        ("RUNG\n[b] t(IN := ~, PT := fresh).Q (c)\nEND_RUNG", "TIME"), ("t(PT := fresh, IN := b);", "TIME"),
    ],
)  # fmt: skip
def test_a_missing_variable_is_declared_with_the_type_that_fits(body: str, type: str) -> None:
    reading = read(PROGRAM.format(body))
    position = at(reading, "fresh")
    (fix,) = fixes(reading, FILE, position, position)
    text = reading.text(FILE)
    made = text[: fix.start] + fix.text + text[fix.end :]
    assert f"  fresh : {type};\nEND_VAR" in made
    assert "fresh" not in " ".join(each.message for each in read(made).checked.problems)


def test_a_pou_without_a_section_gets_one() -> None:
    reading = read("PROGRAM Main\nfresh := 1;\nEND_PROGRAM")
    (fix,) = fixes(reading, FILE, at(reading, "fresh"), at(reading, "fresh"))
    text = reading.text(FILE)
    made = text[: fix.start] + fix.text + text[fix.end :]
    assert made == "PROGRAM Main\nVAR\n  fresh : INT;\nEND_VAR\nfresh := 1;\nEND_PROGRAM"
    assert not read(made).checked.problems


@pytest.mark.parametrize(
    ("body", "where"),
    [("r := MAX(r n);", "n)"), ("n := n + undeclared;", "n +")],
)
def test_what_is_not_known_is_not_mended(body: str, where: str) -> None:
    """A comma may be missing as well as a parenthesis."""
    reading = read(PROGRAM.format(body))
    position = at(reading, where)
    assert not [
        each for each in fixes(reading, FILE, position, position) if each.title.startswith(("Insert", "Convert"))
    ]


@pytest.mark.parametrize(
    ("text", "title"),
    [
        ("PROGRAM Main\nVAR_TEMP\n  n : INT;\nVAR\n  m : INT;\nEND_VAR\nm := 1;\nEND_PROGRAM\n", "Insert `END_VAR`"),
        ("PROGRAM Main\nVAR\n  n : INT;\nEND_VAR\nn := 1;\n", "Insert `END_PROGRAM`"),
    ],
)
def test_the_end_of_a_section_and_of_a_pou_is_written(text: str, title: str) -> None:
    reading = read(text)
    (fix,) = fixes(reading, FILE, 0, len(text))
    assert fix.title == title
    assert not read(text[: fix.start] + fix.text + text[fix.end :]).checked.problems
