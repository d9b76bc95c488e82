"""Giving variables of a frame other values: which command, which bytes, and what is refused."""

import pytest

from scanbench.check.typed.condition import BadCondition
from scanbench.debug.assign import Assign
from scanbench.debug.evaluate import evaluate
from scanbench.debug.scene import Scene
from scanbench.debug.set_value import SetLocal, set_value
from scanbench.debug.shown import VariableInfo
from scanbench.program.program import Program
from scanbench.runtime.command import Command, Plan, Refusal, View
from scanbench.runtime.write import Write
from scanbench.wire.codec import pack_body, unpack
from tests.debug.scenes import checked, halted

SOURCE = """TYPE Color : (RED, GREEN); Small : INT(0..10); END_TYPE
FUNCTION twice : INT VAR_INPUT x : INT; END_VAR
  twice := x * 2;
END_FUNCTION
FUNCTION_BLOCK Counter
  VAR_IN_OUT io : INT; END_VAR
  VAR n : INT; text : STRING[5] := 'ab'; color : Color; small : Small; list : ARRAY[1..3] OF INT; END_VAR
  VAR CONSTANT most : INT := 3; END_VAR
  VAR_TEMP t : INT := 4; END_VAR
  t := t + 1;
  io := twice(io + t);
  n := n + 1;
END_FUNCTION_BLOCK
PROGRAM Main
  VAR c : Counter; one : REF_TO INT; ptr : POINTER TO INT; seat : DWORD; mw AT %MW3 : INT; flag AT %MX0.5 : BOOL; END_VAR
  c(io := mw);
  flag := flag;
END_PROGRAM
"""


@pytest.fixture(scope="module")
def program() -> Program:
    return checked(SOURCE)


@pytest.fixture
def scene(program: Program) -> Scene:
    return halted(program, 12)


def planned(scene: Scene, command: Command) -> Plan | Refusal:
    return command.plan(View(scene.program, scene.memory))


def entered(scene: Scene, frame: int | None, target: str, value: str) -> Command:
    """Sets it, and does to the image what the plan says."""
    command = set_value(scene, frame, target, value, "Ann")
    assert isinstance(command, Command), command
    apply(scene, command)
    return command


def apply(scene: Scene, command: Command) -> None:
    plan = planned(scene, command)
    assert isinstance(plan, Plan), plan
    for patch in plan.patches:
        for at, (mask, data) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
            scene.memory[at] = scene.memory[at] & ~mask | data & mask


def worth(scene: Scene, frame: int | None, text: str) -> str:
    found = evaluate(scene, frame, text)
    assert isinstance(found, VariableInfo), found
    return found.value


@pytest.mark.parametrize(
    ("target", "value", "kind", "shown"),
    [
        ("n", "3", Write, "3"),
        ("n", "16#1F", Write, "31"),
        ("io", "12", Write, "12"),
        ("THIS.n", "5", Write, "5"),
        ("list[n + 1]", "8", Write, "8"),
        ("text", "'xyz'", Write, "'xyz'"),
        ("color", "GREEN", Write, "GREEN"),
        ("small", "10", Write, "10"),
        ("Main.mw", "7", Write, "7"),
        ("t", "7", SetLocal, "7"),
        ("t", "t + 5", Assign, "10"),
        ("n", "twice(4) + t", Assign, "13"),
        ("t.0", "FALSE", SetLocal, "FALSE"),
    ],
)
def test_set(scene: Scene, target: str, value: str, kind: type, shown: str) -> None:
    command = entered(scene, 0, target, value)
    assert isinstance(command, kind)
    assert command.author == "Ann"
    assert worth(scene, 0, target) == shown


def test_a_set_changes_nothing_else(scene: Scene) -> None:
    before = bytes(scene.memory)
    entered(scene, 0, "t", "twice(3)")
    changed = [at for at, (old, new) in enumerate(zip(before, scene.memory, strict=True)) if old != new]
    pou = scene.frames[0].pou
    place = pou.frame_offset + pou.frame.members["T"].offset
    assert set(changed) <= {place, place + 1}, "frames of functions that it called stay as they were"
    assert changed


def test_a_variable_of_a_function(program: Program) -> None:
    scene = halted(program, 3)
    assert isinstance(entered(scene, 0, "x", "21"), SetLocal)
    assert worth(scene, 0, "x") == "21"


def test_a_bit(scene: Scene) -> None:
    byte = evaluate(scene, None, "%MB0")
    entered(scene, 1, "flag", "TRUE")
    assert worth(scene, 1, "flag") == "TRUE"
    assert isinstance(byte, VariableInfo)
    assert worth(scene, None, "%MB0") == "16#20"


@pytest.mark.parametrize(
    ("target", "value", "message"),
    [
        ("n", "TRUE", "n: `TRUE` is not INT; write an integer from -32768 to 32767"),
        ("n", "99999", "n: 99999 is outside of INT (-32768 to 32767)"),
        ("small", "11", "small: 11 is outside of 0..10 (Small)"),
        ("small", "n + 20", "small: 20 is outside of 0..10 (Small)"),
        ("color", "BLUE", "color: `BLUE` is not Color; write RED, GREEN"),
        ("text", "'too long'", "STRING[5]"),
        ("most", "1", "CONSTANT"),
        ("list", "1", "no single value"),
        ("list[4]", "1", "1..3"),
        ("lost", "1", "`lost`"),
        ("n + 1", "1", "variable"),
        ("Main.one", "1234", "a reference would be any place in memory"),
        ("Main.ptr", "16#1234", "a reference would be any place in memory"),
        ("Main.ptr", "n + 16", "POINTER TO INT"),
        ("Main.ptr", "Main.seat", "POINTER TO INT"),
    ],
)
def test_refused(scene: Scene, target: str, value: str, message: str) -> None:
    bad = set_value(scene, 0, target, value, "Ann")
    assert isinstance(bad, BadCondition)
    assert message in bad.message


def test_a_frame_that_is_not_there(scene: Scene) -> None:
    bad = set_value(scene, 9, "n", "1", "Ann")
    assert isinstance(bad, BadCondition)
    assert "no frame 9" in bad.message


# ---- execution points -----------------------------------------------------------------------------------------------


def assign(scene: Scene, text: str, frame: int = 0) -> Assign:
    return Assign("Ann", scene.frames[frame].pou.name, scene.frames[frame].instance, text)


def test_assignments_one_after_the_other(scene: Scene) -> None:
    command = assign(scene, "n := 40; t := n + 2; io := t; list[3] := twice(t);")
    plan = planned(scene, command)
    assert isinstance(plan, Plan)
    assert "Main.c.n := 40" in plan.message
    assert len(plan.patches) == 4
    apply(scene, command)
    assert [worth(scene, 0, each) for each in ("n", "t", "io", "list[3]", "Main.mw")] == ["40", "42", "42", "84", "42"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("lost := 1", "`lost`"),
        ("small := n + 20", "outside of 0..10"),
        ("list[n + 9] := 1", "1..3"),
        ("most := 1", "CONSTANT"),
    ],
)
def test_assignments_that_cannot_be(scene: Scene, text: str, message: str) -> None:
    refusal = planned(scene, assign(scene, text))
    assert isinstance(refusal, Refusal)
    assert message in refusal.message


def test_a_pou_that_is_gone(scene: Scene) -> None:
    refusal = planned(scene, Assign("Ann", "Gone", 0, "n := 1"))
    assert isinstance(refusal, Refusal)
    assert "Gone" in refusal.message


def test_a_latch_only_where_it_holds(scene: Scene) -> None:
    plan = planned(scene, assign(scene, "flag S= FALSE; flag R= FALSE", 1))
    assert isinstance(plan, Plan)
    assert plan.patches == ()
    apply(scene, assign(scene, "flag R= FALSE; flag S= mw > 0", 1))
    assert worth(scene, 1, "flag") == "TRUE"


def test_both_are_kept_in_run_files(scene: Scene) -> None:
    for command in (assign(scene, "n := 1"), SetLocal("Ann", "Counter", 4, "t", "7")):
        assert unpack(pack_body(command)) == command
