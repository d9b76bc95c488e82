"""TYPE declarations and the types of variables."""

import pytest

from tests.syntax.shown import complaints, show, well

TYPES = [
    ("INT", "INT"),
    ("Motion.Axis", "Motion.Axis"),
    ("STRING", "String()"),
    ("STRING[20]", "String(length=20)"),
    ("WSTRING(N + 1)", "String(length=(N + 1), wide=True)"),
    ("ARRAY[1..3, N..2*N] OF ARRAY[0..1] OF BOOL", "Array(ranges=[[1, 3], [N, (2 * N)]], element=Array(ranges=[[0, 1]], element=BOOL))"),
    ("(RED, GREEN := 5)", "Enum(values=[[RED, None], [GREEN, 5]])"),
    ("(RED, GREEN) UDINT", "Enum(values=[[RED, None], [GREEN, None]], base=UDINT)"),
    ("DINT (RED := 1, GREEN)", "Enum(values=[[RED, 1], [GREEN, None]], base=DINT)"),
    ("INT (-6..12)", "Subrange(base=INT, low=neg(6), high=12)"),
    ("MyInt (A.LOW .. f(3))", "Subrange(base=MyInt, low=A.LOW, high=Call(callee=f, arguments=[Argument(value=3)]))"),
    ("REF_TO Axis", "Reference(target=Axis)"),
    ("POINTER TO ARRAY[0..1] OF INT", "Reference(target=Array(ranges=[[0, 1]], element=INT), pointer=True)"),
    ("REFERENCE TO REF_TO INT", "Reference(target=Reference(target=INT), automatic=True)"),
    ("reference", "reference"),
    ("STRUCT a, b : INT := 1; c AT %B4 : BOOL; END_STRUCT", "Struct(members=[Variable(name=a, type=INT, initial=1), Variable(name=b, type=INT, initial=1), Variable(name=c, type=BOOL, address=%B4)])"),
    ("STRUCT OVERLAP a AT %X0.1 : BOOL; END_STRUCT", "Struct(members=[Variable(name=a, type=BOOL, address=%X0.1)], overlap=True)"),
    ("STRUCT overlap : BOOL; END_STRUCT", "Struct(members=[Variable(name=overlap, type=BOOL)])"),
    ("UNION a : DWORD; b : REAL; END_UNION", "Struct(members=[Variable(name=a, type=DWORD), Variable(name=b, type=REAL)], union=True)"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "shown"), TYPES)
def test_type_of_a_variable(text: str, shown: str) -> None:
    file = well(f"PROGRAM p\nVAR x : {text}; y : BOOL; END_VAR\nEND_PROGRAM")
    x, y = file.pous[0].sections[0].variables
    assert (show(x.type), y.name) == (shown, "y")


@pytest.mark.parametrize(("text", "shown"), TYPES)
def test_declared_type(text: str, shown: str) -> None:
    file = well(f"TYPE First : {text}; Second : BOOL := TRUE; END_TYPE")
    assert [show(each.type) for each in file.types] == [shown, "BOOL"]


def test_open_arrays() -> None:
    file = well("FUNCTION f\nVAR_IN_OUT a : ARRAY[*, *] OF INT; END_VAR\nEND_FUNCTION")
    assert show(file.pous[0].sections[0].variables[0].type) == "OpenArray(dimensions=2, element=INT)"
    assert complaints("FUNCTION f\nVAR_IN_OUT a : ARRAY[*, 1..2] OF INT; END_VAR\nEND_FUNCTION") == [
        "S003 2:16 The bounds of an array are all given, or all `*`."
    ]


def test_types_of_vendors() -> None:
    file = well(
        "{attribute 'qualified_only'}\n{attribute 'strict'}\nTYPE Color : (RED, GREEN) INT := GREEN; END_TYPE\n"
        "TYPE\n  Plain : (A, B);\n  {attribute := 'qualified_only'} Own : MyBase (C, D);\nEND_TYPE\n"
        "TYPE Wide EXTENDS Lib.Narrow : STRUCT x : INT; END_STRUCT END_TYPE\n"
    )
    assert [(each.name, "qualified_only" in each.attributes) for each in file.types] == [
        ("Color", True), ("Plain", False), ("Own", True), ("Wide", False),
    ]  # fmt: skip
    assert show(file.types[0].initial) == "GREEN"
    assert show(file.types[2].type) == "Enum(values=[[C, None], [D, None]], base=MyBase)"
    assert show(file.types[3].type) == "Struct(members=[Variable(name=x, type=INT)], extends=Lib.Narrow)"


INITIALS = [
    ("INT := 5 + N", "(5 + N)"),
    ("ARRAY[1..6] OF INT := [1, 2, 3(0), N]", "ArrayInit(items=[[None, 1], [None, 2], [3, 0], [None, N]])"),
    ("ARRAY[1..6] OF INT := 1, 2, 4(7)", "ArrayInit(items=[[None, 1], [None, 2], [4, 7]])"),
    ("ARRAY[1..2] OF S := [2((a := 1))]", "ArrayInit(items=[[2, StructInit(members=[[a, 1]])]])"),
    ("ARRAY[1..2] OF S := [2(a := 1)]", "ArrayInit(items=[[2, StructInit(members=[[a, 1]])]])"),
    ("ARRAY[1..2] OF S := [(a := 1), (a := f(2))]", None),
    ("ARRAY[1..2] OF ARRAY[1..2] OF INT := [[1, 2], N([3, 4])]", "ArrayInit(items=[[None, ArrayInit(items=[[None, 1], [None, 2]])], [N, ArrayInit(items=[[None, 3], [None, 4]])]])"),
    ("S := (a := 1, b := [1, 2], c := (d := 2))", "StructInit(members=[[a, 1], [b, ArrayInit(items=[[None, 1], [None, 2]])], [c, StructInit(members=[[d, 2]])]])"),
    ("FB := (a := 1)", "StructInit(members=[[a, 1]])"),
    ("REFERENCE TO INT REF= y", "Call(callee=REF, arguments=[Argument(value=y)])"),
    ("REF_TO INT := REF(y)", "Call(callee=REF, arguments=[Argument(value=y)])"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "shown"), INITIALS)
def test_initial_value(text: str, shown: str | None) -> None:
    file = well(f"PROGRAM p\nVAR x : {text}; END_VAR\nEND_PROGRAM")
    found = show(file.pous[0].sections[0].variables[0].initial)
    assert shown is None or found == shown


BROKEN = [
    ("TYPE A : (); END_TYPE", "S003 1:10 An enumeration needs at least one value."),
    ("TYPE A : (1, 2); END_TYPE", "S003 1:11 the name of a value expected, found `1`."),
    ("TYPE A INT; END_TYPE", "S003 1:8 `:` expected after the name of the type, found `INT`."),
    ("TYPE IF : INT; END_TYPE", "S003 1:6 the name of a type expected; `IF` is a keyword and cannot be a name, found `IF`."),
    ("TYPE A : ARRAY[1..] OF INT; END_TYPE", "S003 1:19 an expression (a value, variable or call) expected, found `]`."),
    ("TYPE A : INT (1..; END_TYPE", "S003 1:18 an expression (a value, variable or call) expected, found `;`."),
    ("TYPE A : STRUCT x : INT; END_TYPE", "S003 1:26 `END_STRUCT` expected, found `END_TYPE`."),
]  # fmt: skip


@pytest.mark.parametrize(("text", "complaint"), BROKEN)
def test_broken_type(text: str, complaint: str) -> None:
    assert complaint in complaints(text)
