"""Variables of an interface: what may be assigned to them, and the assignment attempt."""

from scanbench.check.body.arguments import together
from scanbench.check.body.dispatch import type_number
from scanbench.check.body.methods import MethodChecker
from scanbench.check.body.references import reference_type
from scanbench.check.context import Rejected
from scanbench.problems import Span
from scanbench.program.program import Assign, Base, Case, Compare, Const, Expr, If, Load, Place, RefOf, Stmt, TrapKind
from scanbench.program.types import BOOL, NULL, Kind, Record, Reference, Type, is_derived
from scanbench.syntax import tree


class InterfaceChecker(MethodChecker):
    def as_interface(self, expr: Expr, type: Reference, span: Span) -> Expr | None:
        if not _to_interface(type) or not isinstance(expr, Load) or not isinstance(expr.place.type, Record):
            return None
        place, target = expr.place, type.target
        assert isinstance(target, Record)
        if not is_derived(expr.place.type, target):
            if expr.place.type.open:
                raise Rejected
            raise self.report.reject(
                "T002", f"`{expr.place.type.name}` does not implement the interface `{target.name}`.", span
            )
        if place.base is Base.FRAME and place.slot is None and place.reference is None:
            raise self.report.reject("T013", "A temporary instance cannot be referred to.", span)
        return RefOf(place, type)

    def attempt(self, node: tree.Assignment) -> Stmt:
        """`target ?= value`: NULL unless the instance is of a class that fits the target."""
        target = self.target(node.target)
        wanted = target.type
        owner = self.pous.classes.of(wanted.target) if isinstance(wanted, Reference) else None
        if not isinstance(wanted, Reference) or owner is None:
            raise self.report.reject(
                "T002", f"`?=` needs an interface or a reference to a class, not {wanted}.", node.target.span
            )
        value = self._attempted(node.value)
        source = self.pous.classes.of(value.type.target) if isinstance(value.type, Reference) else None
        if source is None or source.record is None:
            raise self.report.reject("T002", "`?=` needs an interface, a reference or an instance.", node.value.span)
        if not source.polymorphic:
            raise self.report.reject(
                "T002", f"`{source.name}` has no part in inheritance, so the attempt can be decided now.", node.span
            )
        found = self.temporary(wanted, node.span)
        fits = [each.number for each in owner.family() if not each.abstract]
        trap = self.trap(TrapKind.NULL, node.span, "this refers to no instance")
        number = type_number(Place(source.record, Base.IMAGE, 0, reference=Load(found), null_trap=trap))
        take = Assign(target, Load(found), node.span)
        drop = Assign(target, Const(wanted, 0), node.span)
        branch = (tuple((each, each) for each in fits), (take,))
        choice: Stmt = Case(Load(number), (branch,), (drop,), node.span) if fits else drop
        nothing = Compare("eq", BOOL, Load(found), Const(NULL, 0))
        test = If(((nothing, (drop,)),), (choice,), node.span)
        return together([Assign(found, value, node.span), test], node.span)

    def _attempted(self, node: tree.Expression) -> Expr:
        if isinstance(node, tree.Name | tree.MemberOf | tree.IndexOf | tree.Dereference) and self.is_variable(node):
            place, _ = self.place(node)
            if isinstance(place.type, Record):
                return RefOf(place, reference_type(place.type))
            return Load(place)
        return self.value(node)


def _to_interface(type: Type) -> bool:
    return isinstance(type, Reference) and isinstance(type.target, Record) and type.target.kind is Kind.INTERFACE
