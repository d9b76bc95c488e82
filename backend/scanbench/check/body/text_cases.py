"""CASE of a text or a character, as SIMATIC AX has it: its labels are compared one after the other."""

from functools import reduce

from scanbench.check.body.context import Body
from scanbench.program.types import Elementary, Kind, StringType, Type
from scanbench.syntax import tree

TEXT_CASE = "CASE chooses by a text"


def is_text(type: Type) -> bool:
    """Whether values of this type are texts or characters."""
    return isinstance(type, StringType) or (isinstance(type, Elementary) and type.kind is Kind.CHAR)


def as_comparisons(body: Body, node: tree.CaseStatement, type: Type, held: str) -> tree.IfStatement:
    """The CASE as an IF of comparisons with the variable `held`, which has the value of the selector."""
    selector = tree.Name(held, node.selector.span)
    branches = []
    for labels, inner in node.branches:
        tests: list[tree.Expression] = []
        for first, last in labels:
            if last is not None and isinstance(type, StringType):
                raise body.report.reject("T007", "A range of texts is no label; write each of them.", first.span)
            if last is None:
                tests.append(tree.BinaryOp("eq", selector, first, first.span))
            else:
                low = tree.BinaryOp("ge", selector, first, first.span)
                tests.append(tree.BinaryOp("and", low, tree.BinaryOp("le", selector, last, last.span), first.span))
        branches.append((reduce(lambda one, two: tree.BinaryOp("or", one, two, two.span), tests), inner))
    return tree.IfStatement(tuple(branches), node.orelse, node.span)
