"""Values that refer to a variable: references, pointers, interfaces; their comparison, and arithmetic in bytes."""

from scanbench.check.body import fold
from scanbench.check.body.allowed import allowed, may, used
from scanbench.check.body.context import Body
from scanbench.check.body.lenient import address_number
from scanbench.check.context import Rejected
from scanbench.check.dialect import Allowance
from scanbench.check.vendor_sizes import tell_bytes
from scanbench.problems import Span
from scanbench.program.program import Base, Const, Expr, Load, Place, RefOf
from scanbench.program.sites import TrapKind
from scanbench.program.types import (
    BOOL,
    LINT,
    NULL,
    SLOT_BYTES,
    ULINT,
    ArrayType,
    Elementary,
    Kind,
    Record,
    Reference,
    StringType,
    Type,
    is_derived,
)
from scanbench.program.untyped import ANY_INT, settle

COUNTED = (Kind.INT, Kind.UINT)


def target_of(body: Body, reference: Expr, span: Span, name: str) -> Place:
    """The place to which a reference refers."""
    type = reference.type
    assert isinstance(type, Reference)
    if type.target is None:
        raise body.report.reject("T010", "NULL refers to nothing.", span)
    if isinstance(type.target, Record) and type.target.kind is Kind.INTERFACE:
        raise body.report.reject("T010", f"{type.target} is an interface: call its methods without `^`.", span)
    trap = body.trap(TrapKind.NULL, span, f"the reference {name} refers to nothing")
    return Place(type.target, Base.IMAGE, 0, null_trap=trap, reference=reference)


def _fits(source: Reference, target: Reference) -> bool:
    """Whether a reference may be assigned; a pointer takes any address, as vendors have it."""
    if source.target is None or target.pointer or source.target == target.target:
        return True
    a, b = source.target, target.target
    if isinstance(a, ArrayType) and a == b:
        return True
    return isinstance(a, Record) and isinstance(b, Record) and is_derived(a, b)


def as_reference(body: Body, expr: Expr, type: Reference, span: Span) -> Expr | None:
    """The value as a reference of this type, or None."""
    if isinstance(expr, Const) and expr.type == ANY_INT and expr.value == 0:
        return Const(NULL, 0)
    if isinstance(expr.type, Reference) and (_fits(expr.type, type) or _takes_address(body, expr.type, type, span)):
        source = expr.type.target
        if type.target is not None and source != type.target:
            tell_bytes(body.report, body.dialect, source, span)
        if isinstance(source, StringType) and source.zero and not isinstance(type.target, StringType):
            used(body, Allowance.STRING_BYTES, span, f"This points to the bytes of a {source}")
        elif isinstance(source, StringType) and type.target is not None and not isinstance(type.target, StringType):
            if may(body, Allowance.STRING_FROM_ZERO):
                title = body.dialect.title
                raise body.report.reject(
                    "T013",
                    f"In {title} the first bytes of a string are its first character; here a WSTRING begins with its length, so this "
                    "pointer would read different bytes. Take characters with MID."
                    if source.width == 2
                    else f"In {title} the first byte of a string is its first character; in this project a string begins with its "
                    'length. Write `"version": 3` into language.json, or take characters with `s[0]` or MID.',
                    span,
                )
            body.report.warn(
                "W004",
                f"A {source} begins with its length, in two bytes; its characters follow. In other tools the first byte "
                "after this pointer is the first character.",
                span,
            )
        return expr
    return _as_interface(body, expr, type, span)


def compare_references(body: Body, op: str, left: Expr, right: Expr, span: Span) -> Expr:
    """`left op right`, of which one is a reference at least."""
    if isinstance(left.type, Reference) != isinstance(right.type, Reference):
        first, second = (address_number(body, each, span) for each in (left, right))
        if first is not None and second is not None:
            return fold.compare(op, BOOL, first, second)
    sides = []
    for one, other in ((left, right), (right, left)):
        assert isinstance(left.type, Reference) or isinstance(right.type, Reference)
        wanted = other.type if isinstance(other.type, Reference) else NULL
        made = one if isinstance(one.type, Reference) else as_reference(body, one, wanted, span)
        if made is None and isinstance(other, Const) and other.type == NULL:
            raise body.report.reject(
                "T002",
                f"Only references can be NULL, not {settle(one).type}. Whether a REFERENCE TO is bound, "
                "`__ISVALIDREF` says.",
                span,
            )
        if made is None:
            raise body.report.reject(
                "T002", f"A reference cannot be compared with {settle(one).type}; dereference it with `^`.", span
            )
        sides.append(made)
    ordered = all(isinstance(side.type, Reference) and side.type.pointer for side in sides)
    if op not in ("eq", "ne") and all(_may_move(side.type) for side in sides):
        ordered = allowed(body, Allowance.POINTER_NUMBERS, span, "The order of two REF_TO is that of their addresses")
    if op not in ("eq", "ne") and not ordered:
        raise body.report.reject("T002", "References are equal or not; they have no order.", span)
    return fold.compare(op, BOOL, sides[0], sides[1])


def moved(body: Body, op: str, pointer: Expr, by: Expr, span: Span, of_target: bool = False) -> Expr:
    """`pointer + bytes`, `pointer - bytes`; with `of_target`, in elements of what it points to."""
    by = settle(by)
    type = pointer.type
    assert isinstance(type, Reference)
    if not isinstance(by.type, Elementary) or by.type.kind not in COUNTED:
        raise body.report.reject("T002", f"A pointer moves by a number of bytes, not by {by.type}.", span)
    distance = fold.convert(LINT, by)
    if of_target and type.target is not None:
        distance = fold.binary("mul", LINT, distance, Const(LINT, type.target.size))
    number = fold.binary(op, ULINT, fold.convert(ULINT, pointer), fold.convert(ULINT, distance))
    return fold.convert(type, number)


def pointer_arithmetic(body: Body, op: str, left: Expr, right: Expr, span: Span) -> Expr:
    """`left op right` with pointers, in bytes."""
    a, b = left.type, right.type
    if isinstance(a, Reference) and a.pointer and op in ("add", "sub") and not isinstance(b, Reference):
        return moved(body, op, left, right, span)
    if isinstance(b, Reference) and b.pointer and op == "add" and not isinstance(a, Reference):
        return moved(body, op, right, left, span)
    if isinstance(a, Reference) and isinstance(b, Reference) and a.pointer and b.pointer and op == "sub":
        return fold.binary("sub", LINT, fold.convert(LINT, left), fold.convert(LINT, right))
    for reference, by in ((left, right), (right, left))[: 2 if op == "add" else 1]:
        if _may_move(reference.type) and not isinstance(by.type, Reference) and op in ("add", "sub"):
            told = "A REF_TO moves by elements here"
            if allowed(body, Allowance.POINTER_NUMBERS, span, told, "an index of the array"):
                return moved(body, op, reference, by, span, of_target=True)
    raise body.report.reject(
        "T002",
        "Only a POINTER TO can be computed with: plus or minus a number of bytes, or the difference of two.",
        span,
    )


def _may_move(type: Type | None) -> bool:
    """Whether this is a REF_TO data, which programs for RuSTy compute with."""
    return isinstance(type, Reference) and not (type.pointer or type.automatic) and not _to_interface(type)


def _takes_address(body: Body, source: Reference, target: Reference, span: Span) -> bool:
    """Whether the dialect lets a REF_TO data take an address, or a reference to the array whose first element it means."""
    if not _may_move(target) or target.target is None or isinstance(target.target, Record):
        return False
    first = isinstance(source.target, ArrayType) and source.target.element == target.target
    if not (source.pointer or first):
        return False
    return allowed(
        body, Allowance.POINTER_NUMBERS, span, f"This {source} becomes a {target}", f"`REF(...)` of {target.target}"
    )


def _as_interface(body: Body, expr: Expr, type: Reference, span: Span) -> Expr | None:
    """A reference to an instance, where a variable of an interface that it implements wants one."""
    if not _to_interface(type) or not isinstance(expr, Load) or not isinstance(expr.place.type, Record):
        return None
    place, target = expr.place, type.target
    assert isinstance(target, Record)
    if not is_derived(expr.place.type, target):
        if expr.place.type.open:
            raise Rejected
        raise body.report.reject(
            "T002", f"`{expr.place.type.name}` does not implement the interface `{target.name}`.", span
        )
    if place.base is Base.FRAME and place.slot is None and place.reference is None:
        if body.pou is None or not allowed(body, Allowance.LOCAL_ADDRESSES, span, "The instance is temporary"):
            raise body.report.reject("T013", "A temporary instance cannot be referred to.", span)
        body.pou.addressed = True
    return RefOf(place, type)


def reference_type(target: Type, pointer: bool = False) -> Reference:
    """REF_TO (or POINTER TO) a type."""
    return Reference(
        f"{'POINTER' if pointer else 'REF_TO'}{' TO' if pointer else ''} {target.name}",
        Kind.REF,
        SLOT_BYTES,
        target,
        pointer,
    )


def _to_interface(type: Type) -> bool:
    return isinstance(type, Reference) and isinstance(type.target, Record) and type.target.kind is Kind.INTERFACE
