"""What an integer expression is worth: the bounds that it cannot leave, and its value before it wrapped in its type.

`u := u - 2` of a USINT(1..255) that is 1 computes 255, which is inside; the value that is to be checked is -1. So what may wrap on the
way into a variable with a subrange is computed once more as wide as it takes, and that is checked. As far as a value wraps only
as a whole (+ - * NEG, ABS, DIV by -1, conversions that cut), the wide number and the wrapped one are the same modulo the width: it is
one number that is checked at the end. What wraps before something else looks at it (`(a + b) MOD 10`) is recorded there, with the
bounds of its type, and goes on as it wrapped.
"""

from dataclasses import dataclass

from scanbench.check.body import fold
from scanbench.check.body.context import Body, Truth
from scanbench.check.body.harmless import again, limited
from scanbench.check.body.wide import uncut
from scanbench.problems import Span
from scanbench.program.program import (
    Assign,
    Base,
    Binary,
    Compare,
    Const,
    Convert,
    Expr,
    Halt,
    If,
    Intrinsic,
    Limit,
    Load,
    Place,
    Sequence,
    Stmt,
    Unary,
    Violates,
)
from scanbench.program.sites import CheckSite, TrapKind
from scanbench.program.types import BOOL, DINT, INT, LINT, Elementary, Kind, Subrange, base_of
from scanbench.program.untyped import bounds
from scanbench.program.wide_types import WIDE, WIDE_UNSIGNED

WHOLE = (Kind.INT, Kind.UINT, Kind.BITS)
NUMBERS = (Kind.INT, Kind.UINT)
WRAPPING = ("add", "sub", "mul")
WIDER = (INT, DINT, LINT, WIDE, WIDE_UNSIGNED)
Range = tuple[int, int]


def elementary(expr: Expr) -> Elementary:
    """The type of a number."""
    assert isinstance(expr.type, Elementary)
    return expr.type


def value_range(expr: Expr) -> Range:
    """Bounds that an integer expression cannot leave."""
    type = elementary(expr)
    whole = bounds(type)
    match expr:
        case Const(value=int(value)):
            return value, value
        case Limit(low=low, high=high):
            return low, high
        case Convert(operand=operand) if isinstance(operand.type, Elementary) and operand.type.kind in WHOLE:
            inner = value_range(operand)
            return inner if _inside(inner, whole) else whole
        case Binary("mod", right=Const(value=int(value))) if type.kind in WHOLE and value != 0:
            return _rest(value_range(expr.left), abs(value) - 1)
        case Binary("and", right=Const(value=int(value))) if type.kind is Kind.BITS:
            return 0, value
        case Binary(op=op, left=left, right=right) if type.kind in NUMBERS and op in (*WRAPPING, "div"):
            found = _joined(op, value_range(left), value_range(right))
            return found if _inside(found, whole) else whole
        case Sequence(value=value):
            return value_range(value)
        case Intrinsic("MIN" | "MAX" as name, args=(first, second)) if type.kind in WHOLE:
            a, b = value_range(first), value_range(second)
            choose = min if name == "MIN" else max
            return choose(a[0], b[0]), choose(a[1], b[1])
    return whole


def _inside(inner: Range, outer: Range) -> bool:
    return outer[0] <= inner[0] and inner[1] <= outer[1]


def _rest(left: Range, most: int) -> Range:
    return (max(-most, left[0]) if left[0] < 0 else 0), (min(most, left[1]) if left[1] > 0 else 0)


def _joined(op: str, first: Range, second: Range) -> Range:
    """Bounds of the number that an operation on numbers within these gives."""
    match op:
        case "add":
            return first[0] + second[0], first[1] + second[1]
        case "sub":
            return first[0] - second[1], first[1] - second[0]
        case "mul":
            corners = [one * other for one in first for other in second]
            return min(corners), max(corners)
    divisors = {each for each in (*second, -1, 1) if each and second[0] <= each <= second[1]} or {1}
    corners = [int(abs(a) // abs(b)) * (1 if (a < 0) == (b < 0) else -1) for a in first for b in divisors]
    return min(*corners, 0), max(*corners, 0)


# ---- before it wrapped --------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Way:
    """The way of a value into a variable with a subrange."""

    body: Body
    span: Span
    variable: str
    policy: str

    def true(self, expr: Expr, base: Elementary) -> Expr:
        """The value as it is to be checked, of `base` or wider: before it wrapped. What wrapped inside of it is recorded."""
        if self.policy == "off" or base.kind not in NUMBERS or self.body.pou is None:
            return expr
        carried = self.carried(expr, base)
        return self.exact(expr) if carried is None else carried[0]

    def carried(self, expr: Expr, base: Elementary) -> tuple[Expr, Range] | None:
        """The number in a wider type, and its bounds; None where it cannot be one that `base` does not have."""
        tree = uncut(self.body, expr) or expr
        if base.size < LINT.size and (whole := _whole_of_real(tree)) is not None:
            return self._inner(whole), bounds(LINT)
        found = self._reach(tree)
        if _inside(found, bounds(base)):
            return None
        wide = _wide_enough((min(found[0], bounds(base)[0]), max(found[1], bounds(base)[1])))
        return None if wide is None else (self._widened(tree, wide), found)

    def _reach(self, expr: Expr) -> Range:
        """Bounds of the number that it would be if nothing wrapped as a whole."""
        type = elementary(expr)
        if type.kind not in NUMBERS:
            return value_range(expr) if type.kind in WHOLE else bounds(type)
        match expr:
            case Load(place) if (truth := self._truth(place)) is not None:
                return truth.reach
            case Convert(operand=operand) if _is_number(operand):
                return self._reach(operand) if type.size <= elementary(operand).size else value_range(operand)
            case Unary("neg", operand=operand):
                low, high = self._reach(operand)
                return self._known(expr, (-high, -low))
            case Binary(op=op, left=left, right=right) if op in WRAPPING:
                return self._known(expr, _joined(op, self._reach(left), self._reach(right)))
            case Binary("div", left=left, right=right):
                return _joined("div", value_range(left), value_range(right))
            case Intrinsic("ABS", args=(only,)):
                low, high = value_range(only)
                return (0 if low <= 0 <= high else min(abs(low), abs(high))), max(abs(low), abs(high))
        return value_range(expr)

    def _known(self, expr: Unary | Binary, found: Range) -> Range:
        """What no type is wide enough for is computed of operands that have wrapped."""
        return found if _wide_enough(found) is not None else self._shallow(expr)

    def _shallow(self, expr: Unary | Binary) -> Range:
        if isinstance(expr, Unary):
            low, high = value_range(expr.operand)
            return -high, -low
        return _joined(expr.op, value_range(expr.left), value_range(expr.right))

    def _truth(self, place: Place) -> Truth | None:
        plain = place.base is Base.FRAME and not place.indices and place.slot is None and place.reference is None
        return self.body.truths.get(place.offset) if plain else None

    def _widened(self, expr: Expr, wide: Elementary) -> Expr:
        """The same number in a wider type."""
        type = elementary(expr)
        match expr:
            case Load(place) if (truth := self._truth(place)) is not None:
                return fold.convert(wide, Load(truth.place))
            case Convert(operand=operand) if type.kind in NUMBERS and _is_number(operand):
                if type.size <= elementary(operand).size:
                    return self._widened(operand, wide)
            case Unary("neg", operand=operand) if type.kind in NUMBERS:
                return fold.unary("neg", wide, self._operand(expr, operand, wide))
            case Binary(op=op, left=left, right=right) if type.kind in NUMBERS and op in WRAPPING:
                return fold.binary(op, wide, self._operand(expr, left, wide), self._operand(expr, right, wide))
            case Binary("div", left=left, right=right) if not _inside(self._reach(expr), bounds(type)):
                return self._divided(expr, wide)
            case Intrinsic("ABS", args=(only,)) if type.kind in NUMBERS:
                return Intrinsic("ABS", wide, (fold.convert(wide, self.exact(only)),))
        return fold.convert(wide, self.exact(expr))

    def _operand(self, expr: Unary | Binary, operand: Expr, wide: Elementary) -> Expr:
        if isinstance(expr, Unary):
            low, high = self._reach(operand)
            deep: Range = (-high, -low)
        else:
            deep = _joined(expr.op, self._reach(expr.left), self._reach(expr.right))
        return fold.convert(wide, self.exact(operand)) if _wide_enough(deep) is None else self._widened(operand, wide)

    def _divided(self, expr: Binary, wide: Elementary) -> Expr:
        """Only the smallest number by -1 wraps, and nothing wider than the type has to be divided for that."""
        type = expr.type
        left, right = (self.body.temporary(type, self.span) for _ in range(2))
        kept = (Assign(left, self.exact(expr.left), self.span), Assign(right, self.exact(expr.right), self.span))
        by_minus_one = Compare("eq", BOOL, Load(right), Const(type, -1))
        quotient = fold.convert(wide, Binary("div", type, Load(left), Load(right), expr.trap))
        negative = Unary("neg", wide, fold.convert(wide, Load(left)))
        return Sequence(kept, Intrinsic("SEL", wide, (by_minus_one, quotient, negative)))

    # ---- what wraps before something else looks at it -------------------------------------------------------------

    def exact(self, expr: Expr) -> Expr:
        """The value itself, which wraps as the standard says; that it does is recorded."""
        carried = self.carried(expr, elementary(expr)) if _is_number(expr) else None
        if carried is None:
            return self._inner(expr)
        type, number = elementary(expr), carried[0]
        kept = self.body.temporary(elementary(number), self.span)
        return Sequence((Assign(kept, number, self.span), self._recorded(kept, type)), wrapped(expr, kept))

    def _inner(self, expr: Expr) -> Expr:
        """What does not wrap itself, but perhaps an operand of it."""
        match expr:
            case Convert(type, operand) if isinstance(type, Elementary) and isinstance(operand.type, Elementary):
                made = self.exact(operand)
                return expr if made is operand else Convert(type, made)
            case Unary(op, type, operand):
                made = self.exact(operand)
                return expr if made is operand else Unary(op, type, made)
            case Binary(op, type, left, right, trap, short) if not short and type.kind is not Kind.BOOL:
                first, second = self.exact(left), self.exact(right)
                same = first is left and second is right
                return expr if same else Binary(op, type, first, second, trap)
            case Intrinsic(name, Elementary() as type, args):
                given = tuple(self.exact(each) if isinstance(each.type, Elementary) else each for each in args)
                same = all(one is other for one, other in zip(given, args, strict=True))
                return expr if same else Intrinsic(name, type, given)
        return expr

    def _recorded(self, number: Place, type: Elementary) -> Stmt:
        low, high = bounds(type)
        what = f"{type} for {self.variable}"
        site = self.body.report.check(CheckSite(self.span, self.body.scope.pou, what, low, high, ""))
        outside = Violates(BOOL, Load(number), low, high, site)
        if self.policy != "trap":
            return Assign(self.body.temporary(BOOL, self.span), outside, self.span)
        trap = self.body.trap(TrapKind.BOUNDS, self.span, f"{what} is outside of {low}..{high}")
        return If(((outside, (Halt(trap, self.span),)),), (), self.span)


def wrapped(expr: Expr, number: Place) -> Expr:
    """The value that an expression has, of the number that it was before it wrapped; a REAL is brought to the nearest bound."""
    type, wide = elementary(expr), number.type
    assert isinstance(wide, Elementary)
    if _whole_of_real(expr) is None:
        return fold.convert(type, Load(number))
    return fold.convert(type, limited(wide, Load(number), *bounds(type)))


def _whole_of_real(expr: Expr) -> Expr | None:
    """The 64 bits of a REAL that becomes a shorter integer; None for what is something else."""
    match expr:
        case Convert(Elementary(kind=Kind.INT | Kind.UINT, size=size), operand) if size < LINT.size:
            real = isinstance(operand.type, Elementary) and operand.type.kind is Kind.REAL
            return Convert(LINT, operand) if real else None
        case Intrinsic("TRUNC", Elementary(size=size), args) if size < LINT.size:
            return Intrinsic("TRUNC", LINT, args)
    return None


def _is_number(expr: Expr) -> bool:
    return isinstance(expr.type, Elementary) and expr.type.kind in NUMBERS


def _wide_enough(found: Range) -> Elementary | None:
    return next((each for each in WIDER if _inside(found, bounds(each))), None)


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
    if (type.low > low) == (type.high < high):
        return valid
    at_low = type.low == low
    bound, limit = (type.low, type.high) if at_low else (type.high, type.low)
    is_there = Compare("eq", BOOL, there, Const(base, bound))
    outside = Compare("gt" if at_low else "lt", BOOL, note, Const(base, limit))
    return Binary("or", BOOL, valid, Binary("and", BOOL, is_there, outside))
