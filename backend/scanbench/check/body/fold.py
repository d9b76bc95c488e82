"""Constant folding, by the rules of `program.py`: what is known at build time costs nothing at run time."""

import math
from typing import TypeVar

from scanbench.program.numbers import round_real
from scanbench.program.program import Binary, Compare, Const, Convert, Expr, Unary
from scanbench.program.types import BOOL, Elementary, Kind, StringType
from scanbench.program.untyped import ANY_INT, ANY_REAL, bounds, wrap


def unary(op: str, type: Elementary, operand: Expr) -> Expr:
    if not isinstance(operand, Const) or isinstance(operand.value, bytes):
        return Unary(op, type, operand)
    if op == "neg":
        value = -operand.value
        return Const(type, value if type.kind is Kind.REAL or type == ANY_INT else wrap(int(value), type))
    mask = 1 if type.kind is Kind.BOOL else (1 << type.bits) - 1
    return Const(type, int(operand.value) ^ mask)


def binary(op: str, type: Elementary, left: Expr, right: Expr, trap: int = 0) -> Expr:
    if isinstance(left, Const) and isinstance(right, Const):
        a, b = left.value, right.value
        if not isinstance(a, bytes) and not isinstance(b, bytes):
            value = _real(op, float(a), float(b)) if type.kind is Kind.REAL else _integer(op, int(a), int(b))
            if value is not None:
                if type in (ANY_INT, ANY_REAL):
                    return Const(type, value)
                if type.kind is Kind.REAL:
                    return Const(type, round_real(float(value), type))
                return Const(type, wrap(int(value), type))
    return Binary(op, type, left, right, trap)


def _integer(op: str, a: int, b: int) -> int | None:
    match op:
        case "add":
            return a + b
        case "sub":
            return a - b
        case "mul":
            return a * b
        case "and":
            return a & b
        case "or":
            return a | b
        case "xor":
            return a ^ b
        case "div" if b != 0:
            return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
        case "mod":
            return 0 if b == 0 else (-1 if a < 0 else 1) * (abs(a) % abs(b))
    return None


def _real(op: str, a: float, b: float) -> float | None:
    match op:
        case "add":
            return a + b
        case "sub":
            return a - b
        case "mul":
            return a * b
        case "div":
            if b != 0:
                return a / b
            return math.nan if a == 0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1, b)
    return None


def compare(op: str, type: Elementary, left: Expr, right: Expr) -> Expr:
    if isinstance(left, Const) and isinstance(right, Const):
        a, b = left.value, right.value
        if isinstance(a, bytes) and isinstance(b, bytes):
            return Const(BOOL, int(_ordered(op, _codes(left.type, a), _codes(right.type, b))))
        if not isinstance(a, bytes) and not isinstance(b, bytes):
            return Const(BOOL, int(_ordered(op, a, b)))
    return Compare(op, type, left, right)


def _codes(type: Elementary | StringType, data: bytes) -> list[int]:
    """Of each character."""
    width = type.width if isinstance(type, StringType) else 1
    return [int.from_bytes(data[at : at + width], "little") for at in range(0, len(data), width)]


Ordered = TypeVar("Ordered", list[int], float)


def _ordered(op: str, a: Ordered, b: Ordered) -> bool:
    match op:
        case "eq":
            return a == b
        case "ne":
            return a != b
        case "lt":
            return a < b
        case "le":
            return a <= b
        case "gt":
            return a > b
    return a >= b


def convert(type: Elementary, operand: Expr) -> Expr:
    """Convert as an engine would."""
    if operand.type == type:
        return operand
    if not isinstance(operand, Const) or isinstance(operand.type, StringType) or isinstance(operand.value, bytes):
        return Convert(type, operand)
    value = operand.value
    if type.kind is Kind.REAL:
        return Const(type, int_to_real(value, type) if isinstance(value, int) else round_real(value, type))
    if type.kind is Kind.BOOL:
        return Const(type, int(value != 0))
    if isinstance(value, float):
        return Const(type, real_to_int(value, type))
    return Const(type, wrap(value, type))


def real_to_int(value: float, type: Elementary) -> int:
    low, high = bounds(type)
    if math.isnan(value):
        return 0
    if math.isinf(value):
        return high if value > 0 else low
    return min(max(round(value), low), high)


def int_to_real(value: int, type: Elementary) -> float:
    """Nearest in one rounding: by way of a double it would be two, and wrong for some 64-bit numbers."""
    if type.size == 8 or abs(value) <= 1 << 53:
        return round_real(float(value), type)
    magnitude = abs(value)
    shift = magnitude.bit_length() - 40
    sticky = int(magnitude & ((1 << shift) - 1) != 0)
    return math.copysign(round_real(math.ldexp(float((magnitude >> shift) << 1 | sticky), shift - 1), type), value)
