"""Texts of Logix, which are structures of a length and characters: `a = b` and the like compare what is in them."""

from dataclasses import replace

from scanbench.check.body.allowed import may, used
from scanbench.check.body.context import Body
from scanbench.check.body.generic import tried
from scanbench.check.context import Rejected
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.types import DINT, ELEMENTARY, ArrayType, Record, Type
from scanbench.syntax import tree

TEXT = "LOGIX.STRING82"
SINT = ELEMENTARY["SINT"]
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
    made = _compared(node, types)
    if made is not None:
        used(body, Allowance.TEXT_STRUCTURES, node.span, "Texts are compared")
    return node if made is None else made


def _compared(node: tree.BinaryOp, types: list[Type | None]) -> tree.BinaryOp | None:
    """The comparison of texts of these types with 0; None where they are none."""
    span, zero = node.span, tree.Literal("int", 0, None, node.span)
    if all(map(_is_text, types)):
        return replace(node, left=_call("COMPARE", (node.left, node.right), span), right=zero)
    if not all(_is_text(each) or _is_own_text(each) for each in types):
        return None
    left, right = node.left, node.right
    if isinstance(left, tree.Call) or isinstance(right, tree.Call):
        variable, value = (right, left) if isinstance(left, tree.Call) else (left, right)
        number = _call("COMPARE_TO", (*_where(variable), value), span)
        return replace(node, left=zero, right=number) if variable is right else replace(node, left=number, right=zero)
    return replace(node, left=_call("COMPARE_AT", (*_where(left), *_where(right)), span), right=zero)


def _where(node: tree.Expression) -> tuple[tree.Expression, tree.Expression]:
    """Where the characters of a text are, and how many there are."""
    span = node.span
    first = tree.IndexOf(tree.MemberOf(node, "DATA", span), (tree.Literal("int", 0, None, span),), span)
    return tree.Call(tree.Name("ADR", span), (tree.Argument(None, False, first, span),), span), tree.MemberOf(
        node, "LEN", span
    )


def _call(name: str, values: tuple[tree.Expression, ...], span: Span) -> tree.Call:
    arguments = tuple(tree.Argument(None, False, each, each.span) for each in values)
    return tree.Call(tree.MemberOf(tree.Name("Logix", span), name, span), arguments, span)


def _is_operand(node: tree.Expression) -> bool:
    """Whether it may be a text: a variable, or a call like `Logix.TEXT('on')`."""
    return isinstance(node, tree.Name | tree.MemberOf | tree.IndexOf | tree.Call)


def _is_text(type: Type | None) -> bool:
    return isinstance(type, Record) and type.name.upper() == TEXT


def _is_own_text(type: Type | None) -> bool:
    """Whether it is a structure of LEN and DATA, as string types of the user are."""
    if not isinstance(type, Record) or set(type.members) != {"LEN", "DATA"}:
        return False
    data = type.members["DATA"].type
    return (
        type.members["LEN"].type == DINT
        and isinstance(data, ArrayType)
        and data.element == SINT
        and data.bounds[0][0] == 0
    )
