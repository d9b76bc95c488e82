"""Copies of texts in longer ones, for what is passed and only read."""

from dataclasses import replace

from scanbench.check.body.context import Body
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, For, Index, Load, Place, Stmt
from scanbench.program.sites import TrapKind
from scanbench.program.types import LINT, ArrayType, StringType, Type


def copied_texts(body: Body, place: Place, element: Type, span: Span, before: list[Stmt]) -> Place:
    """A copy of an array of texts, with the same bounds and longer elements, which `before` makes."""
    type = place.type
    assert isinstance(type, ArrayType)
    assert isinstance(type.element, StringType)
    longer = ArrayType(type.bounds, element)
    copy, number = body.temporary(longer, span), body.temporary(LINT, span)
    low, high = 0, type.count - 1
    trap = body.trap(TrapKind.BOUNDS, span, f"index outside of {low}..{high}")
    turns = body.trap(TrapKind.LOOP, span, "this FOR has more rounds than a scan may take")

    def text(of: Place, each: Type) -> Place:
        one = Index(Load(number), low, high, each.size, trap)
        return replace(of, type=each, indices=(*of.indices, one))

    one = Assign(text(copy, element), Load(text(place, type.element)), span)
    before.append(For(number, Const(LINT, low), Const(LINT, high), Const(LINT, 1), (one,), False, turns, span))
    return copy
