"""Where subrange checks are embedded, which are needless and why, and what the list of violations says."""

import json

import pytest

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from scanbench.engines.engine import Engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.symbols import resolve
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
    ("x := y;\nx2 := y;", [("x", 6, ""), ("x2", 7, "")]),
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


IN_METHOD = """FUNCTION_BLOCK Box
VAR v : INT (0..10); END_VAR
METHOD PUBLIC put
VAR_INPUT x : INT; END_VAR
  v := x;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main
VAR boxes : ARRAY[1..2] OF Box; END_VAR
  boxes[2].put(x := 60);
END_PROGRAM
"""


@pytest.mark.parametrize("make", [NativeEngine, ReferenceEngine])
def test_a_violation_in_a_method_names_its_instance(make: type[Engine]) -> None:
    program = check_sources({"a.st": IN_METHOD}, MODELS["GENERIC-IEC"]).program
    assert program is not None
    memory = bytearray(program.initial_image)
    make(program, memory).run(1)
    (found,) = read_violations(program, memory).entries
    assert (found.pou, found.instance, found.variable, found.value) == ("Box.put", "Main.boxes[2]", "v", 60)
    assert (found.span.line, found.times) == (5, 1)


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


PROJECT = """\
TYPE Level : INT (0..9); Quiet : INT (0..9); Loud : INT (0..9); END_TYPE
VAR_GLOBAL all : INT (0..9); END_VAR
FUNCTION_BLOCK Tank
VAR_INPUT raw : INT; END_VAR VAR own : INT (0..9); level : Level; END_VAR
METHOD PUBLIC fill
  own := raw;
END_METHOD
own := raw; level := raw;
END_FUNCTION_BLOCK
PROGRAM Main
VAR raw : INT := 20; tank : Tank; plain : INT (0..9); {subrange 'limit'} said : INT (0..9); set : INT (0..9); quiet : Quiet; loud : Loud; END_VAR
plain := raw; said := raw; set := raw; quiet := raw; loud := raw; all := raw;
tank(raw := raw);
END_PROGRAM
"""
SAID = {
    "*": "report",
    "Level": "limit",
    "quiet": "off",
    "Main.set": "hold",
    "Tank": "limit",
    "tank.fill": "trap",
    "all": "off",
}


def policies(said: dict[str, str], text: str = PROJECT) -> dict[str, str]:
    return {"a.st": text, "language.json": json.dumps({"version": 4, "dialect": "iec", "subranges": said})}


@pytest.mark.parametrize("make", [NativeEngine, ReferenceEngine])
def test_the_project_says_what_becomes_of_values_outside(make: type[Engine]) -> None:
    found = check_sources(policies(SAID), MODELS["GENERIC-IEC"])
    assert found.program is not None, found.problems
    memory = bytearray(found.program.initial_image)
    make(found.program, memory).run(1)
    values = {path: value_at(found.program, memory, path) for path in (
        "Main.plain", "Main.said", "Main.set", "Main.quiet", "Main.loud", "all", "Main.tank.own", "Main.tank.level")}  # fmt: skip
    assert values == {
        "Main.plain": 20, "Main.said": 9, "Main.set": 0, "Main.quiet": 20, "Main.loud": 20, "all": 20, "Main.tank.own": 9,
        "Main.tank.level": 9,
    }  # fmt: skip
    assert int.from_bytes(memory[Layout.SUBRANGE_COUNT : Layout.SUBRANGE_COUNT + 4], "little") == 6


def value_at(program: Program, memory: bytearray, path: str) -> int:
    at = resolve(program, path).locate(memory)
    assert at is not None
    return int.from_bytes(memory[at[0] : at[0] + 2], "little", signed=True)


WRONG = [
    ({"Main.sped": "trap"}, "There is no variable, type or POU `MAIN.SPED` in this project, of which `subranges` says 'trap'. "),
    ({"Main.set": "stop"}, "One of 'limit', 'hold', 'trap', 'report', 'off' expected for `Main.set`, found `stop`."),
    ({"1 2": "trap"}, "`1 2` is no name of a variable, a type or a POU."),
    ({"all": "trap", "ALL": "off"}, "`ALL` is there twice; remove one."),
]  # fmt: skip


@pytest.mark.parametrize(("said", "message"), WRONG, ids=("name", "word", "text", "twice"))
def test_a_setting_that_means_nothing_is_an_error_in_its_line(said: dict[str, str], message: str) -> None:
    sources = policies(said)
    sources["language.json"] = json.dumps(json.loads(sources["language.json"]), indent=2)
    (problem,) = check_sources(sources, MODELS["GENERIC-IEC"]).problems
    assert problem.message.startswith(message)
    assert (problem.span.file, problem.span.line > 3) == ("language.json", True)


def test_a_setting_counts_as_the_project_is_edited() -> None:
    checks, model = Checks(), MODELS["GENERIC-IEC"]

    def kept(said: dict[str, str], text: str = PROJECT) -> list[str]:
        found = checks.check(policies(said, text), model, 10_000_000)
        return (
            [each.variable for each in found.program.checks]
            if found.program
            else [each.message for each in found.problems]
        )

    def anew(said: dict[str, str], text: str) -> list[str]:
        found = check_sources(policies(said, text), model)
        return (
            [each.variable for each in found.program.checks]
            if found.program
            else [each.message for each in found.problems]
        )

    edited = PROJECT.replace("plain := raw;", "plain := raw + 1;")
    seen = []
    for said, text in (
        ({}, PROJECT),
        ({"Main": "off"}, PROJECT),
        ({"Main": "off"}, edited),
        ({"Main.sped": "off"}, edited),
        ({}, edited),
    ):
        seen.append(kept(said, text))
        assert seen[-1] == anew(said, text)
    assert ("plain" in seen[0], "plain" in seen[2], "plain" in seen[4]) == (True, False, True)
