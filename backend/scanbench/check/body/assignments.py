"""Assignments: `:=` of everything that can be copied, `S=` and `R=`."""

from contextlib import suppress
from dataclasses import replace

from scanbench.check.body.arguments import together
from scanbench.check.body.calls import CallChecker
from scanbench.check.body.places import Found
from scanbench.check.context import Rejected
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, If, Load, Place, Pou, Stmt
from scanbench.program.shown import shown
from scanbench.program.types import BOOL, ArrayType, Kind, Member, Record, Section, Type, has_instance
from scanbench.program.untyped import ANY_INT, settle
from scanbench.syntax import tree


class AssignmentChecker(CallChecker):
    """What ST writes as an assignment, and IL as ST, S and R."""

    _counters: list[Place]
    """Control variables of the FOR loops around."""

    def assign(self, node: tree.Assignment) -> Stmt:
        """One assignment, by any operator."""
        match node.operator:
            case "S=" | "R=":
                return self._latch(node)
            case "REF=":
                return Assign(*self.bind(node.target, node.value, node.span), node.span)
            case "?=":
                return self.attempt(node)
        setter = self.assign_property(node.target, node.value, node.span)
        if setter is not None:
            return setter
        target, member = self._target(node)
        if has_instance(target.type):
            raise self.report.reject("T003", "An instance of a function block cannot be assigned.", node.span)
        what = f"`{shown(node.target)}`"
        note = self.noting(target, member)
        if isinstance(target.type, ArrayType | Record):
            copied = Assign(target, self._whole(node.value, target.type, what), node.span)
            return copied if note is None else together([copied, Assign(note, Load(target), node.span)], node.span)
        value = self.as_type(node.value, target.type, what)
        return Assign(target, self.keeping(value, note, node.span), node.span)

    def _target(self, node: tree.Assignment) -> Found:
        """What is assigned; where that is wrong, the value is checked all the same."""
        try:
            target, member = self.declared_target(node.target)
        except Rejected:
            with suppress(Rejected):
                self.expr(node.value)
            raise
        self._not_counter(target, node)
        return target, member

    def _whole(self, node: tree.Expression, type: Type, what: str) -> Expr:
        """A whole array or structure: of this type, or an array of as many elements of the same type."""
        value = self.expr(node, type)
        if isinstance(value, Load) and value.type != type and alike(value.type, type):
            return Load(replace(value.place, type=type))
        return self.coerce(value, type, node.span, what)

    def _latch(self, node: tree.Assignment) -> Stmt:
        """`x S= b`: TRUE where b is TRUE, else as it was; `x R= b`: FALSE where b is TRUE."""
        condition = self.condition(node.value)
        literal = tree.Literal("bool", int(node.operator == "S="), None, node.span)
        plain = tree.Assignment(node.target, literal, node.span)
        mark = self.report.mark()
        if self.accessor(node.target) is None and (type := self._target(plain)[0].type) != BOOL:
            word = "set" if node.operator == "S=" else "reset"
            raise self.report.reject("T002", f"Only a BOOL can be {word}; this is {type}.", node.target.span)
        self.report.undo(mark)
        return If(((condition, (self.assign(plain),)),), (), node.span)

    def condition(self, node: tree.Expression) -> Expr:
        """The condition; a wrong one is reported and taken as FALSE, so that the body is checked as well."""
        try:
            expr = self.expr(node)
            if isinstance(expr, Const) and expr.type == ANY_INT and expr.value in (0, 1):
                return Const(BOOL, expr.value)
            if expr.type != BOOL:
                raise self.report.reject("T006", f"A condition is BOOL, not {settle(expr).type}.", node.span)
        except Rejected:
            return Const(BOOL, 0)
        return expr

    def _not_counter(self, target: Place, node: tree.Assignment) -> None:
        for counter in self._counters:
            same = (counter.base, counter.offset, counter.slot, counter.bit)
            if (target.base, target.offset, target.slot, target.bit) == same and target.type == counter.type:
                raise self.report.reject(
                    "T008", f"`{shown(node.target)}` counts this FOR loop and cannot be assigned in it; use EXIT to leave.",
                    node.span,
                )  # fmt: skip

    def calls(self) -> dict[Pou, int]:
        """Whom this POU calls, and from how many places."""
        return {} if self.pou is None else self.pous.uses.setdefault(self.pou, {})

    def hidden(self, name: str, type: Type, span: Span) -> Member:
        """The temporary of this name and type in the frame of the POU, made where there is none yet."""
        frame = self.scope.frame
        assert frame is not None
        while (known := frame.members.get(name.upper())) is not None:
            if known.type == type:
                return known
            name += "'"  # another type that is called the same
        member = Member(name, type, Section.TEMP, span, hidden=True)
        frame.place(member)
        frame.close()
        return member


def alike(first: Type | None, second: Type) -> bool:
    """Whether one may be assigned to the other: the same type, arrays of the same lengths of it, or variables of one declaration
    that writes its STRUCT out. Two structures that each have a name differ, whatever their members are."""
    if first is None or first == second:
        return first is not None
    if isinstance(first, ArrayType) and isinstance(second, ArrayType):
        lengths = [[high - low for low, high in each.bounds] for each in (first, second)]
        return lengths[0] == lengths[1] and alike(first.element, second.element)
    if not isinstance(first, Record) or not isinstance(second, Record):
        return False
    declared = [[member.span for member in each.members.values()] for each in (first, second)]
    return first.kind is Kind.STRUCT and first.written_out and declared[0] == declared[1]
