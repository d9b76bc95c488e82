"""MOVE_BLK and FILL_BLK of TIA Portal: elements of arrays that are copied or filled, one assignment for each."""

from dataclasses import replace

from scanbench.check.body.allowed import may, used
from scanbench.check.body.arguments import together
from scanbench.check.body.assignments import assign
from scanbench.check.body.context import Body
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Const, Stmt
from scanbench.syntax import tree

MOVES = frozenset(("MOVE_BLK", "UMOVE_BLK", "FILL_BLK", "UFILL_BLK"))
MOST = 256
"""Elements of one instruction; each is an assignment."""
FORMALS = ("IN", "COUNT", "OUT")


def block_move(body: Body, node: tree.Call) -> Stmt | None:
    """The assignments that the instruction makes; None where this is none."""
    if not isinstance(node.callee, tree.Name) or node.callee.name.upper() not in MOVES:
        return None
    if not may(body, Allowance.BLOCK_MOVES) or node.callee.name.upper() in body.pous.functions:
        return None
    name, span = node.callee.name.upper(), node.span
    source, count, target = _given(body, node, name)
    known = body.expression(count)
    number = known.value if isinstance(known, Const) else None
    if not isinstance(number, int) or not 0 < number <= MOST:
        raise body.report.reject(
            "X001", f"`{name}` is read with a constant COUNT of 1 to {MOST}. Write a loop: FOR i := 0 TO n - 1 DO b[i] := a[i]; END_FOR.",
            count.span,
        )  # fmt: skip
    fills = "FILL" in name
    used(body, Allowance.BLOCK_MOVES, node.callee.span, f"`{name}` assigns {number} elements of an array")
    made = []
    for at in range(number):
        value = source if fills else _element(body, source, at, name)
        made.append(assign(body, tree.Assignment(_element(body, target, at, name), value, span)))
    return together(made, span)


def _given(body: Body, node: tree.Call, name: str) -> tuple[tree.Expression, tree.Expression, tree.Expression]:
    given: dict[str, tree.Expression] = {}
    for at, argument in enumerate(node.arguments):
        formal = FORMALS[min(at, 2)] if argument.name is None else argument.name.upper()
        if argument.value is not None:
            given[formal] = argument.value
    missing = next((formal for formal in FORMALS if formal not in given), None)
    if missing is not None or len(given) > len(FORMALS):
        raise body.report.reject("T004", f"`{name}` takes IN, COUNT and OUT.", node.span)
    return given["IN"], given["COUNT"], given["OUT"]


def _element(body: Body, node: tree.Expression, ahead: int, name: str) -> tree.Expression:
    """The element so many places after this one."""
    if not isinstance(node, tree.IndexOf):
        raise body.report.reject("T002", f"`{name}` begins with an element of an array, `a[0]`.", node.span)
    index = tree.BinaryOp("add", node.indices[-1], _number(ahead, node.span), node.span) if ahead else node.indices[-1]
    return replace(node, indices=(*node.indices[:-1], index))


def _number(value: int, span: Span) -> tree.Expression:
    return tree.Literal("int", value, None, span)
