"""Instruction List that is wrong: each problem with its code, its line, and what it says to do."""

import pytest

from scanbench.check.build import check_sources
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
HEAD = "PROGRAM Main\nVAR x, y : INT; b, c : BOOL; t : TON; s : STRING[5]; d : DINT; END_VAR\n"

WRONG = [
    ("ST x", "T010", 3, "LD first"),
    ("LD x\nADD b", "T002", 4, "cannot join INT and BOOL"),
    ("LD x\nLDD y", "T001", 4, "Did you mean `LD`"),
    ("LD x\nLIMT 1, 2", "T001", 4, "Did you mean `LIMIT`"),
    ("LD d\nST x", "T002", 4, "DINT_TO_INT"),
    ("LD x\nST b", "T002", 4, "`b` is BOOL"),
    ("LD x\nS b", "T006", 4, "BOOL, not INT"),
    ("LD b\nS x", "T002", 4, "Only a BOOL can be set"),
    ("LD b\nJMPC gone", "T001", 4, "There is no label `gone`"),
    ("LD b\nJMPC ent\nend: LD x", "T001", 4, "Did you mean `end`"),
    ("LD b\nJMPC a\na: LD b\nA: LD c", "D001", 6, "is already in line 5"),
    ("LD x\nJMPC a\na: LD x", "T006", 4, "JMPC asks for a current result of BOOL, not INT"),
    ("LD x\nRETC", "T006", 4, "RETC"),
    ("LD b\nAND( c", "S003", 4, "is never closed"),
    ("LD b\n)", "S003", 4, "closes nothing"),
    ("LD b\nAND(\n)", "T010", 5, "no current result"),
    ("LD b\nAND( c\nin: OR b\n)", "T010", 5, "inside parentheses"),
    ("LD b\nAND( c\nJMPC out\n)\nout: LD b", "T010", 5, "inside parentheses"),
    ("LD b\nCU t", "T001", 4, "has no input `CU`"),
    ("LD x\nIN t", "T002", 4, "`IN` is BOOL"),
    ("LD t", "T002", 3, "an instance of TON"),
    ("LD b\nAND x", "T002", 4, "cannot join BOOL and INT"),
    ("LD 1\nADD 2\nST s", "T002", 4, "`s` is STRING[5]"),
    ("LD 5\nDIV 0\nST x", "S004", 4, "constant zero"),
    ("LD 40000\nST x", "S004", 3, "does not fit INT"),
    ("LD x\nCALC t", "T006", 4, "CALC"),
    ("LD b\nJMPC two\nLD x\ntwo: ST x", "T010", 6, "the ways to the label `two` bring different types"),
    ("LD x\nagain: ADD 1\nGT 5\nJMPCN again", "T010", 4, "the ways to the label `again`"),
]


@pytest.mark.parametrize(("body", "code", "line", "text"), WRONG, ids=[each[0] for each in WRONG])
def test_what_is_wrong(body: str, code: str, line: int, text: str) -> None:
    checked = check_sources({"a.st": f"{HEAD}{body}\nEND_PROGRAM\n"}, MODEL)
    found = [(each.code, each.span.line) for each in checked.problems]
    assert (code, line) in found, "\n".join(map(str, checked.problems))
    assert any(text in each.message for each in checked.problems if each.code == code)
    assert checked.program is None


def test_one_problem_is_told_once() -> None:
    """What follows from an unknown current result is not told again."""
    body = "LD gone\nADD 1\nST x\nMUL 2\nST y\nLD b\nST c\n"
    problems = check_sources({"a.st": f"{HEAD}{body}END_PROGRAM\n"}, MODEL).problems
    assert [(each.code, each.span.line) for each in problems] == [("T001", 3)]


def test_problems_of_rounds_are_told_once() -> None:
    """A label whose current result comes from a jump back is looked at again; its problems and warnings are not."""
    body = "LD x\nJMP second\nfirst: ADD gone\nST y\nRET\nLD x\nsecond: ADD 1\nJMP first\n"
    problems = check_sources({"a.st": f"{HEAD}{body}END_PROGRAM\n"}, MODEL).problems
    assert [(each.code, each.span.line) for each in problems] == [("T001", 5), ("W001", 8)]


def test_many_jumps_back_end_soon() -> None:
    """Each label brings another type to the one before it: the rounds are bounded, and every use is told."""
    kinds = ("x", "b", "d")
    lines = ["LD x", "JMP L0"]
    for number in range(60):
        lines += [f"L{number}: LD {kinds[number % 3]}", f"JMP L{(number * 7 + 3) % 60}"]
    lines += ["L60: ST x"]
    problems = check_sources({"a.st": HEAD + "\n".join(lines) + "\nEND_PROGRAM\n"}, MODEL).problems
    assert all(each.code == "W001" or each.span.line > 3 for each in problems)


def test_each_instruction_is_a_statement() -> None:
    """A breakpoint can be set on every line that does something."""
    body = "LD x\nADD 1\nST x\nGT 5\nJMPC done\nLD 7\nST y\ndone: CAL t(IN := b)\nRET\n"
    program = check_sources({"a.st": f"{HEAD}{body}END_PROGRAM\n"}, MODEL).program
    assert program is not None
    (blocks,) = program.pous[-1].body
    lines = [statement.span.line for block in blocks.blocks for statement in block]  # type: ignore[union-attr]
    assert lines == [3, 4, 5, 6, 7, 8, 9, 10, 11]
