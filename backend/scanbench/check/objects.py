"""Instances as objects: THIS and SUPER, methods, properties, interfaces."""

from dataclasses import dataclass, replace

from scanbench.check.arguments import ArgumentChecker, Invocation, together
from scanbench.check.classes import Class, Method
from scanbench.check.context import Rejected, did_you_mean
from scanbench.check.dispatch import Dispatcher, type_number
from scanbench.check.program import (
    Assign,
    Base,
    Case,
    Compare,
    Const,
    Expr,
    If,
    Load,
    Place,
    Pou,
    RefOf,
    Sequence,
    Stmt,
    TrapKind,
    TrapSite,
)
from scanbench.check.references import reference_type
from scanbench.check.types import (
    BOOL,
    NULL,
    ArrayType,
    Kind,
    Member,
    Record,
    Reference,
    Section,
    Type,
    has_instance,
    is_derived,
)
from scanbench.problems import Span
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


def named_itself(node: tree.Expression, word: str) -> bool:
    """`THIS` or `THIS^`, likewise for SUPER."""
    if isinstance(node, tree.Dereference):
        node = node.reference
    return isinstance(node, tree.Name) and node.name.upper() == word


class ObjectChecker(ArgumentChecker):
    # ---- THIS and SUPER ---------------------------------------------------------------------------------

    def own_class(self) -> Class | None:
        """The class whose body or method this is."""
        return self.pous.classes.of(self.scope.instance)

    def self_place(self, name: str, span: Span) -> Place:
        """The instance that runs: THIS, or as its base SUPER."""
        owner = self.own_class()
        if owner is None or owner.record is None:
            raise self.report.reject("T010", f"{name} is the instance that runs; a FUNCTION has none.", span)
        record = owner.record
        if name.upper() == "SUPER":
            if owner.base is None or owner.base.record is None:
                raise self.report.reject("T010", f"`{owner.name}` extends nothing, so it has no SUPER.", span)
            record = owner.base.record
        return self.own(Place(record, Base.SELF, 0))

    def own(self, place: Place) -> Place:
        """A place of the instance, as the body sees it: behind the slot of THIS in a method."""
        this = self.scope.this
        if this is None:
            return place
        if place.slot is not None:
            return replace(place, slot=self.own(place.slot))
        if place.base is not Base.SELF:
            return place
        return replace(place, base=Base.FRAME, slot=this, null_trap=self._this_trap(), variable="")

    def _this_trap(self) -> int:
        pou = self.pou
        assert pou is not None
        site = TrapSite(TrapKind.NULL, pou.span, self.scope.pou, "THIS refers to no instance")
        known = self.pous.this_traps.get(pou.name, 0)
        if not known or self.report.traps[known - 1 : known] != [site]:  # new, or undone meanwhile
            known = self.trap(site.kind, site.span, site.message)
            self.pous.this_traps[pou.name] = known
        return known

    def qualified_place(self, node: tree.MemberOf) -> tuple[Place, Member | None] | None:
        for word in ("THIS", "SUPER"):
            if named_itself(node.owner, word):
                return self._own_member(node, word)
        full = self._qualified_variable(node)
        return None if full is None else super()._named(full, node.span)

    def _qualified_variable(self, node: tree.MemberOf) -> str | None:
        """`Namespace.x` or `List.x`: the name that the global variable is kept under."""
        path = dotted(node)
        if path is None or self.scope.find(path.split(".")[0]) is not None:
            return None
        alias = self.pous.aliases.get(path.upper())
        if alias is not None:
            return alias
        return path if self.scope.find(path) is not None else None

    def _own_member(self, node: tree.MemberOf, word: str) -> tuple[Place, Member | None] | None:
        """`THIS.x`; None where x is something else of the instance."""
        place = self.self_place(word, node.owner.span)
        record = place.type
        assert isinstance(record, Record)
        member = record.members.get(node.name.upper())
        if member is None or member.hidden:
            hint = did_you_mean(node.name, [each.name for each in record.members.values() if not each.hidden])
            raise self.report.reject("T001", f"`{record.name}` has no member `{node.name}`.{hint}", node.span)
        scope, self.scope = self.scope, replace(self.scope, frame=None, instance=record, externals={})
        try:
            return self._named(node.name, node.span)
        finally:
            self.scope = scope

    def _named(self, name: str, span: Span) -> tuple[Place, Member | None]:
        place, member = super()._named(name, span)
        choices = self.pous.ambiguous.get(name.upper())
        if choices and member is not None and self.globals_have(member):
            raise self.report.reject("T001", f"`{name}` may be {' or '.join(choices)}; write which.", span)
        instance = self.scope.instance
        if member is not None and instance is not None and instance.members.get(member.name.upper()) is member:
            owner = self.pous.classes.of(instance)
            if member.access == "PRIVATE" and owner is not None and member.home not in ("", owner.name):
                raise self.report.reject("T014", f"`{member.name}` is PRIVATE of `{member.home}`.", span)
        return self.own(place), member

    def globals_have(self, member: Member) -> bool:
        """Whether this is a global variable, and not one of the POU that has the same name."""
        return self.scope.globals.members.get(member.name.upper()) is member

    def unknown(self, name: str, span: Span) -> Rejected:
        instance = self.scope.instance
        if instance is not None and (instance.name.upper(), name.upper()) in self.declarations.broken:
            return Rejected()
        owner = self.own_class()
        if owner is not None and owner.find(name.upper()) is not None:
            return self.report.reject("T010", f"`{name}` is a method; call it with `{name}(...)`.", span)
        return super().unknown(name, span)

    def is_derived(self, record: Record, base: Record) -> bool:
        return is_derived(record, base)

    def may_use(self, record: Record, member: Member) -> bool:
        if member.hidden or member.section is not Section.VAR:
            return False
        if member.access in ("PUBLIC", "INTERNAL"):
            return self._open(member.access, None, self.pous.classes.of(record))
        # an instance may look into another of its own class, as in `equals(other)`
        home = self.pous.classes.by_key.get((member.home or record.name).upper())
        return self._open(member.access, self.own_class(), home)

    def _open(self, access: str, user: Class | None, home: Class | None) -> bool:
        if access == "PUBLIC" or home is None:
            return True
        if access == "INTERNAL":
            return home.declaration.namespace.upper() in ("", *self.scope.space.around())
        if user is None:
            return False
        return user is home or (access == "PROTECTED" and home in user.ancestors())

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

    # ---- interfaces -------------------------------------------------------------------------------------

    def as_interface(self, expr: Expr, type: Reference, span: Span) -> Expr | None:
        if not _to_interface(type) or not isinstance(expr, Load) or not isinstance(expr.place.type, Record):
            return None
        place, target = expr.place, type.target
        assert isinstance(target, Record)
        if not is_derived(expr.place.type, target):
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


def _replaced(node: tree.Expression, old: tree.Expression, new: tree.Expression) -> tree.Expression:
    """The same expression with another owner at its root."""
    if node is old:
        return new
    if isinstance(node, tree.MemberOf):
        return replace(node, owner=_replaced(node.owner, old, new))
    assert isinstance(node, tree.IndexOf)
    return replace(node, array=_replaced(node.array, old, new))


def dotted(node: tree.Expression) -> str | None:
    """`A.B.c` as it was written; None when it is not made of names alone."""
    parts = []
    while isinstance(node, tree.MemberOf):
        parts.append(node.name)
        node = node.owner
    return ".".join([node.name, *reversed(parts)]) if isinstance(node, tree.Name) else None


def _to_interface(type: Type) -> bool:
    return isinstance(type, Reference) and isinstance(type.target, Record) and type.target.kind is Kind.INTERFACE
