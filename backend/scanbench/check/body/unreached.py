"""Statements that nothing can reach: only what is certain without knowing any value."""

from itertools import pairwise

from scanbench.check.body.context import Body
from scanbench.syntax import tree
from scanbench.syntax.source import Stretch

LEAVES = {tree.ReturnStatement: "RETURN", tree.ExitStatement: "EXIT", tree.ContinueStatement: "CONTINUE"}


def unreached(body: Body, statements: tuple[tree.Statement, ...]) -> None:
    """What comes after a statement that always leaves."""
    for before, after in pairwise(statements):
        word = LEAVES.get(type(before))
        if word is not None:
            body.report.warn(
                "W007", f"This is never reached: the {word} before it always leaves. Remove one of them, or put "
                f"the {word} into an IF.", after.span,
            )  # fmt: skip
            return


def never_chosen(body: Body, node: tree.IfStatement) -> None:
    """What is under a condition that says FALSE. A CONSTANT that is FALSE is a switch, and means something."""
    for test, inner in node.branches:
        if inner and _says_false(test):
            body.report.warn(
                "W007", "This is never reached: its condition is FALSE. Remove it, or make the condition a CONSTANT "
                "that switches it.", inner[0].span,
            )  # fmt: skip


def _says_false(test: tree.Expression) -> bool:
    """A condition that could not be read is FALSE as well, but nobody wrote that."""
    span = test.span
    literal = isinstance(test, tree.Literal) and test.kind == "bool" and test.value == 0
    return literal and isinstance(span, Stretch) and span.source.text[span.start : span.end].upper() == "FALSE"
