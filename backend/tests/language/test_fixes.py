"""Mends of problems: what a quick fix leaves has that problem no more."""

import pytest

from scanbench.language.fixes import fixes
from tests.language.reading import FILE, at, read

PROGRAM = """\
TYPE Point : STRUCT wide : INT; END_STRUCT; END_TYPE
PROGRAM Main
VAR
  n, total : INT; r : REAL; t : TON; p : Point;
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
    ],
)
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
