"""Standard functions on strings."""

from collections.abc import Callable
from dataclasses import replace

from scanbench.engines.native import walk
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_operators import convert
from scanbench.engines.native.emit_strings import (
    Piece,
    as_one,
    bytes_of,
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
from scanbench.engines.native.emit_types import elementary, stored, string
from scanbench.program.program import Intrinsic
from scanbench.program.types import LINT, MAX_STRING, Elementary, StringType
from scanbench.program.untyped import bounds

LONGEST = str(MAX_STRING)
"""No string is longer, so counts beyond it mean the same as it."""


def of_intrinsic(body: Body, expr: Intrinsic) -> list[Piece]:
    """The value of a standard function that gives a STRING."""
    return cut(body, GIVES_STRING[expr.name](body, expr), string(expr.type).capacity)


def scalar_of(body: Body, expr: Intrinsic) -> Value:
    """The value of a standard function that takes strings and gives a number."""
    return TAKES_STRING[expr.name](body, expr)


# ---- arguments ----------------------------------------------------------------------------------------------


def _one(body: Body, pieces: list[Piece], type: StringType) -> Piece:
    """The string in one stretch; an empty one has the width of its type."""
    return replace(as_one(body, pieces), width=type.width)


def _arguments(body: Body, expr: Intrinsic) -> tuple[list[Piece], list[str]]:
    """The strings, each in one stretch, and the numbers (i64), evaluated from left to right."""
    strings, numbers = [], []
    for position, arg in enumerate(expr.args):
        if isinstance(arg.type, StringType):
            pieces = body.pieces(arg)
            if any(walk.disturbs(later) for later in expr.args[position + 1 :]):
                pieces = settled(body, pieces)
            strings.append(_one(body, pieces, arg.type))
        else:
            numbers.append(convert(body, elementary(arg.type), LINT, body.scalar(arg)).ssa)
    return strings, numbers


def _clamped(body: Body, number: str, low: str, high: str) -> str:
    return pick(body, "smin", pick(body, "smax", number, low), high)


def _part(body: Body, of: Piece, start: str, length: str) -> Piece:
    """Characters of a piece, from a position that counts from 0."""
    pointer = shifted(body, of.pointer, start, of.width)
    return replace(of, pointer=pointer, length=length, start_of=of.start_of if start == "0" else None)


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
    after = plus(body, s.length, "1")
    start = minus(body, _clamped(body, p, "1", after), "1")
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


def _char_text(body: Body, expr: Intrinsic) -> list[Piece]:
    type = elementary(expr.args[0].type)
    char, buffer = body.scalar(expr.args[0]), body.text.buffer(type.size)
    body.text.do(f"store {stored(type)} {char.ssa}, ptr {buffer}, align 1")
    return [Piece(buffer, "1", 1, width=type.size)]


def _recode(body: Body, expr: Intrinsic) -> list[Piece]:
    (s,), _ = _arguments(body, expr)
    width = string(expr.type).width
    if width == s.width:
        return [s]
    buffer = body.text.buffer(max(s.most * width, 1))
    how = helper(body, "widen" if width > s.width else "narrow")
    body.text.do(f"call void {how}(ptr {buffer}, ptr {s.pointer}, i64 {s.length})")
    return [Piece(buffer, s.length, s.most, width=width)]


# ---- choices --------------------------------------------------------------------------------------------------


def _chosen(body: Body, condition: str, a: Piece, b: Piece) -> Piece:
    """The first where the condition holds, else the second."""
    pointer = body.text.op(f"select i1 {condition}, ptr {a.pointer}, ptr {b.pointer}")
    length = body.text.op(f"select i1 {condition}, i64 {a.length}, i64 {b.length}")
    anywhere = None if a.variable is None and b.variable is None else ""
    return Piece(pointer, length, max(a.most, b.most), anywhere, width=a.width)


def _ones(body: Body, expr: Intrinsic) -> tuple[list[Piece], list[str]]:
    """Strings in one stretch each, and what comes before them (as it is, without a conversion)."""
    numbers = [body.scalar(arg).ssa for arg in expr.args if isinstance(arg.type, Elementary)]
    texts = tuple(arg for arg in expr.args if isinstance(arg.type, StringType))
    return [
        _one(body, pieces, string(arg.type)) for pieces, arg in zip(ordered(body, texts), texts, strict=True)
    ], numbers


def _extreme(body: Body, expr: Intrinsic) -> list[Piece]:
    (a, b), _ = _ones(body, expr)
    first = compare(body, "lt" if expr.name == "MIN" else "gt", a.width, ([a], [b]))
    return [_chosen(body, first.ssa, a, b)]


def _select(body: Body, expr: Intrinsic) -> list[Piece]:
    (a, b), (guard,) = _ones(body, expr)
    return [_chosen(body, guard, b, a)]


def _multiplex(body: Body, expr: Intrinsic) -> list[Piece]:
    texts, (number,) = _ones(body, expr)
    chosen = texts[0]
    for position, each in enumerate(texts[1:], 1):
        chosen = _chosen(body, body.text.op(f"icmp sge i64 {number}, {position}"), each, chosen)
    return [chosen]


# ---- functions that give a number -----------------------------------------------------------------------------


def _length(body: Body, expr: Intrinsic) -> Value:
    pieces = body.pieces(expr.args[0])
    most = min(sum(piece.most for piece in pieces), int(LONGEST))
    return convert(body, LINT, elementary(expr.type), Value(total(body, pieces), 0, most))


def _find(body: Body, expr: Intrinsic) -> Value:
    (s, s2), _ = _arguments(body, expr)
    find = helper(body, "find" if s.width == 1 else "findwide")
    call = f"call i64 {find}(ptr {s.pointer}, i64 {s.length}, ptr {s2.pointer}, i64 {s2.length})"
    return convert(body, LINT, elementary(expr.type), Value(body.text.op(call), 0, s.most))


def _to_int(body: Body, expr: Intrinsic) -> Value:
    (s,), _ = _arguments(body, expr)
    ssa = body.text.op(f"call i64 {helper(body, 'toint')}(ptr {s.pointer}, i64 {s.length})")
    return convert(body, LINT, elementary(expr.type), Value(ssa, *bounds(LINT)))


def _to_real(body: Body, expr: Intrinsic) -> Value:
    (s,), _ = _arguments(body, expr)
    return Value(body.text.op(f"call double {helper(body, 'toreal')}(ptr {s.pointer}, i64 {s.length})"))


def compare(body: Body, op: str, width: int, sides: tuple[list[Piece], list[Piece]]) -> Value:
    """Strings by code, the shorter first."""
    a, b = (as_one(body, pieces) for pieces in sides)
    if op in ("eq", "ne"):
        sizes = [bytes_of(body, each.length, width) for each in (a, b)]
        given = f"(ptr {a.pointer}, i64 {sizes[0]}, ptr {b.pointer}, i64 {sizes[1]})"
        same = body.text.op(f"call i1 {helper(body, 'equal')}{given}")
        return Value(body.text.op(f"xor i1 {same}, true") if op == "ne" else same, 0, 1)
    given = f"(ptr {a.pointer}, i64 {a.length}, ptr {b.pointer}, i64 {b.length})"
    order = body.text.op(f"call i64 {helper(body, 'order' if width == 1 else 'orderwide')}{given}")
    return Value(body.text.op(f"icmp s{op} i64 {order}, 0"), 0, 1)


def _char_at(body: Body, expr: Intrinsic) -> Value:
    (s,), (p,) = _arguments(body, expr)
    type = elementary(expr.type)
    start, inside = _position(body, s, p)
    pointer = shifted(body, s.pointer, start, s.width)
    read, none, on = body.text.name("read"), body.text.block, body.text.name("on")
    body.text.choose(inside, read, on)
    body.text.begin(read)
    char = body.text.op(f"load {stored(type)}, ptr {pointer}, align 1")
    body.text.go(on)
    body.text.begin(on)
    ssa = body.text.op(f"phi {stored(type)} [ 0, %{none} ], [ {char}, %{read} ]")
    return Value(ssa, *bounds(type))


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
    "CHAR_STR": _char_text,
    "RECODE": _recode,
    "MIN": _extreme,
    "MAX": _extreme,
    "SEL": _select,
    "MUX": _multiplex,
}

TAKES_STRING: dict[str, Callable[[Body, Intrinsic], Value]] = {
    "LEN": _length,
    "FIND": _find,
    "CHAR_AT": _char_at,
    "STR_TO_INT": _to_int,
    "STR_TO_REAL": _to_real,
}
