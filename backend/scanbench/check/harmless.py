"""Which expressions may be evaluated any number of times."""

from scanbench.check.program import Binary, Compare, Const, Convert, Expr, Intrinsic, Load, Unary


def harmless(expr: Expr) -> bool:
    """Whether it only reads: it may be evaluated any number of times."""
    match expr:
        case Const():
            return True
        case Load(place):
            inner = [part for index in place.indices for part in (index.value, index.low, index.high, index.stride)]
            inner += [place.reference] if place.reference is not None else []
            inner += [Load(place.slot)] if place.slot is not None else []
            return all(isinstance(part, int) or harmless(part) for part in inner)
        case Unary(operand=operand) | Convert(operand=operand):
            return harmless(operand)
        case Binary(left=left, right=right) | Compare(left=left, right=right):
            return harmless(left) and harmless(right)
        case Intrinsic(args=args):
            return all(map(harmless, args))
    return False
