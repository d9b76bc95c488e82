"""What is shown of a halted program: frames, scopes, what is below, expressions."""

import pytest

from scanbench.check.typed.condition import BadCondition
from scanbench.debug.evaluate import evaluate
from scanbench.debug.frames import stack
from scanbench.debug.message import LONGEST, Message
from scanbench.debug.scene import NoFrame, Scene
from scanbench.debug.scopes import scopes, variables
from scanbench.debug.shown import VariableInfo
from scanbench.engines.interpreter.evaluate import NoValue
from scanbench.program.program import Program
from tests.debug.scenes import checked, halted

SOURCE = """TYPE Color : (RED, GREEN); Pt : STRUCT x, y : INT; c : Color := GREEN; END_STRUCT; END_TYPE
VAR_GLOBAL g : INT := 5; located AT %MW9 : INT; END_VAR
FUNCTION total : DINT VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR VAR i : DINT; word : STRING := 'hi'; END_VAR
  FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO
    total := total + a[i];
  END_FOR;
END_FUNCTION
FUNCTION_BLOCK Base VAR_OUTPUT n : INT; END_VAR
  METHOD bump : INT VAR_INPUT by : INT; END_VAR VAR n : INT := 1; END_VAR
    THIS.n := THIS.n + by;
    bump := n;
  END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Counter EXTENDS Base
  VAR_INPUT on : BOOL := TRUE; END_VAR
  VAR_IN_OUT io : INT; flag : BOOL; END_VAR
  VAR pts : ARRAY[1..3] OF Pt; r : REF_TO INT; none : REF_TO INT; q : REFERENCE TO INT; span : TIME := T#1500ms;
    grid : ARRAY[0..1, 1..2] OF INT; many : ARRAY[1..3000] OF BYTE; END_VAR
  VAR CONSTANT most : INT := 3; END_VAR
  VAR_TEMP t : INT := 4; END_VAR
  t := t + 1;
  r := REF(pts[2].x); q REF= io; grid[1, 2] := 7;
  io := io + 1;
  bump(2);
END_FUNCTION_BLOCK
PROGRAM Main
  VAR c : ARRAY[0..1] OF Counter; list : ARRAY[2..5] OF INT := [1, 2, 3, 4]; sum : DINT; mw AT %MW3 : INT; END_VAR
  VAR bits AT %MX0.5 : BOOL; END_VAR
  bits := TRUE;
  c[1](io := mw, flag := bits);
  sum := total(list);
END_PROGRAM
"""
IN_METHOD, IN_BLOCK, IN_FUNCTION = 11, 24, 5


@pytest.fixture(scope="module")
def program() -> Program:
    return checked(SOURCE)


@pytest.fixture(scope="module")
def method(program: Program) -> Scene:
    return halted(program, IN_METHOD)


@pytest.fixture(scope="module")
def function(program: Program) -> Scene:
    return halted(program, IN_FUNCTION, 2)


def of_scope(scene: Scene, frame: int | None, scope: str) -> dict[str, VariableInfo]:
    return {each.name: each for each in variables(scene, frame, scope, "")[0]}


def below(scene: Scene, frame: int | None, expression: str, start: int = 0, count: int = 0) -> list[VariableInfo]:
    return list(variables(scene, frame, "", expression, start, count)[0])


def one(scene: Scene, frame: int | None, text: str) -> VariableInfo:
    found = evaluate(scene, frame, text)
    assert isinstance(found, VariableInfo), found
    return found


# ---- the call stack -----------------------------------------------------------------------------------------------


def test_frames_are_named_by_instance_method_and_function(method: Scene, function: Scene) -> None:
    found = stack(method)
    assert [(each.index, each.name) for each in found] == [
        (0, "Main.c[1].bump (Base)"), (1, "Main.c[1] (Counter)"), (2, "Main"),
    ]  # fmt: skip
    assert [(each.line, each.column, each.end_line) for each in found] == [(11, 5, 11), (24, 3, 24), (30, 3, 30)]
    assert {(each.file, each.task) for each in found} == {("a.st", "Main")}
    assert [each.instance for each in found] == ["Main.c[1]", "Main.c[1]", "Main"]
    assert [(each.name, each.pou, each.instance) for each in stack(function)] == [
        ("total", "total", ""), ("Main", "Main", "Main"),
    ]  # fmt: skip


def test_tasks_and_instances_of_a_configuration() -> None:
    program = checked("""PROGRAM Slow VAR_INPUT start : INT; END_VAR VAR n : INT; END_VAR
  n := n + start;
END_PROGRAM
CONFIGURATION Plant
  VAR_GLOBAL from : INT := 3; END_VAR
  RESOURCE Cpu ON PLC
    TASK fast (INTERVAL := T#10ms, PRIORITY := 1); TASK slow (INTERVAL := T#20ms, PRIORITY := 2);
    PROGRAM a WITH fast : Slow;
    PROGRAM b WITH slow : Slow (start := from);
  END_RESOURCE
END_CONFIGURATION
""")
    first, second = stack(halted(program, 2)), stack(halted(program, 2, 2))
    assert [(each.instance, each.task) for each in (*first, *second)] == [("a", "fast"), ("b", "slow")]
    connection = stack(halted(program, 9))
    assert [(each.instance, each.line) for each in connection] == [("b", 9)]


# ---- scopes ---------------------------------------------------------------------------------------------------------


def test_sections_in_order(method: Scene, function: Scene) -> None:
    assert [each.name for each in scopes(method, 0)] == ["VAR_INPUT", "VAR", "RESULT", "THIS", "GLOBAL"]
    assert [(each.name, each.count) for each in scopes(method, 1)] == [
        ("VAR_INPUT", 1), ("VAR_OUTPUT", 1), ("VAR_IN_OUT", 2), ("VAR", 8), ("VAR_TEMP", 1), ("GLOBAL", 2),
    ]  # fmt: skip
    assert [each.name for each in scopes(function, 0)] == ["VAR_IN_OUT", "VAR", "RESULT", "GLOBAL"]
    assert [each.name for each in scopes(Scene(function.program, function.memory, function.sites), None)] == ["GLOBAL"]


def test_variables_of_a_block(method: Scene) -> None:
    inputs, inner = of_scope(method, 1, "VAR_INPUT"), of_scope(method, 1, "VAR")
    assert inputs["on"].value == "TRUE"
    assert inputs["on"].path == "Main.c[1].on"
    assert (inner["pts"].value, inner["pts"].children, inner["pts"].indexed) == ("(3 elements)", 3, True)
    assert (inner["span"].value, inner["span"].type) == ("T#1s500ms", "TIME")
    assert (inner["r"].value, inner["r"].children) == ("-> Main.c[1].pts[2].x", 1)
    assert (inner["none"].value, inner["none"].children) == ("NULL", 0)
    assert (inner["q"].value, inner["q"].alias) == ("1", "-> Main.mw (%MW3)")
    assert (inner["most"].value, inner["most"].writable) == ("3", False)
    temporary = of_scope(method, 1, "VAR_TEMP")["t"]
    assert (temporary.value, temporary.path, temporary.writable) == ("5", "", True)


def test_in_outs_say_what_they_are_bound_to(method: Scene, function: Scene) -> None:
    found = of_scope(method, 1, "VAR_IN_OUT")
    assert (found["io"].value, found["io"].alias, found["io"].address) == ("1", "-> Main.mw (%MW3)", "%MW3")
    assert (found["flag"].value, found["flag"].alias) == ("TRUE", "-> Main.bits (%MX0.5)")
    array = of_scope(function, 0, "VAR_IN_OUT")["a"]
    assert (array.value, array.alias, array.path) == ("(4 elements)", "-> Main.list", "Main.list")


def test_a_block_that_was_never_called_is_not_connected(program: Program) -> None:
    scene = halted(program, 29)
    found = {each.name: each for each in below(scene, 0, "c[1]")}
    assert (found["io"].value, found["io"].alias, found["io"].writable) == ("not connected", "", False)


def test_a_method_sees_its_own_before_those_of_the_instance(method: Scene) -> None:
    own, this = of_scope(method, 0, "VAR")["n"], of_scope(method, 0, "THIS")["n"]
    assert (own.value, own.expression, own.path) == ("1", "n", "")
    assert (this.value, this.expression, this.path) == ("2", "THIS.n", "Main.c[1].n")
    assert one(method, 0, this.expression).value == "2"


def test_globals_with_their_addresses(method: Scene) -> None:
    found = of_scope(method, 0, "GLOBAL")
    assert (found["g"].value, found["located"].address) == ("5", "%MW9")


# ---- below ----------------------------------------------------------------------------------------------------------


def test_every_expression_that_is_shown_gives_its_variable(method: Scene, function: Scene) -> None:
    def walk(scene: Scene, frame: int, infos: list[VariableInfo], depth: int) -> int:
        seen = 0
        for each in infos:
            if each.value == "not connected":
                assert isinstance(evaluate(scene, frame, each.expression), BadCondition)
                continue
            again = one(scene, frame, each.expression)
            assert (again.value, again.type) == (each.value, each.type), each
            assert again.path == each.path or not again.path or not each.path or "^" in each.path, each
            seen += 1
            if each.children and depth:
                seen += walk(scene, frame, below(scene, frame, each.expression, count=5), depth - 1)
        return seen

    for scene in (method, function):
        for frame in range(len(scene.frames)):
            for scope in scopes(scene, frame):
                found = list(variables(scene, frame, scope.name, "")[0])
                assert len(found) == scope.count
                assert walk(scene, frame, found, 3) >= len(found)


def test_arrays_are_paged(method: Scene) -> None:
    page = below(method, 1, "many", 2990, 5)
    assert [each.name for each in page] == ["[2991]", "[2992]", "[2993]", "[2994]", "[2995]"]
    assert variables(method, 1, "", "many", 0, 2)[1] == 3000
    assert len(below(method, 1, "many")) == 1000
    assert len(below(method, 1, "many", 2999, 50)) == 1
    assert [(each.name, each.value) for each in below(method, 1, "grid")] == [
        ("[0,1]", "0"), ("[0,2]", "0"), ("[1,1]", "0"), ("[1,2]", "7"),
    ]  # fmt: skip


def test_members_elements_and_what_references_refer_to(method: Scene, function: Scene) -> None:
    assert [(each.expression, each.value) for each in below(method, 1, "pts[2]")] == [
        ("pts[2].x", "0"), ("pts[2].y", "0"), ("pts[2].c", "GREEN"),
    ]  # fmt: skip
    assert [(each.expression, each.path) for each in below(method, 1, "r")] == [("r^", "Main.c[1].r^")]
    assert next(each.path for each in below(method, 2, "c[1]")) == "Main.c[1].n"
    assert next((each.expression, each.value, each.path) for each in below(function, 0, "a")) == (
        "a[2]", "1", "Main.list[2]",
    )  # fmt: skip
    assert below(method, 1, "t") == []
    with pytest.raises(NoValue, match="lost"):
        below(method, 1, "lost")
    with pytest.raises(NoFrame, match="no frame 7"):
        scopes(method, 7)
    with pytest.raises(NoFrame, match="VAR_NONE"):
        variables(method, 0, "VAR_NONE", "")


# ---- expressions ----------------------------------------------------------------------------------------------------


def test_expressions(method: Scene, function: Scene) -> None:
    place = one(method, 1, "pts[io + 1].x")
    assert (place.value, place.path, place.writable) == ("0", "Main.c[1].pts[2].x", True)
    value = one(method, 1, "io * 2 > t")
    assert (value.value, value.type, value.expression, value.writable) == ("FALSE", "BOOL", "", False)
    assert one(method, 1, "this").value == "(12 members)"
    assert one(function, 0, "a[i] + total").value == "3"
    assert one(function, 0, "total(a)").value == "10", "on a copy, though it is this call that is open"
    assert one(function, 0, "total").value == "1"
    assert one(method, None, "Main.c[1].pts[2]").children == 3
    assert one(method, None, "%MW3").value == "16#0001"
    bad = evaluate(method, 1, "pts[io + 9].x")
    assert isinstance(bad, BadCondition)
    assert "1..3" in bad.message


def test_nothing_can_be_written_in_the_past(method: Scene) -> None:
    past = Scene(method.program, method.memory, method.sites, method.frames, past=True)
    assert one(method, 1, "t").writable
    assert not one(past, 1, "t").writable


# ---- messages -------------------------------------------------------------------------------------------------------


def said(scene: Scene, frame: int, text: str) -> str:
    made = Message.of(scene.locals, scene.frames[frame].pou, text)
    assert isinstance(made, Message), made
    return made.text(scene.evaluator, scene.frames[frame].instance)


def test_messages(method: Scene) -> None:
    assert said(method, 1, "io is {io} in {Main.c[1].pts[2].c}, {{t}} = {t + 1}") == "io is 1 in GREEN, {t} = 6"
    assert said(method, 1, "plain") == "plain"
    assert "refers to nothing" in said(method, 1, "{none^}")
    assert len(said(method, 1, "{t}" * 5000)) == LONGEST


@pytest.mark.parametrize(
    ("text", "message", "column"), [("n {lost}", "`lost`", 4), ("n {io", "is alone", 1), ("}", "is alone", 1)]
)
def test_wrong_messages(method: Scene, text: str, message: str, column: int) -> None:
    bad = Message.of(method.locals, method.frames[1].pou, text)
    assert isinstance(bad, BadCondition)
    assert message in bad.message
    assert bad.column == column


# ---- in-outs by value ------------------------------------------------------------------------------------------------


def test_an_in_out_by_value_shows_the_copy_and_what_was_passed() -> None:
    program = checked("""{in_out 'value'}
FUNCTION_BLOCK Inner VAR_IN_OUT level : INT; END_VAR
  level := level + 1;
  level := level + 1;
END_FUNCTION_BLOCK
{in_out 'value'}
FUNCTION_BLOCK Outer VAR_IN_OUT io : INT; END_VAR VAR inner : Inner; END_VAR
  inner(level := io);
END_FUNCTION_BLOCK
PROGRAM Main VAR o : Outer; tank : ARRAY[1..3] OF INT := [10, 20, 30]; END_VAR
  o(io := tank[2]);
END_PROGRAM
""")
    scene = halted(program, 4)
    level = of_scope(scene, 0, "VAR_IN_OUT")["level"]
    assert (level.value, level.alias, level.path) == ("21", "-> Main.tank[2]", "Main.o.inner.level")
    outer = of_scope(scene, 1, "VAR_IN_OUT")["io"]
    assert (outer.value, outer.alias) == ("20", "-> Main.tank[2]")
    assert one(scene, 0, "level").value == "21"
    assert one(scene, 2, "tank[2]").value == "20"
