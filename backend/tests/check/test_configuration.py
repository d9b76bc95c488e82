"""Configurations that are wrong, and what a right one becomes."""

import pytest

from scanbench.check.build import check_sources
from scanbench.program.program import Program
from scanbench.symbols.symbols import UnknownPath, complete, members, resolve
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
SOURCE = """FUNCTION_BLOCK Fb
VAR_INPUT i : INT; END_VAR
VAR q AT %Q* : BOOL; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Plain
VAR_INPUT i : INT; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Bound
VAR_IN_OUT io : INT; END_VAR
END_FUNCTION_BLOCK
VAR_GLOBAL g : INT; big : DINT; flag : BOOL; a : ARRAY[1..3] OF BOOL; END_VAR
PROGRAM Main
VAR_INPUT x : INT; END_VAR
VAR_OUTPUT y : INT; END_VAR
VAR fb : Fb; p : Plain; called : Plain; bound : Bound; t : TON; inner : INT; END_VAR
called(i := 1);
bound(io := inner);
END_PROGRAM
CONFIGURATION C
"""
SET = "VAR_CONFIG R.Main.fb.q AT %QX0.0 : BOOL; END_VAR"
HEAD = SOURCE.count("\n")

WRONG = [
    ("RESOURCE R ON P\nPROGRAM Main : Mian;\nEND_RESOURCE", "D010", 2, "Did you mean `Main`"),
    ("RESOURCE R ON P\nTASK t (INTERVAL := T#10ms);\nPROGRAM Main WITH tt : Main;\nEND_RESOURCE", "D010", 3, "Did you mean `t`"),
    ("RESOURCE R ON P\nTASK t (INTERVAL := T#1ns);\nPROGRAM Main WITH t : Main;\nEND_RESOURCE", "D010", 2, "at least T#1us"),
    ("RESOURCE R ON P\nTASK t (PRIORITY := -1);\nPROGRAM Main WITH t : Main;\nEND_RESOURCE", "D010", 2, "0 (the highest)"),
    ("RESOURCE R ON P\nTASK t (SINGLE := g);\nPROGRAM Main WITH t : Main;\nEND_RESOURCE", "D010", 2, "SINGLE is a BOOL"),
    ("RESOURCE R ON P\nTASK t (SINGLE := gone);\nPROGRAM Main WITH t : Main;\nEND_RESOURCE", "T001", 2, "`gone`"),
    ("RESOURCE R ON P\nTASK t (SINGLE := a[g]);\nPROGRAM Main WITH t : Main;\nEND_RESOURCE", "T004", 2, "fixed place"),
    ("RESOURCE R ON P\nTASK t ();\nTASK T ();\nPROGRAM Main WITH t : Main;\nEND_RESOURCE", "D001", 3, "declared already"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nPROGRAM main : Main;\nEND_RESOURCE", "D001", 3, "declared already"),
    ("RESOURCE R ON P\nPROGRAM Main : Main (z := 1);\nEND_RESOURCE", "T004", 2, "no input or output `z`"),
    ("RESOURCE R ON P\nPROGRAM Main : Main (x := big);\nEND_RESOURCE", "T002", 2, "`x` is INT"),
    ("RESOURCE R ON P\nPROGRAM Main : Main (x => g);\nEND_RESOURCE", "T004", 2, "write `x := ...`"),
    ("RESOURCE R ON P\nPROGRAM Main : Main (y := g);\nEND_RESOURCE", "T004", 2, "write `y => ...`"),
    ("RESOURCE R ON P\nPROGRAM Main : Main (y => flag);\nEND_RESOURCE", "T002", 2, "BOOL"),
    ("RESOURCE R ON P\nPROGRAM Main : Main (x := g + 1);\nEND_RESOURCE", "T004", 2, "compute in the program"),
    ("RESOURCE R ON P\nPROGRAM Main : Main (x := 1, x := 2);\nEND_RESOURCE", "T004", 2, "connected twice"),
    ("RESOURCE R ON P\nTASK t ();\nPROGRAM Main : Main (pp WITH t);\nEND_RESOURCE", "D010", 3, "Did you mean `p`"),
    ("RESOURCE R ON P\nTASK t ();\nPROGRAM Main : Main (called WITH t);\nEND_RESOURCE", "X001", 3, "take the call out"),
    ("RESOURCE R ON P\nTASK t ();\nPROGRAM Main : Main (bound WITH t);\nEND_RESOURCE", "T005", 3, "in-out"),
    ("RESOURCE R ON P\nTASK t ();\nPROGRAM Main : Main (t WITH t);\nEND_RESOURCE", "X001", 3, "TON"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nVAR_CONFIG R.Main.gone : INT := 1; END_VAR", "D010", 4, "`gone`"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nVAR_CONFIG R.Main.inner : DINT := 1; END_VAR", "T002", 4, "is INT"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nVAR_CONFIG R.Main.inner AT %MW1 : INT; END_VAR", "D005", 4, "does not wait"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nVAR_CONFIG R.Main.fb.q AT %IX0.0 : BOOL; END_VAR", "D005", 4, "begins with %Q"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nVAR_CONFIG R.Main.fb.q AT %QW0 : BOOL; END_VAR", "D005", 4, "needs a bit"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nVAR_CONFIG R.Main.fb.q : BOOL := TRUE; END_VAR", "D005", 4, "needs an address"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nVAR_CONFIG R.Main.inner : INT; END_VAR", "D004", 4, "Nothing is set"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nVAR_ACCESS n : R.Main.yy : INT; END_VAR", "D010", 4, "`yy`"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nVAR_ACCESS n : R.Main.y : BOOL; END_VAR", "T002", 4, "is INT"),
    ("RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nRESOURCE R ON P\nPROGRAM b : Main;\nEND_RESOURCE", "D001", 4, "declared already"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "code", "line", "says"), WRONG, ids=[f"{each[1]} {each[3]}" for each in WRONG])
def test_what_is_wrong(text: str, code: str, line: int, says: str) -> None:
    checked = check_sources({"a.st": f"{SOURCE}{text}\n{SET}\nEND_CONFIGURATION\n"}, MODEL)
    found = [each for each in checked.problems if each.code == code and each.span.line == HEAD + line]
    assert any(says in each.message for each in found), "\n".join(map(str, checked.problems))
    assert checked.program is None


def test_what_waits_for_an_address_is_told_by_its_path() -> None:
    text = f"{SOURCE}RESOURCE R ON P\nPROGRAM Main : Main;\nEND_RESOURCE\nEND_CONFIGURATION\n"
    checked = check_sources({"a.st": text}, MODEL)
    (problem,) = checked.problems
    assert (problem.code, problem.span.line) == ("W002", 3)
    assert checked.program is not None
    assert "`Main.fb.q` is AT %Q*" in problem.message


def test_a_star_is_for_data_that_stays() -> None:
    for section in ("VAR_INPUT", "VAR_OUTPUT", "VAR_TEMP"):
        text = f"PROGRAM Main\n{section} q AT %Q* : BOOL; END_VAR\nEND_PROGRAM\n"
        problems = check_sources({"a.st": text}, MODEL).problems
        assert [each.code for each in problems] in (["D005"], ["D008"])


def two_resources() -> Program:
    text = (
        f"{SOURCE}RESOURCE One ON P\nTASK t (INTERVAL := T#4ms);\nPROGRAM m WITH t : Main;\nEND_RESOURCE\n"
        "RESOURCE Two ON P\nTASK t (INTERVAL := T#6ms, SINGLE := flag);\nTASK e (SINGLE := flag);\n"
        "PROGRAM m WITH t : Main (x := g);\nPROGRAM n WITH e : Main;\nEND_RESOURCE\n"
        "VAR_CONFIG\nOne.m.fb.q AT %QX0.0 : BOOL;\nTwo.m.fb.q AT %QX0.1 : BOOL;\nTwo.n.fb.q AT %QX0.2 : BOOL;\nEND_VAR\n"
        "VAR_ACCESS Tall : Two.m.y : INT READ_ONLY; Low : g : INT READ_WRITE; END_VAR\nEND_CONFIGURATION\n"
    )
    checked = check_sources({"a.st": text}, MODEL)
    assert checked.program is not None, "\n".join(map(str, checked.problems))
    return checked.program


def test_tasks_of_two_resources() -> None:
    program = two_resources()
    assert program.interval_ns == 2_000_000
    shown = [
        (task.name, task.every, task.single is not None, [each.name for each in task.programs])
        for task in program.tasks
    ]
    assert shown == [
        ("One.t", 2, False, ["One.m"]),
        ("Two.t", 3, True, ["Two.m"]),
        ("Two.e", 0, True, ["Two.n"]),
    ]
    flags = {task.previous.offset for task in program.tasks if task.previous}
    assert len(flags) == 2
    assert all(at < program.layout.state_size for at in flags)


def test_paths_of_two_resources() -> None:
    program = two_resources()
    assert resolve(program, "two.M.inner").path == "Two.m.inner"
    assert [each.name for each in members(program, "Two.n")][:2] == ["x", "y"]
    assert "One.m" in [each.path for each in complete(program, "One.", 10)]
    assert not resolve(program, "Tall").writable
    assert resolve(program, "Low").writable
    assert resolve(program, "Tall").offset == resolve(program, "Two.m.y").offset
    with pytest.raises(UnknownPath):
        resolve(program, "Three.m.inner")
