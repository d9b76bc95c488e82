"""Conditions: what can be said about a program, and how what cannot is refused."""

import pytest

from scanbench.check.build import check_sources
from scanbench.check.typed.condition import MAX_LENGTH, BadCondition, Condition, compile_condition
from scanbench.engines.engine import Reason
from scanbench.engines.pair import PairEngine
from scanbench.program.program import Program
from tests.caseformat import MODELS

SOURCE = """
TYPE
  Color : (RED, GREEN, BLUE);
  Sub : INT (0..10);
  Point : STRUCT x : INT; ys : ARRAY[1..3] OF REAL; END_STRUCT;
END_TYPE
FUNCTION Twice : INT VAR_INPUT x : INT; END_VAR Twice := 2 * x; END_FUNCTION
FUNCTION_BLOCK Tank
VAR_IN_OUT level : INT; END_VAR
VAR inner : INT; END_VAR
  level := level + 1;
  inner := level;
END_FUNCTION_BLOCK
VAR_GLOBAL motor : BOOL; END_VAR
PROGRAM Main
VAR
  n : DINT; list : ARRAY[0..9] OF INT; pos : INT; color : Color; low : Sub; point : Point; name : STRING;
  tank, idle : Tank; volume : INT; link : REF_TO INT; word AT D100 : WORD; ready AT CIO 0.03 : BOOL; span : TIME; r : REAL;
END_VAR
VAR CONSTANT LIMIT_ : DINT := 5; END_VAR
  n := n + 1;
  pos := pos + 1;
  motor := n > 3;
  ready := n > 6;
  color := GREEN;
  tank(level := volume);
  name := 'abc';
  IF n > 5 THEN link := REF(volume); END_IF;
  low := 3;
  point.ys[2] := 2.5;
  word := 16#FF;
  span := T#5s;
END_PROGRAM
PROGRAM Second VAR n : INT; END_VAR n := n + Twice(1); END_PROGRAM
"""
SCANS = 15


@pytest.fixture(scope="module")
def program() -> Program:
    checked = check_sources({"test.st": SOURCE}, MODELS["CJ1M-CPU63"], 1_000_000)
    assert checked.program is not None, "\n".join(map(str, checked.problems))
    return checked.program


@pytest.mark.parametrize(
    ("text", "scans"),
    [
        ("Main.n >= 4", 4),
        ("main.N >= Main.LIMIT_", 5),
        ("motor", 4),
        ("NOT motor AND Main.n > 1", 2),
        ("Second.n = 8", 4),
        ("Main.tank.level > 3", 4),
        ("Main.tank.inner > 3", 4),
        ("Main.idle.level < 3", None),
        ("Main.idle.level < 3 OR Main.n = 7", None),
        ("Main.list[Main.pos] = 0 AND Main.pos > 8", 9),
        ("Main.list[Main.pos] = 0 AND Main.pos > 9", None),
        ("Main.color = GREEN AND Main.n > 2", 3),
        ("Main.color = Color#GREEN AND Main.n > 2", 3),
        ("Main.color = Color.GREEN AND Main.n > 2", 3),
        ("Main.low + Main.n = 6", 3),
        ("SUBRANGE_ERROR(Main.low) OR Main.n = 2", 2),
        ("Main.point.ys[2] > 2.0", 1),
        ("Main.point.ys[Main.n] > 2.0", 2),
        ("Main.name = 'abc' AND LEN(CONCAT(Main.name, 'CIO 0')) = 8", 1),
        ("Main.link^ = 7", 7),
        ("Main.link <> NULL", 6),
        ("Main.link <> NULL AND_THEN motor", 6),
        ("10 / (Main.n - 3) = 5", 5),
        ("Main.n.3", 8),
        ("GT(6, Main.n, 4)", 5),
        ("SEL(motor, 1, 2) = 2", 4),
        ("TIME() >= T#5ms AND Main.span = T#5s", 6),
        ("_SubrangeErrorCount = 0", 1),
        ("INT_TO_REAL(Main.volume) > 2.5", 3),
        ("P_First_Cycle", 1),
        ("CIO 0.03", 7),
        ("CIO0.03", 7),
        ("CIO 0 = 8", 7),
        ("D100 > 5", 1),
        ("D100.%B1 = 0 AND D100.07", 1),
        ("A402.12 OR D100 >= 16#FF", 1),
        ("Main.word.8 OR Main.n\n> 5", 6),
    ],
)
def test_holds_after(program: Program, text: str, scans: int | None) -> None:
    condition = compile_condition(program, text)
    assert isinstance(condition, Condition), condition
    memory = bytearray(program.initial_image)
    engine = PairEngine(program, memory)
    engine.stop_when(condition)
    stop = engine.run(SCANS)
    assert (stop.reason, int.from_bytes(memory[16:24], "little")) == (
        (Reason.DONE, SCANS) if scans is None else (Reason.CONDITION, scans)
    )


@pytest.mark.parametrize(
    ("text", "words", "near", "column"),
    [
        ("", "There is no condition. Write one", (), 1),
        ("n > 3", "Did you mean `Second.n`?", ("Second.n",), 1),
        ("motor AND Main.nn > 3", "`Main` has no member `nn`. Did you mean `n`?", ("Main.n",), 11),
        ("Main.list[20] = 0", "Index 20 is outside of 0..9.", (), 11),
        ("Twice(Main.volume) > 3", "`Twice` is none of the standard functions", (), 1),
        ("Main.tank(level := 3)", "`Main.tank` is none of the standard functions", (), 1),
        ("LENN(Main.name) = 3", "Did you mean `LEN`", (), 1),
        ("BOOL_TO_STRING(motor) = 'TRUE'", "`BOOL_TO_STRING` is written in ST", (), 1),
        ("EN_CHECK(motor)", "a condition only looks", (), 1),
        ("Main.n", "The condition is DINT, and it must be BOOL: compare it", (), 1),
        ("D100", "The condition is WORD, and it must be BOOL: compare it", (), 1),
        ("Main.n := 3", "`:=` assigns, and a condition changes nothing. Compare with `=`.", (), 8),
        ("Main.n = = 3", "expected, found `=`", (), 10),
        ("Main.n > 3 )", "end of the condition expected, found `)`", (), 12),
        ("(Main.n > 3", "`)` expected to close the parenthesis, but the condition ends here", (), 12),
        ("Main.n > 'abc'", "`>` cannot join DINT and STRING[3].", (), 1),
        ("Main.list > 3", "`>` cannot join ARRAY[0..9] OF INT and DINT.", (), 1),
        ("Main.color = YELLOW", "There is no variable and no address `YELLOW`.", ("Main.low",), 14),
        ("Main.color = Color#YELLOW", "Color has no value `YELLOW`.", (), 14),
        ("D99999 > 1", "the last word is D32767", (), 1),
        ("%MW99999 > 2", "is outside of the area", (), 1),
        ("motor AND_THEN 10 / Main.n > 3", "a trap counts as FALSE", (), 1),
        ("Main.n > 3 " + "AND motor " * 300, f"it may have {MAX_LENGTH}", (), 1),
    ],
)
def test_refusals(program: Program, text: str, words: str, near: tuple[str, ...], column: int) -> None:
    refused = compile_condition(program, text)
    assert isinstance(refused, BadCondition)
    assert words in refused.message
    assert (refused.near, refused.column) == (near, column)
