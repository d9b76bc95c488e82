"""Expressions: the dispatch over their kinds."""

from scanbench.check.program import Binary, CallFunction, Compare, Const, Convert, Expr, Intrinsic, Load, Unary
from scanbench.check.types import StringType
from scanbench.engines.native import emit_calls, emit_string_functions
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_intrinsics import of_intrinsic
from scanbench.engines.native.emit_operators import binary, compare, convert, unary
from scanbench.engines.native.emit_places import load
from scanbench.engines.native.emit_strings import Piece, cut, of_place, ordered
from scanbench.engines.native.emit_types import elementary, integer, is_real, real, string, wrap


def scalar(body: Body, expr: Expr) -> Value:
    """The value of an elementary expression."""
    match expr:
        case Const():
            return constant(expr)
        case Load(place):
            return load(body, place)
        case Unary(op, type, operand):
            return unary(body, op, type, body.scalar(operand))
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


def _compare(body: Body, expr: Compare) -> Value:
    left, right = expr.left, expr.right
    if isinstance(left.type, StringType):
        a, b = ordered(body, (left, right))
        return emit_string_functions.compare(body, expr.op, a, b)
    first = body.scalar(left)
    return compare(body, expr.op, elementary(left.type), first, body.scalar(right))


def pieces(body: Body, expr: Expr) -> list[Piece]:
    """The value of a STRING expression."""
    match expr:
        case Const(_, value):
            assert isinstance(value, bytes)
            return [Piece(body.module.constant(value), str(len(value)), len(value))] if value else []
        case Load(place):
            return [of_place(body, place)]
        case Convert(type, operand):
            return cut(body, body.pieces(operand), string(type).capacity)
        case Intrinsic():
            return emit_string_functions.of_intrinsic(body, expr)
        case CallFunction():
            return [emit_calls.text(body, expr)]
    raise AssertionError(f"not a STRING: {expr}")
