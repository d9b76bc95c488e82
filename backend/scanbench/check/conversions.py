"""`X_TO_Y`: every pair of elementary types that has a meaning, and strings.

TIME converts in milliseconds, as vendors do; DWORD and REAL, LWORD and LREAL have the same bits (IEC 61131-3, table 24).
"""

import re

from scanbench.check import fold
from scanbench.check.program import Compare, Const, Expr, Intrinsic
from scanbench.check.types import (
    BOOL,
    ELEMENTARY,
    LINT,
    LREAL,
    TIME,
    ULINT,
    Elementary,
    Kind,
    StringType,
    Type,
)
from scanbench.check.untyped import bounds

NAME = re.compile(r"(?:([A-Z]+)_)?TO_([A-Z]+)")
UNSIGNED = {type.size: type for type in (ELEMENTARY["USINT"], ELEMENTARY["UINT"], ELEMENTARY["UDINT"], ULINT)}
NS_PER_MS = 1_000_000
NUMBER_TEXT = StringType(20)
REAL_TEXT = StringType(32)
BITCASTS = {("DWORD", "REAL"), ("REAL", "DWORD"), ("LWORD", "LREAL"), ("LREAL", "LWORD")}


def parse_name(name: str) -> tuple[Type | None, Type] | None:
    """Source (None in `TO_INT`, which takes any) and target of a conversion function, or None."""
    match = NAME.fullmatch(name.upper())
    if match is None:
        return None
    source, target = (_type(part) if part else None for part in match.groups())
    if target is None or (match.group(1) and source is None):
        return None
    return source, target


def _type(name: str) -> Type | None:
    return StringType(80) if name == "STRING" else ELEMENTARY.get(name)


def convert(expr: Expr, target: Type) -> Expr | None:
    """The conversion of a value, or None where there is none."""
    source = expr.type
    if isinstance(source, StringType):
        return _from_string(expr, target)
    if not isinstance(source, Elementary):
        return None
    if isinstance(target, StringType):
        return _to_string(expr, source)
    assert isinstance(target, Elementary)
    if source == target:
        return expr
    if (source.name, target.name) in BITCASTS:
        return Intrinsic("BITCAST", target, (expr,))
    if source == TIME:
        return _from_time(expr, target)
    if target == TIME:
        return _to_time(expr, source)
    if {source.kind, target.kind} == {Kind.BITS, Kind.REAL} or {source.kind, target.kind} == {Kind.BOOL, Kind.REAL}:
        whole = ULINT if source.kind is not Kind.REAL else UNSIGNED[target.size]
        return fold.convert(target, fold.convert(whole, expr))
    return fold.convert(target, expr)


def _from_time(expr: Expr, target: Elementary) -> Expr | None:
    if target.kind is Kind.BOOL:
        return Compare("ne", BOOL, expr, Const(TIME, 0))
    if target.kind is Kind.REAL:
        scaled = fold.binary("div", LREAL, fold.convert(LREAL, expr), Const(LREAL, float(NS_PER_MS)))
        return fold.convert(target, scaled)
    return fold.convert(target, fold.binary("div", TIME, expr, Const(TIME, NS_PER_MS)))


def _to_time(expr: Expr, source: Elementary) -> Expr | None:
    if source.kind is Kind.BOOL:
        return None
    if source.kind is Kind.REAL:
        scaled = fold.binary("mul", LREAL, fold.convert(LREAL, expr), Const(LREAL, float(NS_PER_MS)))
        return fold.convert(TIME, scaled)
    return fold.binary("mul", TIME, fold.convert(TIME, expr), Const(TIME, NS_PER_MS))


def _to_string(expr: Expr, source: Elementary) -> Expr | None:
    match source.kind:
        case Kind.INT:
            return Intrinsic("INT_TO_STR", NUMBER_TEXT, (fold.convert(LINT, expr),))
        case Kind.UINT | Kind.BITS:
            return Intrinsic("UINT_TO_STR", NUMBER_TEXT, (fold.convert(ULINT, expr),))
        case Kind.REAL:
            digits = Const(LINT, 7 if source.size == 4 else 15)
            return Intrinsic("REAL_TO_STR", REAL_TEXT, (fold.convert(LREAL, expr), digits))
    return None


def _from_string(expr: Expr, target: Type) -> Expr | None:
    if isinstance(target, StringType):
        return expr
    if not isinstance(target, Elementary) or target == TIME:
        return None
    if target.kind is Kind.REAL:
        return fold.convert(target, Intrinsic("STR_TO_REAL", LREAL, (expr,)))
    if target.kind is Kind.BOOL:
        return None
    low, high = bounds(UNSIGNED[target.size] if target.kind is Kind.BITS else target)
    number: Expr = Intrinsic("STR_TO_INT", LINT, (expr,))
    number = Intrinsic("MAX", LINT, (number, Const(LINT, max(low, -(1 << 63)))))
    return fold.convert(target, Intrinsic("MIN", LINT, (number, Const(LINT, min(high, (1 << 63) - 1)))))
