"""The values of literals: numbers, durations, dates, strings."""

import math
import re
from datetime import date as calendar_date

UNITS_NS = {
    "d": 86_400_000_000_000,
    "h": 3_600_000_000_000,
    "m": 60_000_000_000,
    "s": 1_000_000_000,
    "ms": 1_000_000,
    "us": 1_000,
    "ns": 1,
}
PART = re.compile(r"(\d+)(?:\.(\d+))?(ms|us|ns|d|h|m|s)", re.IGNORECASE)
ESCAPES = {"$": "$", "'": "'", '"': '"', "L": "\n", "N": "\n", "P": "\f", "R": "\r", "T": "\t"}
NARROW, WIDE = re.compile(r"[0-9A-Fa-f]{2}"), re.compile(r"[0-9A-Fa-f]{4}")

MAX_DIGITS = 80
"""More than any type can hold, in any base."""
LONGEST_NS = 2**63 - 1
EPOCH = calendar_date(1970, 1, 1).toordinal()


def integer(text: str) -> int:
    """`1_000`, `16#FF`, `2#1010`, `-8#17`."""
    text = text.replace("_", "")
    if len(text) > MAX_DIGITS:
        raise ValueError("more digits than any type can hold")
    if "#" not in text:
        return int(text)
    base, digits = text.split("#", 1)
    sign, base = (-1, base[1:]) if base[0] == "-" else (1, base.removeprefix("+"))
    if base not in ("2", "8", "10", "16"):  # 10 is of vendors
        raise ValueError("a number is written in base 2, 8 or 16")
    try:
        return sign * int(digits, int(base))
    except ValueError:
        raise ValueError(f"these are not digits of base {base}") from None


def real(text: str) -> float:
    """`1.5`, `1e-3`."""
    value = float(text.replace("_", ""))
    if math.isinf(value):
        raise ValueError("larger than an LREAL can hold (about 1.8E308)")
    return value


def duration(text: str) -> int:
    """Nanoseconds of `1h30m`, `1.5s`, `-5ms` (the text after `T#`)."""
    text = text.replace("_", "")
    sign = -1 if text.startswith("-") else 1
    text = text.lstrip("+-")
    if len(text) > 10 * MAX_DIGITS:
        raise ValueError("more digits than any type can hold")
    total, at = 0, 0
    while at < len(text):
        part = PART.match(text, at)
        if part is None:
            raise ValueError("a duration is written like T#1h30m, T#1.5s or T#-5ms")
        whole, fraction, unit = part.groups()
        scale = UNITS_NS[unit.lower()]
        total += int(whole) * scale
        if fraction:
            total += int(fraction) * scale // 10 ** len(fraction)
        at = part.end()
    if at == 0:
        raise ValueError("a duration needs a number and a unit, as in T#5s")
    if total > LONGEST_NS:
        raise ValueError("longer than a TIME can hold (292 years)")
    return sign * total


def date(text: str) -> int:
    """Nanoseconds from 1970-01-01 to `1996-02-29`."""
    parts = text.split("-")
    if len(parts) != 3:
        raise ValueError("a date is written like D#2026-02-28")
    year, month, day = (_number(part) for part in parts)
    try:
        days = calendar_date(year, month, day).toordinal() - EPOCH
    except ValueError:
        raise ValueError("there is no such day in the calendar") from None
    value = days * UNITS_NS["d"]
    if not -(2**63) <= value <= LONGEST_NS:
        raise ValueError("beyond the years that a date can hold (1678 to 2262)")
    return value


def time_of_day(text: str) -> int:
    """Nanoseconds from midnight to `12:30:15.5`."""
    parts = text.split(":")
    if len(parts) not in (2, 3):
        raise ValueError("a time of day is written like TOD#12:30:15.5")
    hour, minute = _number(parts[0]), _number(parts[1])
    second, _, fraction = parts[2].partition(".") if len(parts) == 3 else ("0", "", "")
    if hour > 23 or minute > 59 or _number(second) > 59:
        raise ValueError("there is no such time of day; the last one is 23:59:59.999999999")
    fraction = fraction.replace("_", "")[:9].ljust(9, "0")
    return hour * UNITS_NS["h"] + minute * UNITS_NS["m"] + _number(second) * UNITS_NS["s"] + _number(fraction)


def date_and_time(text: str) -> int:
    """Nanoseconds from 1970-01-01 to `1996-02-29-12:30:15.5`."""
    day, _, time = text.rpartition("-")
    if not day:
        raise ValueError("a date and time is written like DT#2026-02-28-12:30:15")
    value = date(day) + time_of_day(time)
    if value > LONGEST_NS:
        raise ValueError("beyond the years that a date can hold (1678 to 2262)")
    return value


def _number(text: str) -> int:
    digits = text.replace("_", "")
    if not digits.isdecimal() or len(digits) > 9:
        raise ValueError(f"`{text[:20]}` is not a number that fits here")
    return int(digits)


def string(text: str) -> bytes:
    """Bytes of the text between single quotes, with `$` escapes."""
    return b"".join(_byte(char) if isinstance(char, str) else bytes([char]) for char in _characters(text, NARROW))


def wide_string(text: str) -> bytes:
    """UTF-16 of the text between double quotes, with `$` escapes."""
    units = _characters(text, WIDE)
    return b"".join(
        char.encode("utf-16-le", "surrogatepass") if isinstance(char, str) else char.to_bytes(2, "little")
        for char in units
    )


def _characters(text: str, code: re.Pattern[str]) -> list[str | int]:
    """Characters as text, or as the number that an escape names."""
    if "$" not in text:
        return list(text)
    made: list[str | int] = []
    at = 0
    while at < len(text):
        if text[at] != "$":
            made.append(text[at])
            at += 1
        elif (escape := text[at + 1 : at + 2].upper()) in ESCAPES:
            made.append(ESCAPES[escape])
            at += 2
        elif found := code.match(text, at + 1):
            made.append(int(found.group(), 16))
            at = found.end()
        else:
            digits = "two" if code is NARROW else "four"
            raise ValueError(f"after $ comes one of $ ' \" L N P R T or {digits} hex digits")
    return made


def _byte(char: str) -> bytes:
    try:
        return char.encode("latin-1")
    except UnicodeEncodeError:
        raise ValueError(f"`{char}` does not fit one byte, which is what a STRING holds") from None
