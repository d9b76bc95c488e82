"""Variables -> places: names, members, elements, what a reference refers to, and parts of integers."""

from dataclasses import replace

from scanbench.check.body.absolute import named_address, of_data
from scanbench.check.body.allowed import allowed
from scanbench.check.body.context import Body, Found
from scanbench.check.body.elements import element
from scanbench.check.body.objects import qualified_place
from scanbench.check.body.parts import PARTED, WIDTHS, named_part, part
from scanbench.check.body.references import target_of
from scanbench.check.body.variables import INSTANCE, no_member
from scanbench.check.declare.addresses import offset_of
from scanbench.check.declare.open_references import SLOT, array_of
from scanbench.check.dialect import Allowance
from scanbench.check.uses import variable_symbol
from scanbench.problems import Span
from scanbench.program.program import Base, Expr, Load, Place
from scanbench.program.shown import shown
from scanbench.program.sites import TrapKind
from scanbench.program.types import (
    BOOL,
    ELEMENTARY,
    ULINT,
    Elementary,
    Kind,
    Member,
    Record,
    Reference,
    Section,
    Type,
    actual_of,
)
from scanbench.program.untyped import settle
from scanbench.syntax import tree
from scanbench.syntax.chart import controls
from scanbench.syntax.lexer import DATA

VARIABLES = tree.Name | tree.MemberOf | tree.IndexOf | tree.DirectAddress | tree.Dereference | tree.PartialAccess
"""What names a place."""


def place(body: Body, node: tree.Expression) -> Found:
    """The variable; of a REFERENCE TO, what it refers to. So are properties and calls that give one."""
    given = given_reference(body, node)
    if given is not None:
        return target_of(body, given, node.span, shown(node)), None
    return automatic(body, *raw_place(body, node), node)


def given_reference(body: Body, node: tree.Expression) -> Expr | None:
    """The reference that a property or a call of the type REFERENCE TO gives; None of anything else."""
    if isinstance(node, tree.Call):
        value: Expr | None = body.call(node)
    elif isinstance(node, tree.Name | tree.MemberOf) and node.name.upper() in body.pous.classes.properties:
        value = body.property_value(node)
    else:
        return None
    return value if value is not None and is_automatic(value) else None


def is_automatic(value: Expr) -> bool:
    """Whether the value is a REFERENCE TO, which means what it refers to."""
    return isinstance(value.type, Reference) and value.type.automatic


def at_target(body: Body, value: Expr, wanted: Type | None, node: tree.Expression) -> Expr:
    """What a REFERENCE TO that was given refers to, unless a REFERENCE TO is wanted; any other value as it is."""
    if not is_automatic(value) or (isinstance(wanted, Reference) and wanted.automatic):
        return value
    return Load(target_of(body, value, node.span, shown(node)))


def automatic(body: Body, place: Place, member: Member | None, node: tree.Expression) -> Found:
    """The target of a REFERENCE TO; any other place as it is."""
    if isinstance(place.type, Reference) and place.type.automatic:
        return target_of(body, Load(place), node.span, shown(node)), None
    return place, member


def raw_place(body: Body, node: tree.Expression) -> Found:
    """The variable itself, also of a REFERENCE TO."""
    match node:
        case tree.Name(name, span):
            return body.lookup.variable(body, name, span)
        case tree.MemberOf():
            return _member(body, node)
        case tree.IndexOf():
            return element(body, *body.place(node.array), node)
        case tree.Dereference():
            return _dereferenced(body, node)
        case tree.PartialAccess(owner, size, index, span):
            bit = body.lookup.bit(body, node)
            if bit is not None:
                return bit, None
            place, member = body.place(owner)
            if size.startswith(DATA):
                return of_data(body, place, node), None
            return part(body, place, size, index, span), member
        case tree.DirectAddress():
            return _addressed(body, node), None
    raise body.report.reject("T010", "A variable is needed here.", node.span)


def _addressed(body: Body, node: tree.DirectAddress) -> Place:
    type = _width(body, node.text)
    offset, bit = offset_of(body.declarations, node.text, type, node.span)
    return Place(type, Base.IMAGE, offset, bit=bit, variable="@")


def _width(body: Body, text: str) -> Elementary:
    """The type of an address that a statement names directly; the model gives its width."""
    found = body.declarations.model.locate(text)
    if found is None:
        return BOOL if "." in text else ELEMENTARY["WORD"]
    return next((type for type in WIDTHS.values() if type.bits == found.bits), ELEMENTARY["WORD"])


def _member(body: Body, node: tree.MemberOf) -> Found:
    found = qualified_place(body, node) or _of_action(body, node)
    if found is not None:
        return found
    place, outer = body.place(node.owner)
    record = place.type
    if isinstance(record, Elementary) and record.kind in PARTED:
        return named_part(body, place, node), outer
    if not isinstance(record, Record):
        hint = f" Write `{shown(node.owner)}^.{node.name}`." if isinstance(record, Reference) else ""
        raise body.report.reject("T010", f"{record} has no members.{hint}", node.span)
    member = record.members.get(node.name.upper())
    if member is None and (address := named_address(node)) is not None:
        return of_data(body, place, address), None
    if member is None or member.hidden:
        raise no_member(body, record, node)
    body.report.use(node.span, node.name, variable_symbol(member, record))
    _may_use(body, record, member, node.span)
    inner = body.lookup.inside(body, place, record, member, node.span)
    if inner.slot is not place.slot or inner.reference is not place.reference:
        inner = replace(
            inner, null_trap=body.trap(TrapKind.NULL, node.span, f"the in-out {member.name} is not connected")
        )
    keep = outer is not None and (outer.constant or record.kind is not Kind.BLOCK)
    return inner, outer if keep else member


def _of_action(body: Body, node: tree.MemberOf) -> Found | None:
    """`Name.Q` of an ACTION that a chart controls."""
    if (
        node.name.upper() != "Q"
        or not isinstance(node.owner, tree.Name)
        or body.scope.find(node.owner.name) is not None
    ):
        return None
    instance = body.scope.instance
    found = [] if instance is None else controls(node.owner.name, instance.members)
    if len(found) > 1:
        message = f"Two charts of this POU control `{node.owner.name}`, each with a Q of its own; name an ACTION of its own in each."
        raise body.report.reject("T010", message, node.span)
    return body.lookup.variable(body, found[0], node.span) if found else None


def _may_use(body: Body, record: Record, member: Member, span: Span) -> None:
    if record.kind is not Kind.BLOCK or member.section in (Section.INPUT, Section.OUTPUT):
        return
    if body.lookup.may_use(body, record, member):
        return
    if (
        member.section is Section.VAR
        and not member.hidden
        and member.access != "PRIVATE"
        and allowed(
            body, Allowance.BLOCK_VARIABLES, span, f"`{member.name}` is internal of {record.name}", "`VAR_OUTPUT`"
        )
    ):
        body.peeked.append(span)
        return
    what = "an in-out" if member.section is Section.IN_OUT else "internal"
    raise body.report.reject(
        "T010", f"`{member.name}` is {what} of {record.name}; only its inputs and outputs can be used from outside.",
        span,
    )  # fmt: skip


def _dereferenced(body: Body, node: tree.Dereference) -> Found:
    inner = node.reference
    if isinstance(inner, tree.Name) and inner.name.upper() in INSTANCE:
        return body.place(inner)
    reference = plain_reference(body, body.expression(inner), node.span)
    if not isinstance(reference.type, Reference):
        raise body.report.reject("T010", f"`^` needs a reference; this is {settle(reference).type}.", node.span)
    return target_of(body, reference, node.span, shown(inner)), None


def plain_reference(body: Body, expr: Expr, span: Span) -> Expr:
    """The reference to the array that such a value has with its bounds; any other value as it is."""
    record = expr.type
    if not isinstance(record, Record) or array_of(record) is None:
        return expr
    if not isinstance(expr, Load):
        raise body.report.reject("T010", f"Assign this {record} to a variable first.", span)
    return Load(inside(expr.place, record, record.members[SLOT]))


def inside(place: Place, record: Record, member: Member) -> Place:
    """The place of a member of what lives at `place`."""
    if member.located:
        return Place(member.type, Base.IMAGE, member.offset, bit=member.bit, variable="@")
    if member.copied:  # seen from outside it is what was passed: the block's own copy is over when the block has run
        member = actual_of(record, member)
    free = place.slot is not None or place.reference is not None or place.variable.startswith("@")
    if free or place.variable.endswith(".*") or place.variable == "":
        variable = place.variable
    else:
        # members of a union share their bytes, whatever is inside of them
        variable = f"{record.name}.*" if record.overlaps else f"{member.home or record.name}.{member.name}"
    inner = replace(
        place, type=member.type, offset=place.offset + member.offset, variable=variable.upper(), bit=member.bit
    )
    if not member.bound:
        return inner
    return Place(member.type, Base.IMAGE, 0, slot=replace(inner, type=ULINT))
