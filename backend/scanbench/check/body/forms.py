"""Calls whose argument is not a value but a variable, an array or a type: REF, SIZEOF, UPPER_BOUND, SUBRANGE_ERROR and others."""

from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.allowed import allowed, may, used
from scanbench.check.body.coercion import coerce
from scanbench.check.body.context import Body
from scanbench.check.body.elements import array_bounds, index_value
from scanbench.check.body.heap import FORMS as HEAP_FORMS
from scanbench.check.body.heap import heap_form
from scanbench.check.body.places import VARIABLES, raw_place
from scanbench.check.body.references import reference_type, target_of
from scanbench.check.body.referring import refer
from scanbench.check.body.subrange_checks import as_written
from scanbench.check.body.vendor_forms import UNSUPPORTED, WHY, vendor_form
from scanbench.check.dialect import Allowance
from scanbench.check.uses import Symbol
from scanbench.check.vendor_sizes import tell_bytes
from scanbench.program.program import Assign, Const, Expr, Index, Load, RefOf, Sequence, Violates
from scanbench.program.shown import shown
from scanbench.program.sites import CheckSite, TrapKind
from scanbench.program.types import (
    BOOL,
    DINT,
    LINT,
    NULL,
    SLOT_BYTES,
    UDINT,
    ArrayType,
    Elementary,
    OpenArray,
    Reference,
    StringType,
    Subrange,
)
from scanbench.program.untyped import ANY_INT, settle
from scanbench.syntax import tree
from scanbench.syntax.parse_expression import POINTER_TO

FORMS = ("REF", "ADR", "SIZEOF", "LOWER_BOUND", "UPPER_BOUND", "EN_CHECK", "SUBRANGE_ERROR", "__ISVALIDREF")
"""Calls whose argument is not a value: a variable, an array, a type."""


def _explicit_check(body: Body, node: tree.Call, name: str) -> Expr:
    """`EN_CHECK(ENO)` records the place when ENO is FALSE; `SUBRANGE_ERROR(v)` only looks. Both are TRUE then."""
    if name == "EN_CHECK":
        body.effects.record(body, node.span)
    if len(node.arguments) != 1 or node.arguments[0].value is None or node.arguments[0].output:
        formal = "ENO" if name == "EN_CHECK" else "IN"
        raise body.report.reject("T004", f"`{name}` takes one argument, {formal}.", node.span)
    value = node.arguments[0].value
    if name == "EN_CHECK":
        eno = coerce(body, body.expression(value, BOOL), BOOL, value.span, "`ENO`")
        number = body.report.check(CheckSite(node.span, body.scope.pou, "EN_CHECK", 1, 1))
        return Violates(BOOL, eno, 1, 1, number)
    place, member = body.place(value)
    if not isinstance(place.type, Subrange):
        raise body.report.reject(
            "T002",
            f"`SUBRANGE_ERROR` needs a variable with a subrange; `{shown(value)}` is {place.type}.",
            node.span,
        )
    return Violates(BOOL, as_written(body, place, member), place.type.low, place.type.high, 0)


def _bound_of(body: Body, node: tree.Call, upper: bool) -> Expr:
    """`LOWER_BOUND(array, dimension)` and `UPPER_BOUND`."""
    name = "UPPER_BOUND" if upper else "LOWER_BOUND"
    formal = [(argument.name or "").upper() for argument in node.arguments]
    values = [argument.value for argument in node.arguments if argument.value is not None and not argument.output]
    if len(values) != 2 or len(formal) != 2 or sorted(formal) not in (["", ""], ["ARR", "DIM"]):
        message = f"`{name}` takes an array, ARR, and the number of a dimension, DIM."
        raise body.report.reject("T004", message, node.span)
    if formal[0] == "DIM":
        values.reverse()
    place, _ = body.place(values[0])
    if not isinstance(place.type, ArrayType | OpenArray):
        raise body.report.reject("T002", f"`{name}` needs an array, not {place.type}.", node.span)
    limits = array_bounds(place)
    number = settle(body.expression(values[1]))
    if not isinstance(number, Const):
        return _bound_by_number(body, [each[upper] for each in limits], values[1])
    if not isinstance(number.value, int) or not 1 <= number.value <= len(limits):
        raise body.report.reject("T012", f"The dimension is from 1 to {len(limits)}.", values[1].span)
    bound = limits[number.value - 1][upper]
    return Const(ANY_INT, bound.value) if isinstance(bound, Const) else fold.convert(DINT, bound)


def _bound_by_number(body: Body, bounds: list[Expr], number: tree.Expression) -> Expr:
    """The bound of the dimension that is computed; one that the array has not traps."""
    made = body.temporary(ArrayType(((1, len(bounds)),), LINT), number.span)
    stores = [
        Assign(replace(made, type=LINT, offset=made.offset + LINT.size * at), bound, number.span)
        for at, bound in enumerate(bounds)
    ]
    trap = body.trap(TrapKind.BOUNDS, number.span, f"the dimension is from 1 to {len(bounds)}")
    index = Index(index_value(body, number), 1, len(bounds), LINT.size, trap)
    one = Load(replace(made, type=LINT, indices=(*made.indices, index)))
    return Sequence(tuple(stores), fold.convert(DINT, one))


def _reference_to(body: Body, node: tree.Call, name: str) -> Expr:
    """`REF(variable)`, or `ADR(variable)`, which gives a pointer."""
    values = [argument.value for argument in node.arguments if argument.value is not None and not argument.output]
    if len(values) != 1 or len(node.arguments) != 1:
        raise body.report.reject("T004", f"`{name}` takes one variable.", node.span)
    made = _reference_to_result(body, values[0], name == "ADR") if isinstance(values[0], tree.Call) else None
    return refer(body, values[0], name == "ADR") if made is None else made


def _reference_to_result(body: Body, call: tree.Call, pointer: bool) -> Expr | None:
    """A reference to what a REFERENCE TO of a call refers to; else to a copy of what the call gives, which lasts as a
    variable of the call does. None where the dialect has none."""
    value = settle(body.expression(call, replace(NULL, automatic=True)))
    if isinstance(value.type, Reference) and value.type.automatic:
        target = target_of(body, value, call.span, shown(call))
        return RefOf(target, reference_type(target.type, pointer))
    if body.pou is None or not isinstance(value.type, Elementary | StringType):
        return None
    if not allowed(body, Allowance.LOCAL_ADDRESSES, call.span, "The result of a call is temporary"):
        return None
    copy = body.temporary(value.type, call.span)
    body.pou.addressed = True
    return Sequence((Assign(copy, value, call.span),), RefOf(copy, reference_type(value.type, pointer)))


def _size_of(body: Body, node: tree.Call, name: str) -> Expr:
    """`SIZEOF(variable or type)`, in bytes; of vendors also `XSIZEOF`, and of a `POINTER TO type`."""
    if name == "XSIZEOF":
        used(body, Allowance.VENDOR_OPERATORS, node.span, "`XSIZEOF` is SIZEOF", "`SIZEOF(...)`")
    values = [argument.value for argument in node.arguments if argument.value is not None]
    if len(values) != 1 or len(node.arguments) != 1:
        raise body.report.reject("T004", "`SIZEOF` takes one variable or type.", node.span)
    value = values[0]
    if isinstance(value, tree.Name) and value.name == POINTER_TO:
        if not allowed(body, Allowance.VENDOR_OPERATORS, node.span, "This is the size of a pointer", f"`{SLOT_BYTES}`"):
            raise body.report.reject("T004", "`SIZEOF` takes one variable or type.", node.span)
        return Const(ANY_INT, SLOT_BYTES)
    if isinstance(value, tree.Name) and body.scope.find(value.name) is None:
        named = body.declarations.named(value.name, value.span)
        tell_bytes(body.report, body.dialect, named, node.span)
        return Const(ANY_INT, named.size)
    place, _ = body.place(value)
    tell_bytes(body.report, body.dialect, place.type, node.span)
    if not isinstance(place.type, OpenArray):
        return Const(ANY_INT, place.type.size)
    size: Expr = Const(LINT, place.type.element.size)
    for low, high in array_bounds(place):
        count = fold.binary("add", LINT, fold.binary("sub", LINT, high, low), Const(LINT, 1))
        size = fold.binary("mul", LINT, size, count)
    return fold.convert(UDINT, size)


def _is_bound(body: Body, node: tree.Call) -> Expr:
    """`__ISVALIDREF(reference)` of vendors: whether it refers to something."""
    values = [argument.value for argument in node.arguments if argument.value is not None]
    if len(values) != 1 or not isinstance(values[0], VARIABLES | tree.Call):
        raise body.report.reject("T004", "`__ISVALIDREF` takes one reference.", node.span)
    asked = values[0]
    value = body.call(asked) if isinstance(asked, tree.Call) else Load(raw_place(body, asked)[0])
    if not isinstance(value.type, Reference):
        raise body.report.reject("T002", f"`__ISVALIDREF` takes a reference, not {value.type}.", node.span)
    return fold.compare("ne", BOOL, value, Const(NULL, 0))


def form(body: Body, node: tree.Call) -> Expr | None:
    """One of `FORMS`, unless the user declared something of that name."""
    if not isinstance(node.callee, tree.Name):
        return None
    name = node.callee.name.upper()
    if name in WHY or name in UNSUPPORTED:
        return vendor_form(body, node, name)
    if name in HEAP_FORMS:
        return heap_form(body, node, name)
    known = name in FORMS or (name == "XSIZEOF" and may(body, Allowance.VENDOR_OPERATORS))
    if not known or name in body.pous.functions or body.scope.find(name) is not None:
        return None
    body.report.use(node.callee.span, name, Symbol("function", "", name))
    match name:
        case "REF" | "ADR":
            return _reference_to(body, node, name)
        case "SIZEOF" | "XSIZEOF":
            return _size_of(body, node, name)
        case "LOWER_BOUND" | "UPPER_BOUND":
            return _bound_of(body, node, name == "UPPER_BOUND")
        case "__ISVALIDREF":
            return _is_bound(body, node)
    return _explicit_check(body, node, name)
