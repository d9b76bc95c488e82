"""Expressions -> checked expressions: names to places, operators to typed operations, conversions written out."""

from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.absolute import of_data
from scanbench.check.body.aggregates import aggregate
from scanbench.check.body.allowed import may
from scanbench.check.body.assignments import assigned_value
from scanbench.check.body.bitwise import inverted, literal_inverted
from scanbench.check.body.coercion import coerce
from scanbench.check.body.context import Body
from scanbench.check.body.elements import byte_of, character_index, character_of, element
from scanbench.check.body.enumerations import enumeration_value, is_value_name, typed, value_of_type
from scanbench.check.body.forms import form
from scanbench.check.body.harmless import harmless
from scanbench.check.body.instructions import calculated, with_moments
from scanbench.check.body.lenient import BITS, negative
from scanbench.check.body.literals import literal
from scanbench.check.body.logix_texts import with_texts
from scanbench.check.body.operators import COMPARISONS, NUMERIC, operate
from scanbench.check.body.parts import part, part_type
from scanbench.check.body.places import at_target, automatic
from scanbench.check.body.references import reference_type
from scanbench.check.body.referring import addressed, refer
from scanbench.check.body.subrange_checks import as_written, plain, read
from scanbench.check.body.variables import INSTANCE
from scanbench.check.body.variants import asked, with_types
from scanbench.check.context import Rejected
from scanbench.check.declare.scopes import decode
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.own_variables import SYSTEM
from scanbench.program.program import Assign, Const, Expr, Index, Intrinsic, Load, Place, RefOf, Sequence
from scanbench.program.shown import shown
from scanbench.program.sites import TrapKind
from scanbench.program.types import (
    BOOL,
    ELEMENTARY,
    LINT,
    LWORD,
    NULL,
    ArrayType,
    Elementary,
    Enumeration,
    Kind,
    Member,
    Record,
    Section,
    StringType,
    Subrange,
    Type,
    base_of,
    has_instance,
)
from scanbench.program.untyped import is_untyped, settle
from scanbench.syntax import tree
from scanbench.syntax.lexer import DATA


def expression(body: Body, node: tree.Expression, wanted: Type | None = None) -> Expr:
    """The expression; literals may still be untyped. `wanted` helps a literal find its type."""
    match node:
        case tree.Literal():
            return literal(body, node, wanted)
        case tree.UnaryOp("address", operand, span):
            return refer(body, addressed(body, operand, span), pointer=True)
        case tree.UnaryOp():
            return _unary(body, node, wanted)
        case tree.Aggregate():
            return aggregate(body, node, wanted)
        case tree.BinaryOp("assign"):
            return assigned_value(body, node)
        case tree.BinaryOp():
            return _binary(body, node, wanted)
        case tree.Call():
            value = calculated(body, node, wanted)
            if value is not node:
                return body.expression(value, wanted)
            return form(body, node) or asked(body, node) or at_target(body, body.call(node, wanted), wanted, node)
        case tree.TypedName(type_name, name, span):
            typed(body, type_name, span)
            return value_of_type(body, type_name, name, span)
        case tree.Name(name, span) if name.upper() not in INSTANCE and _is_free(body, name):
            return _unbound(body, node, name, wanted, span)
        case tree.PartialAccess():
            return _part_value(body, node)
        case tree.IndexOf():
            return _element(body, node)
        case _:
            return _read(body, node, wanted)


def _is_free(body: Body, name: str) -> bool:
    """Whether the program declares no variable of this name; an enumeration's value goes before what the model has."""
    found = body.scope.find(name)
    return found is None or found[2] in body.scope.system


def _unbound(body: Body, node: tree.Name, name: str, wanted: Type | None, span: Span) -> Expr:
    """A name that is no variable."""
    if name.upper() == "NULL":
        return Const(NULL, 0)
    value = enumeration_value(body, name, wanted, span)
    if value is not None:
        return value
    return _read(body, node, wanted)


def _read(body: Body, node: tree.Expression, wanted: Type | None = None) -> Expr:
    if isinstance(node, tree.Name) and node.name.upper() == "THIS":  # vendors: a pointer to the instance
        here = body.lookup.this(body, "THIS", node.span)
        return RefOf(here, reference_type(here.type, pointer=True))
    value = None
    if isinstance(node, tree.MemberOf):
        if node.name.upper() not in body.pous.classes.properties:
            value = _part_of_value(body, node)
        value = value or body.lookup.qualified_value(body, node)
    if value is None and isinstance(node, tree.MemberOf | tree.Name):
        value = body.property_value(node)
    if value is not None:
        return at_target(body, value, wanted, node)
    place, member = body.place(node)
    return _value_at(body, place, member, node)


def _value_at(body: Body, place: Place, member: Member | None, node: tree.Expression) -> Expr:
    known = _known(place, member)
    if known is not None:
        return known
    if not isinstance(place.type, Subrange):
        return Load(place)
    if any(node is each for each in body.explicit):
        return as_written(body, place, member)
    return read(body, place, node.span, shown(node))


def _known(place: Place, member: Member | None) -> Const | None:
    """The value of a CONSTANT."""
    if member is None or not member.constant or place.indices or place.slot or place.reference is not None:
        return None
    if member.section is Section.IN_OUT or member.home == SYSTEM.name or place.type is not member.type:
        return None
    if not member.initial and isinstance(place.type, Elementary | StringType):
        raise Rejected  # its value was refused where it is declared, so nobody knows it
    return decode(place.type, member.initial)


def _part_value(body: Body, node: tree.PartialAccess) -> Expr:
    """A part of a variable is a place; of a value it is shifted out."""
    bit = body.lookup.bit(body, node)
    if bit is not None:
        return Load(bit)
    if isinstance(node.owner, tree.Name | tree.MemberOf | tree.IndexOf | tree.DirectAddress | tree.Dereference):
        place, member = body.place(node.owner)
        whole = _known(place, member)
        if node.size.startswith(DATA):
            return Load(of_data(body, place, node))
        if whole is None:
            return Load(part(body, place, node.size, node.index, node.span))
    else:
        whole = None
    value: Expr = whole if whole is not None else settle(body.expression(node.owner))
    _, narrow = part_type(body, value.type, node.size, node.index, node.span)
    bits = fold.convert(LWORD, value)
    if isinstance(bits, Const) and isinstance(bits.value, int):
        return Const(narrow, bits.value >> node.index * narrow.bits & (1 << narrow.bits) - 1)
    shifted = Intrinsic("SHR", LWORD, (bits, Const(LINT, node.index * narrow.bits)))
    if narrow == BOOL:
        return fold.compare("ne", BOOL, fold.binary("and", LWORD, shifted, Const(LWORD, 1)), Const(LWORD, 0))
    return fold.convert(narrow, shifted)


def _element(body: Body, node: tree.IndexOf) -> Expr:
    """An element of an array; `text[1]` is one character of a string."""
    part = _part_of_value(body, node)
    if part is not None:
        return part
    place, member = body.place(node.array)
    if isinstance(place.type, StringType) and len(node.indices) == 1:
        if place.type.zero:
            return Load(byte_of(body, place, place.type, node.indices[0], read=True))
        return _character_at(body, place, place.type, node.indices[0])
    place, member = automatic(body, *element(body, place, member, node), node)
    return _value_at(body, place, member, node)


def _character_at(body: Body, place: Place, type: StringType, node: tree.Expression) -> Expr:
    """A character by its position: 0 beyond the current length, a trap beyond the declared one and below 1."""
    index = character_index(body, node, type)
    before: list[Assign] = []
    if not harmless(index):
        before.append(Assign(body.temporary(LINT, node.span), index, node.span))
        index = Load(before[-1].target)
    if not harmless(Load(place)):
        before.append(Assign(body.temporary(type, node.span), Load(place), node.span))
        place = before[-1].target
    trap = body.trap(
        TrapKind.BOUNDS, node.span, f"the string has room for characters 1..{type.capacity}, not for this one"
    )
    one = Index(index, 1, type.capacity, type.width, trap)
    kind = character_of(type)
    here = Load(replace(place, type=kind, offset=place.offset + 2, indices=(*place.indices, one)))
    length = Intrinsic("LEN", LINT, (Load(place),))
    value = Intrinsic("SEL", kind, (fold.compare("le", BOOL, index, length), Const(kind, 0), here))
    made: Expr = Sequence(tuple(before), value) if before else value
    return fold.convert(ELEMENTARY[BITS[kind.size]], made) if may(body, Allowance.STRING_FROM_ZERO) else made


def _unary(body: Body, node: tree.UnaryOp, wanted: Type | None) -> Expr:
    operand = plain(body, body.expression(node.operand, wanted), node.operand.span)
    type = operand.type
    if isinstance(type, Enumeration):
        type = base_of(type)
        operand = fold.convert(type, operand)
    if node.op == "not":
        if isinstance(type, Elementary) and type.kind in (Kind.BOOL, Kind.BITS):
            return fold.unary("not", type, operand)
        if is_untyped(operand) and isinstance(wanted, Elementary) and wanted.kind in (Kind.BOOL, Kind.BITS):
            return fold.unary("not", wanted, coerce(body, operand, wanted, node.span, "The operand"))
        bits = inverted(body, operand, node.span) or literal_inverted(body, operand, wanted, node.span)
        if bits is not None:
            return bits
        raise body.report.reject(
            "T002", f"NOT needs BOOL or a bit string, not {settle(operand).type}.", node.operand.span
        )
    if isinstance(type, Elementary) and type.kind in (*NUMERIC, Kind.TIME):
        return operand if node.op == "plus" else negative(body, type, operand)
    raise body.report.reject("T002", f"A sign needs a number, not {type}.", node.operand.span)


def _binary(body: Body, node: tree.BinaryOp, wanted: Type | None) -> Expr:
    if node.op in COMPARISONS:
        node = with_texts(body, with_moments(body, with_types(body, node)))
        left, right = _compared(body, node)
    else:
        left, right = body.expression(node.left, wanted), body.expression(node.right, wanted)
    return operate(body, node.op, left, right, node.span, wanted)


def _compared(body: Body, node: tree.BinaryOp) -> tuple[Expr, Expr]:
    """Both sides; the name of an enumeration's value may need to know what it is compared with."""
    if is_value_name(body, node.left):
        right = body.expression(node.right)
        return body.expression(node.left, right.type), right
    left = body.expression(node.left)
    hint = left.type if isinstance(left.type, Enumeration) else None
    return left, body.expression(node.right, hint)


def _part_of_value(body: Body, node: tree.MemberOf | tree.IndexOf) -> Expr | None:
    """A member or element of what a property or call gives: of a copy, as the value itself has no place."""
    inner: tree.Expression = node
    value = None
    while value is None and isinstance(inner, tree.MemberOf | tree.IndexOf):
        inner = inner.owner if isinstance(inner, tree.MemberOf) else inner.array
        value = _whole_value(body, inner)
    if value is None or value.type is None or has_instance(value.type):
        return None
    text = isinstance(value.type, StringType) and isinstance(node, tree.IndexOf)
    if not text and not isinstance(value.type, Record | ArrayType):
        return None
    kept = body.temporary(value.type, node.span)
    name = kept.variable.rpartition(".")[2]
    part = body.expression(_replaced(node, inner, tree.Name(name, inner.span)))
    return Sequence((Assign(kept, value, node.span),), part)


def _whole_value(body: Body, node: tree.Expression) -> Expr | None:
    if isinstance(node, tree.Call):
        return body.call(node)
    return body.property_value(node)


def _replaced(node: tree.Expression, old: tree.Expression, new: tree.Expression) -> tree.Expression:
    """The same expression, with `new` in place of the owner `old` at its root."""
    if node is old:
        return new
    if isinstance(node, tree.MemberOf):
        return replace(node, owner=_replaced(node.owner, old, new))
    assert isinstance(node, tree.IndexOf)
    return replace(node, array=_replaced(node.array, old, new))
