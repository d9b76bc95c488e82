"""Operators on values, by the rules of `program/program.py`."""

import math
import operator
import struct
from collections.abc import Callable

from scanbench.program.types import Elementary, Kind
from scanbench.program.untyped import bounds

Number = int | float
Operand = Callable[[int], Number]
"""Takes the offset of the running instance."""

SINGLE = struct.Struct("<f")


def wrapper(type: Elementary) -> Callable[[int], int]:
    """Cuts an integer to the width of its type."""
    mask = (1 << type.bits) - 1
    if not type.signed:
        return lambda value: value & mask
    half = 1 << type.bits - 1
    return lambda value: (value + half & mask) - half


def to_single(value: float) -> float:
    """Nearest single-precision number; beyond the largest, infinity."""
    try:
        return float(SINGLE.unpack(SINGLE.pack(value))[0])
    except OverflowError:
        return math.copysign(math.inf, value)


def rounder(type: Elementary) -> Callable[[float], float]:
    return to_single if type.size == 4 else float


def divide_real(a: float, b: float) -> float:
    if b != 0:
        return a / b
    if a == 0 or math.isnan(a) or math.isnan(b):
        return math.nan
    return math.copysign(math.inf, a) * math.copysign(1, b)


def divide_integer(a: int, b: int) -> int:
    """Towards zero; the caller has looked for zero."""
    quotient = abs(a) // abs(b)
    return quotient if (a < 0) == (b < 0) else -quotient


def modulo(a: int, b: int) -> int:
    """Sign of the dividend; by zero it is 0."""
    if b == 0:
        return 0
    rest = abs(a) % abs(b)
    return -rest if a < 0 else rest


# Each closure has its operator written out: a call of a function for it would double the time.


def compare(op: str, left: Operand, right: Operand) -> Operand:
    """A comparison of two operands, as a BOOL."""
    match op:
        case "eq":
            return lambda instance: left(instance) == right(instance)
        case "ne":
            return lambda instance: left(instance) != right(instance)
        case "lt":
            return lambda instance: left(instance) < right(instance)
        case "le":
            return lambda instance: left(instance) <= right(instance)
        case "gt":
            return lambda instance: left(instance) > right(instance)
        case _:
            return lambda instance: left(instance) >= right(instance)


def real(op: str, type: Elementary, left: Operand, right: Operand) -> Operand:
    """An operator on REAL or LREAL, rounded."""
    to_type = rounder(type)
    match op:
        case "add":
            return lambda instance: to_type(left(instance) + right(instance))
        case "sub":
            return lambda instance: to_type(left(instance) - right(instance))
        case "mul":
            return lambda instance: to_type(left(instance) * right(instance))
        case _:
            return lambda instance: to_type(divide_real(left(instance), right(instance)))


def integer(op: str, type: Elementary, left: Operand, right: Operand) -> Operand:
    """An operator on integers, bit strings, BOOL and times, but for `div`; cut to the width."""
    if op in BITWISE:
        function = BITWISE[op]
        return lambda instance: function(left(instance), right(instance))
    mask, half = (1 << type.bits) - 1, (1 << type.bits - 1) if type.signed else 0
    match op:
        case "add":
            return lambda instance: (left(instance) + right(instance) + half & mask) - half  # type: ignore[operator]
        case "sub":
            return lambda instance: (left(instance) - right(instance) + half & mask) - half  # type: ignore[operator]
        case "mul":
            return lambda instance: (left(instance) * right(instance) + half & mask) - half  # type: ignore[operator]
        case _:
            return lambda instance: modulo(left(instance), right(instance))  # type: ignore[arg-type]


def short(op: str, left: Operand, right: Operand) -> Operand:
    """AND_THEN or OR_ELSE."""
    if op == "and":
        return lambda instance: left(instance) and right(instance)
    return lambda instance: left(instance) or right(instance)


BITWISE: dict[str, Callable[..., int]] = {"and": operator.and_, "or": operator.or_, "xor": operator.xor}
"""Of operands within the width, so the result is."""


def converter(source: Elementary, target: Elementary) -> Callable[[float], int | float]:
    """`Convert` between elementary types."""
    if target.kind is Kind.REAL:
        if source.kind is Kind.REAL:
            return rounder(target)
        return to_single_exact if target.size == 4 else float
    if target.kind is Kind.BOOL:
        return lambda value: value != 0
    wrap = wrapper(target)
    if source.kind is not Kind.REAL:
        return wrap  # type: ignore[return-value]
    low, high = bounds(target)

    def saturate(value: float) -> int:
        if math.isnan(value):
            return 0
        if math.isinf(value):
            return high if value > 0 else low
        return min(max(round(value), low), high)

    return saturate


def to_single_exact(value: float) -> float:
    """An integer to single precision in one rounding: by way of a double, large ones would be rounded twice."""
    whole = int(value)
    magnitude = abs(whole)
    if magnitude < 1 << 53:
        return to_single(float(whole))
    shift = magnitude.bit_length() - 30
    kept = magnitude >> shift << 1 | (magnitude & (1 << shift) - 1 != 0)
    return math.copysign(to_single(math.ldexp(float(kept), shift - 1)), whole)


def truncate(value: float, target: Elementary) -> int:
    low, high = bounds(target)
    if math.isnan(value):
        return 0
    if math.isinf(value):
        return high if value > 0 else low
    return min(max(math.trunc(value), low), high)
