"""STRING values: pieces that are joined where they are stored, without copies in between."""

from dataclasses import dataclass, replace

from scanbench.engines.native import walk
from scanbench.engines.native.emit_body import Body, Self
from scanbench.engines.native.emit_memory import Address
from scanbench.engines.native.emit_places import address
from scanbench.engines.native.emit_types import STRING_HEAD, string
from scanbench.engines.native.string_helpers import HELPERS
from scanbench.program.program import Expr, Place
from scanbench.program.types import StringType


@dataclass(frozen=True, slots=True)
class Piece:
    """Characters somewhere in memory: `length` (an i64) of them, never more than `most`, of `width` bytes each."""

    pointer: str
    length: str
    most: int
    variable: str | None = None
    """The variable that has these characters: '' for any, None for a constant or an own buffer."""
    start_of: tuple[Place, Self] | None = None
    """The variable whose first characters these are, and the instance that its Base.SELF counts from."""
    width: int = 1


def helper(body: Body, name: str) -> str:
    """The symbol of a helper, which becomes part of the module."""
    text, needs = HELPERS[name]
    body.module.declare(f"@s.{name}", text)
    for each in needs:
        helper(body, each)
    return f"@s.{name}"


# ---- arithmetic on lengths ----------------------------------------------------------------------------------


def plus(body: Body, a: str, b: str) -> str:
    """Sum of two lengths."""
    if a == "0" or b == "0":
        return b if a == "0" else a
    if a.isdigit() and b.isdigit():
        return str(int(a) + int(b))
    return body.text.op(f"add nuw nsw i64 {a}, {b}")


def minus(body: Body, a: str, b: str) -> str:
    """Difference of two lengths, the second the smaller."""
    return a if b == "0" else body.text.op(f"sub nuw nsw i64 {a}, {b}")


def pick(body: Body, op: str, a: str, b: str) -> str:
    """smin, smax or umin of two i64."""
    symbol = f"@llvm.{op}.i64"
    body.module.declare(symbol, f"declare i64 {symbol}(i64, i64)")
    return body.text.op(f"call i64 {symbol}(i64 {a}, i64 {b})")


def bytes_of(body: Body, length: str, width: int) -> str:
    """Bytes that so many characters take."""
    if width == 1:
        return length
    return str(int(length) * width) if length.isdigit() else body.text.op(f"mul nuw nsw i64 {length}, {width}")


# ---- values -------------------------------------------------------------------------------------------------


def of_place(body: Body, place: Place) -> Piece:
    """The characters of a variable."""
    where = address(body, place)
    body.unit.flavour.read(body, place, where)
    piece = of_pointer(body, where.pointer, string(place.type), where.tag)
    return replace(piece, variable=place.variable, start_of=(place, body.self))


def of_pointer(body: Body, pointer: str, type: StringType, tag: str = "") -> Piece:
    """The characters of a STRING at an address. Its length may have been overwritten as a number: a union, a pointer."""
    if type.zero:
        length = body.text.op(f"call i64 {helper(body, 'length')}(ptr {pointer}, i64 {type.capacity}){tag}")
        return Piece(pointer, length, type.capacity, "")
    short = body.text.op(f"load i16, ptr {pointer}, align 1{tag}")
    length = pick(body, "umin", body.text.op(f"zext i16 {short} to i64"), str(type.capacity))
    data = body.text.address(pointer, STRING_HEAD)
    return Piece(data, length, type.capacity, "", width=type.width)


def cut(body: Body, pieces: list[Piece], capacity: int) -> list[Piece]:
    """The pieces, of which what is beyond the capacity is dropped."""
    if sum(piece.most for piece in pieces) <= capacity:
        return pieces
    kept, room = [], str(capacity)
    for position, piece in enumerate(pieces):
        length = pick(body, "umin", piece.length, room)
        kept.append(replace(piece, length=length, most=min(piece.most, capacity)))
        if position < len(pieces) - 1:
            room = minus(body, room, length)
    return kept


def total(body: Body, pieces: list[Piece]) -> str:
    """Length of the whole."""
    length = "0"
    for piece in pieces:
        length = plus(body, length, piece.length)
    return length


def as_one(body: Body, pieces: list[Piece]) -> Piece:
    """The whole in one stretch of memory; several pieces are copied together."""
    if not pieces:
        return Piece(body.module.constant(b"\0"), "0", 0)
    return pieces[0] if len(pieces) == 1 else copied(body, pieces)


def copied(body: Body, pieces: list[Piece]) -> Piece:
    """A copy of the whole in a buffer."""
    most, width = sum(piece.most for piece in pieces), pieces[0].width
    buffer = body.text.buffer(max(most * width, 1))
    return Piece(buffer, _join(body, buffer, pieces, ""), most, width=width)


def ordered(body: Body, exprs: tuple[Expr, ...]) -> list[list[Piece]]:
    """Values of several expressions; those that a later one may change are copied."""
    values = []
    for position, expr in enumerate(exprs):
        pieces = body.pieces(expr)
        if any(walk.disturbs(later) for later in exprs[position + 1 :]):
            pieces = settled(body, pieces)
        values.append(pieces)
    return values


def settled(body: Body, pieces: list[Piece]) -> list[Piece]:
    """The pieces, safe from what comes after."""
    return [copied(body, pieces)] if any(piece.variable is not None for piece in pieces) else pieces


# ---- storing ------------------------------------------------------------------------------------------------


def assign(body: Body, target: Place, pieces: list[Piece]) -> Address:
    """Stores the whole in a variable, of which the pieces may be parts; gives its address."""
    type = string(target.type)
    pieces = cut(body, pieces, type.capacity)
    where = address(body, target)
    data = where.pointer if type.zero else body.text.address(where.pointer, STRING_HEAD)
    if not any(_may_overlap(piece, target) for piece in pieces[1:]):
        length = _in_order(body, target, data, pieces, where.tag)
    elif not any(_may_overlap(piece, target) for piece in pieces[1:-1]) and _starts(body, pieces[0], target):
        length = _around(body, data, pieces, where.tag)
    else:
        one = copied(body, pieces)
        length = one.length
        copy(body, data, one, where.tag)
    _store_length(body, where, type, length)
    return where


def _store_length(body: Body, where: Address, type: StringType, length: str) -> None:
    """Stores the current length, or ends the characters with a 0."""
    if type.zero:
        end = shifted(body, where.pointer, length, 1)
        body.text.do(f"store i8 0, ptr {end}, align 1{where.tag}")
        return
    short = length if length.isdigit() else body.text.op(f"trunc nuw i64 {length} to i16")
    body.text.do(f"store i16 {short}, ptr {where.pointer}, align 1{where.tag}")


def _in_order(body: Body, target: Place, data: str, pieces: list[Piece], tag: str) -> str:
    """Joins from front to back. Only the first piece may be a part of the target, so no piece is overwritten before it is read."""
    if pieces and _starts(body, pieces[0], target):
        return _join(body, data, pieces[1:], tag, pieces[0].length)
    return _join(body, data, pieces, tag)


def _around(body: Body, data: str, pieces: list[Piece], tag: str) -> str:
    """Start and end of the target stay, the rest goes between: the end moves first."""
    before = total(body, pieces[:-1])
    copy(body, shifted(body, data, before, pieces[-1].width), pieces[-1], tag)
    _join(body, data, pieces[1:-1], tag, pieces[0].length)
    return plus(body, before, pieces[-1].length)


def _join(body: Body, data: str, pieces: list[Piece], tag: str, start: str = "0") -> str:
    at = start
    for piece in pieces:
        copy(body, shifted(body, data, at, piece.width), piece, tag)
        at = plus(body, at, piece.length)
    return at


def shifted(body: Body, pointer: str, length: str, width: int) -> str:
    """The address so many characters on."""
    if length == "0":
        return pointer
    return body.text.op(f"getelementptr inbounds nuw i8, ptr {pointer}, i64 {bytes_of(body, length, width)}")


def copy(body: Body, to: str, piece: Piece, tag: str) -> None:
    """Copies the characters; the two places may overlap."""
    if piece.length == "0":
        return
    size = bytes_of(body, piece.length, piece.width)
    if size.isdigit() and piece.variable is None:
        body.module.declare("@llvm.memcpy", "declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)")
        body.text.do(f"call void @llvm.memcpy.p0.p0.i64(ptr {to}, ptr {piece.pointer}, i64 {size}, i1 false)")
        return
    body.text.do(f"call void {helper(body, 'copy')}(ptr {to}, ptr {piece.pointer}, i64 {size})")


def _starts(body: Body, piece: Piece, target: Place) -> bool:
    """Whether the piece is already at the beginning of the target. Offsets in different instances cannot be compared."""
    if piece.start_of is None:
        return False
    other, instance = piece.start_of
    return (
        instance == body.self
        and target.variable != ""
        and (other.base, other.offset, other.slot, other.indices) == (target.base, target.offset, None, ())
        and target.slot is None
        and target.reference is None
        and other.reference is None
        and target.indices == ()
    )


def _may_overlap(piece: Piece, target: Place) -> bool:
    variable = piece.variable
    if variable is None:
        return False
    if "" in (variable, target.variable):
        return True
    return variable == target.variable or (variable.startswith("@") and target.variable.startswith("@"))
