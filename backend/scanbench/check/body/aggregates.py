"""All values of an array or structure among the statements, as vendors write them: `numbers := [1, 2, 3(0)]`."""

from dataclasses import replace

from scanbench.check.body.allowed import allowed, may
from scanbench.check.body.coercion import as_type
from scanbench.check.body.context import Body
from scanbench.check.declare.declarations import StartExpression
from scanbench.check.declare.initial_values import with_references
from scanbench.check.dialect import Allowance
from scanbench.program.program import Assign, Expr, Load, Sequence, SetBytes, Stmt
from scanbench.program.types import ArrayType, Record, Type, has_instance
from scanbench.syntax import tree


def aggregate(body: Body, node: tree.Aggregate, wanted: Type | None) -> Expr:
    """A hidden variable with these values: they are all computed before anything is assigned."""
    value = _one_assignment(node)
    if value is not None and not isinstance(wanted, ArrayType | Record) and may(body, Allowance.ASSIGNED_VALUES):
        return body.expression(value)
    what = "This is all that an array or structure has"
    if not allowed(body, Allowance.LITERAL_VALUES, node.span, what):
        raise body.report.reject(
            "S003",
            "Only a declaration gives all values of an array or structure; among the statements assign them one by one.",
            node.span,
        )
    if not isinstance(wanted, ArrayType | Record) or has_instance(wanted):
        raise body.report.reject(
            "T002", "Only an array, or a structure without instances of blocks, is assigned like this.", node.span
        )
    declared = body.declarations
    outer, declared.in_body = declared.in_body, True
    try:
        data, given = with_references(declared, node.value, wanted)
    finally:
        declared.in_body = outer
    whole = body.temporary(wanted, node.span)
    made: list[Stmt] = [SetBytes(whole, data, node.span)]
    for each in given:
        if not isinstance(each, StartExpression):
            continue
        part = replace(whole, type=each.type, offset=whole.offset + each.offset)
        made.append(Assign(part, as_type(body, each.node, each.type, "This value"), each.node.span))
    return Sequence(tuple(made), Load(whole))


def _one_assignment(node: tree.Aggregate) -> tree.Expression | None:
    """`(b := 1)`, which is the same text as a structure with one member."""
    members = node.value.members if isinstance(node.value, tree.StructInit) else ()
    if len(members) != 1:
        return None
    name, value, span = members[0]
    if isinstance(value, tree.ArrayInit | tree.StructInit):
        return None
    return tree.BinaryOp("assign", tree.Name(name, span), value, node.span)
