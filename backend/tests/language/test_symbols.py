"""The outline of a file: what it declares, by sections, and the statements around a place."""

from scanbench.language.entry import Entry
from scanbench.language.symbols import entries, find
from tests.language.reading import FILE, read

PROGRAM = """\
VAR_GLOBAL CONSTANT
  limit : INT := 3;
END_VAR
NAMESPACE Line
FUNCTION_BLOCK Belt
VAR_INPUT run : BOOL; END_VAR
VAR
  speed, spare : INT;
END_VAR
METHOD Stop : BOOL
VAR n : INT; END_VAR
WHILE n > 0 DO n := n - 1; END_WHILE;
END_METHOD
ACTION Reset:
  speed := 0;
END_ACTION
IF run THEN // faster
  CASE speed OF
  1: speed := 2;
  END_CASE;
END_IF;
END_FUNCTION_BLOCK
END_NAMESPACE
TYPE
  Pair : STRUCT low, high : INT; END_STRUCT;
  Mode : (idle, busy);
END_TYPE
"""


def lines(found: list[Entry], level: int = 0) -> list[str]:
    made = []
    for each in found:
        made += [f"{' ' * level}{each.name}", *lines(list(each.inner), level + 1)]
    return made


def test_variables_are_in_their_sections_and_members_in_their_block() -> None:
    assert lines(entries(read(PROGRAM), FILE)) == [
        "VAR_GLOBAL CONSTANT", " limit",
        "Line.Belt", " VAR_INPUT", "  run", " VAR", "  speed", "  spare", " Stop", "  VAR", "   n", " Reset",
        "Pair", " low", " high", "Mode", " idle", " busy",
    ]  # fmt: skip


def test_statements_with_others_inside_are_there_where_they_are_wanted() -> None:
    reading = read(PROGRAM)
    belt = entries(reading, FILE, statements=True)[1]
    (outer,) = (each for each in belt.inner if each.kind == "statement")
    assert lines([outer]) == ["IF run", " CASE speed"]
    text = reading.text(FILE)
    assert text[outer.start : outer.end].startswith("IF run")
    assert text[outer.start : outer.end].endswith("END_IF")
    (stop,) = (each for each in belt.inner if each.name == "Stop")
    assert lines(list(stop.inner)) == ["VAR", " n", "WHILE n > 0"]


def test_sections_and_statements_are_known_while_the_text_is_broken() -> None:
    text = "PROGRAM Main\nVAR\n  n : INT;\n  m :\nEND_VAR\nIF n > \nFOR n := 1 TO\n\nEND_PROGRAM\n"
    assert lines(entries(read(text), FILE, statements=True)) == [
        "Main", " VAR", "  n", " IF n >", "  FOR n := 1 TO",
    ]  # fmt: skip


def test_global_variables_are_found_by_name_though_a_section_is_around_them() -> None:
    assert [(each.name, around) for each, around in find(read(PROGRAM), "lim")] == [("limit", "")]
    assert [each.name for each, _ in find(read(PROGRAM), "global")] == []
