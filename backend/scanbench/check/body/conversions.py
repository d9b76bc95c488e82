"""`X_TO_Y` and its like: every pair of elementary types and strings that has a meaning.

The rules, once:
- Integers, bit strings, BOOL, CHAR among each other: as `Convert` (extension by the source, then the low bits). A
  REAL to them is rounded, ties to even, and saturates; with TRUNC it is cut instead. DWORD and REAL, LWORD and LREAL
  have the same bits (IEC 61131-3, table 24); other bit strings convert to and from reals by their number.
- A TIME is a number of milliseconds, DATE and DATE_AND_TIME one of seconds since 1970-01-01, TIME_OF_DAY one of
  milliseconds since midnight, as vendors have it; LTIME, LDATE, LDATE_AND_TIME, LTIME_OF_DAY count nanoseconds. To
  an integer the part below is cut. Whatever becomes a date loses its time of day, and the other way round.
- BCD: a digit above 9 counts as what it is (16#1A is 20). A number that has more digits than there is room for loses
  the highest; a negative one is 0.
- Text is read as far as it can be read, and is 0 when that is nothing; numbers saturate. WSTRING goes by way of STRING.
- An enumeration converts as its base type, without a look at its values.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, replace

from scanbench.check.body import fold
from scanbench.check.body.short_times import counts, cut
from scanbench.check.body.standard_fold import intrinsic
from scanbench.check.vendor_sizes import UNITS
from scanbench.program.program import Compare, Const, Expr, Intrinsic
from scanbench.program.types import (
    ABBREVIATIONS,
    BOOL,
    DATE_AND_TIME,
    ELEMENTARY,
    INT,
    LINT,
    LREAL,
    LTIME,
    LWORD,
    UDINT,
    ULINT,
    Elementary,
    Enumeration,
    Kind,
    StringType,
    Subrange,
    Type,
)
from scanbench.program.untyped import bounds, wrap

TRUNC = re.compile(r"(?:(\w+?)_)?TRUNC(?:_(\w+))?")
FROM_BCD = re.compile(r"(?:(\w+?)_)?BCD_TO_(\w+)")
TO_BCD = re.compile(r"(?:(\w+?)_)?TO_BCD_(\w+)")
UNSIGNED = {type.size: type for type in (ELEMENTARY["USINT"], ELEMENTARY["UINT"], ELEMENTARY["UDINT"], ULINT)}
STRINGS = {"STRING": StringType(80), "WSTRING": StringType(80, 2)}
SHORT = {name: type for name, type in ABBREVIATIONS.items() if len(name) > 2 or name == "DT"}
"""TOD, LTOD, DT, LDT: the abbreviations that occur in names of conversions."""

FRACTIONS = {"TIME_OF_DAY": 3, "LTIME_OF_DAY": 9, "LDATE_AND_TIME": 9}
"""Digits of a second that CODESYS writes, where there are any but zeros."""
NUMBER_TEXT = StringType(20)
REAL_TEXT = StringType(32)
BITCASTS = {("DWORD", "REAL"), ("REAL", "DWORD"), ("LWORD", "LREAL"), ("LREAL", "LWORD")}

WHOLE = (Kind.INT, Kind.UINT, Kind.BITS)
TIMES = (Kind.TIME, Kind.DATE)

Library = Callable[..., Expr | None]
"""A call of a function of the ST library by name, or None where there is none."""


@dataclass(frozen=True, slots=True)
class Conversion:
    """What a name says: `source` is None where it takes any, `target` in TRUNC; `way` is plain, trunc, from_bcd, to_bcd."""

    source: Type | None
    target: Type | None
    way: str = "plain"


@dataclass(frozen=True, slots=True)
class Vendor:
    """What a dialect has otherwise than the standard."""

    by_number: bool = False
    """REAL and DWORD, LREAL and LWORD convert by their number."""
    true_texts: bool = False
    """Every REAL but 0.0 is TRUE, and of all texts 'TRUE' and 'true'."""
    text_numbers: bool = False
    """Texts have a base and `_`, and lose their upper bits."""
    halves_away: bool = False
    """A REAL is rounded to an integer with halves away from zero, and loses its upper bits."""
    short_times: bool = False
    """TIME, TOD, DATE and DT have 32 bits without a sign, and whole milliseconds or seconds."""


STANDARD = Vendor()


def parse_name(name: str, find: Callable[[str], Type | None] = lambda name: None) -> Conversion | None:
    """The conversion that an upper-case name means, or None. `find` knows the user's types."""

    def known(part: str) -> Type | None:
        return ELEMENTARY.get(part) or SHORT.get(part) or STRINGS.get(part) or find(part)

    for pattern, way in ((FROM_BCD, "from_bcd"), (TO_BCD, "to_bcd"), (TRUNC, "trunc")):
        match = pattern.fullmatch(name)
        if match is not None:
            source, target = (known(part) if part else None for part in match.groups())
            missing = [part for part, type in zip(match.groups(), (source, target), strict=True) if part and not type]
            return None if missing else Conversion(source, target, way)
    if name.startswith("TO_"):
        target = known(name[3:])
        return Conversion(None, target) if target else None
    at = name.find("_TO_")
    while at > 0:
        source = known(name[:at])
        target = known(name[at + 4 :]) if source else None
        if source and target:
            return Conversion(source, target)
        at = name.find("_TO_", at + 1)
    return None


def convert(
    expr: Expr, target: Type, way: str, library: Library, raw: bool = False, vendor: Vendor = STANDARD
) -> Expr | str:
    """The conversion of a value, or the text to add to the message `There is no conversion X_TO_Y`.

    `raw`: in the library itself, where a number of nanoseconds becomes a long time as it is. `vendor`: what the dialect has otherwise.
    """
    if isinstance(expr.type, Enumeration):
        expr = fold.convert(ELEMENTARY[expr.type.base_name], expr)
    if isinstance(target, Enumeration | Subrange):
        made = convert(expr, ELEMENTARY[target.base_name], way, library, vendor=vendor)
        return fold.convert(target, made) if isinstance(target, Enumeration) and not isinstance(made, str) else made
    source = expr.type
    if not isinstance(source, Elementary | StringType) or not isinstance(target, Elementary | StringType):
        return f": {source} is not elementary."
    if way == "trunc":
        return _trunc(expr, source, target)
    if way != "plain":
        return _from_bcd(expr, source, target, library) if way == "from_bcd" else _to_bcd(expr, source, target, library)
    if raw and isinstance(target, Elementary) and _is_raw(source, target):
        return fold.convert(target, expr)
    made_or_none = _Converter(library, vendor).convert(expr, target)
    return ": it has no meaning." if made_or_none is None else made_or_none


def _is_raw(source: Type, target: Type) -> bool:
    times = [type for type in (source, target) if type.kind in TIMES]
    return len(times) == 2 or (len(times) == 1 and LINT in (source, target) and _unit(times[0]) == 1)


def _unit(type: Type) -> int:
    return UNITS.get(type.name, 1)


def _trunc(expr: Expr, source: Type, target: Type) -> Expr | str:
    if source.kind is not Kind.REAL:
        return f": TRUNC needs a REAL or LREAL, not {source}."
    if not isinstance(target, Elementary) or target.kind not in (Kind.INT, Kind.UINT):
        return ": TRUNC gives an integer."
    return intrinsic("TRUNC", target, (expr,))


def _from_bcd(expr: Expr, source: Type, target: Type, library: Library) -> Expr | str:
    if source.kind is not Kind.BITS:
        return f": BCD is read from a BYTE, WORD, DWORD or LWORD, not from {source}."
    if not isinstance(target, Elementary) or target.kind not in (Kind.INT, Kind.UINT):
        return ": BCD becomes an integer."
    made = library("__FROM_BCD", fold.convert(LWORD, expr))
    assert made is not None
    return fold.convert(target, made)


def _to_bcd(expr: Expr, source: Type, target: Type, library: Library) -> Expr | str:
    if source.kind not in (Kind.INT, Kind.UINT):
        return f": only an integer becomes BCD, not {source}."
    if target.kind is not Kind.BITS:
        return ": BCD is a BYTE, WORD, DWORD or LWORD."
    assert isinstance(target, Elementary)
    if source.kind is Kind.INT:
        expr = Intrinsic("MAX", LINT, (fold.convert(LINT, expr), Const(LINT, 0)))
    made = library("__TO_BCD", fold.convert(ULINT, expr))
    assert made is not None
    return fold.convert(target, made)


def _nearest(value: float, wide: bool) -> int:
    """What `__NEAREST` and `__NEAREST_ULINT` compute."""
    if not -(2.0**63) <= value < (2.0**64 if wide else 2.0**63):
        return -(1 << 63)
    whole = math.trunc(value)
    return whole + (abs(value - whole) >= 0.5) * (1 if value > 0 else -1)


def nearest(value: Expr, library: Library) -> Expr:
    """A REAL or LREAL as a LINT as CODESYS makes one of it."""
    made = _Converter(library, Vendor(halves_away=True)).convert(value, LINT)
    assert made is not None
    return made


class _Converter:
    """Conversions between elementary types and strings; each gives None where there is none."""

    def __init__(self, library: Library, vendor: Vendor) -> None:
        self.library, self._vendor = library, vendor

    def convert(self, expr: Expr, target: Elementary | StringType) -> Expr | None:
        source = expr.type
        assert isinstance(source, Elementary | StringType)
        if isinstance(source, StringType):
            return self._from_string(expr, source, target)
        if isinstance(target, StringType):
            return self._to_string(expr, source, target)
        if source == target:
            return expr
        if Kind.REF in (source.kind, target.kind):
            return None
        if (source.name, target.name) in BITCASTS and not self._vendor.by_number:
            return Intrinsic("BITCAST", target, (expr,))
        if source.kind in TIMES or target.kind in TIMES:
            return self._time(expr, source, target)
        if Kind.CHAR in (source.kind, target.kind):
            return self._char(expr, source, target)
        if source.kind is Kind.REAL and target.kind is Kind.BOOL and self._vendor.true_texts:
            return Compare("ne", BOOL, expr, Const(source, 0.0))
        if source.kind is Kind.REAL and target.kind in WHOLE and self._vendor.halves_away:
            return self._nearest(expr, target)
        if {source.kind, target.kind} in ({Kind.BITS, Kind.REAL}, {Kind.BOOL, Kind.REAL}):
            whole = ULINT if source.kind is not Kind.REAL else UNSIGNED[target.size]
            return fold.convert(target, fold.convert(whole, expr))
        return fold.convert(target, expr)

    def _nearest(self, expr: Expr, target: Elementary) -> Expr | None:
        """A REAL as CODESYS makes an integer of it: by way of 64 bits with a sign, and of 64 bits without one by these, too."""
        wide = target.size == ULINT.size and target.kind is not Kind.INT
        if isinstance(expr, Const) and isinstance(expr.value, float):
            return Const(target, wrap(_nearest(expr.value, wide), target))
        made = self.library("__NEAREST_ULINT" if wide else "__NEAREST", fold.convert(LREAL, expr))
        return None if made is None else fold.convert(target, made)

    def _char(self, expr: Expr, source: Elementary, target: Elementary) -> Expr | None:
        if source.kind is target.kind and target.size < source.size:
            narrow = Intrinsic("RECODE", StringType(1), (_text_of(expr, source),))
            return Intrinsic("CHAR_AT", target, (narrow, Const(LINT, 1)))
        if not {source.kind, target.kind} <= {Kind.CHAR, *WHOLE}:
            return None
        return fold.convert(target, expr)

    # ---- durations and dates ----------------------------------------------------------------------------

    def _time(self, expr: Expr, source: Elementary, target: Elementary) -> Expr | None:
        if Kind.CHAR in (source.kind, target.kind):
            return None
        if source.kind in TIMES and target.kind in TIMES:
            days = {_part(source), _part(target)}
            return None if days == {"DATE", "TIME_OF_DAY"} else self._as_time(expr, target)
        if target.kind in TIMES:
            if self._vendor.short_times and target.name in UNITS:
                if source.kind is Kind.REAL and (nearest := self._nearest(expr, LINT)) is not None:
                    expr = nearest
                expr = fold.convert(UDINT, expr)  # the bits that count
            elif source.kind is Kind.REAL:
                scaled = fold.binary("mul", LREAL, fold.convert(LREAL, expr), Const(LREAL, float(_unit(target))))
                return self._as_time(fold.convert(LINT, scaled), target)
            ns = fold.binary("mul", LINT, fold.convert(LINT, expr), Const(LINT, _unit(target)))
            return self._as_time(ns, target)
        if target.kind is Kind.BOOL:
            return Compare("ne", BOOL, fold.convert(LINT, expr), Const(LINT, 0))
        if target.kind is Kind.REAL and self._vendor.short_times and source.name in UNITS:
            return fold.convert(target, counts(expr))
        if target.kind is Kind.REAL:
            ns = fold.convert(LREAL, fold.convert(LINT, expr))
            return fold.convert(target, fold.binary("div", LREAL, ns, Const(LREAL, float(_unit(source)))))
        whole = fold.binary("div", LINT, fold.convert(LINT, expr), Const(LINT, _unit(source)))
        return fold.convert(target, whole)

    def _as_time(self, expr: Expr, target: Elementary) -> Expr | None:
        """Nanoseconds to a duration, a date (whole days) or a time of day (below a day)."""
        part = _part(target)
        source = expr.type
        assert isinstance(source, Elementary)
        if part in ("DATE", "TIME_OF_DAY") and part != _part(source):
            made = self.library(f"DATE_AND_TIME_TO_{part}", fold.convert(DATE_AND_TIME, expr))
            return None if made is None else self._kept(target, made)
        return self._kept(target, expr)

    def _kept(self, target: Elementary, time: Expr) -> Expr:
        """A time as the dialect has it."""
        return cut(target, time) if self._vendor.short_times and target.name in UNITS else fold.convert(target, time)

    # ---- text -------------------------------------------------------------------------------------------

    def _to_string(self, expr: Expr, source: Elementary, target: StringType) -> Expr | None:
        if source.kind is Kind.CHAR:
            return _recoded(_text_of(expr, source), target)
        return _recoded(self._text(expr, source), target)

    def _text(self, expr: Expr, source: Elementary) -> Expr | None:
        match source.kind:
            case Kind.INT:
                return Intrinsic("INT_TO_STR", NUMBER_TEXT, (fold.convert(LINT, expr),))
            case Kind.UINT | Kind.BITS:
                return Intrinsic("UINT_TO_STR", NUMBER_TEXT, (fold.convert(ULINT, expr),))
            case Kind.REAL:
                digits = Const(LINT, 7 if source.size == 4 else 15)
                return Intrinsic("REAL_TO_STR", REAL_TEXT, (fold.convert(LREAL, expr), digits))
            case Kind.BOOL:
                return self.library("BOOL_TO_STRING", expr)
            case Kind.TIME if self._vendor.short_times:
                long = Const(BOOL, int(source == LTIME))
                return self.library("__DURATION_TEXT", fold.convert(ELEMENTARY["TIME"], expr), long)
            case Kind.TIME | Kind.DATE:
                part = _part(source)
                text = self.library(f"{part}_TO_STRING", fold.convert(ELEMENTARY[part], expr))
                if text is not None and self._vendor.short_times and source.name in FRACTIONS:
                    text = self.library("__FILLED", text, Const(INT, FRACTIONS[source.name]))
                if text is None or part == source.name:
                    return text
                assert isinstance(text.type, StringType)
                longer = replace(text.type, capacity=text.type.capacity + 1)
                return Intrinsic("CONCAT", longer, (Const(StringType(1), b"L"), text))
        return None

    def _from_string(self, expr: Expr, source: StringType, target: Elementary | StringType) -> Expr | None:
        if isinstance(target, StringType):
            return _recoded(expr, replace(target, capacity=source.capacity))
        if target.kind is Kind.CHAR:
            text = _recoded(expr, StringType(source.capacity, target.size))
            return None if text is None else Intrinsic("CHAR_AT", target, (text, Const(LINT, 1)))
        if source.width == 2:
            text = _recoded(expr, StringType(source.capacity))
            return None if text is None else self.convert(text, target)
        if target.kind is Kind.REAL:
            return fold.convert(target, Intrinsic("STR_TO_REAL", LREAL, (expr,)))
        if target.kind in WHOLE and self._vendor.text_numbers:
            made = self.library("__WHOLE_OF", expr)
            return None if made is None else fold.convert(target, made)
        if target.kind is Kind.BOOL and self._vendor.true_texts:
            return self.library("__IS_TRUE", expr)
        if target.kind in WHOLE and target.size == 8 and not target.signed:
            made = self.library("STRING_TO_ULINT", expr)
            return None if made is None else fold.convert(target, made)
        if target.kind in WHOLE:
            low, high = bounds(UNSIGNED[target.size] if target.kind is Kind.BITS else target)
            number = Intrinsic("MAX", LINT, (Intrinsic("STR_TO_INT", LINT, (expr,)), Const(LINT, low)))
            return fold.convert(target, Intrinsic("MIN", LINT, (number, Const(LINT, high))))
        name = "BOOL" if target.kind is Kind.BOOL else _part(target)
        made = self.library(f"STRING_TO_{name}", expr)
        return None if made is None else self._kept(target, made)


def _part(type: Elementary) -> str:
    """The name of a time type without what makes it long."""
    return type.name.removeprefix("L") if type.kind in TIMES else ""


def _text_of(expr: Expr, source: Elementary) -> Expr:
    return Intrinsic("CHAR_STR", StringType(1, source.size), (expr,))


def _recoded(expr: Expr | None, target: StringType) -> Expr | None:
    """The text in the width of the target."""
    if expr is None or not isinstance(expr.type, StringType) or expr.type.width == target.width:
        return expr
    type = StringType(expr.type.capacity, target.width)
    if isinstance(expr, Const) and isinstance(expr.value, bytes):
        if target.width == 2:
            return Const(type, expr.value.decode("latin-1").encode("utf-16-le"))
        units = [expr.value[at : at + 2] for at in range(0, len(expr.value), 2)]
        return Const(type, b"".join(unit[:1] if unit[1] == 0 else b"?" for unit in units))
    return Intrinsic("RECODE", type, (expr,))
