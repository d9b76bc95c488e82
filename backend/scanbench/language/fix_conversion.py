"""Conversions: the operand gets one that does not fit, not the expression around it."""

import re
from collections.abc import Iterator
from itertools import pairwise

from scanbench.check.body.coercion import name_in_conversions
from scanbench.check.body.context import Body
from scanbench.check.context import Rejected
from scanbench.check.declare.names import Space
from scanbench.language.complete import parsed
from scanbench.language.fix import Fix, balanced, stretch
from scanbench.language.reading import Around, Reading
from scanbench.problems import Problem
from scanbench.program.untyped import settle
from scanbench.syntax import tree

CONVERT = re.compile(r"Convert it with (\w+_TO_\w+)\b")


def conversions(reading: Reading, file: str, problem: Problem, start: int, end: int) -> Iterator[Fix]:
    """What the problem tells people to convert."""
    told = CONVERT.search(problem.message)
    if told is None:
        return
    text, function = reading.text(file), told.group(1)
    start, end = balanced(text, start, end)
    written = text[start:end]
    node = parsed(written)
    if node is None:
        return
    around = reading.around(file, start)
    body = None if around is None else reading.body(around)
    wanted = function.partition("_TO_")[0]
    parts: list[tree.Expression] = []
    if around is not None and body is not None and _type(reading, body, around, node) != wanted:
        parts = [each for each in _operands(node) if _type(reading, body, around, each) == wanted]
        if not parts:
            return
    places = [balanced(written, *stretch(each.span)) for each in parts] or [(0, len(written))]
    made = written
    for first, last in reversed(places):
        made = f"{made[:first]}{function}({made[first:last]}){made[last:]}"
    if all(before[1] <= after[0] for before, after in pairwise(places)) and parsed(made) is not None:
        yield Fix(f"Convert with {function}", start, end, made)


def _operands(node: tree.Expression) -> list[tree.Expression]:
    if isinstance(node, tree.BinaryOp):
        return [node.left, node.right]
    if isinstance(node, tree.UnaryOp):
        return [node.operand]
    if isinstance(node, tree.Call):
        return [each.value for each in node.arguments if each.value is not None and not each.output]
    return []


def _type(reading: Reading, body: Body, around: Around, node: tree.Expression) -> str:
    """The type of an expression as the names of conversions have it; empty where it has none."""
    with reading.project.checker.declarations.names.within(Space(around.pou.namespace, around.pou.using)):
        try:
            return name_in_conversions(settle(body.expression(node)).type)
        except Rejected:
            return ""
