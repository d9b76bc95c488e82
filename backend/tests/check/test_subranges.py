"""Where subrange checks are embedded, which are needless and why, and what the list of violations says."""

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.engine import Engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.violations import read_violations
from tests.caseformat import MODELS

HEAD = "PROGRAM Main\nVAR x, x2 : INT (0..10); y, z : INT; s : INT (0..5); u : USINT; w : INT (0..255); END_VAR\n"


def checked(body: str) -> Program:
    made = check_sources({"a.st": f"{HEAD}{body}\nEND_PROGRAM\n"}, MODELS["GENERIC-IEC"])
    assert made.program is not None, "\n".join(map(str, made.problems))
    return made.program


def sites(body: str) -> list[tuple[str, int, str]]:
    return [(site.variable, site.span.column, site.needless) for site in checked(body).checks]


SITES = [
    ("y := x + x2;", [("x", 6, ""), ("x2", 10, "")]),
    ("x := y;", [("x", 6, "")]),
    ("x := 3;", [("x", 6, "the constant is in range")]),
    ("x := s;", [("s", 6, ""), ("x", 6, "the value is brought to 0..5 already")]),
    ("x := y MOD 3 + 1;", [("x", 6, "")]),
    ("w := u;", [("w", 6, "the value is 0..255 at most")]),
    ("x := y;\ny := x;", [("x", 6, ""), ("x", 6, "assigned with a check in line 3")]),
    ("y := x;\nz := x;", [("x", 6, ""), ("x", 6, "checked already in line 3")]),
    ("y := x;\nIF y > 1 THEN x2 := 3; END_IF;\nz := x;", [("x", 6, ""), ("x2", 21, "the constant is in range"), ("x", 6, "checked already in line 3")]),
    ("x := y;\nIF y > 1 THEN x := z; END_IF;\nz := x;", [("x", 6, ""), ("x", 20, ""), ("x", 6, "")]),
    ("x := y;\nWHILE x > 3 DO y := x; x := 1; END_WHILE;", [("x", 6, ""), ("x", 7, ""), ("x", 21, "checked already in line 4"), ("x", 29, "the constant is in range")]),
]  # fmt: skip


@pytest.mark.parametrize(("body", "expected"), SITES, ids=[body for body, _ in SITES])
def test_where_checks_are_and_which_are_needless(body: str, expected: list[tuple[str, int, str]]) -> None:
    assert sites(body) == expected


MANY = """
FUNCTION_BLOCK Tank
VAR level : INT (0..9); n : INT; END_VAR
n := level;
END_FUNCTION_BLOCK
PROGRAM Main
VAR tanks : ARRAY[1..300] OF Tank; i : INT; END_VAR
FOR i := 1 TO 300 DO tanks[i](); END_FOR;
END_PROGRAM
"""


@pytest.mark.parametrize("make", [NativeEngine, ReferenceEngine])
def test_the_list_is_bounded_and_counters_saturate(make: type[Engine]) -> None:
    program = check_sources({"a.st": MANY}, MODELS["GENERIC-IEC"]).program
    assert program is not None
    memory = bytearray(program.initial_image)
    tank = program.tasks[0].programs[0].offset
    for index in range(300):
        memory[tank + 4 * index] = 200
    engine = make(program, memory)
    engine.run(2)
    found = read_violations(program, memory)
    assert len(found.entries) == Layout.VIOLATION_LIMIT
    assert (found.count, found.dropped) == (600, 88)
    assert (found.entries[2].instance, found.entries[2].value, found.entries[2].times) == ("Main.tanks[3]", 200, 2)
    memory[Layout.SUBRANGE_COUNT : Layout.SUBRANGE_COUNT + 4] = b"\xfe\xff\xff\xff"
    engine.run(1)
    assert read_violations(program, memory).count == 0xFFFF_FFFF


def test_constants_and_start_values_out_of_range_are_errors_at_their_place() -> None:
    text = "PROGRAM Main\nVAR x : INT (0..9) := 3;\ny : INT (0..9) :=\n10; END_VAR\nx :=\n -1;\nEND_PROGRAM\n"
    problems = check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems
    assert [(each.code, each.span.line) for each in problems] == [("S004", 4), ("S004", 6)]
    assert "10 is outside of" in problems[0].message


POLICY_PROBLEMS = [
    ("PROGRAM Main\nVAR\n  {subrange 'stop'} x : INT (0..5);\nEND_VAR\nx := 1;\nEND_PROGRAM\n", 3, "One of 'limit', 'hold', 'trap', 'report', 'off' expected, found `'stop'`."),
    ("PROGRAM Main\nVAR x : INT (0..5); END_VAR\n{subrange 'trap'}\nx := 1;\nEND_PROGRAM\n", 3, "A pragma `subrange` belongs right before the declaration of a variable, a type or a POU; move it there."),
]  # fmt: skip


@pytest.mark.parametrize(("text", "line", "message"), POLICY_PROBLEMS, ids=("word", "place"))
def test_a_pragma_that_says_nothing_is_an_error(text: str, line: int, message: str) -> None:
    found = check_sources({"a.st": text}, MODELS["GENERIC-IEC"])
    assert [(each.span.line, each.message) for each in found.problems if each.code == "S003"] == [(line, message)]


def test_a_check_that_is_off_is_not_listed_and_one_that_reports_proves_nothing() -> None:
    text = "PROGRAM Main\nVAR {subrange 'off'} o : INT (0..5); {subrange 'report'} r : INT (0..5); y : INT; END_VAR\no := y;\nr := y;\ny := o + r;\nEND_PROGRAM\n"  # fmt: skip
    found = check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).program
    assert found is not None
    assert [(each.variable, each.span.line, each.needless) for each in found.checks] == [("r", 4, ""), ("r", 5, "")]
