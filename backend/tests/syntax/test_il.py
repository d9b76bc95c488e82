"""Instruction List: which bodies are IL, and what each instruction says."""

import pytest

from scanbench.syntax import tree
from tests.syntax.shown import complaints, show, well


def instructions(text: str) -> list[str]:
    body = well(f"FUNCTION_BLOCK b\n{text}\nEND_FUNCTION_BLOCK").pous[0].body
    assert isinstance(body, tree.IlBody)
    return [show(each) for each in body.instructions]


def short(text: str) -> str:
    return " | ".join(each.removeprefix("IlInstruction(operator=").removesuffix(")") for each in instructions(text))


LINES = [
    ("LD a\nST b", "LD, operand=a | ST, operand=b"),
    ("LDN a (* comment *) // more\nSTN b", "LD, negated=True, operand=a | ST, negated=True, operand=b"),
    ("LD 5\nS x\nR y.z[1]", "LD, operand=5 | S, operand=x | R, operand=IndexOf(array=y.z, indices=[1])"),
    ("LD -5\nADD INT#3\nNOT", "LD, operand=neg(5) | ADD, operand=INT#3 | NOT"),
    ("ld TRUE\nandn x\norn y\nxorn z\nmod w", None),
    ("LD a\n& b\n&N c", "LD, operand=a | AND, operand=b | AND, negated=True, operand=c"),
    ("LD a\nGT b\nGE c\nEQ d\nNE e\nLE f\nLT g", None),
    ("LD a\nAND( b\nOR c\n)\nST d", "LD, operand=a | AND, deferred=True, operand=b | OR, operand=c | ) | ST, operand=d"),
    ("LD a\nADD(\nLD b\nMUL( c\nSUB d\n)\n)", "LD, operand=a | ADD, deferred=True | LD, operand=b | MUL, deferred=True, operand=c | SUB, operand=d | ) | )"),
    ("LD a\nORN( b )", "LD, operand=a | OR, negated=True, deferred=True, operand=b | )"),
    ("JMP end\nJMPC end\nJMPCN end\nRET\nRETC\nRETCN", "JMP, operand=end | JMP, conditional=True, operand=end | JMP, negated=True, conditional=True, operand=end | RET | RET, conditional=True | RET, negated=True, conditional=True"),
    ("CAL t\nCALC t(IN := a, PT := T#5s, Q => q, NOT Q => n)\nCALCN a[1].b(\n  x := 1,\n  y => z\n)", "CAL, operand=t | CAL, conditional=True, operand=t, arguments=[Argument(name=IN, value=a), Argument(name=PT, value=TIME#5000000000), Argument(name=Q, output=True, value=q), Argument(name=Q, output=True, value=n, negated=True)] | CAL, negated=True, conditional=True, operand=IndexOf(array=a, indices=[1]).b, arguments=[Argument(name=x, value=1), Argument(name=y, output=True, value=z)]"),
    ("LD a\nLIMIT 1, x, 3\nABS\nLib.f b", "LD, operand=a | LIMIT, operand=1, arguments=[Argument(value=x), Argument(value=3)] | ABS | LIB.F, operand=b"),
    ("LIMIT(\n MN := 1,\n IN := x,\n MX := 3\n)\nST y", "LIMIT, arguments=[Argument(name=MN, value=1), Argument(name=IN, value=x), Argument(name=MX, value=3)] | ST, operand=y"),
    ("LD a\nADD(IN1 := b, IN2 := c)", "LD, operand=a | ADD, arguments=[Argument(name=IN1, value=b), Argument(name=IN2, value=c)]"),
    ("LD a\nS1 sr\nCU ctr\nPV ctr\nIN tmr\nPT tmr\nCLK trig\nR1 sr\nCD ctr", None),
    ("LD p^\nST w.%B1\nLD w.3\nST %QX0.0", "LD, operand=Dereference(reference=p) | ST, operand=PartialAccess(owner=w, size=B, index=1) | LD, operand=PartialAccess(owner=w, size=X, index=3) | ST, operand=DirectAddress(text=%QX0.0)"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "shown"), LINES)
def test_instructions(text: str, shown: str | None) -> None:
    found = short(text)
    assert shown is None or found == shown
    if shown is None:
        assert len(found.split(" | ")) == len(text.split("\n"))


def test_labels() -> None:
    found = instructions("start: LD a\nalone:\n ST b\nlast:")
    assert found == [
        "IlInstruction(label=start, operator=LD, operand=a)",
        "IlInstruction(label=alone, operator=ST, operand=b)",
        "IlInstruction(label=last)",
    ]
    assert instructions("LD a\nfirst:\nsecond: ST b")[1:] == [
        "IlInstruction(label=first)",
        "IlInstruction(label=second, operator=ST, operand=b)",
    ]


def test_places() -> None:
    body = well("PROGRAM p\nLD a\n  ST b\nEND_PROGRAM").pous[0].body
    assert isinstance(body, tree.IlBody)
    assert [(each.span.line, each.span.column, each.span.end_column) for each in body.instructions] == [
        (2, 1, 5),
        (3, 3, 7),
    ]


@pytest.mark.parametrize(
    "text",
    [
        "LD := 5;",
        "ST(a := 1);",
        "S := R;",
        "RET := TRUE;",
        "LD.x := 1;",
        "R[1] := 2;",
        "ld();",
        "f(a := 1);\nLD := 3;",
        "",
    ],
)
def test_statements_with_names_like_operators_are_no_il(text: str) -> None:
    assert isinstance(well(f"PROGRAM p\n{text}\nEND_PROGRAM").pous[0].body, tuple)


@pytest.mark.parametrize(
    "text", ["LD a", "l: LD a", "CAL t", "JMP x\nx: RET", "RET", "CAL t(a := 1)", "f(a := 1)\nST b", "ldn %IX0.0"]
)
def test_bodies_that_are_il(text: str) -> None:
    assert isinstance(well(f"PROGRAM p\n{text}\nEND_PROGRAM").pous[0].body, tree.IlBody)


def test_il_in_methods() -> None:
    file = well("CLASS c\nMETHOD a : INT\nLD 1\nST a\nEND_METHOD\nMETHOD b\nx := 1;\nEND_METHOD\nEND_CLASS")
    assert [type(each.body).__name__ for each in file.pous[0].methods] == ["IlBody", "tuple"]
    block = well("FUNCTION_BLOCK b\nLD 1\nMETHOD m\nLD 2\nEND_METHOD\nST x\nEND_FUNCTION_BLOCK").pous[0]
    assert isinstance(block.body, tree.IlBody)
    assert (len(block.body.instructions), len(block.methods)) == (2, 1)


BROKEN = [
    ("LD a b\nST c", "S003 2:6 the end of the line expected after the instruction, found `b`."),
    ("LD", "S003 3:1 an operand expected after LD, found `END_PROGRAM`."),
    ("LD a\nST\nLD b", "S003 4:1 an operand expected after ST, found `LD`."),
    ("LD a\n:= 3\nST b", "S003 3:1 an instruction (an operator, and what it works on) expected, found `:=`."),
    ("LD a\nST b := 3\nLD c", "S003 3:6 the end of the line expected after the instruction, found `:=`."),
    ("LD a\nCAL\nST c", "S003 4:4 the end of the line"),
    ("LD a\nLIMIT 1,\nST c", "S003 4:4 the end of the line"),
]


@pytest.mark.parametrize(("text", "complaint"), BROKEN)
def test_broken_instructions(text: str, complaint: str) -> None:
    found = complaints(f"PROGRAM p\n{text}\nEND_PROGRAM")
    assert found[0].startswith(complaint), found
    assert len(found) == 1
