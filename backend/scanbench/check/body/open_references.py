"""A reference to an array, with the bounds of the array, where a REF_TO ARRAY[*] is wanted."""

from scanbench.check.body import fold
from scanbench.check.body.context import Body
from scanbench.check.body.places import inside
from scanbench.check.declare.open_references import BOUNDS, SLOT, array_of
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, Load, Sequence
from scanbench.program.types import LINT, NULL, ArrayType, Record, Reference
from scanbench.program.untyped import settle


def open_value(body: Body, expr: Expr, type: Record, span: Span, what: str) -> Expr:
    """The value as a reference to an array of any size; `what` it is, for people."""
    wanted, given = array_of(type), expr.type
    assert wanted is not None
    array = given.target if isinstance(given, Reference) else None
    fits = isinstance(array, ArrayType) and array.element == wanted.element and len(array.bounds) == wanted.dimensions
    if given != NULL and not fits:
        said = "nothing" if given is None else str(settle(expr).type)
        raise body.report.reject("T002", f"{what} is {type}, but this is {said}. Write REF(array).", span)
    bounds = array.bounds if isinstance(array, ArrayType) else ((0, 0),) * wanted.dimensions
    made = body.temporary(type, span)
    slot = type.members[SLOT].type
    assert isinstance(slot, Reference)
    values = {SLOT: fold.convert(slot, expr)}
    for dimension, limits in enumerate(bounds, 1):
        values.update((f"{name}{dimension}", Const(LINT, limit)) for name, limit in zip(BOUNDS, limits, strict=True))
    stores = [Assign(inside(made, type, type.members[key]), value, span) for key, value in values.items()]
    return Sequence(tuple(stores), Load(made))
