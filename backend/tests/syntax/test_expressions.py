"""Expressions: what binds stronger, what a variable may be followed by, and calls."""

import pytest

from tests.syntax.shown import complaints, show_body, show_expression

EXPRESSIONS = [
    ("a + b * c - d", "((a + (b * c)) - d)"),
    ("a OR b XOR c AND d = e < f + g * h ** i", "(a or (b xor (c and (d = (e < (f + (g * (h ** i))))))))"),
    ("a & b AND c", "((a and b) and c)"),
    ("-2 ** 2", "(neg(2) ** 2)"),
    ("2 ** -x ** y", "((2 ** neg(x)) ** y)"),
    ("NOT a AND b", "(not(a) and b)"),
    ("NOT NOT -+a", "not(not(neg(plus(a))))"),
    ("a MOD b / c", "((a mod b) div c)".replace("div", "/")),
    ("a AND_THEN b OR_ELSE c", "((a and_then b) or_else c)"),
    ("(a OR b) AND c", "((a or b) and c)"),
    ("a <> b = c", "((a <> b) = c)"),
    ("a.b[1, i + 1].c", "IndexOf(array=a.b, indices=[1, (i + 1)]).c"),
    ("p^.x^[2]^", "Dereference(reference=IndexOf(array=Dereference(reference=Dereference(reference=p).x), indices=[2]))"),
    ("w.3", "PartialAccess(owner=w, size=X, index=3)"),
    ("a[1].%B2.%x7", "PartialAccess(owner=PartialAccess(owner=IndexOf(array=a, indices=[1]), size=B, index=2), size=X, index=7)"),
    ("l.%D1 + l.%W3 + l.%L0", None),
    ("Color#RED", "Color#RED"),
    ("Lib.Types.Color#RED", "Lib.Types.Color#RED"),
    ("Lib.Speed#5", "Lib.Speed#5"),
    ("%IX0.0 AND %MW5 = 3", "(DirectAddress(text=%IX0.0) and (DirectAddress(text=%MW5) = 3))"),
    ("THIS.x + THIS^.y + SUPER.z", "((THIS.x + Dereference(reference=THIS).y) + SUPER.z)"),
    ("SUPER^.m()", "Call(callee=Dereference(reference=SUPER).m)"),
    ("a.m(1).n[2](x)", None),
    ("AND(a, b, c)", "Call(callee=AND, arguments=[Argument(value=a), Argument(value=b), Argument(value=c)])"),
    ("OR(a, b) XOR XOR(a, b)", None),
    ("MOD(IN1 := a, IN2 := b)", None),
    ("NOT(IN := a)", "Call(callee=NOT, arguments=[Argument(name=IN, value=a)])"),
    ("NOT(a) = b", "(not(a) = b)"),
    ("f(EN := a, x => , y => b[1], NOT q => c)", "Call(callee=f, arguments=[Argument(name=EN, value=a), Argument(name=x, output=True), Argument(name=y, output=True, value=IndexOf(array=b, indices=[1])), Argument(name=q, output=True, value=c, negated=True)])"),
    ("f(IN := , PT := c, Q => )", "Call(callee=f, arguments=[Argument(name=PT, value=c), Argument(name=Q, output=True)])"),
    ("f(NOT a)", "Call(callee=f, arguments=[Argument(value=not(a))])"),
    ("#local + #b.c", "(local + b.c)"),
    ("(p)^", "Dereference(reference=p)"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "shown"), EXPRESSIONS)
def test_expression(text: str, shown: str | None) -> None:
    found = show_expression(text)
    assert shown is None or found == shown


BROKEN = [
    ("x := ;", "S003 2:6 an expression (a value, variable or call) expected, found `;`."),
    ("x := (a + b;", "S003 2:12 `)` expected to close the parenthesis, found `;`."),
    ("x := a[1;", "S003 2:9 `]` expected to close the index, found `;`."),
    ("x := a.;", "S003 2:8 the name of a member expected, found `;`."),
    ("x := a.TO;", "S003 2:8 the name of a member expected; `TO` is a keyword and cannot be a name, found `TO`."),
    (
        "x := a.%Q3;",
        "S003 2:8 a part of a variable is written like x.%X3, x.%B1, x.%W0, x.%D0 or x.%B1.3, found `%Q3`.",
    ),
    ("x := f(1, 2;", "S003 2:12 `)` expected to close the call, found `;`."),
    ("x := AND a;", "S003 2:6 an expression (a value, variable or call) expected, found `AND`."),
    ('x := "Motor".run;', "X001 2:6 Names in quotes are not supported; write Motor."),
]


@pytest.mark.parametrize(("text", "complaint"), BROKEN)
def test_broken_expression(text: str, complaint: str) -> None:
    assert complaints(f"PROGRAM p\n{text}\ny := 1;\nEND_PROGRAM") == [complaint]


def test_a_call_of_anything() -> None:
    assert show_body("a.b[1](x := 1); p^(); SUPER(); THIS.m(1); SUPER^();").count("Expression") == 5
