"""Lists of global variables (.TcGVL): their variables are known with the list's name in front, and without it where one list has them."""

from scanbench.check.build import Checked, check_sources
from scanbench.check.typed.condition import BadCondition, Condition, compile_condition
from scanbench.symbols.symbols import resolve
from tests.caseformat import MODELS

LIST = (
    '<?xml version="1.0" encoding="utf-8"?><TcPlcObject Version="1.1.0.1"><GVL Name="{}" Id="{{1}}">'
    "<Declaration><![CDATA[VAR_GLOBAL\n x : INT := {}; {} : INT; END_VAR]]></Declaration></GVL></TcPlcObject>"
)
MAIN = "PROGRAM Main\nVAR a : INT; END_VAR\na := {};\nEND_PROGRAM"


def check(expression: str) -> Checked:
    sources = {
        "L.TcGVL": LIST.format("L", 1, "y"),
        "M.TcGVL": LIST.format("M", 2, "z"),
        "m.st": MAIN.format(expression),
    }
    return check_sources(sources, MODELS["GENERIC-IEC"])


def test_with_and_without_the_name_of_the_list() -> None:
    found = check("L.x + M.x + y + M.z + L.y + z")
    assert found.problems == ()
    assert found.program is not None


def test_a_name_that_two_lists_have() -> None:
    assert [each.message for each in check("x").problems] == ["`x` may be L.x or M.x; write which."]


def test_a_name_that_the_list_has_not() -> None:
    assert [each.code for each in check("L.z").problems] == ["T001"]


def test_tools_find_variables_of_lists_and_namespaces() -> None:
    program = check("y").program
    assert program is not None
    assert resolve(program, "M.x").path == "M.x"
    assert resolve(program, "m.Z").path == "z", "which one list only has"
    assert isinstance(compile_condition(program, "M.z > 1 AND M.x = 2"), Condition)
    assert isinstance(compile_condition(program, "M.y > 1"), BadCondition)
    text = "NAMESPACE Plant\nVAR_GLOBAL level : ARRAY[0..1] OF INT; END_VAR\nEND_NAMESPACE\n" + MAIN.format("1")
    program = check_sources({"m.st": text}, MODELS["GENERIC-IEC"]).program
    assert program is not None
    assert resolve(program, "plant.level[1]").path == "Plant.level[1]"
