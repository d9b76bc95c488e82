"""The assignment attempt, `?=`."""

from scanbench.check.body import targets
from scanbench.check.body.arguments import together
from scanbench.check.body.coercion import value_of
from scanbench.check.body.context import Body
from scanbench.check.body.dispatch import type_number
from scanbench.check.body.receivers import is_variable
from scanbench.check.body.references import reference_type
from scanbench.program.program import Assign, Base, Case, Compare, Const, Expr, If, Load, Place, RefOf, Stmt
from scanbench.program.sites import TrapKind
from scanbench.program.types import BOOL, NULL, Record, Reference
from scanbench.syntax import tree


def attempt(body: Body, node: tree.Assignment) -> Stmt:
    """`target ?= value`: NULL unless the instance is of a class that fits the target."""
    target = targets.target(body, node.target)
    wanted = target.type
    owner = body.pous.classes.of(wanted.target) if isinstance(wanted, Reference) else None
    if not isinstance(wanted, Reference) or owner is None:
        raise body.report.reject(
            "T002", f"`?=` needs an interface or a reference to a class, not {wanted}.", node.target.span
        )
    value = _attempted(body, node.value)
    source = body.pous.classes.of(value.type.target) if isinstance(value.type, Reference) else None
    if source is None or source.record is None:
        raise body.report.reject("T002", "`?=` needs an interface, a reference or an instance.", node.value.span)
    if not source.polymorphic:
        raise body.report.reject(
            "T002", f"`{source.name}` has no part in inheritance, so the attempt can be decided now.", node.span
        )
    found = body.temporary(wanted, node.span)
    fits = [each.number for each in owner.family() if not each.abstract]
    trap = body.trap(TrapKind.NULL, node.span, "this refers to no instance")
    number = type_number(Place(source.record, Base.IMAGE, 0, reference=Load(found), null_trap=trap))
    take = Assign(target, Load(found), node.span)
    drop = Assign(target, Const(wanted, 0), node.span)
    branch = (tuple((each, each) for each in fits), (take,))
    choice: Stmt = Case(Load(number), (branch,), (drop,), node.span) if fits else drop
    nothing = Compare("eq", BOOL, Load(found), Const(NULL, 0))
    test = If(((nothing, (drop,)),), (choice,), node.span)
    return together([Assign(found, value, node.span), test], node.span)


def _attempted(body: Body, node: tree.Expression) -> Expr:
    if isinstance(node, tree.Name | tree.MemberOf | tree.IndexOf | tree.Dereference) and is_variable(body, node):
        place, _ = body.place(node)
        if isinstance(place.type, Record):
            return RefOf(place, reference_type(place.type))
        return Load(place)
    return value_of(body, node)
