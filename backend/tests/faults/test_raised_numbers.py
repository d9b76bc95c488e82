"""Which numbers a program raises user errors with."""

from scanbench.check.build import check_sources
from scanbench.faults.raised_numbers import RaisedNumber, raised_numbers
from tests.runtime.bench import model

SOURCE = """\
FUNCTION_BLOCK Pump
VAR hot : BOOL; END_VAR
IF hot THEN FAL(N := 42, S := 'PUMP HOT'); END_IF;
END_FUNCTION_BLOCK
PROGRAM Main
VAR CONSTANT LEVEL : INT := 7; END_VAR
VAR pump : Pump; ok : BOOL; n : INT; k : INT; END_VAR
pump();
n := n + 1;
CASE n OF
  1: ok := n > 0 AND FAL(LEVEL + 1);
  2: FALS(16#10);
ELSE
  FAL(n);  // computed
  FAL(0);  // clears
  FAL(99999);  // raises nothing
  FOR k := 1 TO 2 DO FAL(42); END_FOR;
END_CASE;
END_PROGRAM
"""


def numbers(source: str, name: str = "CJ1M-CPU13") -> tuple[RaisedNumber, ...]:
    checked = check_sources({"main.st": source}, model(name))
    assert checked.program is not None, checked.problems
    return raised_numbers(checked.program)


def test_constant_numbers_are_found_once_each_with_their_text_and_first_call() -> None:
    assert numbers(SOURCE) == (
        RaisedNumber("fal", 8, "", "main.st", 11),
        RaisedNumber("fal", 42, "PUMP HOT", "main.st", 3),
        RaisedNumber("fals", 16, "", "main.st", 12),
    )


def test_an_instruction_with_levels_has_a_kind_of_hardware_for_each_number() -> None:
    source = "PROGRAM Main\nSetAlarm(Code := 1);\nSetAlarm(Code := 40000);\nEND_PROGRAM\n"
    assert [(each.kind, each.number) for each in numbers(source, "NJ501-1300")] == [("fal", 1), ("fal", 40000)]


def test_a_function_of_the_project_with_such_a_name_elsewhere_is_none() -> None:
    source = "FUNCTION FAL : BOOL\nVAR_INPUT N : INT; END_VAR\nFAL := N > 0;\nEND_FUNCTION\nPROGRAM Main\nFAL(3);\nEND_PROGRAM\n"
    assert numbers(source, "GENERIC-IEC") == ()
