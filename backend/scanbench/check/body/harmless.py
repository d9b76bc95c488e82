"""Which expressions may be evaluated any number of times, and how those are that must not record anything twice."""

from dataclasses import replace

from scanbench.program.program import (
    Binary,
    Compare,
    Const,
    Convert,
    Expr,
    Index,
    Intrinsic,
    Limit,
    Load,
    Place,
    Unary,
)
from scanbench.program.types import Elementary


def harmless(expr: Expr) -> bool:
    """Whether it only reads, and records nothing."""
    return again(expr) == expr


def again(expr: Expr) -> Expr | None:
    """An expression that gives the same value again and records no second violation; None for an expression with a call."""
    match expr:
        case Const():
            return expr
        case Load(place):
            found = again_at(place)
            return None if found is None else Load(found)
        case Unary(operand=operand) | Convert(operand=operand):
            inner = again(operand)
            return None if inner is None else replace(expr, operand=inner)
        case Binary(left=left, right=right) | Compare(left=left, right=right):
            first, second = again(left), again(right)
            return None if first is None or second is None else replace(expr, left=first, right=second)
        case Intrinsic(args=args):
            made = [again(arg) for arg in args]
            known = tuple(each for each in made if each is not None)
            return replace(expr, args=known) if len(known) == len(args) else None
        case Limit(type, value, low, high):
            inner = again(value)
            if inner is None or not isinstance(inner.type, Elementary) or inner.type == type:
                return None if inner is None else limited(type, inner, low, high)
            return Convert(type, limited(inner.type, inner, low, high))
    return None


def again_at(place: Place) -> Place | None:
    """The same place."""
    indices = [_again_index(each) for each in place.indices]
    slot = None if place.slot is None else again_at(place.slot)
    reference = None if place.reference is None else again(place.reference)
    known = tuple(each for each in indices if each is not None)
    if len(known) < len(indices) or (slot is None) != (place.slot is None):
        return None
    if (reference is None) != (place.reference is None):
        return None
    return replace(place, indices=known, slot=slot, reference=reference)


def _again_index(index: Index) -> Index | None:
    parts = [each if isinstance(each, int) else again(each) for each in (index.low, index.high, index.stride)]
    value, (low, high, stride) = again(index.value), parts
    if value is None or low is None or high is None or stride is None:
        return None
    return replace(index, value=value, low=low, high=high, stride=stride)


def limited(type: Elementary, value: Expr, low: int, high: int) -> Expr:
    """The value, brought between the bounds without a record."""
    return Intrinsic("MIN", type, (Intrinsic("MAX", type, (value, Const(type, low))), Const(type, high)))
