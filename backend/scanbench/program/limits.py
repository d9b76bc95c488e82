"""What an expression may be at most, from its text alone: whole numbers and BOOL. What has one value only is a constant.

Sure, not complete: nothing is found out of what variables were given before.
"""

from collections.abc import Iterator
from dataclasses import replace

from scanbench.program.program import Binary, Compare, Const, Convert, Expr, Intrinsic, Limit, Load, Place, Unary
from scanbench.program.types import BOOL, Elementary, Kind, StringType, Type

Limits = tuple[int, int]
"""The smallest and the largest number."""
_WHOLE = (Kind.BOOL, Kind.INT, Kind.UINT, Kind.BITS)
_Folded = tuple[Expr, Limits | None]


def folded(value: Expr) -> Expr:
    """The expression without what its value does not depend on: `x AND FALSE` is FALSE, `x + 0` is x."""
    made, _ = _fold(value)
    if made.type == BOOL and not isinstance(made, Const) and _contradicts(made):
        return Const(BOOL, 0)
    return made


def _fold(value: Expr) -> _Folded:
    """The limits are None where it is no whole number."""
    made, found = _folded_parts(value)
    whole = _of_type(value.type)
    if whole is None:
        return made, None
    if found is None or found[0] < whole[0] or found[1] > whole[1]:  # it may wrap
        found = whole
    if found[0] == found[1] and isinstance(value.type, Elementary):
        return Const(value.type, found[0]), found
    return made, found


def _folded_parts(value: Expr) -> _Folded:
    match value:
        case Const():
            return value, (value.value, value.value) if isinstance(value.value, int) else None
        case Unary():
            operand, found = _fold(value.operand)
            return replace(value, operand=operand), _of_unary(value, found)
        case Binary():
            (left, one), (right, other) = _fold(value.left), _fold(value.right)
            both = None if one is None or other is None else _of_binary(value, one, other)
            return _without_neutral(replace(value, left=left, right=right), one, other), both
        case Compare():
            (left, one), (right, other) = _fold(value.left), _fold(value.right)
            both = None if one is None or other is None else _compared(value.op, one, other)
            return replace(value, left=left, right=right), both
        case Convert():
            operand, found = _fold(value.operand)
            return replace(value, operand=operand), _converted(value, found)
        case Intrinsic(name="LEN", args=(text,)) if isinstance(text.type, StringType):
            return value, (0, text.type.capacity)
        case Limit():
            return value, (value.low, value.high)
    return value, None


def _of_type(type: Type | None) -> Limits | None:
    if not isinstance(type, Elementary) or type.kind not in _WHOLE:
        return None
    if type.signed:
        return -(1 << type.bits - 1), (1 << type.bits - 1) - 1
    return 0, (1 << type.bits) - 1


def _of_unary(value: Unary, found: Limits | None) -> Limits | None:
    if found is None:
        return None
    if value.op == "neg":
        return -found[1], -found[0]
    whole = _of_type(value.type)
    return None if whole is None else (whole[1] - found[1], whole[1] - found[0])


def _of_binary(value: Binary, one: Limits, other: Limits) -> Limits | None:
    single = one[0] == one[1] and other[0] == other[1]
    match value.op:
        case "add":
            return one[0] + other[0], one[1] + other[1]
        case "sub":
            return one[0] - other[1], one[1] - other[0]
        case "mul":
            products = [left * right for left in one for right in other]
            return min(products), max(products)
        case "and" if single or value.type == BOOL:
            return one[0] & other[0], one[1] & other[1]
        case "or" if single or value.type == BOOL:
            return one[0] | other[0], one[1] | other[1]
        case "and" if value.type.kind is Kind.BITS:
            return 0, min(one[1], other[1])
    return None


def _compared(op: str, one: Limits, other: Limits) -> Limits:
    below, above = one[1] < other[0], one[0] > other[1]
    same = one == other and one[0] == one[1]
    never_above, never_below = one[1] <= other[0], one[0] >= other[1]
    yes, no = {
        "eq": (same, below or above), "ne": (below or above, same),
        "lt": (below, never_below), "le": (never_above, above),
        "gt": (above, never_above), "ge": (never_below, below),
    }[op]  # fmt: skip
    return int(yes), int(not no)


def _converted(value: Convert, found: Limits | None) -> Limits | None:
    if found is None:
        return None
    if value.type.kind is Kind.BOOL:
        return _compared("ne", found, (0, 0))
    return found


def _without_neutral(value: Binary, one: Limits | None, other: Limits | None) -> Expr:
    """One side alone where the other one changes nothing."""
    whole = _of_type(value.type)
    if whole is None:
        return value
    none, all = (0, 0), (whole[1], whole[1])
    match value.op:
        case "add" | "or" | "xor" if other == none:
            return value.left
        case "add" | "or" | "xor" if one == none:
            return value.right
        case "sub" if other == none:
            return value.left
        case "mul" if other == (1, 1):
            return value.left
        case "mul" if one == (1, 1):
            return value.right
        case "and" if other == all:
            return value.left
        case "and" if one == all:
            return value.right
    return value


# ---- contradictions -----------------------------------------------------------------------------------------------


def _contradicts(condition: Expr) -> bool:
    """Whether what is joined by AND cannot all be true: each place alone is looked at. With a call nothing is sure."""
    known: dict[Place, Limits] = {}
    for term in _joined(condition):
        found = _wanted(term)
        if found is None:
            return False
        place, (low, high) = found
        before = known.get(place, (low, high))
        known[place] = max(low, before[0]), min(high, before[1])
    return any(low > high for low, high in known.values())


def _joined(condition: Expr) -> Iterator[Expr]:
    waiting = [condition]
    while waiting:
        term = waiting.pop()
        if isinstance(term, Binary) and term.op == "and":
            waiting += (term.left, term.right)
        else:
            yield term


def _wanted(term: Expr) -> tuple[Place, Limits] | None:
    """Between which numbers a place has to be."""
    if isinstance(term, Load):
        return term.place, (1, 1)
    if isinstance(term, Unary) and isinstance(term.operand, Load):
        return term.operand.place, (0, 0)
    if not isinstance(term, Compare):
        return None
    left, right, op = term.left, term.right, term.op
    if isinstance(left, Const):
        left, right = right, left
        op = {"lt": "gt", "le": "ge", "gt": "lt", "ge": "le"}.get(op, op)
    place, whole = _widened(left), _of_type(left.type)
    if place is None or whole is None or not isinstance(right, Const) or not isinstance(right.value, int):
        return None
    number = right.value
    low, high = {
        "eq": (number, number), "lt": (whole[0], number - 1), "le": (whole[0], number),
        "gt": (number + 1, whole[1]), "ge": (number, whole[1]),
    }.get(op, whole)  # fmt: skip
    return place, (low, high)


def _widened(value: Expr) -> Place | None:
    """The place whose number this is, perhaps in a larger type."""
    if isinstance(value, Convert):
        outer, inner = _of_type(value.type), _of_type(value.operand.type)
        fits = outer is not None and inner is not None and outer[0] <= inner[0] and inner[1] <= outer[1]
        return _widened(value.operand) if fits else None
    return value.place if isinstance(value, Load) else None
