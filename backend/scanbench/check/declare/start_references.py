"""Start values of references: `p : REF_TO INT := REF(x)`. Known when every instance has its place in the image."""

from collections.abc import Iterable, Iterator, Sequence

from scanbench.check.context import Rejected
from scanbench.check.declare.declarations import Declarations, Start, StartReference
from scanbench.check.dialect import Allowance, said
from scanbench.problems import Span
from scanbench.program.program import Base, Expr, Place, RefOf
from scanbench.program.shown import shown
from scanbench.program.tasks import ProgramInstance
from scanbench.program.types import (
    SLOT_BYTES,
    ArrayType,
    Kind,
    Member,
    Record,
    Reference,
    Section,
    Type,
    is_derived,
)
from scanbench.syntax import tree

STARTS_WITH = "A reference starts with NULL or REF(variable) of a variable that is found without running anything."


def bind_start_references(
    declarations: Declarations, variables: Record, instances: Iterable[ProgramInstance], image: bytearray
) -> None:
    """Writes the references that declarations ask for into every instance."""
    if not declarations.start_references:
        return
    bases: dict[str, list[int]] = {}
    for record, base in _records(variables, 0):
        bases.setdefault(record.name.upper(), []).append(base)
    for instance in instances:
        for record, base in _records(instance.pou.instance, instance.offset):
            bases.setdefault(record.name.upper(), []).append(base)
    for start in declarations.start_references:
        owner, node = start.owner, start.given.node
        try:
            place = _lasting(declarations, declarations.reference_of(owner, node, start.given.type), node.span)
        except Rejected:
            continue
        for base in bases.get(owner.name.upper(), []):
            offset = place.offset + (base if place.base is Base.SELF else 0)
            reference = offset | (place.bit or 0) << 32
            at = base + start.member.offset + start.given.offset
            image[at : at + SLOT_BYTES] = reference.to_bytes(SLOT_BYTES, "little")


def refers(declared: Declarations, type: Reference, initial: tree.Initial) -> bool:
    """Whether a reference starts with a variable: `REF(x)`, or where the dialect has it so, `x` and `THIS`."""
    if isinstance(initial, tree.Call) or is_this(initial):
        return True
    direct = (type.automatic or _is_interface(type)) and Allowance.DIRECT_REFERENCES in declared.dialect.allows
    return direct and isinstance(initial, tree.Name | tree.MemberOf | tree.IndexOf) and shown(initial).upper() != "NULL"


def _is_interface(type: Type) -> bool:
    return isinstance(type, Reference) and isinstance(type.target, Record) and type.target.kind is Kind.INTERFACE


def start_with(declared: Declarations, owner: Record, member: Member, given: Sequence[StartReference]) -> None:
    """Notes the references that the variable, or what is in it, starts with."""
    for each in given:
        node, name = each.node, each.name or member.name
        if owner.kind is not Kind.BLOCK and member.section is not Section.GLOBAL:
            raise declared.report.reject("D004", "This starts with NULL; assign the reference in the body.", node.span)
        if _is_interface(each.type) and not isinstance(node, tree.Call):
            used = f"`{name}` is an interface that starts with an instance"
            instead = f"`{name} := {shown(node)};` in the body"
            declared.report.warn("W006", said(declared.dialect, Allowance.DIRECT_REFERENCES, used, instead), node.span)
        declared.start_references.append(Start(owner, member, each))


def is_this(node: tree.Initial) -> bool:
    """Whether a pointer starts with its own instance: `THIS`, `ADR(THIS^)`."""
    if isinstance(node, tree.Call) and isinstance(node.callee, tree.Name) and node.callee.name.upper() == "ADR":
        given = node.arguments[0].value if len(node.arguments) == 1 else None
        return isinstance(given, tree.Dereference) and _names_this(given.reference)
    return _names_this(node)


def _names_this(node: object) -> bool:
    return isinstance(node, tree.Name) and node.name.upper() == "THIS"


def own_instance(declarations: Declarations, owner: Record, node: tree.Expression, type: Reference) -> Expr:
    """The instance itself, as the start value of a pointer or reference to its block or to a base of it."""
    wanted = type.target
    if Allowance.DIRECT_REFERENCES not in declarations.dialect.allows:
        raise declarations.report.reject("D004", STARTS_WITH, node.span)
    if owner.kind is not Kind.BLOCK or not isinstance(wanted, Record) or not is_derived(owner, wanted):
        raise declarations.report.reject(
            "T002", f"The start value is {type}, but THIS is an instance of {owner.name}.", node.span
        )
    said_of = said(
        declarations.dialect,
        Allowance.DIRECT_REFERENCES,
        "A pointer starts with its own instance",
        "`p := THIS;` in the body",
    )
    declarations.report.warn("W006", said_of, node.span)
    return RefOf(Place(owner, Base.SELF, 0), type)


def _lasting(declarations: Declarations, expr: object, span: Span) -> Place:
    """The place, when it is found without running anything."""
    if isinstance(expr, RefOf):
        place = expr.place
        if place.slot is None and place.reference is None and not place.indices:
            return place
    raise declarations.report.reject("D004", STARTS_WITH, span)


def _records(record: Record, base: int) -> Iterator[tuple[Record, int]]:
    """The record itself, what it extends, and all that is inside of it."""
    ancestor: Record | None = record
    while ancestor is not None:
        yield ancestor, base
        ancestor = ancestor.base
    for member in record.members.values():
        if member.located or member.bound or member.storage == 0 or member.storage != member.type.size:
            continue
        inner, offset = member.type, base + member.offset
        if isinstance(inner, Record):
            yield from _records(inner, offset)
        elif isinstance(inner, ArrayType):
            element = inner.element
            while isinstance(element, ArrayType):
                element = element.element
            if isinstance(element, Record):
                for index in range(inner.size // element.size if element.size else 0):
                    yield from _records(element, offset + index * element.size)
