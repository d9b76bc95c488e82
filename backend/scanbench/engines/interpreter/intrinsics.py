"""Standard functions that ST cannot say; their rules are stated in `check/standard/__init__.py`."""

import math
import re
from collections.abc import Callable
from typing import cast

from scanbench.engines.interpreter.arithmetic import rounder, truncate, wrapper
from scanbench.engines.interpreter.memory import CANONICAL_NAN, Value, packing
from scanbench.program.program import Intrinsic
from scanbench.program.types import Elementary, Kind, StringType

Function = Callable[..., Value]
LARGEST_CODE = 0xFF
"""In a STRING."""

NUMBER = re.compile(r"[ \t]*([+-]?[0-9]+)")
REAL = re.compile(r"[ \t]*([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)")


def intrinsic(node: Intrinsic) -> Function:
    """The function of the argument values, for all but CLOCK."""
    made = ANY.get(node.name) or STRINGS.get(node.name)
    if made is None:
        assert isinstance(node.type, Elementary)
        made = _number(node, node.type)
    if not isinstance(node.type, StringType):
        return made
    if node.name == "RECODE" and node.type.width == 1:
        made = _narrow
    capacity = node.type.capacity
    return lambda *args: cast(str, made(*args))[:capacity]


def _number(node: Intrinsic, type: Elementary) -> Function:
    name = node.name
    match name:
        case "ABS":
            return abs if type.kind is Kind.REAL else lambda a: wrapper(type)(abs(a))
        case "TRUNC":
            return lambda a: truncate(a, type)
        case "SHL" | "SHR" | "ROL" | "ROR":
            return _shift(name, type.bits)
        case "BITCAST":
            source = node.args[0].type
            assert isinstance(source, Elementary)
            pack, unpack = packing(source).pack, packing(type).unpack
            return lambda a: cast(Value, unpack(CANONICAL_NAN[source.size] if a != a else pack(a))[0])
        case "SWAP":
            pack, unpack = packing(type).pack, packing(type).unpack
            return lambda a: cast(Value, unpack(pack(a)[::-1])[0])
    return _real(name, type)


def _shift(name: str, width: int) -> Function:
    mask = (1 << width) - 1

    def shift_left(value: int, count: int) -> int:
        return value << count & mask if 0 <= count < width else 0

    def shift_right(value: int, count: int) -> int:
        return value >> count if 0 <= count < width else 0

    def rotate(value: int, count: int) -> int:
        count %= width
        return (value << count | value >> width - count) & mask

    if name in ("ROL", "ROR"):
        return rotate if name == "ROL" else lambda value, count: rotate(value, -count)
    return shift_left if name == "SHL" else shift_right


def _log(function: Callable[[float], float]) -> Callable[[float], float]:
    def log(a: float) -> float:
        return -math.inf if a == 0 else function(a)

    return log


def power(a: float, b: float) -> float:
    """C's pow, where Python raises."""
    odd = b == math.floor(b) and math.fmod(b, 2) != 0 if math.isfinite(b) else False
    try:
        return math.pow(a, b)
    except OverflowError:
        return -math.inf if a < 0 and odd else math.inf
    except ValueError:
        if a == 0:
            return math.copysign(math.inf, a) if odd else math.inf
        return math.nan


REALS: dict[str, Callable[..., float]] = {
    "SQRT": math.sqrt, "LN": _log(math.log), "LOG": _log(math.log10), "EXP": math.exp, "SIN": math.sin,
    "COS": math.cos, "TAN": math.tan, "ASIN": math.asin, "ACOS": math.acos, "ATAN": math.atan, "ATAN2": math.atan2, "EXPT": power,
}  # fmt: skip


def _real(name: str, type: Elementary) -> Function:
    function, to_type = REALS[name], rounder(type)

    def compute(*args: float) -> float:
        try:
            return to_type(function(*args))
        except ValueError:
            return math.nan
        except OverflowError:
            return math.inf

    return compute


def _mid(text: str, count: int, start: int) -> str:
    return text[start - 1 : start - 1 + max(count, 0)] if 1 <= start <= len(text) else ""


def _insert(text: str, other: str, at: int) -> str:
    at = min(max(at, 0), len(text))
    return text[:at] + other + text[at:]


def _delete(text: str, count: int, start: int) -> str:
    if not 1 <= start <= len(text) or count <= 0:
        return text
    return text[: start - 1] + text[start - 1 + count :]


def _replace(text: str, other: str, count: int, start: int) -> str:
    start = min(max(start, 1), len(text) + 1)
    return text[: start - 1] + other + text[start - 1 + max(count, 0) :]


def _narrow(text: str) -> str:
    return "".join(each if ord(each) <= LARGEST_CODE else "?" for each in text)


def _to_int(text: str) -> int:
    match = NUMBER.match(text)
    if match is None:
        return 0
    digits = match.group(1).lstrip("+-0")
    magnitude = int(digits or "0") if len(digits) < 20 else 1 << 63  # Python refuses to read very long numbers
    return max(-magnitude, -(1 << 63)) if match.group(1).startswith("-") else min(magnitude, (1 << 63) - 1)


def _to_real(text: str) -> float:
    match = REAL.match(text)
    return float(match.group(1)) if match else 0.0


ANY: dict[str, Function] = {
    "MIN": lambda a, b: min(b, a),  # a if a < b else b: of a NaN, the second
    "MAX": lambda a, b: max(b, a),
    "SEL": lambda gate, a, b: b if gate else a,
    "MUX": lambda number, *values: values[min(max(number, 0), len(values) - 1)],
}
"""The same for numbers and strings."""
STRINGS: dict[str, Function] = {
    "LEN": len,
    "LEFT": lambda text, count: text[: max(count, 0)],
    "RIGHT": lambda text, count: text[max(len(text) - max(count, 0), 0) :],
    "MID": _mid,
    "CONCAT": lambda a, b: a + b,
    "INSERT": _insert,
    "DELETE": _delete,
    "REPLACE": _replace,
    "FIND": lambda text, other: text.find(other) + 1 if other else 0,
    "CHAR_AT": lambda text, at: ord(text[at - 1]) if 1 <= at <= len(text) else 0,
    "CHAR_STR": chr,
    "RECODE": lambda text: text,
    "INT_TO_STR": str,
    "UINT_TO_STR": str,
    "REAL_TO_STR": lambda a, digits: f"{a:.{digits}g}",
    "STR_TO_INT": _to_int,
    "STR_TO_REAL": _to_real,
}
