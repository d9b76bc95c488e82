"""What classes, interfaces and methods may not do: code, line and a piece of the message."""

import pytest

from scanbench.check.build import check_sources
from tests.caseformat import MODELS

MAIN = "\nPROGRAM Main\nEND_PROGRAM\n"

RULES = [
    ("D003", 1, "extends itself", "CLASS A EXTENDS B\nEND_CLASS\nCLASS B EXTENDS A\nEND_CLASS"),
    ("D014", 2, "is FINAL", "CLASS FINAL A END_CLASS\nCLASS B EXTENDS A\nEND_CLASS"),
    ("D002", 1, "Did you mean `Base`", "CLASS B EXTENDS Bose\nEND_CLASS\nCLASS Base END_CLASS"),
    ("D014", 2, "that is a CLASS, not INTERFACE", "CLASS A END_CLASS\nCLASS B IMPLEMENTS A\nEND_CLASS"),
    ("D014", 2, "that is a FUNCTION_BLOCK, not CLASS", "FUNCTION_BLOCK A END_FUNCTION_BLOCK\nCLASS B EXTENDS A\nEND_CLASS"),
    ("D014", 2, "no variables", "INTERFACE I\nVAR x : INT; END_VAR\nEND_INTERFACE"),
    ("D008", 2, "A CLASS has no VAR_INPUT", "CLASS A\nVAR_INPUT x : INT; END_VAR\nEND_CLASS"),
    ("D014", 2, "no body for `I.m`, `GET of I.p`",
     "INTERFACE I METHOD m\nEND_METHOD PROPERTY p : INT GET END_GET END_PROPERTY END_INTERFACE CLASS B IMPLEMENTS I END_CLASS"),
    ("D014", 3, "no body for `A.m`", "CLASS ABSTRACT A\nMETHOD PUBLIC ABSTRACT m END_METHOD END_CLASS\nCLASS B EXTENDS A END_CLASS"),
    ("D014", 2, "must be declared ABSTRACT", "CLASS A\nMETHOD PUBLIC ABSTRACT m END_METHOD END_CLASS"),
    ("D014", 2, "ABSTRACT and FINAL", "CLASS ABSTRACT A\nMETHOD PUBLIC ABSTRACT FINAL m END_METHOD END_CLASS"),
    ("D008", 2, "must keep its state; not in a METHOD", "CLASS A\nMETHOD PUBLIC m VAR t : TON; END_VAR END_METHOD END_CLASS"),
    ("D014", 2, "nothing to OVERRIDE. Did you mean `Run`", "CLASS A METHOD PUBLIC Run END_METHOD END_CLASS CLASS B EXTENDS A\nMETHOD PUBLIC OVERRIDE Rum END_METHOD END_CLASS"),
    ("D014", 2, "is FINAL and cannot be overridden", "CLASS A METHOD PUBLIC FINAL m END_METHOD END_CLASS CLASS B EXTENDS A\nMETHOD PUBLIC m END_METHOD END_CLASS"),
    ("D014", 2, "is PRIVATE; use another name", "CLASS A METHOD PRIVATE m END_METHOD END_CLASS CLASS B EXTENDS A\nMETHOD PRIVATE m END_METHOD END_CLASS"),
    ("D014", 2, "is PROTECTED, but `A.m` is PUBLIC", "CLASS A METHOD PUBLIC m END_METHOD END_CLASS CLASS B EXTENDS A\nMETHOD PROTECTED m END_METHOD END_CLASS"),
    ("D014", 2, "`VAR_INPUT y : INT` where `A.m` has `VAR_INPUT x : INT`", "CLASS A METHOD m VAR_INPUT x : INT; END_VAR END_METHOD END_CLASS CLASS B EXTENDS A\nMETHOD m VAR_INPUT y : INT; END_VAR END_METHOD END_CLASS"),
    ("D014", 2, "`B.m` has `VAR_OUTPUT y : INT`, but `A.m` has not", "CLASS A METHOD m END_METHOD END_CLASS CLASS B EXTENDS A\nMETHOD m VAR_OUTPUT y : INT; END_VAR END_METHOD END_CLASS"),
    ("D014", 2, "a result INT, but `A.m` has no result", "CLASS A METHOD m END_METHOD END_CLASS CLASS B EXTENDS A\nMETHOD m : INT END_METHOD END_CLASS"),
    ("D014", 2, "`A.m` has `VAR_INPUT x : INT`, but `I.m` has not", "INTERFACE I METHOD m END_METHOD END_INTERFACE CLASS A METHOD m VAR_INPUT x : INT; END_VAR END_METHOD END_CLASS\nCLASS B EXTENDS A IMPLEMENTS I END_CLASS"),
    ("D001", 2, "`A.m` is declared already", "CLASS A METHOD m END_METHOD\nMETHOD m END_METHOD END_CLASS"),
    ("D001", 2, "`A.m` is declared already", "CLASS A VAR m : INT; END_VAR\nMETHOD m END_METHOD END_CLASS"),
    ("D001", 2, "declared already", "CLASS A VAR x : INT; END_VAR END_CLASS CLASS B EXTENDS A\nVAR x : INT; END_VAR END_CLASS"),
    ("X001", 2, "FB_init", "FUNCTION_BLOCK F\nMETHOD FB_init : BOOL END_METHOD END_FUNCTION_BLOCK"),
    ("D009", 1, "F.a -> F.b -> F.a", "FUNCTION_BLOCK F METHOD a b(); END_METHOD METHOD b THIS.a(); END_METHOD END_FUNCTION_BLOCK"),
    ("D009", 1, "I.GO.dispatch", "INTERFACE I METHOD Go END_METHOD END_INTERFACE FUNCTION_BLOCK F IMPLEMENTS I VAR next : I; END_VAR METHOD Go THIS^(); END_METHOD next.Go(); END_FUNCTION_BLOCK"),
    ("T014", 2, "`x` is PRIVATE of `A`", "CLASS A VAR PRIVATE x : INT; END_VAR END_CLASS CLASS B EXTENDS A METHOD m\nx := 1; END_METHOD END_CLASS"),
    ("T014", 2, "`A.p` is PRIVATE", "FUNCTION_BLOCK A VAR x : INT; END_VAR PROPERTY p : INT GET p := x; END_GET PRIVATE SET x := p; END_SET END_PROPERTY END_FUNCTION_BLOCK FUNCTION_BLOCK B VAR a : A; y : INT; END_VAR y := a.p;\na.p := 1; END_FUNCTION_BLOCK"),
    ("T014", 2, "`A.m` is PRIVATE", "CLASS A METHOD PRIVATE m END_METHOD END_CLASS CLASS B EXTENDS A METHOD n\nm(); END_METHOD END_CLASS"),
    ("T010", 2, "ABSTRACT; it has no body", "CLASS ABSTRACT A METHOD ABSTRACT m END_METHOD END_CLASS CLASS B EXTENDS A METHOD m\nSUPER.m(); END_METHOD END_CLASS"),
    ("T010", 2, "a FUNCTION has none", "FUNCTION F : INT\nF := THIS.x;\nEND_FUNCTION"),
    ("T010", 2, "is a method; call it", "CLASS A METHOD m : INT END_METHOD METHOD n : INT\nn := m; END_METHOD END_CLASS"),
]  # fmt: skip

TYPES = (
    "INTERFACE I METHOD m : INT END_METHOD END_INTERFACE "
    "FUNCTION_BLOCK F VAR hid : INT; END_VAR END_FUNCTION_BLOCK "
    "FUNCTION_BLOCK G IMPLEMENTS I VAR PROTECTED own : INT; END_VAR "
    "METHOD m : INT END_METHOD METHOD PROTECTED q END_METHOD METHOD plain VAR_IN_OUT v : INT; END_VAR END_METHOD "
    "PROPERTY ro : INT GET END_GET END_PROPERTY PROPERTY wo : INT SET END_SET END_PROPERTY END_FUNCTION_BLOCK "
    "CLASS ABSTRACT A END_CLASS CLASS C METHOD PUBLIC m : INT END_METHOD END_CLASS "
    "PROGRAM Main VAR i : I; f : F; g : G; c : C; p : REF_TO F; q : REF_TO G; x : INT; {} END_VAR\n{}\nEND_PROGRAM\n"
)

USES = [
    ("D014", 1, "`A` is ABSTRACT", "a : ARRAY[0..1] OF A;", ";"),
    ("T002", 2, "`F` does not implement the interface `I`", "", "i := f;"),
    ("T002", 2, "Assign an instance that implements it", "", "i := 5;"),
    ("T010", 2, "call its methods without `^`", "", "x := i^.m();"),
    ("T001", 2, "`I` has no method `k`", "", "i.k();"),
    ("T001", 2, "`G` has no method `plane`. Did you mean `plain`", "", "g.plane();"),
    ("T010", 2, "no body that could be called", "", "i();"),
    ("T010", 2, "no body that could be called", "", "c();"),
    ("T010", 2, "write `^`", "", "q.m();"),
    ("T002", 2, "no part in inheritance", "", "p ?= f;"),
    ("T002", 2, "needs an interface or a reference to a class, not INT", "", "x ?= i;"),
    ("T002", 2, "needs an interface, a reference or an instance", "", "i ?= x;"),
    ("T014", 2, "PROTECTED and cannot be called from here", "", "g.q();"),
    ("T010", 2, "`own` is internal of G", "", "x := g.own;"),
    ("T010", 2, "can only be read", "", "g.ro := 3;"),
    ("T010", 2, "can only be assigned", "", "x := g.wo;"),
    ("T010", 2, "`G.plain` has no result; call it as a statement.", "", "x := g.plain(x);"),
    ("T005", 2, "must be connected", "", "g.plain();"),
    ("T010", 2, "extends nothing", "", "SUPER.m();"),
    ("T001", 2, "There is no function `K.m`", "", "x := K.m();"),
]


@pytest.mark.parametrize(("code", "line", "message", "text"), RULES)
def test_declaration(code: str, line: int, message: str, text: str) -> None:
    expect(code, line, message, text + MAIN)


@pytest.mark.parametrize(("code", "line", "message", "variables", "body"), USES)
def test_use(code: str, line: int, message: str, variables: str, body: str) -> None:
    expect(code, line, message, TYPES.format(variables, body))


def test_the_types_of_the_uses_are_right() -> None:
    assert check_sources({"a.st": TYPES.format("", "x := g.m();")}, MODELS["GENERIC-IEC"]).problems == ()


def test_a_missing_type_of_a_result_is_told_once() -> None:
    text = "INTERFACE I\nMETHOD m : Gone END_METHOD END_INTERFACE\nPROGRAM Main VAR i : I; n : BOOL; END_VAR n := i.m().x(); END_PROGRAM"
    found = check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems
    assert [(each.code, each.message) for each in found] == [("D002", "There is no type `Gone`.")]


def expect(code: str, line: int, message: str, text: str) -> None:
    checked = check_sources({"a.st": text}, MODELS["GENERIC-IEC"])
    assert checked.program is None
    found = [each for each in checked.problems if each.code == code and each.span.line == line]
    assert any(message in each.message for each in found), "\n".join(map(str, checked.problems))
