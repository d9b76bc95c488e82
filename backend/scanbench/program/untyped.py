"""Literals before they have a type: the other operands decide whether `7` becomes INT, REAL or WORD."""

from collections.abc import Sequence
from functools import cache

from scanbench.program.program import Const, Expr
from scanbench.program.types import (
    DINT,
    ELEMENTARY,
    LINT,
    LREAL,
    REAL,
    ULINT,
    Elementary,
    Enumeration,
    Kind,
    StringType,
    Subrange,
    Type,
    base_of,
)

ANY_INT = Elementary("integer literal", Kind.INT, 0)
ANY_REAL = Elementary("real literal", Kind.REAL, 0)


def is_untyped(expr: Expr) -> bool:
    return isinstance(expr, Const) and expr.type in (ANY_INT, ANY_REAL)


def bounds(type: Elementary) -> tuple[int, int]:
    """Smallest and largest integer of a type."""
    if type.kind is Kind.BOOL:
        return 0, 1
    if type.signed:
        return -(1 << (type.bits - 1)), (1 << (type.bits - 1)) - 1
    return 0, (1 << type.bits) - 1


def wrap(value: int, type: Elementary) -> int:
    """The value an integer has after overflow at the width of its type."""
    low, high = bounds(type)
    return value if low <= value <= high else (value - low) % (high - low + 1) + low


def settle(expr: Expr) -> Expr:
    """Gives an untyped literal its default type, for a context that asks for none: DINT (LINT, ULINT), LREAL."""
    if isinstance(expr, Const) and expr.type == ANY_INT:
        value = int(expr.value)
        for type in (DINT, LINT, ULINT):
            low, high = bounds(type)
            if low <= value <= high:
                return Const(type, value)
        return Const(ULINT, wrap(value, ULINT))
    if isinstance(expr, Const) and expr.type == ANY_REAL:
        return Const(LREAL, expr.value)
    return expr


def real_beside(types: Sequence[Type | None], wanted: Type | None) -> Elementary:
    """The type of a real literal in an operation with values of these types: REAL if that is wanted and holds all of them, else LREAL."""
    return REAL if wanted == REAL and all(type is not None and widens(type, REAL) for type in types) else LREAL


def widens(source: Type, target: Type) -> bool:
    """Whether a value of `source` can be used as a `target` without loss (IEC 61131-3, figure 11)."""
    if source == target:
        return True
    if isinstance(source, StringType) and isinstance(target, StringType):
        return source.width == target.width
    if isinstance(source, Elementary) and base_of(source) is not source:
        # as a number, never back to a different enumeration
        return widens(base_of(source), target)
    if isinstance(target, Subrange):
        return widens(source, base_of(target))
    if isinstance(target, Enumeration) or not isinstance(source, Elementary) or not isinstance(target, Elementary):
        return False
    match source.kind, target.kind:
        case (Kind.INT, Kind.INT) | (Kind.UINT, Kind.UINT) | (Kind.BITS, Kind.BITS) | (Kind.REAL, Kind.REAL):
            return source.size < target.size
        case (Kind.UINT, Kind.INT):
            return source.size < target.size
        case (Kind.INT | Kind.UINT, Kind.REAL):
            return source.size < target.size
        case (Kind.BOOL, Kind.BITS):
            return True
        case (Kind.TIME, Kind.TIME) | (Kind.DATE, Kind.DATE):
            return target.name == f"L{source.name}"
    return False


@cache
def common(left: Elementary, right: Elementary) -> Elementary | None:
    """The smallest type that both widen to; of one enumeration, that."""
    if left == right and not isinstance(left, Subrange):
        return left
    for type in sorted(ELEMENTARY.values(), key=lambda type: type.size):
        if widens(left, type) and widens(right, type):
            return type
    return None
