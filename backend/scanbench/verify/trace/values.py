"""Cells of a trace as values of a variable, and whether a value of the program is the one that a cell has."""

import math
import re
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal

from scanbench.program.strings import characters
from scanbench.program.types import Elementary, Enumeration, Kind, StringType
from scanbench.symbols.values import parse_value
from scanbench.syntax.literals import UNITS_NS
from scanbench.verify.trace.clock import number
from scanbench.verify.trace.table import Unit

Leaf = Elementary | StringType
_PLAIN = re.compile(r"[+-]?\d+")
_WHOLE = re.compile(r"([+-]?\d+)[.,]0+")
_DIGITS = re.compile(r"[+-]?(\d*)(?:[.,](\d*))?(?:[eE]([+-]?\d+))?")
REAL_DIGITS = 9
"""So many significant digits tell a single-precision number exactly."""
LEAST_DIGITS = 6
"""Significant digits that a column of numbers has at least: what `%g` writes."""


def cell_value(type: Leaf, text: str, unit: Unit | None, comma: bool) -> bytes:
    """The bytes of a cell. Raises ValueError that says what fits."""
    if isinstance(type, StringType):
        return parse_value(type, text).ljust(type.size, b"\0")
    if type.kind is Kind.REAL and text.upper().lstrip("+-") not in ("NAN", "INF", "INFINITY"):
        return parse_value(type, str(number(text.replace("_", ""), comma)))
    if type.kind is Kind.TIME and not text.upper().startswith(("T#", "LT#", "TIME#", "LTIME#")):
        return _duration(type, text, unit, comma)
    if type.kind is Kind.DATE and _PLAIN.fullmatch(text):
        return parse_value(Elementary("LINT", Kind.INT, type.size), text)
    whole = _WHOLE.fullmatch(text)  # what comes out of a spreadsheet, or of a tool that has nothing but REALs
    if whole is not None and type.kind is not Kind.DATE and not isinstance(type, Enumeration):
        return parse_value(type, whole.group(1))
    return parse_value(type, text)


def _duration(type: Elementary, text: str, unit: Unit | None, comma: bool) -> bytes:
    if unit is None:
        try:
            return parse_value(type, text)
        except ValueError:
            raise ValueError(
                f"`{text}` is not a TIME: write T#1s500ms, or put the unit after the column's name, as [s]"
            ) from None
    step = type.unit or 1  # a controller that counts milliseconds has written no part of one
    ns = round(number(text, comma) * UNITS_NS[unit] / step) * step
    return parse_value(type, f"T#{ns}ns")


@dataclass(frozen=True, slots=True)
class Exactness:
    """How exact the numbers of a column are: a controller's tool writes them with so many digits, and no more can be compared."""

    digits: int = 0
    """Significant ones; 0: values are compared byte by byte."""
    decimals: int | None = None
    """The cells have no more than so many after the point; None: that says nothing."""
    scale: float = 1.0
    """What 1 in the file is in the variable: ns of a TIME."""

    def same(self, type: Leaf, recorded: bytes, found: bytes) -> bool:
        """Whether the cell can mean the value that was found."""
        if isinstance(type, StringType):
            return characters(type, recorded) == characters(type, found)
        if recorded == found or not self.digits:
            return recorded == found
        one, other = number_of(type, recorded), number_of(type, found)
        if not (math.isfinite(one) and math.isfinite(other)):
            return (math.isnan(one) and math.isnan(other)) or one == other
        return abs(one - other) <= self.half(max(abs(one), abs(other)))

    def half(self, value: float) -> float:
        """By how much a value of about this size may differ from what is written; 0: it is written exactly."""
        if not self.digits or not math.isfinite(value):
            return 0.0
        size = abs(value) / self.scale
        step = 10.0 ** (math.floor(math.log10(size)) + 1 - self.digits) if size else 0.0
        if self.decimals is not None:
            step = max(step, 10.0**-self.decimals)
        return 0.5000001 * step * self.scale

    @property
    def rounds(self) -> bool:
        """Whether a number is written with fewer digits than a REAL has."""
        return 0 < self.digits < REAL_DIGITS and self.scale == 1.0


@dataclass(frozen=True, slots=True)
class Tolerance:
    """By what a recorded value may differ from that of the reference, as somebody has chosen."""

    absolute: float = 0.0
    relative: float = 0.0
    """A part of the recorded value."""
    scans: int = 0
    """So many scans it may come earlier or later."""

    def allows(self, type: Leaf, recorded: bytes, found: bytes) -> bool:
        """Whether the numbers are near enough to each other. What is no number has no tolerance."""
        if not (self.absolute or self.relative) or not is_number(type):
            return False
        one, other = number_of(type, recorded), number_of(type, found)
        return abs(one - other) <= max(self.absolute, self.relative * abs(one)) * (1 + 1e-9)


def exactness(type: Leaf, texts: Sequence[str], unit: Unit | None) -> Exactness:
    """Of a column with these cells."""
    timed = isinstance(type, Elementary) and type.kind is Kind.TIME and unit is not None
    if not timed and not (isinstance(type, Elementary) and type.kind is Kind.REAL):
        return Exactness()
    digits, decimals, zero = LEAST_DIGITS, set[int](), False
    for text in filter(None, texts):
        found = _DIGITS.fullmatch(text)
        if found is None:
            continue
        whole, fraction = found.group(1), found.group(2) or ""
        digits = max(digits, len((whole + fraction).lstrip("0")))
        decimals.add(max(0, len(fraction) - int(found.group(3) or 0)))
        zero = zero or fraction.endswith("0")
    most = max(decimals, default=0)
    # a REAL is rounded to the longest cell's decimals; whole numbers, and durations, are mostly exact
    fixed = most if most and (not timed or (zero and len(decimals) == 1)) else None
    return Exactness(digits, fixed, float(UNITS_NS[unit]) if timed and unit is not None and unit != "scan" else 1.0)


def is_number(type: Leaf) -> bool:
    """Whether values are more or less than others."""
    return isinstance(type, Elementary) and type.kind in (Kind.REAL, Kind.INT, Kind.UINT, Kind.TIME)


def number_of(type: Leaf, data: bytes) -> float:
    """The number that the bytes of a value are; of a TIME ns."""
    if isinstance(type, Elementary) and type.kind is Kind.REAL:
        return float(struct.unpack("<f" if type.size == 4 else "<d", data)[0])
    signed = isinstance(type, Elementary) and type.kind is not Kind.UINT
    return float(Decimal(int.from_bytes(data, "little", signed=signed)))


def real_bytes(type: Leaf, value: float) -> bytes:
    """A REAL or LREAL; what is too large for it is infinite."""
    if type.size == 8:
        return struct.pack("<d", value)
    try:
        return struct.pack("<f", value)
    except OverflowError:
        return struct.pack("<f", math.copysign(math.inf, value))
