"""Standard functions on strings."""

from collections.abc import Callable

from scanbench.check.program import Intrinsic
from scanbench.check.types import LINT, StringType
from scanbench.engines.native import walk
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_operators import convert
from scanbench.engines.native.emit_strings import (
    Piece,
    as_one,
    cut,
    helper,
    minus,
    ordered,
    pick,
    plus,
    settled,
    shifted,
    total,
)
from scanbench.engines.native.emit_types import bounds, elementary, string

LONGEST = "32767"
"""No string is longer, so counts beyond it mean the same as it."""


def of_intrinsic(body: Body, expr: Intrinsic) -> list[Piece]:
    """The value of a standard function that gives a STRING."""
    return cut(body, GIVES_STRING[expr.name](body, expr), string(expr.type).capacity)


def scalar_of(body: Body, expr: Intrinsic) -> Value:
    """The value of a standard function that takes strings and gives a number."""
    return TAKES_STRING[expr.name](body, expr)


# ---- arguments ----------------------------------------------------------------------------------------------


def _arguments(body: Body, expr: Intrinsic) -> tuple[list[Piece], list[str]]:
    """The strings, each in one stretch, and the numbers (i64), evaluated from left to right."""
    strings, numbers = [], []
    for position, arg in enumerate(expr.args):
        if isinstance(arg.type, StringType):
            pieces = body.pieces(arg)
            if any(walk.calls_functions(later) for later in expr.args[position + 1 :]):
                pieces = settled(body, pieces)
            strings.append(as_one(body, pieces))
        else:
            numbers.append(convert(body, elementary(arg.type), LINT, body.scalar(arg)).ssa)
    return strings, numbers


def _clamped(body: Body, number: str, low: str, high: str) -> str:
    return pick(body, "smin", pick(body, "smax", number, low), high)


def _part(body: Body, of: Piece, start: str, length: str) -> Piece:
    """Characters of a piece, from a position that counts from 0."""
    pointer = shifted(body, of.pointer, start)
    return Piece(pointer, length, of.most, of.variable, of.start_of if start == "0" else None)


# ---- functions that give a STRING -----------------------------------------------------------------------------


def _left(body: Body, expr: Intrinsic) -> list[Piece]:
    (s,), (n,) = _arguments(body, expr)
    return [_part(body, s, "0", _clamped(body, n, "0", s.length))]


def _right(body: Body, expr: Intrinsic) -> list[Piece]:
    (s,), (n,) = _arguments(body, expr)
    length = _clamped(body, n, "0", s.length)
    return [_part(body, s, minus(body, s.length, length), length)]


def _mid(body: Body, expr: Intrinsic) -> list[Piece]:
    (s,), (n, p) = _arguments(body, expr)
    start, inside = _position(body, s, p)
    rest = body.text.op(f"select i1 {inside}, i64 {minus(body, s.length, start)}, i64 0")
    return [_part(body, s, start, _clamped(body, n, "0", rest))]


def _position(body: Body, s: Piece, p: str) -> tuple[str, str]:
    """Position from 0 (0 when it is outside), and whether the position from 1 is one of the string's."""
    text = body.text
    before = text.op(f"sub i64 {p}, 1")
    inside = text.op(f"icmp ult i64 {before}, {s.length}")
    return text.op(f"select i1 {inside}, i64 {before}, i64 0"), inside


def _concat(body: Body, expr: Intrinsic) -> list[Piece]:
    return [piece for pieces in ordered(body, expr.args) for piece in pieces]


def _insert(body: Body, expr: Intrinsic) -> list[Piece]:
    (s, s2), (p,) = _arguments(body, expr)
    at = _clamped(body, p, "0", s.length)
    return [_part(body, s, "0", at), s2, _part(body, s, at, minus(body, s.length, at))]


def _delete(body: Body, expr: Intrinsic) -> list[Piece]:
    (s,), (n, p) = _arguments(body, expr)
    text = body.text
    start, inside = _position(body, s, p)
    count = _clamped(body, n, "0", LONGEST)
    end = pick(body, "smin", plus(body, start, count), s.length)
    head = text.op(f"select i1 {inside}, i64 {start}, i64 {s.length}")
    tail = text.op(f"select i1 {inside}, i64 {end}, i64 {s.length}")
    return [_part(body, s, "0", head), _part(body, s, tail, minus(body, s.length, tail))]


def _replace(body: Body, expr: Intrinsic) -> list[Piece]:
    (s, s2), (n, p) = _arguments(body, expr)
    behind = plus(body, s.length, "1")
    start = minus(body, _clamped(body, p, "1", behind), "1")
    count = _clamped(body, n, "0", LONGEST)
    end = pick(body, "smin", plus(body, start, count), s.length)
    return [_part(body, s, "0", start), s2, _part(body, s, end, minus(body, s.length, end))]


def _decimal(body: Body, expr: Intrinsic) -> list[Piece]:
    _, (number,) = _arguments(body, expr)
    buffer, text = body.text.buffer(32), body.text
    digits, negative = number, "false"
    if expr.name == "INT_TO_STR":
        negative = text.op(f"icmp slt i64 {number}, 0")
        opposite = text.op(f"sub i64 0, {number}")
        digits = text.op(f"select i1 {negative}, i64 {opposite}, i64 {number}")
    length = text.op(f"call i64 {helper(body, 'decimal')}(ptr {buffer}, i64 {digits}, i1 {negative})")
    return [Piece(buffer, length, 20)]


def _real_text(body: Body, expr: Intrinsic) -> list[Piece]:
    number, digits = body.scalar(expr.args[0]), body.scalar(expr.args[1])
    buffer = body.text.buffer(40)
    call = f"call i64 {helper(body, 'realtext')}(ptr {buffer}, double {number.ssa}, i64 {digits.ssa})"
    return [Piece(buffer, body.text.op(call), 32)]


# ---- functions that give a number -----------------------------------------------------------------------------


def _length(body: Body, expr: Intrinsic) -> Value:
    pieces = body.pieces(expr.args[0])
    most = min(sum(piece.most for piece in pieces), int(LONGEST))
    return convert(body, LINT, elementary(expr.type), Value(total(body, pieces), 0, most))


def _find(body: Body, expr: Intrinsic) -> Value:
    (s, s2), _ = _arguments(body, expr)
    call = f"call i64 {helper(body, 'find')}(ptr {s.pointer}, i64 {s.length}, ptr {s2.pointer}, i64 {s2.length})"
    return convert(body, LINT, elementary(expr.type), Value(body.text.op(call), 0, s.most))


def _to_int(body: Body, expr: Intrinsic) -> Value:
    (s,), _ = _arguments(body, expr)
    ssa = body.text.op(f"call i64 {helper(body, 'toint')}(ptr {s.pointer}, i64 {s.length})")
    return convert(body, LINT, elementary(expr.type), Value(ssa, *bounds(LINT)))


def _to_real(body: Body, expr: Intrinsic) -> Value:
    (s,), _ = _arguments(body, expr)
    return Value(body.text.op(f"call double {helper(body, 'toreal')}(ptr {s.pointer}, i64 {s.length})"))


def compare(body: Body, op: str, left: list[Piece], right: list[Piece]) -> Value:
    """Strings by code, the shorter first."""
    a, b = as_one(body, left), as_one(body, right)
    given = f"(ptr {a.pointer}, i64 {a.length}, ptr {b.pointer}, i64 {b.length})"
    if op in ("eq", "ne"):
        same = body.text.op(f"call i1 {helper(body, 'equal')}{given}")
        return Value(body.text.op(f"xor i1 {same}, true") if op == "ne" else same, 0, 1)
    order = body.text.op(f"call i64 {helper(body, 'order')}{given}")
    return Value(body.text.op(f"icmp s{op} i64 {order}, 0"), 0, 1)


GIVES_STRING: dict[str, Callable[[Body, Intrinsic], list[Piece]]] = {
    "LEFT": _left,
    "RIGHT": _right,
    "MID": _mid,
    "CONCAT": _concat,
    "INSERT": _insert,
    "DELETE": _delete,
    "REPLACE": _replace,
    "INT_TO_STR": _decimal,
    "UINT_TO_STR": _decimal,
    "REAL_TO_STR": _real_text,
}

TAKES_STRING: dict[str, Callable[[Body, Intrinsic], Value]] = {
    "LEN": _length,
    "FIND": _find,
    "STR_TO_INT": _to_int,
    "STR_TO_REAL": _to_real,
}
