"""Renaming changes every use and nothing else; where that cannot be known, it says so."""

from collections.abc import Mapping

import pytest

from scanbench.check.build import check_sources
from scanbench.language.navigate import named_at
from scanbench.language.reading import Reading, Readings
from scanbench.language.rename import CannotRename, changed_meaning, places
from tests.caseformat import MODELS
from tests.language.reading import FILE, marked
from tests.language.test_index import PROGRAM
from tests.language.test_navigate import SHAPES


def rename(text: str, name: str) -> str | CannotRename:
    """The text after it."""
    reading, position = marked(text)
    found = named_at(reading, FILE, position)
    assert found is not None
    named = places(reading, found.symbol, name)
    if isinstance(named, CannotRename):
        return named
    spots = [(each.span.line, each.span.column, each.span.end_column) for each in named]
    made = changed(reading, spots, name)
    return changed_meaning(reading, named, name, Readings(reading.project.model).read) or made


def changed(reading: Reading, places: list[tuple[int, int, int]], name: str) -> str:
    lines = reading.text(FILE).split("\n")
    for line, column, end in sorted(places, reverse=True):
        lines[line - 1] = lines[line - 1][: column - 1] + name + lines[line - 1][end - 1 :]
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("mark", "name"),
    [("Twice(a)", "Double"), ("inc(by", "counter"), ("by := Tw", "step"), ("RED THEN", "CRIMSON"), ("Point; END", "Spot"), ("x;\nIF", "wide")],
)  # fmt: skip
def test_every_use_is_renamed_and_the_program_stays_the_same(mark: str, name: str) -> None:
    before = check_sources({FILE: PROGRAM}, MODELS["GENERIC-IEC"])
    made = rename(PROGRAM.replace(mark, f"|{mark}", 1), name)
    assert isinstance(made, str)
    after = check_sources({FILE: made}, MODELS["GENERIC-IEC"])
    assert before.program is not None
    assert after.program is not None, after.problems
    assert after.program.initial_image == before.program.initial_image
    assert after.problems == before.problems


def test_a_method_is_renamed_with_those_that_override_it() -> None:
    made = rename(SHAPES.replace("big.area", "big.|area"), "surface")
    assert isinstance(made, str)
    assert "area" not in made
    assert check_sources({FILE: made}, MODELS["GENERIC-IEC"]).program is not None


COUNTER = """\
FUNCTION_BLOCK Counter
VAR total : INT; END_VAR
METHOD PUBLIC up : INT
VAR part : INT; END_VAR
part := 1;
total := total + part;
END_METHOD
END_FUNCTION_BLOCK"""


@pytest.mark.parametrize(
    ("text", "name", "after"),
    [
        (
            "TYPE |Volt : INT; Col : (RED, GREEN); END_TYPE\nPROGRAM Main VAR v : Volt; c : Col; END_VAR\nv := Volt#5;\nc := Col#RED;\nEND_PROGRAM",
            "Level", ["Level : INT;", "v : Level;", "v := Level#5;", "c := Col#RED;"],
        ),
        (
            "TYPE |Col : (RED, GREEN); END_TYPE\nPROGRAM Main VAR c : Col := Col#RED; END_VAR\nc := col#GREEN;\nEND_PROGRAM",
            "Kind", ["TYPE Kind :", "c : Kind := Kind#RED;", "c := Kind#GREEN;"],
        ),
        (
            "FUNCTION_BLOCK B VAR v : INT; END_VAR\nPROPERTY PUBLIC |p : INT\nGET\np := v;\nEND_GET\nSET\nv := p;\nEND_SET\n"
            "END_PROPERTY\nEND_FUNCTION_BLOCK\nPROGRAM Main END_PROGRAM", "level", ["PROPERTY PUBLIC level : INT", "level := v;", "v := level;"],
        ),
        (
            "INTERFACE IA\nMETHOD foo : INT VAR_INPUT |p : INT; END_VAR END_METHOD\nEND_INTERFACE\nCLASS A IMPLEMENTS IA\n"
            "METHOD PUBLIC foo : INT VAR_INPUT p : INT; END_VAR\nfoo := p;\nEND_METHOD\nEND_CLASS\n"
            "PROGRAM Main VAR a : A; n : INT; END_VAR\nn := a.foo(p := 1);\nEND_PROGRAM", "part", ["foo := part;", "a.foo(part := 1)"],
        ),
        (
            "PROGRAM Main VAR |on, with, priority : BOOL; END_VAR\non := with AND priority;\nEND_PROGRAM\nCONFIGURATION C\n"
            "RESOURCE R ON CJ1M\nTASK t(INTERVAL := T#1s, PRIORITY := 1);\nPROGRAM p WITH t : Main;\nEND_RESOURCE\nEND_CONFIGURATION",
            "runs", ["runs := with", "RESOURCE R ON CJ1M"],
        ),
        (
            "PROGRAM Main VAR on, with, |priority : BOOL; END_VAR\non := with AND priority;\nEND_PROGRAM\nCONFIGURATION C\n"
            "TASK t(INTERVAL := T#1s, PRIORITY := 1);\nPROGRAM p WITH t : Main;\nEND_CONFIGURATION",
            "first", ["with AND first;", "PRIORITY := 1"],
        ),
        (
            "PROGRAM Main VAR on, |with, priority : BOOL; END_VAR\non := with AND priority;\nEND_PROGRAM\nCONFIGURATION C\n"
            "TASK t(INTERVAL := T#1s, PRIORITY := 1);\nPROGRAM p WITH t : Main;\nEND_CONFIGURATION",
            "beside", ["on := beside AND", "PROGRAM p WITH t"],
        ),
        ("PROGRAM Main VAR |Straße : INT; END_VAR\nstraße := Straße + 1;\nEND_PROGRAM", "way", ["way := way + 1;"]),
    ],
)  # fmt: skip
def test_every_place_is_found(text: str, name: str, after: list[str]) -> None:
    made = rename(text, name)
    assert isinstance(made, str), made
    for each in after:
        assert each in made
    assert not [
        each for each in check_sources({FILE: made}, MODELS["GENERIC-IEC"]).problems if each.severity == "error"
    ]


APART = """\
FUNCTION_BLOCK Tank
VAR_INPUT level : INT; END_VAR
VAR_OUTPUT full : BOOL; END_VAR
full := level > 9;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Pump
VAR speed : INT; END_VAR
speed := speed + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR t : Tank; END_VAR
t(level := 3);
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("mark", "name", "again"),
    [
        ("level :", "speed", False),  # named where nothing else has that name: nothing has to be checked again
        ("speed :", "level", False),
        ("level :", "t", True),  # Main names both
        ("t : Tank", "speed", False),
    ],
)
def test_a_name_that_only_something_apart_has_needs_no_second_check(mark: str, name: str, again: bool) -> None:
    reading, position = marked(APART.replace(mark, f"|{mark}", 1))
    found = named_at(reading, FILE, position)
    assert found is not None
    named = places(reading, found.symbol, name)
    assert not isinstance(named, CannotRename)
    asked = []

    def read(texts: Mapping[str, str]) -> Reading:
        asked.append(texts)
        return Readings(reading.project.model).read(texts)

    assert changed_meaning(reading, named, name, read) is None
    assert bool(asked) is again


OVERRIDES = """\
FUNCTION_BLOCK Base
METHOD PUBLIC foo : INT
foo := 1;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Der EXTENDS Base
METHOD PUBLIC bar : INT
bar := 2;
END_METHOD
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize(
    ("text", "name", "why"),
    [
        ("PROGRAM Main VAR |a, b : INT; END_VAR\na := b;\nEND_PROGRAM", "b", "declared already"),
        ("PROGRAM Main VAR |a : INT; END_VAR\na := 1;\nEND_PROGRAM", "END_IF", "keyword"),
        ("PROGRAM Main VAR |a : INT; END_VAR\na := 1;\nEND_PROGRAM", "9a", "no name"),
        ("PROGRAM Main VAR t : TON; END_VAR\nt(|IN := TRUE);\nEND_PROGRAM", "x", "library"),
        ("PROGRAM Main VAR |a : INT; END_VAR\na := ;\nEND_PROGRAM", "b", "cannot be read"),
        ("VAR_GLOBAL |g : INT; END_VAR\nPROGRAM Main VAR h : INT; END_VAR\nh := g;\nEND_PROGRAM", "h", "main.st:3 would mean something else"),
        ("VAR_GLOBAL g : INT; END_VAR\nPROGRAM Main VAR |h : INT; END_VAR\nh := g;\nEND_PROGRAM", "g", "main.st:3 would mean something else"),
        (f"{COUNTER}\nPROGRAM Main VAR c : Counter; END_VAR\nc.up();\nEND_PROGRAM".replace("total :", "|total :", 1), "part", "mean something"),
        (f"{COUNTER}\nPROGRAM Main VAR c : Counter; END_VAR\nc.up();\nEND_PROGRAM".replace("part :", "|part :", 1), "total", "mean something"),
        (OVERRIDES.replace("foo :", "|foo :", 1), "bar", "in place of"),
        (OVERRIDES.replace("bar :", "|bar :", 1), "foo", "in place of"),
        (
            "TYPE Col : (|RED, GREEN); END_TYPE\nPROGRAM Main VAR c : Col; END_VAR\nc := nope(Col#RED);\nEND_PROGRAM",
            "CRIMSON", "may mean this, too",
        ),
        (
            "FUNCTION F : INT VAR_INPUT |v : INT; END_VAR\nF := v;\nEND_FUNCTION\nPROGRAM Main VAR g : INT; END_VAR\n"
            "g := nope + F(v := 2);\nEND_PROGRAM", "w", "may mean this, too",
        ),
        (
            "FUNCTION_BLOCK Base VAR |a : INT; END_VAR\na := 1;\nEND_FUNCTION_BLOCK\n"
            "FUNCTION_BLOCK Derived EXTENDS Base VAR b : INT; END_VAR\nb := 2;\nEND_FUNCTION_BLOCK\n", "b", "would be wrong",
        ),
        (
            "PROGRAM Main VAR |a : INT; END_VAR\na := 1;\nEND_PROGRAM\nCONFIGURATION C\nTASK a(INTERVAL := T#1s);\n"
            "PROGRAM p WITH a : Main;\nEND_CONFIGURATION", "b", "may mean this, too",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_renamed_says_why(text: str, name: str, why: str) -> None:
    made = rename(text, name)
    assert isinstance(made, CannotRename)
    assert why in made.message
