"""What an integer expression is worth: the bounds that it cannot leave, and its value before it wrapped in its type.

`u := u - 2` of a USINT(1..255) that is 1 computes 255, which is inside; the value that is to be checked is -1. So where + - * and NEG
may wrap on the way into a variable with a subrange, they are computed once more as wide as it takes, up to 64 bits, and that is checked.
"""

from scanbench.check.body import fold
from scanbench.check.body.context import Body
from scanbench.check.body.harmless import again, limited
from scanbench.check.body.wide import uncut
from scanbench.program.program import Binary, Compare, Const, Convert, Expr, Intrinsic, Limit, Sequence, Unary
from scanbench.program.types import BOOL, DINT, INT, LINT, Elementary, Kind, Subrange, base_of
from scanbench.program.untyped import bounds

WHOLE = (Kind.INT, Kind.UINT, Kind.BITS)
WRAPPING = ("add", "sub", "mul")
Range = tuple[int, int]


def value_range(expr: Expr) -> tuple[int, int]:
    """Bounds that an integer expression cannot leave."""
    type = expr.type
    assert isinstance(type, Elementary)
    whole = bounds(type)
    match expr:
        case Const(value=int(value)):
            return value, value
        case Limit(low=low, high=high):
            return low, high
        case Convert(operand=operand) if isinstance(operand.type, Elementary) and operand.type.kind in WHOLE:
            inner = value_range(operand)
            return inner if whole[0] <= inner[0] and inner[1] <= whole[1] else whole
        case Binary("mod", right=Const(value=int(value))) if type.kind in WHOLE and value != 0:
            most = abs(value) - 1
            return (-most if type.signed else 0), most
        case Binary("and", right=Const(value=int(value))) if type.kind is Kind.BITS:
            return 0, value
        case Sequence(value=value):
            return value_range(value)
        case Intrinsic("MIN" | "MAX" as name, args=(first, second)) if type.kind in WHOLE:
            a, b = value_range(first), value_range(second)
            choose = min if name == "MIN" else max
            return choose(a[0], b[0]), choose(a[1], b[1])
    return whole


def elementary(expr: Expr) -> Elementary:
    """The type of a number."""
    assert isinstance(expr.type, Elementary)
    return expr.type


# ---- before it wrapped --------------------------------------------------------------------------------------------


def true_value(body: Body, expr: Expr, type: Subrange) -> Expr | None:
    """The value in a wider type, on its way into a variable of this type; None where it cannot wrap, or no type is wide enough."""
    base = base_of(type)
    tree = uncut(body, expr) or expr
    if base.kind not in (Kind.INT, Kind.UINT) or base.bits >= LINT.bits or not _wraps(tree):
        return None
    low, high = _reach(tree, elementary(tree))
    if bounds(base)[0] <= low and high <= bounds(base)[1]:
        return None
    inner, outer = bounds(base)
    low, high = min(low, inner), max(high, outer)
    wide = next((each for each in (INT, DINT, LINT) if bounds(each)[0] <= low and high <= bounds(each)[1]), None)
    return None if wide is None else _widened(tree, elementary(tree), wide)


def _wraps(expr: Expr) -> bool:
    match expr:
        case Binary(op=op, type=type):
            return op in WRAPPING and type.kind in (Kind.INT, Kind.UINT)
        case Unary(op=op, type=type):
            return op == "neg" and type.kind in (Kind.INT, Kind.UINT)
    return False


def _reach(expr: Expr, type: Elementary) -> Range:
    """Bounds of the number that it would be if nothing wrapped, of the + - * and NEG that are computed in this type."""
    if not _wraps(expr) or expr.type != type:
        return value_range(expr)
    if isinstance(expr, Unary):
        low, high = _reach(expr.operand, type)
        return -high, -low
    assert isinstance(expr, Binary)
    first, second = _reach(expr.left, type), _reach(expr.right, type)
    match expr.op:
        case "add":
            return first[0] + second[0], first[1] + second[1]
        case "sub":
            return first[0] - second[1], first[1] - second[0]
    corners = [one * other for one in first for other in second]
    return min(corners), max(corners)


def _widened(expr: Expr, type: Elementary, wide: Elementary) -> Expr:
    """The same + - * and NEG in a wider type."""
    if not _wraps(expr) or expr.type != type:
        return fold.convert(wide, expr)
    if isinstance(expr, Unary):
        return fold.unary(expr.op, wide, _widened(expr.operand, type, wide))
    assert isinstance(expr, Binary)
    return fold.binary(expr.op, wide, _widened(expr.left, type, wide), _widened(expr.right, type, wide))


# ---- what is noted of it ------------------------------------------------------------------------------------------


def written(value: Expr, to: Limit | Subrange) -> Expr:
    """What a note of the base type keeps of a value in a wider one: outside of the bounds on the same side where the base type has
    room there, else on the other; where the bounds are those of the base type it has no room for that."""
    wide = elementary(value)
    base = to.type if isinstance(to, Limit) else base_of(to)
    if wide == base:
        return value
    low, high = bounds(base)
    nearest = fold.convert(base, limited(wide, value, low, high))
    if (to.low > low) == (to.high < high):
        return nearest
    other = Const(base, to.high + 1 if to.low == low else to.low - 1)
    op, limit = ("lt", low) if to.low == low else ("gt", high)
    beyond = Compare(op, BOOL, value, Const(wide, limit))
    once_more = again(nearest)
    assert once_more is not None
    return Intrinsic("SEL", base, (beyond, once_more, other))


def wrapped_valid(valid: Expr, note: Expr, there: Expr, type: Subrange) -> Expr:
    """Whether a note is of the value that is there: `valid`, or it was noted on the other side (`written`), and the bound is there."""
    base = base_of(type)
    low, high = bounds(base)
    if base.bits >= LINT.bits or (type.low > low) == (type.high < high):
        return valid
    at_low = type.low == low
    bound, limit = (type.low, type.high) if at_low else (type.high, type.low)
    is_there = Compare("eq", BOOL, there, Const(base, bound))
    outside = Compare("gt" if at_low else "lt", BOOL, note, Const(base, limit))
    return Binary("or", BOOL, valid, Binary("and", BOOL, is_there, outside))
