"""POUs, classes, interfaces, properties, namespaces."""

from scanbench.syntax import tree
from tests.syntax.shown import complaints, show, well


def test_functions_with_and_without_result() -> None:
    file = well(
        "FUNCTION a : ARRAY[0..1] OF INT; VAR_INPUT x : INT; END_VAR END_FUNCTION\nFUNCTION b END_FUNCTION;\n"
        "FUNCTION c : VOID c := 1; END_FUNCTION FUNCTION d : STRING[5] USING A.B; d := ''; END_FUNCTION"
    )
    assert [(each.name, show(each.result)) for each in file.pous] == [
        ("a", "Array(ranges=[[0, 1]], element=INT)"),
        ("b", "None"),
        ("c", "None"),
        ("d", "String(length=5)"),
    ]
    assert file.pous[3].using == ("A.B",)


CLASSES = """
INTERFACE Movable EXTENDS Base, Lib.Other
  METHOD move : BOOL VAR_INPUT x : INT; END_VAR END_METHOD
  METHOD stop END_METHOD;
  PROPERTY speed : INT GET END_GET SET END_SET END_PROPERTY
  PROPERTY both : INT END_PROPERTY
END_INTERFACE
CLASS ABSTRACT Thing EXTENDS Lib.Root IMPLEMENTS Movable, Lib.I
  VAR PRIVATE n : INT; END_VAR
  METHOD PUBLIC ABSTRACT move : BOOL VAR_INPUT x : INT; END_VAR END_METHOD
  METHOD PROTECTED FINAL OVERRIDE stop n := 0; SUPER.stop(); END_METHOD
  METHOD final : INT END_METHOD
END_CLASS
FUNCTION_BLOCK FINAL Motor EXTENDS Thing
  METHOD INTERNAL early early := 1; END_METHOD
  VAR v : INT; END_VAR
  v := 1;
  PROPERTY PRIVATE speed : INT
    GET VAR t : INT; END_VAR speed := v; END_GET
    SET v := speed; END_SET
  END_PROPERTY
  ACTION reset: v := 0; END_ACTION
  v := v + 1;
END_FUNCTION_BLOCK
PROPERTY_GET late : INT late := 1; END_PROPERTY
METHOD method : INT method := 1; END_METHOD
ACTION after v := 2; END_ACTION
"""


def test_classes() -> None:
    interface, thing, motor = well(CLASSES).pous
    assert interface.kind == "interface"
    assert [[each.name for each in names] for names in (interface.extends, thing.extends, thing.implements)] == [
        ["Base", "Lib.Other"], ["Lib.Root"], ["Movable", "Lib.I"],
    ]  # fmt: skip
    assert (thing.modifiers, motor.modifiers) == (("ABSTRACT",), ("FINAL",))
    assert [_member(each) for each in interface.methods] == [
        "method move PUBLIC  BOOL 0", "method stop PUBLIC  None 0", "get speed PUBLIC  INT 0", "set speed PUBLIC  INT 0",
        "get both PUBLIC  INT 0", "set both PUBLIC  INT 0",
    ]  # fmt: skip
    assert [_member(each) for each in thing.methods] == [
        "method move PUBLIC ABSTRACT BOOL 0", "method stop PROTECTED FINAL+OVERRIDE None 2",
        "method final PUBLIC  INT 0",
    ]  # fmt: skip
    assert [_member(each) for each in motor.methods] == [
        "method early INTERNAL  None 1", "get speed PRIVATE  INT 1", "set speed PRIVATE  INT 1",
        "method reset PUBLIC ACTION None 1", "get late PUBLIC  INT 1", "method method PUBLIC  INT 1",
        "method after PUBLIC ACTION None 1",
    ]  # fmt: skip
    assert show(motor.body) == "[Assignment(target=v, value=1), Assignment(target=v, value=(v + 1))]"
    assert [each.variables[0].name for each in motor.sections] == ["v"]


def _member(pou: tree.PouDeclaration) -> str:
    assert isinstance(pou.body, tuple)
    return f"{pou.kind} {pou.name} {pou.access} {'+'.join(pou.modifiers)} {show(pou.result)} {len(pou.body)}"


def test_namespaces() -> None:
    file = well(
        """USING Std;
NAMESPACE A.B
  USING C, D.E;
  TYPE T : INT; END_TYPE
  NAMESPACE INTERNAL Inner
    USING F;
    FUNCTION f : INT USING G; f := 1; END_FUNCTION
  END_NAMESPACE
  VAR_GLOBAL g : INT; END_VAR
  CLASS c END_CLASS
END_NAMESPACE
FUNCTION_BLOCK b USING X; EXTENDS Y END_FUNCTION_BLOCK"""
    )
    assert [(each.name, each.namespace, each.using) for each in file.pous] == [
        ("f", "A.B.Inner", ("Std", "C", "D.E", "F", "G")),
        ("c", "A.B", ("Std", "C", "D.E")),
        ("b", "", ("Std", "X")),
    ]
    assert (file.types[0].namespace, file.types[0].using) == ("A.B", ("Std", "C", "D.E"))
    assert file.globals[0].namespace == "A.B"
    assert [each.name for each in file.pous[2].extends] == ["Y"]


def test_what_one_vendor_writes_between() -> None:
    file = well(
        "FUNCTION_BLOCK b\nTITLE = A name\nVERSION : 0.1\nVAR x : INT; END_VAR\nBEGIN\n#x := #x + 1;\nEND_FUNCTION_BLOCK"
    )
    assert show(file.pous[0].body) == "[Assignment(target=x, value=(x + 1))]"
    assert complaints("DATA_BLOCK d\nBEGIN\nEND_DATA_BLOCK\nPROGRAM p\nEND_PROGRAM") == [
        "X001 1:1 DATA_BLOCK is not supported here; write VAR_GLOBAL."
    ]
    assert complaints('FUNCTION_BLOCK "Motor"\nEND_FUNCTION_BLOCK')[0] == (
        "X001 1:16 Names in quotes are not supported; write Motor."
    )


BROKEN = [
    ("PROGRAM p\nx := 1;", "S003 2:8 `END_PROGRAM` expected"),
    ("PROGRAM p\nx := 1;\nEND_FUNCTION", "S003 3:1 `END_PROGRAM` expected to close PROGRAM p, found `END_FUNCTION`."),
    ("CLASS c\nx := 1;\nEND_CLASS", "S003 2:1 A CLASS has no statements of its own; put them into a METHOD."),
    ("FUNCTION_BLOCK b EXTENDS c, d\nEND_FUNCTION_BLOCK", "S003 1:16 A FUNCTION_BLOCK extends one other only;"),
    ("CLASS c\nMETHOD m\nx := 1;\nEND_CLASS", "S003 4:1 `END_METHOD` expected to close METHOD m, found `END_CLASS`."),
    ("CLASS c\nPROPERTY p : INT\nEND_PROPERTY\nEND_CLASS", "S003 2:10 PROPERTY p has neither GET nor SET."),
    ("CLASS c\nPROPERTY p GET END_GET END_PROPERTY\nEND_CLASS", "S003 2:10 PROPERTY p needs a type"),
    ("PROGRAM\nEND_PROGRAM", "S003 2:1 the name of the PROGRAM expected; `END_PROGRAM` is a keyword"),
    ("NAMESPACE n\nPROGRAM p\nEND_PROGRAM", "S003 3:12 `END_NAMESPACE` expected to close the NAMESPACE of line 1"),
    ("x := 1;", "S003 1:1 PROGRAM, FUNCTION_BLOCK, FUNCTION, CLASS, INTERFACE, TYPE"),
]


def test_broken_pous() -> None:
    for text, complaint in BROKEN:
        found = complaints(text)
        assert found[0].startswith(complaint), (text, found)


def test_variables_between_pous_are_no_variables_of_an_open_one() -> None:
    file = well("FUNCTION f : INT f := 1; END_FUNCTION VAR_GLOBAL g : INT; END_VAR PROGRAM p END_PROGRAM")
    assert len(file.globals) == 1
    found = complaints("PROGRAM p\nx := 1;\nVAR_GLOBAL g : INT; END_VAR\nPROGRAM q\nEND_PROGRAM")
    assert found == ["S003 3:1 `END_PROGRAM` expected to close PROGRAM p, found `VAR_GLOBAL`."]
