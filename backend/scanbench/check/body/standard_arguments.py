"""Arguments of standard functions: by position or name, brought to a common type."""

import re
from dataclasses import replace

from scanbench.check.body import fold, lenient
from scanbench.check.body.allowed import allowed
from scanbench.check.body.coercion import coerce
from scanbench.check.body.context import Body
from scanbench.check.context import did_you_mean
from scanbench.check.dialect import Allowance
from scanbench.check.standard.functions import Row, StringFunction
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, Load, Stmt
from scanbench.program.types import LINT, Elementary, Kind, StringType, Type
from scanbench.program.untyped import ANY_REAL, common, is_untyped, real_beside, settle
from scanbench.syntax import tree

VENDOR_NAMES = {"STR": "IN", "STR1": "IN1", "STR2": "IN2", "SIZE": "L", "LEN": "L", "POS": "P"}
"""Names that CODESYS has for the arguments of string functions."""


def ordered(body: Body, node: tree.Call, name: str, row: Row) -> list[tree.Expression]:
    """The arguments in the order of the formals, however they were given."""
    given: dict[int, tree.Expression] = {}
    for index, argument in enumerate(node.arguments):
        if argument.output or argument.value is None:
            shown = argument.name or ""
            raise body.report.reject("T004", f"`{name}` has no output `{shown}`.", argument.span)
        position = index if argument.name is None else _position(body, argument, name, row)
        if position in given:
            raise body.report.reject("T004", f"`{argument.name}` of `{name}` is given twice.", argument.span)
        given[position] = argument.value
    count = max(len(given), len(row.formals))
    if (len(given) > len(row.formals) and not row.variadic) or sorted(given) != list(range(count)):
        missing = [formal for index, formal in enumerate(row.formals) if index not in given]
        takes = f"{', '.join(row.formals)}{', ...' if row.variadic else ''}" or "nothing"
        hint = f" `{missing[0]}` is missing." if missing else ""
        takes = f"{len(row.formals)} argument{'s' if len(row.formals) != 1 else ''} ({takes})"
        raise body.report.reject("T004", f"`{name}` takes {takes}, not {len(given)}.{hint}", node.span)
    return [given[index] for index in range(count)]


def _position(body: Body, argument: tree.Argument, name: str, row: Row) -> int:
    """Of a formal argument; those after the last formal count on: IN3, IN4."""
    assert argument.name is not None
    key = argument.name.upper()
    if key in row.formals:
        return row.formals.index(key)
    last = re.fullmatch(r"([A-Z]+)(\d+)", row.formals[-1]) if row.variadic else None
    if last is not None and re.fullmatch(rf"{last.group(1)}[1-9]\d{{0,3}}", key):
        further = int(key[len(last.group(1)) :]) - int(last.group(2))
        if further > 0:
            return len(row.formals) - 1 + further
    vendor = VENDOR_NAMES.get(key) if isinstance(row, StringFunction) else None
    if vendor in row.formals:
        what = f"`{argument.name}` is the argument `{vendor}` of `{name}`"
        if allowed(body, Allowance.ARGUMENT_NAMES, argument.span, what, f"`{name}({vendor} := ...)`"):
            return row.formals.index(vendor)
    hint = did_you_mean(key, row.formals) or f" It takes {', '.join(row.formals) or 'nothing'}."
    raise body.report.reject("T004", f"`{name}` has no argument `{argument.name}`.{hint}", argument.span)


def checked(body: Body, node: tree.Call, name: str, row: Row, wanted: Type | None = None) -> list[Expr]:
    """The arguments, checked; `wanted` helps literals inside them."""
    return [body.expression(value, wanted) for value in ordered(body, node, name, row)]


def unify(body: Body, values: list[Expr], span: Span, name: str, wanted: Type | None = None) -> list[Expr]:
    """All in one common type; literals alone take the one that is wanted."""
    what = f"Each argument of `{name}`"
    if isinstance(wanted, Elementary) and all(_is_literal_of(value, wanted) for value in values):
        return [coerce(body, value, wanted, span, what) for value in values]
    typed = [value for value in values if not is_untyped(value)]
    if typed and all(value.type == typed[0].type for value in typed):
        type: Type | None = typed[0].type
    else:
        type = _join(body, typed or [settle(value) for value in values], span, name)
    assert type is not None
    real = any(value.type == ANY_REAL for value in values)
    if real and isinstance(type, Elementary) and type.kind is not Kind.REAL:
        literal = Const(real_beside([value.type for value in typed], wanted), 0.0)
        type = _join(body, [*typed, literal], span, name)
    return [coerce(body, value, type, span, what) for value in values]


def _join(body: Body, values: list[Expr], span: Span, name: str) -> Type:
    type = values[0].type
    for value in values[1:]:
        joined = _common(type, value) or lenient.joined(body, type, value.type)
        if joined is None:
            raise body.report.reject(
                "T002", f"The arguments of `{name}` have no common type: {type} and {value.type}.", span
            )
        type = joined
    if type is None:
        raise body.report.reject("T002", f"`{name}` needs values, and this gives none.", span)
    return type


def integer(body: Body, value: Expr, span: Span, name: str) -> Expr:
    """A count, position or selector, as LINT."""
    value = settle(value)
    value = lenient.index(body, value, span, f"A number that `{name}` takes") or value
    if not isinstance(value.type, Elementary) or value.type.kind not in (Kind.INT, Kind.UINT):
        raise body.report.reject("T002", f"`{name}` needs an integer here, not {value.type}.", span)
    return fold.convert(LINT, value)


def hold(body: Body, value: Expr, span: Span) -> tuple[tuple[Stmt, ...], Expr]:
    """What must run first, and a value that may then be read any number of times."""
    if isinstance(value, Const) or body.effects.repeats(value):
        return (), value
    assert value.type is not None
    place = body.temporary(value.type, span)
    return (Assign(place, value, span),), Load(place)


def _common(type: Type | None, value: Expr) -> Type | None:
    other = value.type
    if type == other:
        return type
    if isinstance(type, StringType) and isinstance(other, StringType):
        return replace(type, capacity=max(type.capacity, other.capacity)) if type.width == other.width else None
    if isinstance(type, Elementary) and isinstance(other, Elementary):
        return common(type, other)
    if isinstance(type, Elementary) and type.kind is Kind.CHAR and _is_character(value):
        return type
    if isinstance(other, Elementary) and other.kind is Kind.CHAR:
        return other
    return None


def _is_character(value: Expr) -> bool:
    return isinstance(value, Const) and isinstance(value.type, StringType) and len(value.value) == value.type.width  # type: ignore[arg-type]


def _is_literal_of(value: Expr, wanted: Elementary) -> bool:
    """Whether this is a literal that can take the type."""
    if not is_untyped(value):
        return wanted.kind is Kind.CHAR and _is_character(value)
    if wanted.kind is Kind.REAL:
        return True
    return value.type != ANY_REAL and wanted.kind in (Kind.INT, Kind.UINT, Kind.BITS)
