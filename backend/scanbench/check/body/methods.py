"""Calls of methods and uses of properties: which instance, which method, and what runs."""

from dataclasses import dataclass, replace

from scanbench.check.body.arguments import Invocation, together
from scanbench.check.body.dispatch import Dispatcher
from scanbench.check.body.objects import ObjectChecker, dotted, named_itself
from scanbench.check.body.references import reference_type
from scanbench.check.context import Rejected, did_you_mean
from scanbench.check.declare.classes import Class, Method
from scanbench.problems import Span
from scanbench.program.program import Assign, Base, Expr, Load, Place, Pou, RefOf, Sequence, Stmt, TrapKind
from scanbench.program.types import ArrayType, Record, Reference, Section, has_instance
from scanbench.syntax import tree


@dataclass(frozen=True, slots=True)
class Receiver:
    """The instance that a call goes to."""

    place: Place
    owner: Class
    exact: bool
    """Whether the instance is of this class, and of none that extends it."""
    above: bool = False
    """SUPER: the call goes to what the class had from its base."""


class MethodChecker(ObjectChecker):
    # ---- who is called ----------------------------------------------------------------------------------

    def method_called(self, callee: tree.Expression) -> tuple[Receiver, Method] | None:
        """The instance and the method that this names; None when it names something else."""
        return self._looked_up(callee, "")

    def _looked_up(self, node: tree.Expression, half: str) -> tuple[Receiver, Method] | None:
        if isinstance(node, tree.Name):
            owner = self.own_class()
            found = owner.find(f"{node.name.upper()}{half}") if owner and self._free(node.name) else None
            if owner is None or found is None:
                return None
            return Receiver(self.self_place("THIS", node.span), owner, exact=False), found
        if not isinstance(node, tree.MemberOf) or self._is_qualified(node):
            return None
        receiver = self.receiver(node.owner)
        if receiver is None:
            return None
        method = receiver.owner.find(f"{node.name.upper()}{half}")
        if method is None:
            record = receiver.owner.record
            if half or (record is not None and node.name.upper() in record.members):
                return None
            if record is not None and (record.open or self.is_broken(record, node.name)):
                raise Rejected
            known = [each.declaration.name for parent in (receiver.owner, *receiver.owner.ancestors())
                     for each in parent.methods.values()]  # fmt: skip
            raise self.report.reject(
                "T001",
                f"`{receiver.owner.name}` has no method `{node.name}`.{did_you_mean(node.name, known)}",
                node.span,
            )
        return receiver, method

    def _free(self, name: str) -> bool:
        """Whether no variable has this name; the result of a getter is no variable to other readers."""
        return self.scope.find(name) is None

    def _is_qualified(self, node: tree.MemberOf) -> bool:
        """`Namespace.name`, and nothing of an instance."""
        path = dotted(node)
        first = path.split(".")[0] if path else ""
        return (
            bool(path)
            and first.upper() not in ("THIS", "SUPER")
            and self.scope.find(first) is None
            and (not self._property_of_own(first))
        )

    def _property_of_own(self, name: str) -> bool:
        owner = self.own_class()
        return owner is not None and owner.find(f"{name.upper()}.GET") is not None

    def receiver(self, node: tree.Expression) -> Receiver | None:
        """The instance that this expression names; None when it names none."""
        for word in ("THIS", "SUPER"):
            if named_itself(node, word):
                place = self.self_place(word, node.span)
                owner = self.pous.classes.of(place.type)
                assert owner is not None
                return Receiver(place, owner, exact=False, above=word == "SUPER")
        value = self._reference_value(node)
        if value is not None:
            return self._referred(value, node)
        place, member = self.place(node)
        if isinstance(place.type, Reference):
            return self._referred(Load(place), node)
        owner = self.pous.classes.of(place.type)
        if owner is None or not isinstance(place.type, Record):
            return None
        declared = member is not None and member.type is place.type and member.section is not Section.IN_OUT
        return Receiver(place, owner, exact=declared or isinstance(node, tree.IndexOf))

    def _reference_value(self, node: tree.Expression) -> Expr | None:
        """A call or property that gives a reference to the instance."""
        if isinstance(node, tree.Call):
            value = self.call(node)
        else:
            got = self.property_value(node)
            if got is None:
                return None
            value = got
        if not isinstance(value.type, Reference):
            raise self.report.reject("T010", f"This is {value.type}, which has no methods.", node.span)
        return value

    def _referred(self, value: Expr, node: tree.Expression) -> Receiver | None:
        type = value.type
        assert isinstance(type, Reference)
        owner = self.pous.classes.of(type.target)
        if owner is None or owner.record is None:
            return None
        if owner.kind != "interface" and not type.automatic:
            raise self.report.reject("T010", "This is a reference; write `^` to get at the instance.", node.span)
        trap = self.trap(TrapKind.NULL, node.span, "this refers to no instance")
        place = Place(owner.record, Base.IMAGE, 0, reference=value, null_trap=trap)
        return Receiver(place, owner, exact=False)

    # ---- calls of methods -------------------------------------------------------------------------------

    def send(self, receiver: Receiver, method: Method, node: tree.Call, eno: Place | None = None) -> Invocation:
        """The call of a method."""
        declaration = method.declaration
        if not self._open(declaration.access, self.own_class(), method.owner):
            raise self.report.reject(
                "T014", f"`{method.name}` is {declaration.access} and cannot be called from here.", node.span
            )
        callee = self._reached(receiver, method, node.span)
        place = receiver.place
        wanted = callee.frame.members["THIS"].type
        return self.invoke(node, callee, method.name, replace(place, type=wanted), eno)

    def _reached(self, receiver: Receiver, method: Method, span: Span) -> Pou:
        """The POU that runs: the method itself where the class is known, else one that finds out."""
        made = method.pou
        if not (receiver.exact or receiver.above):
            dispatcher = Dispatcher(self.report, self.pous)
            through = receiver.place.reference is not None or receiver.owner.kind == "interface"
            made = dispatcher.method(receiver.owner, method, always=through)
        elif method.abstract:
            raise self.report.reject("T010", f"`{method.name}` is ABSTRACT; it has no body to call.", span)
        if made is None:
            raise Rejected  # its declaration is wrong, which was reported
        return made

    # ---- properties -------------------------------------------------------------------------------------

    def property_value(self, node: tree.Expression) -> Expr | None:
        """What reading the property gives; None when this is no property."""
        found = self._property(node, ".GET")
        if found is None:
            return None
        return self.as_value(self.send(*found, tree.Call(node, (), node.span)), node.span)

    def assign_property(self, target: tree.Expression, value: tree.Expression, span: Span) -> Stmt | None:
        """The assignment to a property; None when the target is no property."""
        found = self._property(target, ".SET")
        if found is None:
            return None
        argument = tree.Argument(None, False, value, value.span)
        return together(self.send(*found, tree.Call(target, (argument,), span)).statements(span), span)

    def _property(self, node: tree.Expression, half: str) -> tuple[Receiver, Method] | None:
        properties = self.pous.classes.properties
        if not isinstance(node, tree.Name | tree.MemberOf) or node.name.upper() not in properties:
            return None
        found = self._looked_up(node, half)
        if found is None and self._looked_up(node, ".SET" if half == ".GET" else ".GET") is not None:
            can = "read" if half == ".SET" else "assigned"
            raise self.report.reject("T010", f"The property `{node.name}` can only be {can}.", node.span)
        return found

    def accessor(self, node: tree.Expression) -> Expr | None:
        return self.property_value(node) if self.pous.classes.properties else None

    def _read(self, node: tree.Expression) -> Expr:
        if isinstance(node, tree.Name) and node.name.upper() == "THIS":  # vendors: a pointer to the instance
            place = self.self_place("THIS", node.span)
            return RefOf(place, reference_type(place.type, pointer=True))
        if isinstance(node, tree.MemberOf) and node.name.upper() not in self.pous.classes.properties:
            return self._part_of_value(node) or super()._read(node)
        return super()._read(node)

    def _element(self, node: tree.IndexOf) -> Expr:
        return self._part_of_value(node) or super()._element(node)

    def _part_of_value(self, node: tree.MemberOf | tree.IndexOf) -> Expr | None:
        """A member or element of what a property or call gives: of a copy, as the value itself has no place."""
        inner: tree.Expression = node
        value = None
        while value is None and isinstance(inner, tree.MemberOf | tree.IndexOf):
            inner = inner.owner if isinstance(inner, tree.MemberOf) else inner.array
            value = self._whole_value(inner)
        if value is None or not isinstance(value.type, Record | ArrayType) or has_instance(value.type):
            return None
        kept = self.temporary(value.type, node.span)
        name = kept.variable.rpartition(".")[2]
        part = self.expr(_replaced(node, inner, tree.Name(name, inner.span)))
        return Sequence((Assign(kept, value, node.span),), part)

    def _whole_value(self, node: tree.Expression) -> Expr | None:
        if isinstance(node, tree.Call):
            return self.call(node)
        return self.property_value(node) if self.pous.classes.properties else None

    def is_variable(self, node: tree.Expression) -> bool:
        return self._property(node, ".GET") is None if self.pous.classes.properties else True


def _replaced(node: tree.Expression, old: tree.Expression, new: tree.Expression) -> tree.Expression:
    """The same expression with another owner at its root."""
    if node is old:
        return new
    if isinstance(node, tree.MemberOf):
        return replace(node, owner=_replaced(node.owner, old, new))
    assert isinstance(node, tree.IndexOf)
    return replace(node, array=_replaced(node.array, old, new))
