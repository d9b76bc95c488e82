"""Calls of methods and uses of properties: which method, and what runs."""

from dataclasses import replace

from scanbench.check.body.arguments import Invocation, as_value, invoke, together
from scanbench.check.body.context import Body
from scanbench.check.body.dispatch import Dispatcher
from scanbench.check.body.objects import is_open, own_class
from scanbench.check.body.receivers import Receiver, accessor
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Method
from scanbench.check.declare.creations import FB_INIT
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Expr, Place, Pou, Stmt
from scanbench.syntax import tree


def send(body: Body, receiver: Receiver, method: Method, node: tree.Call, eno: Place | None = None) -> Invocation:
    """The call of a method."""
    declaration = method.declaration
    if not is_open(body, declaration.access, own_class(body), method.owner):
        raise body.report.reject(
            "T014", f"`{method.name}` is {declaration.access} and cannot be called from here.", node.span
        )
    _not_implicit(body, receiver, method, node.span)
    callee = _reached(body, receiver, method, node.span)
    place = receiver.place
    wanted = callee.frame.members["THIS"].type
    return invoke(body, node, callee, method.name, replace(place, type=wanted), eno)


def _not_implicit(body: Body, receiver: Receiver, method: Method, span: Span) -> None:
    """Refuses calls of FB_init where it runs by itself: the vendors' tools would initialise the whole instance again."""
    if Allowance.LIFE not in body.dialect.allows or method.declaration.name.upper() != FB_INIT:
        return
    if receiver.above:
        message = f"`{method.name}` has run already, before this FB_init; leave this call out."
    else:
        message = (
            f"`{method.name}` is called when the instance is initialised, and a call would initialise all of its variables "
            "again, which is not supported. Put what you need into a method of another name, and call that in both places."
        )
    raise body.report.reject("X001", message, span)


def _reached(body: Body, receiver: Receiver, method: Method, span: Span) -> Pou:
    """The POU that runs: the method itself where the class is known, else one that finds out."""
    made = method.pou
    if not (receiver.exact or receiver.above):
        dispatcher = Dispatcher(body.report, body.pous)
        through = receiver.place.reference is not None or receiver.owner.kind == "interface"
        made = dispatcher.method(receiver.owner, method, always=through)
    elif method.abstract:
        raise body.report.reject("T010", f"`{method.name}` is ABSTRACT; it has no body to call.", span)
    if made is None:
        raise Rejected  # its declaration is wrong, which was reported
    return made


def property_value(body: Body, node: tree.Expression) -> Expr | None:
    """What reading the property gives; None when this is no property."""
    found = accessor(body, node, ".GET")
    if found is None:
        return None
    return as_value(body, send(body, *found, tree.Call(node, (), node.span)), node.span)


def assign_property(body: Body, target: tree.Expression, value: tree.Expression, span: Span) -> Stmt | None:
    """The assignment to a property; None when the target is no property."""
    found = accessor(body, target, ".SET")
    if found is None:
        return None
    argument = tree.Argument(None, False, value, value.span)
    return together(send(body, *found, tree.Call(target, (argument,), span)).statements(span), span)
