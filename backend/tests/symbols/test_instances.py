"""The instances of a POU, by path."""

from scanbench.check.build import check_sources
from scanbench.program.program import Program
from scanbench.symbols.instances import instances_of
from tests.caseformat import MODELS

SOURCE = """
FUNCTION_BLOCK Lamp VAR n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK
FUNCTION_BLOCK Blinker EXTENDS Lamp VAR on : BOOL; END_VAR on := NOT on; END_FUNCTION_BLOCK
FUNCTION_BLOCK Belt VAR lamp : Lamp; noise : ARRAY[0..9999] OF INT; END_VAR lamp(); END_FUNCTION_BLOCK
FUNCTION_BLOCK Other VAR_IN_OUT seen : Lamp; END_VAR seen(); END_FUNCTION_BLOCK
PROGRAM Main
VAR belt : ARRAY[1..3] OF Belt; spare : Lamp; blinker : Blinker; other : Other; END_VAR
belt[1](); belt[2](); belt[3](); spare(); blinker(); other(seen := spare);
END_PROGRAM
"""


def program() -> Program:
    made = check_sources({"a.st": SOURCE}, MODELS["GENERIC-IEC"]).program
    assert made is not None
    return made


def paths(pou: str, limit: int = 1000) -> list[str]:
    return [symbol.path for symbol in instances_of(program(), pou, limit)]


def test_instances_in_order_of_declaration() -> None:
    assert paths("belt") == ["Main.belt[1]", "Main.belt[2]", "Main.belt[3]"]
    assert paths("Main") == ["Main"]


def test_inner_and_derived_instances_are_found_each_once() -> None:
    assert paths("Lamp") == [
        "Main.belt[1].lamp", "Main.belt[2].lamp", "Main.belt[3].lamp", "Main.spare", "Main.blinker",
    ]  # fmt: skip
    assert paths("Blinker") == ["Main.blinker"]


def test_a_limit_and_an_unknown_name() -> None:
    assert paths("Lamp", 2) == ["Main.belt[1].lamp", "Main.belt[2].lamp"]
    assert paths("Nothing") == []
