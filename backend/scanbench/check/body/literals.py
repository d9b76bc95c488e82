"""Literals -> constants."""

import math
from dataclasses import replace

from scanbench.check.body.allowed import allowed, may, used
from scanbench.check.body.context import Body
from scanbench.check.body.enumerations import typed
from scanbench.check.body.lenient import MILLISECOND_NS, enumerated
from scanbench.check.body.short_times import literal_here
from scanbench.check.body.subrange_checks import into
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.numbers import round_real
from scanbench.program.program import Const, Expr, Intrinsic
from scanbench.program.types import (
    ABBREVIATIONS,
    BOOL,
    CHAR,
    DINT,
    ELEMENTARY,
    LINT,
    REAL,
    TIME,
    ULINT,
    WCHAR,
    Elementary,
    Enumeration,
    Kind,
    StringType,
    Subrange,
    Type,
    base_of,
)
from scanbench.program.untyped import ANY_INT, ANY_REAL, bounds
from scanbench.syntax import tree

MOMENTS = {"time": Kind.TIME, "date": Kind.DATE, "tod": Kind.DATE, "dt": Kind.DATE}
EXAMPLES = {
    "TIME": "T#5s", "LTIME": "LTIME#5s", "DATE": "D#2026-11-21", "LDATE": "LDATE#2026-11-21", "TIME_OF_DAY": "TOD#12:30:00",
    "LTIME_OF_DAY": "LTOD#12:30:00", "DATE_AND_TIME": "DT#2026-11-21-12:30:00",
    "LDATE_AND_TIME": "LDT#2026-11-21-12:30:00",
}  # fmt: skip


def literal(body: Body, node: tree.Literal, wanted: Type | None) -> Const:
    """The constant; a number without a type stays untyped."""
    if node.kind in MOMENTS:
        type = (
            ELEMENTARY[ABBREVIATIONS[name].name]
            if (name := _upper(node.type_name)) in ABBREVIATIONS
            else ELEMENTARY.get(name, TIME)
        )
        if isinstance(wanted, Elementary) and wanted.name == f"L{type.name}":
            type = wanted  # T#5s is as good for an LTIME
        return literal_here(body, Const(type, node.value), node.span)
    if node.type_name is not None:
        return _typed(body, node, node.type_name)
    match node.kind:
        case "int":
            return in_64_bits(body, Const(ANY_INT, node.value), node.span)
        case "real":
            return Const(ANY_REAL, node.value)
        case "bool":
            return Const(BOOL, node.value)
    return _text(body, node)


def in_64_bits(body: Body, expr: Const, span: Span) -> Const:
    """Refuses an integer constant that no type can hold."""
    if not bounds(LINT)[0] <= int(expr.value) <= bounds(ULINT)[1]:
        raise body.report.reject("S004", f"{expr.value!r} does not fit any integer type.", span)
    return expr


def _typed(body: Body, node: tree.Literal, name: str) -> Const:
    """`INT#5`, `CHAR#'a'`, `STRING#'text'`, `Level#5` of a type of the user."""
    if isinstance(node.value, bytes):
        text = _text(body, node)
        if name.upper().startswith("W") and node.kind == "string":
            text = _text(body, replace(node, kind="wstring", value=node.value.decode("latin-1").encode("utf-16-le")))
        if name.upper() in ("CHAR", "WCHAR"):
            return _character(body, text, CHAR if name.upper() == "CHAR" else WCHAR, node.span)
        if name.upper() in ("STRING", "WSTRING"):
            return text
    type = ABBREVIATIONS.get(name.upper()) or ELEMENTARY.get(name.upper())
    if type is None:
        known = body.report.near(name, lambda: [*ELEMENTARY, *body.declarations.type_trees], "type")
        if body.declarations.find_type(name, node.span) is None:
            raise body.report.reject("D002", f"There is no type `{name}` for a literal.{known}", node.span)
        typed(body, name, node.span)
        declared = body.declarations.named(name, node.span)
        if not isinstance(declared, Elementary) or isinstance(declared, Enumeration):
            raise body.report.reject("S004", f"This is not a value of {declared}.", node.span)
        type = declared
    if node.kind == "bool" and type == BOOL:
        return Const(BOOL, node.value)
    if node.kind == "int" and type.kind is Kind.CHAR:
        return Const(type, _in_range(body, int(node.value), type, node.span))
    if node.kind not in ("int", "real"):
        raise body.report.reject("S004", f"This is not a value of {name}.", node.span)
    value = Const(ANY_INT if node.kind == "int" else ANY_REAL, node.value)
    made = literal_as(body, value, base_of(type), node.span, "The literal")
    if isinstance(type, Subrange):
        into(body, made, type, node.span, "The literal")
    return made


def _in_range(body: Body, value: int, type: Elementary, span: Span) -> int:
    low, high = bounds(type)
    if not low <= value <= high:
        raise body.report.reject("S004", f"{value} does not fit {type} ({low} to {high}).", span)
    return value


def _character(body: Body, text: Const, type: Elementary, span: Span) -> Const:
    assert isinstance(text.type, StringType)
    assert isinstance(text.value, bytes)
    if len(text.value) != text.type.width or text.type.width != type.size:
        quotes = "'a'" if type.size == 1 else '"a"'
        raise body.report.reject("S004", f"A {type} is one character in quotes, {quotes}.", span)
    return Const(type, int.from_bytes(text.value, "little"))


def literal_as(body: Body, expr: Const, type: Elementary, span: Span, what: str) -> Const:
    """An untyped number as one of `type`."""
    value = expr.value
    assert not isinstance(value, bytes)
    if type.kind is Kind.REAL:
        rounded = round_real(float(value), type)
        if math.isinf(rounded) and not math.isinf(value):
            raise body.report.reject("S004", f"{value} does not fit {type}.", span)
        return Const(type, rounded)
    if isinstance(type, Enumeration):
        if (made := enumerated(body, expr, type, span, what)) is not None:
            return made
        example = next((f" Write {type}#{name}." for name, number in type.values if number == value), "")
        raise body.report.reject("T002", f"{what} is {type}, but this is the number {value}.{example}", span)
    if expr.type == ANY_REAL and type.kind in (Kind.INT, Kind.UINT) and math.isfinite(value):
        nearest = round(round_real(float(value), REAL))
        if allowed(body, Allowance.ROUNDING, span, f"{what} is {type}, and this is {value}", f"`{nearest}`"):
            return Const(type, _in_range(body, nearest, type, span))
    if type == TIME and expr.type == ANY_INT and may(body, Allowance.TIME_NUMBERS):
        milliseconds = _in_range(body, int(value), DINT, span)
        used(body, Allowance.TIME_NUMBERS, span, f"{what} is {type}, and this is {value}", f"`T#{value}ms`")
        return Const(type, milliseconds * MILLISECOND_NS)
    if expr.type == ANY_REAL or type.kind in (Kind.TIME, Kind.DATE, Kind.CHAR, Kind.REF):
        hint = f" Write it like {EXAMPLES[type.name]}." if type.name in EXAMPLES else ""
        if type.kind in (Kind.INT, Kind.UINT, Kind.BITS):
            hint = f" Use TRUNC or LREAL_TO_{type}."
        raise body.report.reject("T002", f"{what} is {type}, but this is the number {value}.{hint}", span)
    low, high = bounds(type)
    if type.kind is Kind.INT and high < value <= high - low and may(body, Allowance.INTEGER_BITS):
        told = f"{what} is {type}, and this is {value}, the bits of {int(value) + 2 * low}"
        if allowed(body, Allowance.NARROWING, span, told, f"`{int(value) + 2 * low}`"):
            return Const(type, int(value) + 2 * low)
    return Const(type, _in_range(body, int(value), type, span))


def as_text(body: Body, expr: Expr, type: Type, span: Span) -> Expr | None:
    """A character as a string, or a string literal of one character as that, where that is wanted; or None."""
    source = expr.type
    if isinstance(type, Elementary) and type.kind is Kind.CHAR:
        if isinstance(expr, Const) and isinstance(source, StringType) and source.width == type.size:
            return _character(body, expr, type, span)
    if isinstance(type, StringType) and isinstance(source, Elementary) and source.kind is Kind.CHAR:
        if source.size == type.width:
            return Intrinsic("CHAR_STR", StringType(1, source.size), (expr,))
    return None


def _text(body: Body, node: tree.Literal) -> Const:
    """Where strings end at their first 0, a literal does."""
    value = node.value
    assert isinstance(value, bytes)
    width = 2 if node.kind == "wstring" else 1
    if width == 1 and may(body, Allowance.STRING_BYTES):
        value = value.partition(b"\0")[0]
    return Const(StringType(max(len(value) // width, 1), width), value)


def _upper(name: str | None) -> str:
    return (name or "TIME").upper()
