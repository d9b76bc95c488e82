"""Values as people write them: text to bytes and back, for every type that has one value."""

import math
import struct

from scanbench.check.fold import round_real
from scanbench.check.types import ArrayType, Elementary, Kind, Record, StringType, Type
from scanbench.check.untyped import bounds
from scanbench.syntax import literals

TRUE, FALSE = ("TRUE", "1", "ON", "BOOL#TRUE", "BOOL#1"), ("FALSE", "0", "OFF", "BOOL#FALSE", "BOOL#0")
WORDS = ((86_400_000_000_000, "d"), (3_600_000_000_000, "h"), (60_000_000_000, "m"), (1_000_000_000, "s"),
         (1_000_000, "ms"), (1_000, "us"), (1, "ns"))  # fmt: skip


def parse_value(type: Type, text: str) -> bytes:
    """The bytes of a value as typed: TRUE, 42, 16#FF, T#5s, 1.5, 'text'. Raises ValueError that says what fits."""
    text = text.strip()
    if isinstance(type, StringType):
        return _parse_string(type, text)
    if not isinstance(type, Elementary):
        raise ValueError(f"{type} has no single value; write one of its members")
    if type.kind is Kind.BOOL:
        if text.upper() in TRUE:
            return b"\1"
        if text.upper() in FALSE:
            return b"\0"
        raise ValueError(f"`{text}` is not a BOOL; write TRUE or FALSE")
    if type.kind is Kind.REAL:
        return _parse_real(type, text)
    number = _parse_time(text) if type.kind is Kind.TIME else _parse_integer(type, text)
    low, high = bounds(type)
    if not low <= number <= high:
        raise ValueError(f"{number} is outside of {type} ({low} to {high})")
    return number.to_bytes(type.size, "little", signed=type.signed)


def _parse_integer(type: Elementary, text: str) -> int:
    body = text.upper().removeprefix(f"{type.name}#")
    sign = -1 if body.startswith("-") else 1
    try:
        return sign * literals.integer(body.lstrip("+-"))
    except ValueError:
        low, high = bounds(type)
        raise ValueError(f"`{text}` is not {type}; write an integer from {low} to {high}, or 16#FF") from None


def _parse_time(text: str) -> int:
    body = text.upper()
    for prefix in ("TIME#", "T#"):
        body = body.removeprefix(prefix)
    try:
        return literals.duration(body)
    except ValueError as error:
        raise ValueError(f"`{text}` is not a TIME: {error}") from None


def _parse_real(type: Elementary, text: str) -> bytes:
    try:
        value = float(text.upper().removeprefix(f"{type.name}#").replace("_", ""))
    except ValueError:
        raise ValueError(f"`{text}` is not {type}; write a number, e.g. 1.5") from None
    if math.isnan(value):
        value = math.nan
    if type.size == 4 and math.isinf(round_real(value, type)) and not math.isinf(value):
        raise ValueError(f"{text} is too large for REAL (about 3.4e38)")
    return struct.pack("<f" if type.size == 4 else "<d", value)


def _parse_string(type: StringType, text: str) -> bytes:
    quoted = len(text) >= 2 and text[0] == text[-1] == "'"
    data = literals.string(text[1:-1] if quoted else text.replace("$", "$$"))
    if len(data) > type.capacity:
        raise ValueError(f"{len(data)} characters do not fit {type}; at most {type.capacity}")
    return len(data).to_bytes(2, "little") + data


def python_value(type: Type, data: bytes) -> bool | int | float | str | None:
    """A value for JSON: TIME as integer nanoseconds; NaN and infinities as text, since JSON has no such numbers."""
    if isinstance(type, StringType):
        return data[2 : 2 + min(int.from_bytes(data[:2], "little"), type.capacity)].decode("latin-1")
    if isinstance(type, ArrayType | Record):
        return None
    if type.kind is Kind.BOOL:
        return data[0] != 0
    if type.kind is Kind.REAL:
        value = float(struct.unpack("<f" if type.size == 4 else "<d", data)[0])
        return value if math.isfinite(value) else str(value)
    return int.from_bytes(data, "little", signed=type.signed)


def format_value(type: Type, data: bytes) -> str:
    """A value as people read it: TRUE, 42, 16#00FF, T#1s500ms, 1.5, 'text'."""
    value = python_value(type, data)
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(type, StringType):
        return f"'{value}'"
    if isinstance(type, Elementary) and isinstance(value, int):
        if type.kind is Kind.TIME:
            return format_time(value)
        return f"16#{value:0{2 * type.size}X}" if type.kind is Kind.BITS else str(value)
    if isinstance(value, float) and isinstance(type, Elementary) and type.size == 4:
        return _shortest(value, type)
    return str(value)


def _shortest(value: float, type: Elementary) -> str:
    """The fewest digits that give this single-precision number back."""
    for digits in range(1, 9):
        text = f"{value:.{digits}g}"
        if round_real(float(text), type) == value:
            return repr(float(text)).removesuffix(".0")
    return f"{value:.9g}"


def format_time(ns: int) -> str:
    """`T#1m30s`."""
    if ns == 0:
        return "T#0s"
    text, rest = "", abs(ns)
    for size, unit in WORDS:
        count, rest = divmod(rest, size)
        if count:
            text += f"{count}{unit}"
    return f"T#{'-' if ns < 0 else ''}{text}"
