"""Statements of Structured Text, and how parsing continues after a bad one."""

import pytest

from tests.syntax.shown import complaints, show_body

STATEMENTS = [
    (";;;", ""),
    ("x := 1", None),
    ("IF a THEN b := 1; ELSIF c THEN ; ELSE d := 2; END_IF e := 3;",
     "If(branches=[[a, [Assignment(target=b, value=1)]], [c, []]], orelse=[Assignment(target=d, value=2)]) Assignment(target=e, value=3)"),
    ("CASE x OF 1, 3..5: a := 1; -2: ; RED, C#GREEN, C.BLUE: b := 1; 'a': c(); T#1s..T#2s: ; ELSE d := 1; END_CASE",
     "Case(selector=x, branches=[[[[1, None], [3, 5]], [Assignment(target=a, value=1)]], [[[neg(2), None]], []], "
     "[[[RED, None], [C#GREEN, None], [C.BLUE, None]], [Assignment(target=b, value=1)]], "
     "[[[b'a', None]], [Expression(expression=Call(callee=c))]], [[[TIME#1000000000, TIME#2000000000]], []]], "
     "orelse=[Assignment(target=d, value=1)])"),
    ("FOR i := 1 TO 10 BY 2 DO IF a THEN CONTINUE; END_IF; EXIT; END_FOR; continue := by;",
     "For(variable=i, start=1, end=10, step=2, body=[If(branches=[[a, [Continue()]]]), Exit()]) Assignment(target=continue, value=by)"),
    ("WHILE a DO RETURN; END_WHILE REPEAT b := 1; UNTIL c; END_REPEAT",
     "While(condition=a, body=[Return()]) Repeat(body=[Assignment(target=b, value=1)], until=c)"),
    ("p^.a[1].%X3 := NOT f(1).b;", None),
]  # fmt: skip


@pytest.mark.parametrize(("text", "shown"), STATEMENTS)
def test_statement(text: str, shown: str | None) -> None:
    if text == "x := 1":
        assert complaints("PROGRAM p\nx := 1\nEND_PROGRAM") == [
            "S003 2:6 `;` expected at the end of the assignment, found `END_PROGRAM`."
        ]
        return
    found = show_body(text)
    assert shown is None or found == shown


REFUSED = [
    ("GOTO there;", "X001 2:1 GOTO is not supported; use IF and loops."),
    ("REGION Some name\n", "X001 2:1 REGION is not supported; remove it, and its END_REGION."),
    (
        "x := 1;\nSTEP start:\nEND_STEP",
        "X001 3:1 STEP is not supported; a chart (SFC) is a body of its own, without statements beside it.",
    ),
    ("_LD_BODY\n_NETWORKS : 1\n", "X001 2:1 _LD_BODY is not supported; convert the drawing to Structured Text."),
    ("x = 1;", "S003 2:1 An assignment is written `:=`; `=` compares."),
    ("x := 1 y := 2;", "S003 2:6 `;` expected at the end of the assignment, found `y`."),
    ("IF a THEN b := 1;", "S003 4:1 `END_IF` expected to close the IF of line 2, found `END_PROGRAM`."),
    ("END_IF;", "S003 2:1 `END_IF` without its beginning."),
    ("FOR i = 1 TO 3 DO END_FOR", "S003 2:5 `:=` expected after the control variable of the FOR, found `=`."),
    ("CASE a b: x := 1; END_CASE", "S003 2:6 `OF` expected after the selector, found `b`."),
]


@pytest.mark.parametrize(("text", "complaint"), REFUSED)
def test_what_is_refused_is_named(text: str, complaint: str) -> None:
    found = complaints(f"PROGRAM p\n{text}\ny := 1;\nEND_PROGRAM")
    assert found[0] == complaint
    assert not any("4:1" in each for each in found[1:]), found


def test_try_has_a_catch_and_an_end() -> None:
    whole = "PROGRAM p\n__TRY\nx := 1;\n__CATCH(e)\nx := 2;\n__FINALLY\nx := 3;\n__ENDTRY\nEND_PROGRAM"
    assert not complaints(whole)
    assert [each[:8] for each in complaints(whole.replace("__CATCH(e)\nx := 2;\n", ""))] == ["S003 4:1"]
    assert [each[:8] for each in complaints(whole.replace("__ENDTRY\n", ""))] == ["S003 8:1"]


def test_each_bad_statement_is_one_problem() -> None:
    text = "x := ;\ny := 1;\nf(;\nz := 2\nIF THEN x := 1; END_IF;\nw := 3;"
    assert [each.split()[1] for each in complaints(f"PROGRAM p\n{text}\nEND_PROGRAM")] == ["2:6", "4:3", "5:6", "6:4"]
