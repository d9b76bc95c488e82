"""What is told about `plant/`: programs and tables of inputs, at the place where it is wrong."""

from collections.abc import Mapping

import pytest

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from scanbench.check.system.plant import plant_files
from scanbench.engines.native.emit_program import emit_program
from scanbench.symbols.symbols import UnknownPath, complete, members, resolve
from scanbench.syntax.parse_file import is_program_file
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
MAIN = """\
TYPE Level : INT(0..100); END_TYPE
VAR_GLOBAL go : BOOL; level : Level; list : ARRAY[0..3] OF INT; k : INT; END_VAR
PROGRAM Main
VAR speed AT %MW10 : INT; inner : INT; END_VAR
speed := list[k];
END_PROGRAM
"""


def found(files: Mapping[str, str]) -> list[str]:
    return [str(each) for each in check_sources(files, MODEL).problems]


TABLES = [
    ("", "p.csv:1:1: S003 This file has no heading."),
    ("# only words\n", "p.csv:1:1: S003 This file has no heading."),
    ("scan;go\n", "p.csv:1:1: S003 This file has no rows below its heading."),
    ("row;go\n1;1", "p.csv:1:1: S003 The first column is `scan` or `time`, not `row`."),
    ("scan\n1", "p.csv:1:1: S003 There are no variables in the heading"),
    ("scan;go;gone\n1;1;1", "p.csv:1:9: T001 There is no variable and no address `gone`. Did you mean `go`?"),
    ("scan;%IW999999\n1;1", "p.csv:1:6: T001 There is no variable and no address `%IW999999`. '%IW999999' is outside"),
    ("scan;IW2\n1;1", "p.csv:1:6: T001 There is no variable and no address `IW2`. Did you mean `%IW2`?"),
    ("scan;Main.inner\n1;1", "p.csv:1:6: T010 `Main.inner` is no located variable (AT)"),
    ("scan;Main.sped\n1;1", "p.csv:1:6: T010 `Main.sped` is no located variable (AT), and others of a program are its own business. Did you mean `speed`?"),
    ("scan;list\n1;1", "p.csv:1:6: T010 `list` is ARRAY[0..3] OF INT, which has no single value"),
    ("scan;list[k]\n1;1", "p.csv:1:6: T010 `list[k]` is not always at the same place"),
    ("scan;list[9]\n1;1", "p.csv:1:11: T012 Index 9 is outside of 0..3."),
    ("scan; go +\n1;1", "p.csv:1:7: S003 `go +` is no variable"),
    ("scan;go;\n1;1;5;6", "p.csv:2:1: S003 This row has 4 cells, the heading 2."),
    ("scan;go\n1;yes", "p.csv:2:3: S004 `go`: `yes` is not a BOOL; write TRUE or FALSE."),
    ("scan;go;level\n1;1;7\n2;0; 101", "p.csv:3:6: S004 `level`: 101 is outside of 0..100."),
    ("scan;go\n# fine\n\n3;1\n3;0", "p.csv:5:1: S003 Rows are in ascending order, and `3` is not after that of line 4."),
    ("scan;go\n1.5;1", "p.csv:2:1: S003 `1.5` is no scan: write a number of scans, from 0 on."),
    ("time;go\n1q;1", "p.csv:2:1: S003 `1q` is no time: a duration is written like T#1h30m, T#1.5s or T#-5ms."),
    ("time;go\nT#-1s;1", "p.csv:2:1: S003 `T#-1s` is no time: it counts from the start of the program"),
    ("scan;go\n99999999999999999999999;TRUE", "p.csv:2:1: S003 `99999999999999999999999` is no scan: no run gets further than scan 9,223,372,036,854,775,807."),
    ("scan;go\n9223372036854775808;TRUE", "p.csv:2:1: S003 `9223372036854775808` is no scan: no run gets further"),
    ("scan;go\n1;1\n" + "9" * 5000 + ";0", "p.csv:3:1: S003"),
    ("time;go\n0;1\n99999999999999999999999;TRUE", "p.csv:3:1: S003 `99999999999999999999999` is no time: longer than a TIME can hold"),
    ("time;go\nT#99999999999999999999d;TRUE", "p.csv:2:1: S003 `T#99999999999999999999d` is no time: longer"),
    ("time;level\n0;1e999", "p.csv:2:3: S004 `level`"),
    ("time;level\n0;99999999999999999999999", "p.csv:2:3: S004 `level`"),
    ("# repeat 99999999999999999999999\nscan;go\n1;1", "p.csv:1:1: S003 `99999999999999999999999` is no length of a round"),
    ("scan;go;level;GO\n1;1;2;0", "p.csv:1:15: S003 `GO` drives what the column `go` drives already: leave one of them out."),
    ("scan;%IW2;%IX4.3\n1;1;1", "p.csv:1:11: S003 `%IX4.3` drives what the column `%IW2` drives already"),
    ("scan;Main.speed;%MW10\n1;1;1", "p.csv:1:17: S003 `%MW10` drives what the column `Main.speed` drives already"),
    ("scan;list[1];list[2];list[1]\n1;1;1;1", "p.csv:1:22: S003 `list[1]` drives what the column `list[1]` drives already"),
    ("# repeat\nscan;go\n1;1", "p.csv:1:1: S003 Say how long one round is, as in `# repeat 3s`."),
    ("# repeat 5\nscan;go\n1;1\n5;0", "p.csv:1:1: S003 A round of `5` ends before the last row comes."),
    ("# repeat often\nscan;go\n1;1", "p.csv:1:1: S003 `often` is no length of a round"),
]  # fmt: skip


@pytest.mark.parametrize(("table", "expected"), TABLES)
def test_a_table_that_is_wrong(table: str, expected: str) -> None:
    problems = found({"main.st": MAIN, "plant/p.csv": table})
    assert [each for each in problems if each.startswith(f"plant/{expected}")], problems
    assert len(problems) == 1


@pytest.mark.parametrize(
    "table",
    ["scan;go\n9223372036854775807;1", "# repeat\nscan;go\n1;1\n9223372036854775807;0", "scan;%IX2.3;%IX2.4\n0;1;1"],
)
def test_a_table_that_is_right(table: str) -> None:
    checked = check_sources({"main.st": MAIN, "plant/p.csv": table}, MODEL)
    assert checked.program is not None
    assert not checked.problems


def test_two_tables_that_drive_the_same() -> None:
    files = {"main.st": MAIN, "plant/b.csv": "scan;level;go\n0;1;1", "plant/a.csv": "scan;go;%IW0\n0;1;1"}
    files["plant/c.csv"] = "scan;go\n0;1"
    assert found(files) == [
        "plant/a.csv:1:6: W001 `go` is driven by plant/b.csv too, which comes later in every scan, so its values win."
    ]
    assert check_sources(files, MODEL).program is not None


def test_a_table_with_many_wrong_cells_does_not_tell_all() -> None:
    rows = "\n".join(f"{number};x{number}" for number in range(1000))
    assert len(found({"main.st": MAIN, "plant/p.csv": f"scan;level\n{rows}"})) == 20


PROGRAMS = [
    ({"plant/a.st": "PROGRAM A\nEND_PROGRAM"}, "plant/a.st:1:1: D011 There is no PROGRAM, so nothing would run. What is in plant/"),
    ({"main.st": MAIN, "plant/a.st": "PROGRAM Main\nEND_PROGRAM"}, "plant/a.st:1:9: D001 `Main` is declared already"),
    ({"main.st": MAIN, "plant/Main.csv": "scan;go\n1;1"}, "plant/Main.csv:1:1: D001 This file's program `Main` is declared already"),
    (
        {"main.st": MAIN + "CONFIGURATION C\nRESOURCE R ON PLC\nPROGRAM a : A;\nPROGRAM m : Main;\nEND_RESOURCE\nEND_CONFIGURATION",
         "plant/a.st": "PROGRAM A\nEND_PROGRAM"},
        "main.st:9:9: D010 `A` is of the plant, which runs by itself in every scan",
    ),
    (
        {"main.st": MAIN, "plant/c.st": "PROGRAM A\nEND_PROGRAM\nCONFIGURATION C\nRESOURCE R ON PLC\nPROGRAM m : Main;\nEND_RESOURCE\n"
         "END_CONFIGURATION"},
        "plant/c.st:3:1: D010 A CONFIGURATION belongs outside of plant/",
    ),
    (
        {"main.st": "PROGRAM Main\nVAR x : INT; END_VAR\nx := Twice(x);\nEND_PROGRAM",
         "plant/f.st": "FUNCTION Twice : INT\nVAR_INPUT x : INT; END_VAR\nTwice := 2 * x;\nEND_FUNCTION"},
        "main.st:1:9: T010 `Main` uses `Twice`, which is of the plant (plant/f.st)",
    ),
    ({"main.st": MAIN, "plant/a.st": "PROGRAM A\nMain.inner := 1;\nEND_PROGRAM"}, "plant/a.st:2:1: T010 `Main` is a PROGRAM"),
]  # fmt: skip


@pytest.mark.parametrize(("files", "expected"), PROGRAMS)
def test_a_plant_that_is_wrong(files: dict[str, str], expected: str) -> None:
    problems = found(files)
    assert any(each.startswith(expected) for each in problems), problems


def test_only_the_plant_writes_what_programs_may_only_read() -> None:
    body = "%A200.00 := TRUE;\nEND_PROGRAM"
    model = MODELS["CJ1M-CPU63"]
    files = {"main.st": f"PROGRAM Main\n{body}", "plant/a.st": f"PROGRAM A\n{body}"}
    assert [(each.code, each.span.file) for each in check_sources(files, model).problems] == [("T011", "main.st")]


def test_which_files_are_the_plant() -> None:
    assert plant_files(["main.st", "plant/a.st", "Plant/b.csv", "x/plant/c.st"]) == {"plant/a.st", "Plant/b.csv"}
    assert plant_files(["/home/plant/p/main.st", "/home/plant/p/plant/a.st"]) == {"/home/plant/p/plant/a.st"}
    assert plant_files(["samples\\c\\main.st", "samples\\c\\plant\\a.csv"]) == {"samples\\c\\plant\\a.csv"}
    assert plant_files(["/home/plant/main.st", "/home/plant/other.st"]) == set()
    assert [path for path in ("a.st", "plant/a.csv", "a.csv", "x/plant/a.CSV") if is_program_file(path)] == [
        "a.st", "plant/a.csv", "x/plant/a.CSV",
    ]  # fmt: skip


FILES = {
    "main.st": MAIN,
    "plant/a.st": "PROGRAM A\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n",
    "plant/b.csv": "scan;go;list[1]\n0;1;\n5;;7\n",
    "plant/c.csv": "scan;level\n0;1\n",
}


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("plant/a.st", "n + 1", "n + 2"),
        ("plant/a.st", "n : INT;", "n : INT; m : BOOL;"),
        ("plant/a.st", "PROGRAM A", "PROGRAM Other"),
        ("plant/b.csv", ";7", ";8"),
        ("plant/b.csv", "5;;7", "5;;7\n9;0;1"),
        ("plant/b.csv", "list[1]", "gone"),
        ("plant/b.csv", "list[1]", "go"),
        ("plant/c.csv", "level", "go"),
        ("main.st", "go : BOOL", "go : INT"),
        ("main.st", "speed := list[k];", "speed := list[k] + 1;"),
    ],
)
def test_a_check_after_an_edit_finds_what_a_check_of_the_whole_finds(name: str, old: str, new: str) -> None:
    checks = Checks()
    checks.check(FILES, MODEL, 1_000_000)
    files = FILES | {name: FILES[name].replace(old, new)}
    assert files != FILES
    for sources in (files, FILES):
        assert checks.diagnose(sources, MODEL, 1_000_000).problems == check_sources(sources, MODEL, 1_000_000).problems
        again, expected = checks.check(sources, MODEL, 1_000_000), check_sources(sources, MODEL, 1_000_000)
        assert again.problems == expected.problems
        assert (again.program is None) == (expected.program is None)
        if again.program is not None and expected.program is not None:
            assert emit_program(again.program) == emit_program(expected.program)
            assert again.program.initial_image == expected.program.initial_image
            assert [each.name for each in again.program.instances[-2:]] == ["b", "c"]


def test_what_a_watch_sees() -> None:
    program = check_sources(FILES, MODEL).program
    assert program is not None
    assert [each.path for each in members(program, "")][:4] == ["Main", "A", "b", "c"]
    assert [each.name for each in program.instances] == ["__System", "Main", "A", "b", "c"]
    assert [each.path for each in members(program, "b")] == ["b.row"]
    assert resolve(program, "A.n").type.name == "INT"
    assert resolve(program, "_firstcycle").address == "%MX8576.0"
    assert not resolve(program, "_FirstCycle").writable
    assert "_FirstCycle" in [each.path for each in complete(program, "_fir", 10)]
    with pytest.raises(UnknownPath):
        resolve(program, "__System.second")


def test_generated_text_is_not_shown() -> None:
    checked = check_sources(FILES, MODEL)
    assert {each.name for each in checked.pous} == {"Main", "A", "Level", "go", "level", "list", "k"}
    problems = found({"main.st": "PROGRAM Main\nUserEror(1);\nx := __SCAN;\nEND_PROGRAM"})
    assert "Did you mean `UserError`" in problems[0]
    assert "`__SCAN` is not declared" in problems[2] or "`__SCAN` is not declared" in problems[1]
