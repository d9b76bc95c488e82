"""Texts in the scope of a POU: names, calls, assignments, and what is refused with which words."""

import pytest

from scanbench.check.typed.condition import BadCondition
from scanbench.check.typed.local import Local, Locals, locals_of
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.engines.interpreter.evaluate import Evaluator, NoValue
from scanbench.program.program import Pou, Program
from tests.debug.scenes import checked

SOURCE = """
TYPE Color : (RED, GREEN); Small : INT(0..10); END_TYPE
VAR_GLOBAL factor : INT := 5; hidden : INT := 7; END_VAR
FUNCTION twice : INT VAR_INPUT x : INT; END_VAR
twice := x * 2;
END_FUNCTION
FUNCTION_BLOCK Base VAR_OUTPUT n : INT; END_VAR VAR own : INT := 9; END_VAR
METHOD bump : INT VAR_INPUT by : INT; n : INT; END_VAR
THIS.n := THIS.n + by; bump := THIS.n + n;
END_METHOD
n := n + 0;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Counter EXTENDS Base
VAR_IN_OUT io : INT; END_VAR
VAR list : ARRAY[1..3] OF INT := [11, 22, 33]; pos : INT := 2; color : Color := GREEN; small : Small; on : BOOL;
  nothing : REF_TO INT; hidden : INT := 3; text : STRING := 'ab'; END_VAR
VAR CONSTANT most : INT := 4; END_VAR
VAR_TEMP t : INT := 4; END_VAR
t := t + 1; io := twice(io + t); bump(2, 1);
END_FUNCTION_BLOCK
PROGRAM Main VAR c : Counter; v : INT; END_VAR
c(io := v);
END_PROGRAM
"""


@pytest.fixture(scope="module")
def program() -> Program:
    return checked(SOURCE)


@pytest.fixture(scope="module")
def ran(program: Program) -> Evaluator:
    """An image after one scan."""
    memory = bytearray(program.initial_image)
    debug_engine(program, memory).run(1)
    return Evaluator(program, memory)


def pou_of(program: Program, name: str) -> Pou | None:
    return next(each for each in program.pous if each.name == name) if name else None


def instance_of(program: Program, name: str) -> int:
    return program.shown[0].offset if name in ("Main", "Counter", "Base", "Base.bump") else 0


@pytest.mark.parametrize(
    ("pou", "text", "wanted"),
    [
        ("Counter", "t", "5"),
        ("Counter", "io", "10"),
        ("Counter", "n", "2"),
        ("Counter", "own + factor", "14"),
        ("Counter", "hidden", "3"),
        ("Counter", "THIS.hidden", "3"),
        ("Counter", "list[pos]", "22"),
        ("Counter", "LIST[POS + 1] / 2", "16"),
        ("Counter", "color", "GREEN"),
        ("Counter", "color = RED", "FALSE"),
        ("Counter", "Color#RED", "RED"),
        ("Counter", "twice(list[3])", "66"),
        ("Counter", "text", "'ab'"),
        ("Counter", "LEN(text)", "2"),
        ("Counter", "Main.v", "10"),
        ("Counter", "most * 2", "8"),
        ("Counter", "pos.1", "TRUE"),
        ("Base.bump", "n", "1"),
        ("Base.bump", "THIS.n", "2"),
        ("Base.bump", "by", "2"),
        ("Base.bump", "bump", "3"),
        ("Base.bump", "own", "9"),
        ("twice", "x", "5"),
        ("twice", "twice", "10"),
        ("twice", "twice(1)", "2"),
        ("Main", "v", "10"),
        ("Main", "c.n", "2"),
        ("", "Main.c.n", "2"),
        ("", "hidden", "7"),
        ("", "%MW3", "16#0000"),
    ],
)
def test_worth(program: Program, ran: Evaluator, pou: str, text: str, wanted: str) -> None:
    local = Locals(program).value(pou_of(program, pou), text)
    assert isinstance(local, Local), local
    before = bytes(ran.memory)
    if pou == "twice" and "(" not in text:  # the frame holds what the last call left
        wanted = {"x": "5", "twice": "10"}[text]
    assert ran.text(local, instance_of(program, pou)) == wanted
    assert ran.memory == before, "it changes nothing"


@pytest.mark.parametrize(
    ("pou", "text", "message"),
    [
        ("Counter", "lost", "`lost`"),
        ("Counter", "lis", "Did you mean `list`?"),
        ("Main", "own", "`own`"),
        ("", "t", "`t`"),
        ("Counter", "bump(1, 2)", "Function blocks and methods are not run"),
        ("Counter", "twise(1)", "Did you mean `twice`"),
        ("Counter", "twice(TRUE)", "INT"),
        ("Counter", "list[9]", "outside of 1..3"),
        ("Counter", "", "There is no expression"),
        ("Counter", "1 +", "expected"),
        ("Counter", "n := 1", "an expression changes nothing"),
        ("Counter", "x" * 2001, "2001 characters"),
        ("twice", "THIS.n", "THIS"),
    ],
)
def test_refused(program: Program, pou: str, text: str, message: str) -> None:
    bad = Locals(program).value(pou_of(program, pou), text)
    assert isinstance(bad, BadCondition)
    assert message in bad.message


@pytest.mark.parametrize(
    ("text", "reason"),
    [("nothing^", "refers to nothing"), ("list[pos + 5]", "outside of 1..3"), ("pos / (n - 2)", "zero")],
)
def test_without_a_value_says_why(program: Program, ran: Evaluator, text: str, reason: str) -> None:
    local = Locals(program).value(pou_of(program, "Counter"), text)
    assert isinstance(local, Local)
    with pytest.raises(NoValue, match=reason):
        ran.value(local, instance_of(program, "Counter"))
    condition = Locals(program).condition(pou_of(program, "Counter"), f"{text} = 0")
    assert isinstance(condition, Local)
    assert not ran.condition(condition)(instance_of(program, "Counter"))


def test_a_condition_is_bool_and_may_call(program: Program, ran: Evaluator) -> None:
    locals = Locals(program)
    bad = locals.condition(pou_of(program, "Counter"), "n")
    assert isinstance(bad, BadCondition)
    assert "must be BOOL" in bad.message
    good = locals.condition(pou_of(program, "Counter"), "twice(n) = 4 AND NOT on")
    assert isinstance(good, Local)
    assert ran.condition(good)(instance_of(program, "Counter"))


def stored(program: Program, ran: Evaluator, text: str) -> list[bytes]:
    local = Locals(program).assignments(pou_of(program, "Counter"), text)
    assert not isinstance(local, BadCondition), local
    return [data for _, _, data in ran.assigned(local, instance_of(program, "Counter"))]


def test_assignments_see_those_before(program: Program, ran: Evaluator) -> None:
    assert stored(program, ran, "n := n + 100; t := twice(n); io := t") == [b"\x66\0", b"\xcc\0", b"\xcc\0"]
    assert stored(program, ran, "on S= n > 1; on R= n > 1; on S= n > 50;") == [b"\1", b"\0"]
    assert stored(program, ran, "list[pos] := 1; color := RED;") == [b"\1\0", b"\0\0"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("n := TRUE", "INT"),
        ("n := 70000", "does not fit INT"),
        ("n = 3", "`=` compares"),
        ("bump(1, 2)", "Only assignments"),
        ("IF on THEN n := 1; END_IF", "Only assignments"),
        ("most := 1", "CONSTANT"),
        ("small := 11", "outside of"),
        ("n := 1; lost := 2", "`lost`"),
        ("", "There is no assignment"),
    ],
)
def test_wrong_assignments(program: Program, text: str, message: str) -> None:
    bad = Locals(program).assignments(pou_of(program, "Counter"), text)
    assert isinstance(bad, BadCondition)
    assert message in bad.message


def test_a_subrange_is_kept(program: Program, ran: Evaluator) -> None:
    local = Locals(program).assignments(pou_of(program, "Counter"), "small := n + 9")
    assert not isinstance(local, BadCondition)
    with pytest.raises(NoValue, match=r"small: 11 is outside of 0\.\.10"):
        ran.assigned(local, instance_of(program, "Counter"))


def test_made_once_for_a_program(program: Program) -> None:
    assert locals_of(program) is locals_of(program)
    assert locals_of(checked("PROGRAM Main VAR a : INT; END_VAR a := 1; END_PROGRAM")) is not locals_of(program)


def test_a_function_that_does_not_come_to_an_end_is_given_up() -> None:
    """Whoever looks at it must not hold up the PLC, however long the program itself may take."""
    program = checked(
        "FUNCTION forever : INT VAR_INPUT x : INT; END_VAR WHILE x > 0 DO forever := forever + 1; END_WHILE; END_FUNCTION\n"
        "PROGRAM Main VAR v : INT; END_VAR v := forever(0); END_PROGRAM"
    )
    evaluator = Evaluator(program, bytearray(program.initial_image))
    endless = locals_of(program).value(None, "forever(9)")
    assert isinstance(endless, Local)
    with pytest.raises(NoValue, match="does not end"):
        evaluator.value(endless, 0)
    held = locals_of(program).condition(None, "forever(9) = 0")
    assert isinstance(held, Local)
    assert not evaluator.condition(held)(0)
    ends = locals_of(program).value(None, "forever(0)")
    assert isinstance(ends, Local)
    assert evaluator.text(ends, 0) == "0"


def test_what_the_program_notes_is_seen_and_not_written() -> None:
    """`SUBRANGE_ERROR` knows what the program wrote; an assignment of a tool stores the variable alone."""
    source = SOURCE.replace(
        "t := t + 1;", "t := t + 1; small := 50 + n; text[2] := 'x'; on := SUBRANGE_ERROR(small) OR too_large(n);"
    )
    source = source.replace(
        "PROGRAM Main",
        "FUNCTION too_large : BOOL VAR_INPUT small : Small; END_VAR\ntoo_large := SUBRANGE_ERROR(small);\nEND_FUNCTION PROGRAM Main",
    )
    program = checked(source)
    memory = bytearray(program.initial_image)
    debug_engine(program, memory).run(1)
    ran, pou = Evaluator(program, memory), pou_of(program, "Counter")
    texts = ("small", "SUBRANGE_ERROR(small)", "too_large(n + 20)", "too_large(n)", "too_large(twice(30))", "text[2]")
    found = [Locals(program).value(pou, text) for text in texts]
    values = [ran.text(each, instance_of(program, "Counter")) for each in found if isinstance(each, Local)]
    assert values == ["10", "TRUE", "TRUE", "FALSE", "TRUE", "'x'"]
    before = bytes(memory)
    assert stored(program, ran, "small := n + 3; text[1] := 'y'") == [b"\5\0", b"y"]
    assert bytes(memory) == before
