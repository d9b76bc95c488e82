"""Evaluates standard functions of constants by the rules of `check/standard/__init__.py`, so that declarations may use them.

Only what has a plain value is folded; NaN, infinities and whatever is out of a function's domain is left to run time.
"""

import math
from collections.abc import Callable

from scanbench.program.numbers import round_real
from scanbench.program.program import Const, Expr, Intrinsic
from scanbench.program.types import Elementary, Kind, StringType
from scanbench.program.untyped import bounds, wrap

REALS: dict[str, Callable[..., float]] = {
    "SQRT": math.sqrt, "LN": math.log, "LOG": math.log10, "EXP": math.exp, "SIN": math.sin, "COS": math.cos,
    "TAN": math.tan, "ASIN": math.asin, "ACOS": math.acos, "ATAN": math.atan, "ATAN2": math.atan2,
}  # fmt: skip


def intrinsic(name: str, type: Elementary | StringType, args: tuple[Expr, ...]) -> Expr:
    """The intrinsic, or its value where the arguments are constants."""
    if isinstance(type, Elementary) and args:
        numbers = [arg.value for arg in args if isinstance(arg, Const) and not isinstance(arg.value, bytes)]
        if len(numbers) == len(args) and all(map(math.isfinite, numbers)):
            try:
                value = _value(name, type, numbers)
            except (ValueError, OverflowError):
                value = None
            if value is not None:
                return Const(type, round_real(value, type) if isinstance(value, float) else value)
    return Intrinsic(name, type, args)


def _value(name: str, type: Elementary, args: list[int | float]) -> int | float | None:
    match name:
        case "MIN":
            return min(args[1], args[0])
        case "MAX":
            return max(args[1], args[0])
        case "SEL":
            return args[2] if args[0] else args[1]
        case "MUX":
            return args[1:][min(max(int(args[0]), 0), len(args) - 2)]
        case "ABS":
            return abs(args[0]) if type.kind is Kind.REAL else wrap(abs(int(args[0])), type)
        case "TRUNC":
            low, high = bounds(type)
            return min(max(math.trunc(args[0]), low), high)
        case "SHL" | "SHR" | "ROL" | "ROR":
            return _moved(name, type.bits, int(args[0]), int(args[1]))
    return REALS[name](*args) if name in REALS else None


def _moved(name: str, width: int, value: int, count: int) -> int:
    mask = (1 << width) - 1
    if name in ("SHL", "SHR"):
        if not 0 <= count < width:
            return 0
        return value << count & mask if name == "SHL" else value >> count
    count = (count if name == "ROL" else -count) % width
    return (value << count | value >> width - count) & mask
