"""Calls -> checked calls: for their value, and as statements."""

from scanbench.check.body.arguments import as_value, together
from scanbench.check.body.block_calls import call_block, names_instance
from scanbench.check.body.callees import callee_of, invoked, standard_function
from scanbench.check.body.context import Body
from scanbench.check.body.enabling import enabled, enabling
from scanbench.check.body.forms import form
from scanbench.check.body.instructions import instructed
from scanbench.program.program import Assign, CallFunction, Evaluate, Expr, Sequence, Stmt, Violates
from scanbench.program.types import BOOL, Type
from scanbench.syntax import tree


def call(body: Body, node: tree.Call, wanted: Type | None = None) -> Expr:
    """A call for its value."""
    node = instructed(body, node, wanted)
    apart = enabling(node)
    if apart.en is not None or apart.eno is not None:
        statements, value = enabled(body, apart, wanted)
        if value is None:
            raise body.report.reject("T010", "This has no result; call it as a statement.", node.span)
        return Sequence(tuple(statements), value)
    callee = callee_of(body, node.callee, node)
    if callee is not None:
        return as_value(body, invoked(body, callee, node), node.span)
    return standard_function(body, node, wanted)


def call_statement(body: Body, node: tree.Call) -> Stmt | None:
    """A call as a statement: of an instance, or of a function or method whose result is dropped."""
    node = instructed(body, node)
    apart = enabling(node)
    callee = callee_of(body, node.callee, apart.call)
    if callee is None and names_instance(body, node.callee):
        return call_block(body, node)
    if apart.en is not None or apart.eno is not None:
        return together(enabled(body, apart, None)[0], node.span)
    if callee is not None:
        return together(invoked(body, callee, node).statements(node.span), node.span)
    value = form(body, node) or standard_function(body, node, None)
    if isinstance(value, Violates) and value.site:
        return Assign(body.temporary(BOOL, node.span), value, node.span)
    if isinstance(value, CallFunction):
        return Evaluate(value, node.span)
    if isinstance(value, Sequence):
        last = [Evaluate(value.value, node.span)] if isinstance(value.value, CallFunction) else []
        return together([*value.body, *last], node.span)
    body.report.warn("W001", "The result of this call is dropped.", node.span)
    return None
