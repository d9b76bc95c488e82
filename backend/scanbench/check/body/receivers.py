"""The instance that a call of a method, or the use of a property, goes to."""

from dataclasses import dataclass

from scanbench.check.body.context import Body
from scanbench.check.body.objects import dotted, named_itself, own_class, qualified_variable
from scanbench.check.body.variables import is_broken
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Class, Method
from scanbench.program.program import Base, Expr, Load, Place
from scanbench.program.sites import TrapKind
from scanbench.program.types import Record, Reference, Section
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


def method_called(body: Body, callee: tree.Expression) -> tuple[Receiver, Method] | None:
    """The instance and the method that this names; None when it names something else."""
    return _looked_up(body, callee, "")


def _looked_up(body: Body, node: tree.Expression, half: str) -> tuple[Receiver, Method] | None:
    if isinstance(node, tree.Name):
        owner = own_class(body)
        free = _free(body, node.name) or (not half and (_is_action_too(body, node.name) or _is_result(body, node.name)))
        found = _found(owner, node.name.upper(), half) if owner and free else None
        if owner is None or found is None:
            return None
        body.report.use(node.span, node.name, found.symbol)
        return Receiver(body.lookup.this(body, "THIS", node.span), owner, exact=False), found
    if not isinstance(node, tree.MemberOf) or is_qualified(body, node):
        return None
    receiver = receiver_of(body, node.owner)
    if receiver is None:
        return None
    method = _found(receiver.owner, node.name.upper(), half)
    if method is None:
        record = receiver.owner.record
        gives = receiver.owner.find(f"{node.name.upper()}.GET") is not None
        if half or gives or (record is not None and node.name.upper() in record.members):
            return None
        if record is not None and (record.open or is_broken(body, record, node.name)):
            raise Rejected
        hint = body.report.near(node.name, receiver.owner.method_names, f"method:{receiver.owner.name}")
        raise body.report.reject("T001", f"`{receiver.owner.name}` has no method `{node.name}`.{hint}", node.span)
    body.report.use(node.span, node.name, method.symbol)
    return receiver, method


def _is_action_too(body: Body, name: str) -> bool:
    """Whether a value of this name cannot be called, and an ACTION of the same POU can, as vendors allow."""
    found = body.scope.find(name)
    return found is not None and not isinstance(found[0].type, Record) and name.upper() in body.pous.classes.actions


def _is_result(body: Body, name: str) -> bool:
    """Whether it is the result of this method, a plain value: what is called by its name is the method."""
    found = body.scope.find(name)
    own = found is not None and found[0].section is Section.RESULT
    return own and found is not None and not isinstance(found[0].type, Record | Reference)


def _found(owner: Class, name: str, half: str) -> Method | None:
    """The method; of several of one name the first."""
    method = owner.find(f"{name}{half}")
    return method if method is not None or half else next(iter(owner.overloads(name)), None)


def _free(body: Body, name: str) -> bool:
    """Whether no variable has this name; the result of a getter is no variable to other readers."""
    return body.scope.find(name) is None


def is_qualified(body: Body, node: tree.MemberOf) -> bool:
    """`Namespace.name`, and nothing of an instance, as `List.instance.name` is."""
    path = dotted(node)
    first = path.split(".")[0] if path else ""
    return (
        bool(path)
        and first.upper() not in ("THIS", "SUPER")
        and body.scope.find(first) is None
        and (not is_own_property(body, first))
        and not _of_a_global(body, node.owner)
    )


def _of_a_global(body: Body, node: tree.Expression) -> bool:
    """Whether this is `Namespace.x` or `List.x`, or something of such a variable."""
    while isinstance(node, tree.MemberOf):
        if qualified_variable(body, node) is not None:
            return True
        node = node.owner
    return False


def is_own_property(body: Body, name: str) -> bool:
    """Whether the class that this is in has a property of this name that can be read."""
    owner = own_class(body)
    return owner is not None and owner.find(f"{name.upper()}.GET") is not None


def receiver_of(body: Body, node: tree.Expression) -> Receiver | None:
    """The instance that this expression names; None when it names none."""
    for word in ("THIS", "SUPER"):
        if named_itself(node, word):
            place = body.lookup.this(body, word, node.span)
            owner = body.pous.classes.of(place.type)
            assert owner is not None
            return Receiver(place, owner, exact=False, above=word == "SUPER")
    value = _reference_value(body, node)
    if value is not None:
        return _referred(body, value, node)
    place, member = body.place(node)
    if isinstance(place.type, Reference):
        return _referred(body, Load(place), node)
    owner = body.pous.classes.of(place.type)
    if owner is None or not isinstance(place.type, Record):
        return None
    declared = member is not None and member.type is place.type and member.section is not Section.IN_OUT
    return Receiver(place, owner, exact=declared or isinstance(node, tree.IndexOf))


def _reference_value(body: Body, node: tree.Expression) -> Expr | None:
    """A call or property that gives a reference to the instance."""
    if isinstance(node, tree.Call):
        value = body.call(node)
    else:
        got = body.property_value(node)
        if got is None:
            return None
        value = got
    if not isinstance(value.type, Reference):
        raise body.report.reject("T010", f"This is {value.type}, which has no methods.", node.span)
    return value


def _referred(body: Body, value: Expr, node: tree.Expression) -> Receiver | None:
    type = value.type
    assert isinstance(type, Reference)
    owner = body.pous.classes.of(type.target)
    if owner is None or owner.record is None:
        return None
    if owner.kind != "interface" and not type.automatic:
        raise body.report.reject("T010", "This is a reference; write `^` to get at the instance.", node.span)
    trap = body.trap(TrapKind.NULL, node.span, "this refers to no instance")
    place = Place(owner.record, Base.IMAGE, 0, reference=value, null_trap=trap)
    return Receiver(place, owner, exact=False)


def accessor(body: Body, node: tree.Expression, half: str) -> tuple[Receiver, Method] | None:
    """The getter or setter, as `half` says, of a property and its instance; None when this is no property."""
    properties = body.pous.classes.properties
    if not isinstance(node, tree.Name | tree.MemberOf) or node.name.upper() not in properties:
        return None
    found = _looked_up(body, node, half)
    if found is None and _looked_up(body, node, ".SET" if half == ".GET" else ".GET") is not None:
        can = "read" if half == ".SET" else "assigned"
        raise body.report.reject("T010", f"The property `{node.name}` can only be {can}.", node.span)
    return found


def is_variable(body: Body, node: tree.Expression) -> bool:
    """Whether this names something that has a place: no property."""
    return accessor(body, node, ".GET") is None if body.pous.classes.properties else True
