"""Expressions: the dispatch over their kinds."""

from typing import assert_never

from scanbench.engines.native import emit_calls, emit_checks, emit_string_functions
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_intrinsics import of_intrinsic
from scanbench.engines.native.emit_operators import binary, compare, convert, unary
from scanbench.engines.native.emit_places import load, reference
from scanbench.engines.native.emit_strings import Piece, cut, of_place, ordered
from scanbench.engines.native.emit_types import elementary, integer, is_real, real, string, wrap
from scanbench.program.program import (
    Binary,
    CallFunction,
    Compare,
    Const,
    Convert,
    Expr,
    Intrinsic,
    Limit,
    Load,
    RefOf,
    Sequence,
    Unary,
    Violates,
)
from scanbench.program.types import StringType
from scanbench.program.untyped import bounds


def scalar(body: Body, expr: Expr) -> Value:
    """The value of an elementary expression."""
    match expr:
        case Const():
            return constant(expr)
        case Load(place):
            return load(body, place)
        case Unary(op, type, operand):
            return unary(body, op, type, body.scalar(operand))
        case Binary(op, _, left, right) if expr.short and body.unit.flavour.exact:
            return _short(body, op, left, right)
        case Binary(op, type, left, right, trap):
            return binary(body, op, type, body.scalar(left), body.scalar(right), trap)
        case Compare():
            return _compare(body, expr)
        case Convert(type, operand):
            return convert(body, elementary(operand.type), elementary(type), body.scalar(operand))
        case Intrinsic():
            if expr.name in emit_string_functions.TAKES_STRING:
                return emit_string_functions.scalar_of(body, expr)
            return of_intrinsic(body, expr)
        case CallFunction():
            return emit_calls.scalar(body, expr)
        case RefOf(place, type):
            return Value(reference(body, place), *bounds(type))
        case Limit():
            return emit_checks.limit(body, expr)
        case Violates():
            return emit_checks.violates(body, expr)
        case Sequence(before, value):
            with body.text.inside_expression():
                body.run(before)
            return body.scalar(value)
        case _:
            assert_never(expr)


def constant(expr: Const) -> Value:
    """A literal."""
    type = elementary(expr.type)
    assert not isinstance(expr.value, bytes)
    if is_real(type):
        return Value(real(float(expr.value), type), clean=True)
    number = int(expr.value)
    if type.signed:
        number = wrap(number, type.bits)
    else:
        number &= (1 << type.bits) - 1
    return Value(integer(number, type), number, number)


def _short(body: Body, op: str, left: Expr, right: Expr) -> Value:
    """AND_THEN or OR_ELSE; code that may run what it is not asked for evaluates both sides, which is quicker."""
    text, first = body.text, body.scalar(left).ssa
    before, more, on = text.block, text.name("more"), text.name("on")
    text.choose(first, *((more, on) if op == "and" else (on, more)))
    text.begin(more)
    second, end = body.scalar(right).ssa, text.block
    text.go(on)
    text.begin(on)
    decided = "false" if op == "and" else "true"
    return Value(text.op(f"phi i1 [ {decided}, %{before} ], [ {second}, %{end} ]"), 0, 1)


def _compare(body: Body, expr: Compare) -> Value:
    left, right = expr.left, expr.right
    if isinstance(left.type, StringType):
        a, b = ordered(body, (left, right))
        return emit_string_functions.compare(body, expr.op, left.type.width, (a, b))
    first = body.scalar(left)
    return compare(body, expr.op, elementary(left.type), first, body.scalar(right))


def pieces(body: Body, expr: Expr) -> list[Piece]:
    """The value of a STRING expression."""
    match expr:
        case Const(_, value):
            assert isinstance(value, bytes)
            width = string(expr.type).width
            count = len(value) // width
            return [Piece(body.module.constant(value), str(count), count, width=width)] if value else []
        case Load(place):
            return [of_place(body, place)]
        case Convert(type, operand):
            return cut(body, body.pieces(operand), string(type).capacity)
        case Intrinsic():
            return emit_string_functions.of_intrinsic(body, expr)
        case CallFunction():
            return [emit_calls.text(body, expr)]
        case Sequence(before, inner):
            with body.text.inside_expression():
                body.run(before)
            return body.pieces(inner)
    raise AssertionError(f"not a STRING: {expr}")
