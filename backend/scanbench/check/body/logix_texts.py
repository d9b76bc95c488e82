"""Texts of Logix, which are structures of a length and characters: `a = b` and the like compare what is in them."""

from dataclasses import replace

from scanbench.check.body.allowed import may, used
from scanbench.check.body.context import Body
from scanbench.check.body.generic import tried
from scanbench.check.context import Rejected
from scanbench.check.dialect import Allowance
from scanbench.program.types import Record, Type
from scanbench.syntax import tree

TEXT = "LOGIX.STRING82"
COMPARED = frozenset(("eq", "ne", "lt", "le", "gt", "ge"))


def with_texts(body: Body, node: tree.BinaryOp) -> tree.BinaryOp:
    """A comparison of two texts as one of the number that `Logix.COMPARE` gives; others as they are."""
    if node.op not in COMPARED or not may(body, Allowance.TEXT_STRUCTURES):
        return node
    if not (_is_operand(node.left) and _is_operand(node.right)):
        return node
    try:
        types = [tried(body, each).type for each in (node.left, node.right)]
    except Rejected:
        return node
    if not all(map(_is_text, types)):
        return node
    used(body, Allowance.TEXT_STRUCTURES, node.span, "Texts are compared")
    function = tree.MemberOf(tree.Name("Logix", node.span), "COMPARE", node.span)
    arguments = tuple(tree.Argument(None, False, each, each.span) for each in (node.left, node.right))
    zero = tree.Literal("int", 0, None, node.span)
    return replace(node, left=tree.Call(function, arguments, node.span), right=zero)


def _is_operand(node: tree.Expression) -> bool:
    """Whether it may be a text: a variable, or a call like `Logix.TEXT('on')`."""
    return isinstance(node, tree.Name | tree.MemberOf | tree.IndexOf | tree.Call)


def _is_text(type: Type | None) -> bool:
    return isinstance(type, Record) and type.name.upper() == TEXT
