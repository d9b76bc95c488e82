"""The values of literals: numbers, durations, strings."""

import math
import re

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


MAX_DIGITS = 80
"""More than any type can hold, in any base."""


def integer(text: str) -> int:
    """`1_000`, `16#FF`, `2#1010`."""
    if len(text) > MAX_DIGITS:
        raise ValueError("more digits than any type can hold")
    if "#" in text:
        base, digits = text.split("#", 1)
        return int(digits.replace("_", ""), int(base))
    return int(text.replace("_", ""))


def real(text: str) -> float:
    """`1.5`, `1e-3`."""
    value = float(text.replace("_", ""))
    if math.isinf(value):
        raise ValueError("larger than an LREAL can hold (about 1.8E308)")
    return value


def duration(text: str) -> int:
    """Nanoseconds of `1h30m`, `1.5s`, `-5ms` (what stands behind `T#`)."""
    text = text.replace("_", "")
    sign = -1 if text.startswith("-") else 1
    text = text.lstrip("+-")
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
    if total > 2**63 - 1:
        raise ValueError("longer than a TIME can hold (292 years)")
    return sign * total


def string(text: str) -> bytes:
    """Bytes of what stands between the quotes, with `$` escapes."""
    out = bytearray()
    at = 0
    while at < len(text):
        char = text[at]
        if char != "$":
            out += _byte(char)
            at += 1
            continue
        escape = text[at + 1 : at + 2].upper()
        if escape in ESCAPES and escape:
            out += ESCAPES[escape].encode()
            at += 2
            continue
        digits = text[at + 1 : at + 3]
        if not re.fullmatch(r"[0-9A-Fa-f]{2}", digits):
            raise ValueError("behind $ comes one of $ ' L N P R T or two hex digits")
        out.append(int(digits, 16))
        at += 3
    return bytes(out)


def _byte(char: str) -> bytes:
    try:
        return char.encode("latin-1")
    except UnicodeEncodeError:
        raise ValueError(f"`{char}` does not fit one byte, which is what a STRING holds") from None
