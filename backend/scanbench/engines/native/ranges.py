"""Intervals of integer operations: what needs no check and cannot wrap."""

from scanbench.program.types import Elementary
from scanbench.program.untyped import bounds

Range = tuple[int, int]


def within(inner: Range, outer: Range) -> bool:
    return outer[0] <= inner[0] and inner[1] <= outer[1]


def fit(found: Range, type: Elementary) -> tuple[Range, bool]:
    """The range of a result of this type, and whether it certainly did not wrap."""
    limits = bounds(type)
    return (found, True) if within(found, limits) else (limits, False)


def arithmetic(op: str, type: Elementary, left: Range, right: Range) -> tuple[Range, bool]:
    """Range of `left op right` in this type; the flag says that the mathematical result fits."""
    match op:
        case "add":
            return fit((left[0] + right[0], left[1] + right[1]), type)
        case "sub":
            return fit((left[0] - right[1], left[1] - right[0]), type)
        case "mul":
            corners = [a * b for a in left for b in right]
            return fit((min(corners), max(corners)), type)
        case "div":
            return _quotient(type, left, right)
        case "mod":
            return _remainder(left, right), True
        case "and":
            return (0, min(left[1], right[1])), True
        case "or":
            return (max(left[0], right[0]), _ones(left, right)), True
        case "xor":
            return (0, _ones(left, right)), True
    return bounds(type), False


def _ones(left: Range, right: Range) -> int:
    return int((1 << max(left[1].bit_length(), right[1].bit_length())) - 1)


def _quotient(type: Elementary, left: Range, right: Range) -> tuple[Range, bool]:
    divisors = {each for each in (*right, -1, 1) if each != 0 and right[0] <= each <= right[1]}
    if not divisors:
        return bounds(type), False
    corners = [abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1) for a in left for b in divisors]
    return fit((min(*corners, max(0, left[0]) * 0), max(*corners, 0)), type)


def _remainder(left: Range, right: Range) -> Range:
    most = max(abs(right[0]), abs(right[1]), 1) - 1
    low = max(-most, left[0]) if left[0] < 0 else 0
    high = min(most, left[1]) if left[1] > 0 else 0
    return low, high
