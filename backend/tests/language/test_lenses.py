"""What is counted above a declaration."""

from scanbench.check.uses import Symbol
from scanbench.language.lenses import count, instances_at, lenses
from scanbench.language.reading import Reading
from tests.language.reading import FILE, at, read

TEXT = """\
TYPE Mode : (off, on) := off; END_TYPE
FUNCTION Twice : INT
VAR_INPUT value : INT; END_VAR
Twice := value * 2;
END_FUNCTION
FUNCTION_BLOCK Inc
VAR n : INT; END_VAR
METHOD PUBLIC Reset : BOOL
n := Twice(Twice(0));
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Pair
VAR left, right : Inc; END_VAR
VAR_IN_OUT other : Inc; END_VAR
left.Reset();
END_FUNCTION_BLOCK
PROGRAM Main
VAR pairs : ARRAY[0..1, 1..2] OF Pair; one : Inc; mode : Mode := Mode#on; END_VAR
one();
pairs[0, 1](other := one);
END_PROGRAM
CONFIGURATION Plant
VAR_GLOBAL spare : Inc; END_VAR
RESOURCE Plc ON CPU
TASK slow (INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM first WITH slow : Main;
PROGRAM second WITH slow : Main;
END_RESOURCE
END_CONFIGURATION
"""


def counted(reading: Reading) -> list[tuple[str, str, int | None]]:
    return [
        (each.declared.name, each.counted, count(reading, each.declared.symbol, each.counted))
        for each in lenses(reading, FILE)
    ]


def test_instances_are_those_that_run_and_references_do_not_count_the_declaration() -> None:
    reading = read(TEXT)
    assert reading.checked.program is not None, reading.checked.problems
    assert sorted(counted(reading)) == sorted([
        ("Mode", "references", 2), ("Twice", "references", 3),
        ("Inc", "instances", 2 * (4 * 2 + 1) + 1), ("Inc", "references", 4), ("Reset", "references", 1),
        ("Pair", "instances", 2 * 4), ("Pair", "references", 1), ("Main", "instances", 2),
    ])  # fmt: skip


def test_instances_are_listed_where_they_are_declared() -> None:
    reading = read(TEXT)
    position = at(reading, "Inc")
    assert [each.name for each in instances_at(reading, FILE, position)] == ["left", "right", "one", "spare"]
    assert [each.name for each in instances_at(reading, FILE, at(reading, "Pair"))] == ["pairs"]
    assert instances_at(reading, FILE, at(reading, "Twice")) == []


def test_a_program_with_errors_has_no_instances_yet() -> None:
    reading = read(TEXT.replace("one();", "one(;"))
    assert count(reading, Symbol("pou", "", "INC"), "instances") is None


def test_a_property_is_counted_once() -> None:
    text = "FUNCTION_BLOCK Tank\nVAR v : INT; END_VAR\nPROPERTY PUBLIC Level : INT\nGET\nLevel := v;\nEND_GET\nSET\nv := Level;\nEND_SET\nEND_PROPERTY\nEND_FUNCTION_BLOCK\n"
    assert [(each.declared.name, each.counted) for each in lenses(read(text), FILE)] == [
        ("Tank", "instances"), ("Tank", "references"), ("Level", "references"),
    ]  # fmt: skip
