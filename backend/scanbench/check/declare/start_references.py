"""Start values of references: `p : REF_TO INT := REF(x)`. Known when every instance has its place in the image."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress

from scanbench.check.context import Rejected
from scanbench.check.declare.declarations import Afresh, Declarations, Given, Start, StartExpression, StartReference
from scanbench.check.dialect import Allowance
from scanbench.check.dialect_rules import said
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
    places: dict[int, Place] = {}
    for start in declarations.start_references:
        given = start.given
        if isinstance(given, StartReference):
            with suppress(Rejected):
                found = declarations.reference_of(start.owner, given.node, given.type)
                places[id(given)] = _lasting(declarations, found, given.node.span)
    held = Held(declarations.start_references)
    for record, begin in [(variables, 0), *((each.pou.instance, each.offset) for each in instances)]:
        for at, (start, base) in held.of(record).items():
            place = places.get(id(start.given))
            if place is not None:
                offset = place.offset + (begin + base if place.base is Base.SELF else 0)
                reference = offset | (place.bit or 0) << 32
                image[begin + at : begin + at + SLOT_BYTES] = reference.to_bytes(SLOT_BYTES, "little")


Bound = dict[int, tuple[Start, int]]
"""By the place of a reference within a variable: what gives it a start value, and where in the variable the owner of that begins."""


class Held:
    """Which references within a variable have start values, by its type."""

    def __init__(self, starts: Sequence[Start]) -> None:
        self._starts: dict[str, list[Start]] = {}
        for start in starts:
            self._starts.setdefault(start.owner.name.upper(), []).append(start)
        self._known: dict[int, tuple[Record, Bound]] = {}

    def of(self, type: Type) -> Bound:
        """Those of a variable whose declaration gives no value."""
        if not self._starts:
            return {}
        if isinstance(type, ArrayType):
            within, made = self.of(type.element), dict[int, tuple[Start, int]]()
            for number in range(type.count if within else 0):
                made |= _moved(within, number * type.element.size)
            return made
        if not isinstance(type, Record):
            return {}
        known = self._known.get(id(type))
        if known is None:
            known = self._known[id(type)] = type, self._record(type)
        return known[1]

    def _record(self, record: Record) -> Bound:
        found: Bound = {}
        for member in _inside(record):
            found |= _moved(self.of(member.type), member.offset)
        for owner in _chain(record):
            for start in self._starts.get(owner.name.upper(), []):
                at = start.member.offset + start.given.offset
                if isinstance(start.given, StartReference):
                    found[at] = start, 0
                else:
                    for slot in slots(start.given.type):
                        found.pop(at + slot, None)
                    found |= _moved(self.of(start.given.type), at)
        return found

    def changed(self, type: Type, given: Sequence[Given]) -> list[Given]:
        """The same without each `Afresh` that changes no reference of a variable of this type."""
        if not any(isinstance(each, Afresh) for each in given):
            return [*given]
        found = self.of(type)
        return [
            each
            for each in given
            if not isinstance(each, Afresh) or any(each.offset + slot in found for slot in slots(each.type))
        ]


def slots(type: Type) -> list[int]:
    """Where in a variable of this type its references are."""
    if isinstance(type, Reference):
        return [0]
    if isinstance(type, ArrayType):
        within = slots(type.element)
        return [number * type.element.size + at for number in range(type.count if within else 0) for at in within]
    if not isinstance(type, Record):
        return []
    return [member.offset + at for member in _inside(type) for at in slots(member.type)]


def _inside(record: Record) -> Iterator[Member]:
    """What is in the memory of the record itself."""
    for member in record.members.values():
        if not (member.located or member.bound or member.storage == 0 or member.storage != member.type.size):
            yield member


def _chain(record: Record | None) -> list[Record]:
    """The record and what it extends, the farthest first."""
    found: list[Record] = []
    while record is not None:
        found.append(record)
        record = record.base
    return found[::-1]


def _moved(bound: Bound, by: int) -> Bound:
    return {at + by: (start, base + by) for at, (start, base) in bound.items()}


def own_references(declared: Declarations, type: Type) -> dict[int, tuple[RefOf, int]]:
    """The references that a fresh variable of this type has, by their places in it; with each, where in the variable the block begins
    that a place of Base.SELF counts from. What is wrong with them is told elsewhere."""
    made: dict[int, tuple[RefOf, int]] = {}
    for at, (start, base) in Held(declared.start_references).of(type).items():
        if isinstance(start.given, StartReference):
            with suppress(Rejected), declared.report.apart():
                value = declared.reference_of(start.owner, start.given.node, start.given.type)
                if isinstance(value, RefOf):
                    made[at] = value, base
    return made


def refers(declared: Declarations, type: Reference, initial: tree.Initial) -> bool:
    """Whether a reference starts with a variable: `REF(x)`, or where the dialect has it so, `x` and `THIS`."""
    if isinstance(initial, tree.Call):
        computed = Allowance.START_EXPRESSIONS in declared.dialect.allows
        return not computed or is_this(initial) or shown(initial.callee).upper() in ("REF", "ADR")
    if is_this(initial):
        return True
    direct = (type.automatic or _is_interface(type)) and Allowance.DIRECT_REFERENCES in declared.dialect.allows
    return direct and isinstance(initial, tree.Name | tree.MemberOf | tree.IndexOf) and shown(initial).upper() != "NULL"


def _is_interface(type: Type) -> bool:
    return isinstance(type, Reference) and isinstance(type.target, Record) and type.target.kind is Kind.INTERFACE


def start_with(declared: Declarations, owner: Record, member: Member, given: Sequence[Given]) -> None:
    """Notes the references that the variable, or what is in it, starts with, and what is computed."""
    for each in given:
        if isinstance(each, Afresh):
            declared.start_references.append(Start(owner, member, each))
            continue
        if isinstance(each, StartExpression):
            _compute(declared, owner, member, each)
            continue
        node, name = each.node, each.name or member.name
        if owner.kind is not Kind.BLOCK and member.section is not Section.GLOBAL:
            local = (
                member.section in (Section.VAR, Section.TEMP) and Allowance.START_EXPRESSIONS in declared.dialect.allows
            )
            if local and isinstance(node, tree.Call) and not is_this(node):
                _compute(declared, owner, member, StartExpression(each.offset, each.type, node))
                continue
            raise declared.report.reject("D004", "This starts with NULL; assign the reference in the body.", node.span)
        if _is_interface(each.type) and not isinstance(node, tree.Call):
            used = f"`{name}` is an interface that starts with an instance"
            instead = f"`{name} := {shown(node)};` in the body"
            declared.report.warn("W006", said(declared.dialect, Allowance.DIRECT_REFERENCES, used, instead), node.span)
        declared.start_references.append(Start(owner, member, each))


def _compute(declared: Declarations, owner: Record, member: Member, given: StartExpression) -> None:
    """Notes a start value that is no constant; a constant, a member of a structure and an input of a function have none."""
    called = owner.kind is not Kind.BLOCK and member.section is Section.INPUT
    if member.constant or member.section is Section.MEMBER or called:
        declared.constant_of(given.node, given.type)  # tells what is wrong
        raise declared.report.reject("D004", "A constant is needed here: a literal or a CONSTANT.", given.node.span)
    name = member.name.rpartition("$")[2]  # what a method keeps has the method before it
    used = f"The start value of `{name}` is computed"
    declared.report.warn("W006", said(declared.dialect, Allowance.START_EXPRESSIONS, used), given.node.span)
    declared.computed.setdefault((owner.name.upper(), member.name.upper()), []).append(given)


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
