"""Ladder diagrams that are wrong: each problem with its code, its line, and what it says to do."""

import pytest

from scanbench.check.build import check_sources
from scanbench.problems import Problem
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
HEAD = "PROGRAM Main\nVAR x, y : INT; b, c : BOOL; t : TON; END_VAR\n"


def problems(body: str) -> list[Problem]:
    return list(check_sources({"a.st": f"{HEAD}{body}\nEND_PROGRAM\n"}, MODEL).problems)


WRONG = [
    ("RUNG\n[x] (b)\nEND_RUNG", "T002", 4, "A contact is BOOL, but this is INT"),
    ("RUNG\n[b] (x)\nEND_RUNG", "T002", 4, "`x` is INT"),
    ("RUNG\n[b] (S x)\nEND_RUNG", "T002", 4, "Only a BOOL can be set"),
    ("RUNG\n[gone] (b)\nEND_RUNG", "T001", 4, "`gone`"),
    ("RUNG\n[b] JMP gone\nEND_RUNG", "T001", 4, "There is no label `gone`"),
    ("RUNG a:\n[b] (c)\nEND_RUNG\nRUNG A:\n(b)\nEND_RUNG", "D001", 6, "The label `A` is there already"),
    ("RUNG\n#left (b)\nEND_RUNG", "T001", 4, "Nothing sends its power to `#left`"),
    ("RUNG\n< [b] -> #w | [c] -> #w >\nEND_RUNG", "D001", 4, "`#w` has its power already"),
    ("RUNG\n[b] t(IN := ~, PT := T#1s).ET (c)\nEND_RUNG", "T002", 4, "The power after a box is BOOL, but this is TIME"),
    ("RUNG\n[b] t(IN := ~, PT := 5).Q (c)\nEND_RUNG", "T002", 4, "`PT`"),
    ("RUNG\n< [b] JMP end | [c] RETURN > (b)\nEND_RUNG\nRUNG end:\nEND_RUNG", "T010", 4, "No power comes to this"),
    ("RUNG\n< [b] RETURN > (gone)\nEND_RUNG", "T001", 4, "`gone`"),
    ("RUNG\nt(IN := < [b] RETURN >, PT := T#1s) (c)\nEND_RUNG", "T010", 4, "No power comes to `IN`"),
    ("RUNG\nt(IN := < [b] -> #l >, PT := gone) (c)\nEND_RUNG", "T001", 4, "`gone`"),
    ("RUNG\n[b] t(IN := ~, PT := T#1s, Q => #l)\nEND_RUNG\nRUNG\n#l (c)\nEND_RUNG", "T001", 7, "Nothing sends"),
    ("RUNG\n[b (c)\nEND_RUNG", "S003", 4, "`]` expected to close the contact"),
    ("RUNG\n[] (c)\nEND_RUNG", "S003", 4, "a variable expected in the contact"),
    ("RUNG\n< [b] | [c] (b)\nEND_RUNG", "S003", 5, "`|` or `>` expected in the parallel branches of line 4"),
    ("RUNG\n[b] c\nEND_RUNG", "S003", 5, "a box is a call"),
    ("RUNG\n[b] (c)\n", "S003", 6, "END_RUNG expected to close the RUNG of line 3"),
    ("RUNG\n[b] JMP a (c)\nEND_RUNG", "S003", 4, "END_RUNG expected"),
    ("RUNG\n[b] - b\nEND_RUNG", "S003", 4, "END_RUNG expected"),
    ("RUNG\n[b] (c)\nEND_RUNG\nx := 1;", "S003", 6, "RUNG or NETWORK expected: this body is a diagram"),
]


@pytest.mark.parametrize(("body", "code", "line", "text"), WRONG, ids=[each[0] for each in WRONG])
def test_what_is_wrong(body: str, code: str, line: int, text: str) -> None:
    found = problems(body)
    assert (code, line) in [(each.code, each.span.line) for each in found], "\n".join(map(str, found))
    assert any(text in each.message for each in found if each.code == code), "\n".join(map(str, found))
    assert len(found) <= 2, "\n".join(map(str, found))


def test_a_wrong_rung_is_told_once_and_the_next_one_is_read() -> None:
    found = problems(
        "RUNG one:\n[] (c)\nEND_RUNG\nRUNG\n[gone] (c)\nEND_RUNG\nRUNG\n[b]\nRUNG two:\n[b] JMP one\nEND_RUNG"
    )
    assert [(each.code, each.span.line) for each in found] == [("S003", 4), ("T001", 7), ("S003", 11)]


@pytest.mark.parametrize("word", ["RUNG", "rung"])
def test_rung_is_a_name_elsewhere(word: str) -> None:
    text = f"PROGRAM Main\nVAR {word} : ARRAY[1..3] OF INT; p : INT; END_VAR\n{word}[3] := 1;\np := {word}[3];\nEND_PROGRAM\n"
    assert check_sources({"a.st": text}, MODEL).problems == ()


def test_edges_are_refused_where_nothing_is_kept() -> None:
    text = "FUNCTION F : BOOL\nVAR_INPUT a : BOOL; END_VAR\nRUNG\n[P a] (F)\nEND_RUNG\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM\n"
    (found,) = check_sources({"a.st": text}, MODEL).problems
    assert (found.code, found.span.line) == ("T010", 4)
    assert "keeps nothing" in found.message


DIAGRAMS = [
    ("x := #gone;", "T001", 4, "`#gone`"),
    ("#a = 1;\n#A = 2;", "D001", 5, "`#A` is a wire of line 4 already"),
    ("#a = b;\nt(IN := b, PT := T#1s, Q => #a);", "D001", 5, "`#a` is a wire of line 4 already"),
    ("#a = b;\nEND_NETWORK\nNETWORK\nc := #a;", "T001", 7, "Nothing sets `#a` in this network"),
    ("y := 1;\nEND_NETWORK\nNETWORK\n#a : INT = #a;\nEND_NETWORK\nNETWORK\ny := #a;", "T001", 10, "Nothing sets `#a`"),
    ("x := MOVE(#e);\nt(IN := b, PT := T#1s, ET => #e);", "T002", 5, "write `ET => #e : TIME`"),
    ("#a = t;", "T002", 4, "so a wire cannot have it"),
    ("x := b;", "T002", 4, "`x` is INT"),
    ("x + 1;", "S003", 4, "a value alone goes nowhere"),
    ("JMP gone IF b;", "T001", 4, "There is no label `gone`"),
    ("JMP IF x;", "S003", 4, "expected"),
    ("RETURN IF x;", "T002", 4, "A condition is BOOL, but this is INT"),
    ("b := R_EDGE x;", "T002", 4, "An edge is BOOL, but this is INT"),
    ("y := #n;\n#n : INT = ADD(#n, b);", "T002", 5, "BOOL"),
    ("y := #n;\n#n = ADD(x, 1);", "T002", 5, "write `#n : INT = ...`"),
    ("c := #n;\n#n = ADD(#n, 1);", "T002", 5, "write `#n : INT = ...`"),
    ("c := #n;\n#n = t.ET;", "T002", 5, "write `#n : TIME = ...`"),
    ("c := #n;\n#n = b AND x;", "T002", 5, "`AND` cannot join BOOL and INT"),
    ("#n INT = 1;", "S003", 4, "`=` expected after the wire"),
    ("x := ADD(x, 1)", "S003", 4, "`;` expected at the end of the line"),
    ("x := ADD(IN1 := x, IN2 := 1, OK => #ok);", "T010", 4, "The type of `#ok` is not known here"),
]


def test_a_loop_that_does_not_say_its_type_is_told_once() -> None:
    found = problems("NETWORK\ny := #e;\nt(IN := b, PT := T#1s, ET => #e);\nx := MOVE(#e);\nEND_NETWORK")
    assert [(each.code, each.span.line) for each in found] == [("T002", 5)]


@pytest.mark.parametrize(("lines", "code", "line", "text"), DIAGRAMS, ids=[each[0] for each in DIAGRAMS])
def test_what_is_wrong_in_a_function_block_diagram(lines: str, code: str, line: int, text: str) -> None:
    found = problems(f"NETWORK\n{lines}\nEND_NETWORK")
    assert (code, line) in [(each.code, each.span.line) for each in found], "\n".join(map(str, found))
    assert any(text in each.message for each in found if each.code == code), "\n".join(map(str, found))
    assert len(found) <= 2, "\n".join(map(str, found))


def test_a_loop_is_refused_where_nothing_is_kept() -> None:
    text = "FUNCTION F : INT\nNETWORK\nF := #n;\n#n : INT = 1;\nEND_NETWORK\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM\n"
    found = check_sources({"a.st": text}, MODEL).problems
    assert [(each.code, each.span.line) for each in found] == [("T010", 4)]


OPEN = """RUNG
[???] (b)
END_RUNG
RUNG
[b] t(IN := ~, PT := ???).Q (???)
END_RUNG
NETWORK
#one = AND(b, ???);
#two = OR(#one, c);
#three = ???(x, y);
b := #two;
x := #three;
t(IN := #two, PT := ???, Q => #late);
??? := #late;
c := ???;
END_NETWORK
"""


def test_a_pin_that_is_not_connected_is_told_once_and_nothing_that_follows_from_it() -> None:
    found = problems(OPEN)
    assert [(each.code, each.span.line) for each in found] == [
        ("S001", line) for line in (4, 7, 7, 10, 12, 15, 16, 17)
    ], "\n".join(map(str, found))


def test_a_wire_whose_line_is_wrong_is_told_there_alone() -> None:
    found = problems(
        "NETWORK\n#one = AND(b, gone);\n#two = OR(#one c);\nb := #one;\nc := #two;\nb := #other;\nEND_NETWORK"
    )
    assert [(each.code, each.span.line) for each in found] == [("T001", 4), ("S003", 5), ("T001", 8)]
