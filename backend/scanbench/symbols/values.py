"""Values as people write them: text to bytes and back, for every type that has one value."""

import math
import re
import struct
from datetime import date as calendar_date
from typing import Literal

from scanbench.program.numbers import round_real
from scanbench.program.strings import characters, stored
from scanbench.program.types import (
    ArrayType,
    Elementary,
    Enumeration,
    Kind,
    OpenArray,
    Record,
    StringType,
    Type,
    base_of,
)
from scanbench.program.untyped import bounds
from scanbench.syntax import literals

TRUE, FALSE = ("TRUE", "1", "ON", "BOOL#TRUE", "BOOL#1"), ("FALSE", "0", "OFF", "BOOL#FALSE", "BOOL#0")
WORDS = ((86_400_000_000_000, "d"), (3_600_000_000_000, "h"), (60_000_000_000, "m"), (1_000_000_000, "s"),
         (1_000_000, "ms"), (1_000, "us"), (1, "ns"))  # fmt: skip
UNITS_NS = literals.UNITS_NS
DAY_NS = UNITS_NS["d"]
DATES = {
    "DATE": ("D", literals.date, "D#2026-11-21"),
    "TIME_OF_DAY": ("TOD", literals.time_of_day, "TOD#12:30:15.5"),
    "DATE_AND_TIME": ("DT", literals.date_and_time, "DT#2026-11-21-12:30:15"),
}
"""By name of the type without its L: short prefix, reader, example."""

Format = Literal["default", "decimal", "signed", "unsigned", "hex", "binary", "bcd", "float", "time", "ascii"]
"""The same names, and the same meaning, as of a row of the watch table."""
NUMBERS = (Kind.INT, Kind.UINT, Kind.BITS)
"""What is shown in any of them."""


def parse_value(type: Type, text: str) -> bytes:
    """The bytes of a value as typed: TRUE, 42, 16#FF, T#5s, D#2026-11-21, 1.5, 'text', "wide", RED, NULL.

    Raises ValueError that says what fits. A tool may write a subrange variable outside of its bounds, as on a PLC:
    that is how one tries out what a program does then. An enumeration takes its values only.
    """
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
    number = _parse_number(type, text)
    low, high = bounds(type)
    if not low <= number <= high:
        raise ValueError(f"{number} is outside of {type} ({low} to {high})")
    if type.unit and (number % type.unit or not 0 <= number // type.unit < 1 << 32):
        last = _format_integer(type, ((1 << 32) - 1) * type.unit)
        step = "1 ms" if type.unit == UNITS_NS["ms"] else "1 s"
        raise ValueError(
            f"{text} is not {type} here, which has steps of {step} from {_format_integer(type, 0)} to {last}"
        )
    return number.to_bytes(type.size, "little", signed=type.signed)


def _parse_number(type: Elementary, text: str) -> int:
    """The number for any type that the image represents as an integer."""
    if isinstance(type, Enumeration):
        return _parse_enumeration(type, text)
    match type.kind:
        case Kind.TIME:
            return _parse_time(text)
        case Kind.DATE:
            return _parse_date(type, text)
        case Kind.CHAR:
            return _parse_character(type, text)
        case Kind.REF:
            if text.upper() == "NULL":
                return 0
            raise ValueError(
                f"`{text}` is not {type}; as a number a reference would be any place in memory: write NULL, or the "
                "variable that it refers to (after a ^)"
            )
    return _parse_integer(base_of(type), text)


def _parse_enumeration(type: Enumeration, text: str) -> int:
    name = re.split(r"[#.]", text)[-1].strip().upper()
    for each, number in type.values:
        if name in (each.upper(), str(number)):
            return number
    raise ValueError(f"`{text}` is not {type}; write {', '.join(each for each, _ in type.values)}")


def _parse_date(type: Elementary, text: str) -> int:
    prefix, reader, example = DATES[type.name.removeprefix("L")]
    body = text.upper()
    for each in (f"L{type.name.removeprefix('L')}#", f"L{prefix}#", f"{type.name.removeprefix('L')}#", f"{prefix}#"):
        body = body.removeprefix(each)
    try:
        return reader(body)
    except ValueError as error:
        raise ValueError(f"`{text}` is not {type}: {error}; write {example}") from None


def _parse_character(type: Elementary, text: str) -> int:
    quote = "'" if type.size == 1 else '"'
    if len(text) >= 3 and text[0] == text[-1] == quote:
        data = literals.string(text[1:-1]) if type.size == 1 else literals.wide_string(text[1:-1])
        if len(data) == type.size:
            return int.from_bytes(data, "little")
    elif text[:1].isdigit():
        return _parse_integer(type, text)
    raise ValueError(f"`{text}` is not {type}; write one character in quotes, {quote}a{quote}")


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
    for prefix in ("LTIME#", "TIME#", "LT#", "T#"):
        body = body.removeprefix(prefix)
    try:
        return literals.duration(body)
    except ValueError as error:
        raise ValueError(f"`{text}` is not a TIME: {error}") from None


def _parse_real(type: Elementary, text: str) -> bytes:
    digits = text.upper().removeprefix(f"{type.name}#").replace("_", "")
    try:
        value = float(digits)
    except ValueError:
        raise ValueError(f"`{text}` is not {type}; write a number, e.g. 1.5") from None
    if math.isnan(value):
        value = math.nan
    if math.isinf(round_real(value, type)) and "INF" not in digits:
        raise ValueError(f"{text} is too large for {type} (about {'3.4e38' if type.size == 4 else '1.8e308'})")
    return struct.pack("<f" if type.size == 4 else "<d", value)


def _parse_string(type: StringType, text: str) -> bytes:
    wide = type.width == 2
    quoted = len(text) >= 2 and text[0] == text[-1] and text[0] in (("'", '"') if wide else "'")
    body = text[1:-1] if quoted else text.replace("$", "$$")
    data = literals.wide_string(body) if wide else literals.string(body)
    length = len(data) // type.width
    if length > type.capacity:
        raise ValueError(f"{length} characters do not fit {type}; at most {type.capacity}")
    if type.zero and b"\0" in data:
        raise ValueError(f"A {type} ends at its first 16#00: write no `$00`")
    return stored(type, data)


def python_value(type: Type, data: bytes) -> bool | int | float | str | None:
    """A value for JSON: durations, dates and references as integers (ns, ns, address), characters and values of
    enumerations as text; NaN and infinities as text, since JSON has no such numbers."""
    if isinstance(type, StringType):
        text = characters(type, data)
        return text.decode("utf-16-le", "replace") if type.width == 2 else text.decode("latin-1")
    if isinstance(type, ArrayType | OpenArray | Record):
        return None
    if type.kind is Kind.BOOL:
        return data[0] != 0
    if type.kind is Kind.REAL:
        value = float(struct.unpack("<f" if type.size == 4 else "<d", data)[0])
        return value if math.isfinite(value) else str(value)
    number = int.from_bytes(data, "little", signed=type.signed)
    if isinstance(type, Enumeration):
        return next((name for name, value in type.values if value == number), number)
    return chr(number) if type.kind is Kind.CHAR else number


def format_value(type: Type, data: bytes, format: Format = "default") -> str:
    """A value as people read it: TRUE, 42, 16#00FF, T#1s500ms, D#2026-11-21, 1.5, 'text', "wide", RED, NULL. A format that the
    type does not have is the usual one; what has no single value, an array or a structure, is empty."""
    if format != "default" and isinstance(type, Elementary) and not isinstance(type, Enumeration):
        found = _in_format(type, data, format)
        if found:
            return found
    if not isinstance(type, Elementary | StringType):
        return ""
    value = python_value(type, data)
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(type, StringType):
        return f'"{value}"' if type.width == 2 else f"'{value}'"
    if isinstance(type, Elementary):
        if isinstance(value, int):
            return _format_integer(type, value)
        if isinstance(value, str) and type.kind is Kind.CHAR:
            return _format_character(value, type.size)
        if isinstance(value, float) and type.size == 4:
            return _shortest(value, type)
    return str(value)


def _format_integer(type: Elementary, value: int) -> str:
    match type.kind:
        case Kind.TIME:
            text = format_time(value)
            return text if type.name == "TIME" else f"L{text}"
        case Kind.DATE:
            return format_date(type, value)
        case Kind.REF:
            return "NULL" if value == 0 else f"16#{value:08X}"
        case Kind.BITS:
            return f"16#{value:0{2 * type.size}X}"
    return str(value)


def _format_character(value: str, size: int) -> str:
    quote = "'" if size == 1 else '"'
    shown = value if value.isprintable() and value not in (quote, "$") else f"${ord(value):0{2 * size}X}"
    return f"{quote}{shown}{quote}"


def format_date(type: Elementary, ns: int) -> str:
    """`D#2026-11-21`, `TOD#12:30:15.5`, `DT#2026-11-21-12:30:15`, with an L before the long ones."""
    prefix, _, _ = DATES[type.name.removeprefix("L")]
    head = f"{'L' if type.name.startswith('L') else ''}{prefix}#"
    days, rest = divmod(ns, DAY_NS)
    if prefix == "TOD":
        return f"{head}{_clock(ns)}" if 0 <= ns < DAY_NS else f"{head}{ns}ns"
    day = calendar_date.fromordinal(literals.EPOCH + days).isoformat()
    return f"{head}{day}" if prefix == "D" else f"{head}{day}-{_clock(rest)}"


def _clock(ns: int) -> str:
    seconds, fraction = divmod(ns, 1_000_000_000)
    text = f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}"
    return f"{text}.{fraction:09}".rstrip("0") if fraction else text


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


def raw(data: bytes) -> str:
    """Bytes as one number, the highest first."""
    return f"16#{data[::-1].hex().upper()}"


def _in_format(type: Elementary, data: bytes, format: Format) -> str:
    """Empty where the type has no such format."""
    bits, signed = int.from_bytes(data, "little"), int.from_bytes(data, "little", signed=True)
    if type.kind is Kind.REAL:
        return _based(bits, len(data), format)
    if type.kind is Kind.TIME:
        return f"{signed / 1e6:.15g}" if format == "decimal" else raw(data) if format == "hex" else ""
    if type.kind not in NUMBERS:
        return ""
    number = signed if type.kind is Kind.INT else bits
    match format:
        case "decimal":
            return str(number)
        case "signed":
            return str(signed)
        case "unsigned":
            return str(bits)
        case "bcd":
            digits = data[::-1].hex().upper()
            return digits if digits.isdigit() else f"16#{digits}"
        case "float":
            return repr(_real(data)) if len(data) >= 4 else ""
        case "time":
            return format_time(number * 1_000_000)
        case "ascii":
            return f"'{''.join(chr(each) if 0x20 <= each < 0x7F else '.' for each in data[::-1])}'"
    return _based(bits, len(data), format)


def _real(data: bytes) -> float:
    value = float(struct.unpack("<f" if len(data) == 4 else "<d", data)[0])
    return float(f"{value:.7g}") if len(data) == 4 else value


def _based(bits: int, size: int, format: Format) -> str:
    if format == "hex":
        return f"16#{bits:0{2 * size}X}"
    return f"2#{bits:0{8 * size}b}" if format == "binary" else ""
