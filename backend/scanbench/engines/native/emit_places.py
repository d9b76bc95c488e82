"""Places: where they are in memory, and how a reference to them looks."""

from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_memory import Address, load_at
from scanbench.engines.native.emit_types import elementary, has_members, value_type
from scanbench.engines.native.ranges import within
from scanbench.program.layout import Layout
from scanbench.program.program import Base, Expr, Index, Place
from scanbench.program.types import Elementary, Kind

I64_MAX = (1 << 63) - 1
BIT_SHIFT = 32
"""Of the bit number in a reference."""
NO_BIT = ~(7 << BIT_SHIFT)
"""Keeps all of a reference but the bit number."""


# ---- addresses ------------------------------------------------------------------------------------------------


def address(body: Body, place: Place) -> Address:
    """The address, after the checks that the place asks for."""
    if place.slot is None and place.reference is None:
        if place.base is Base.FRAME and place.offset in body.registers and not place.indices:
            return Address(body.registers[place.offset])
        return _direct(body, place)
    tag = body.module.tag(place.variable)
    start, bit = _follow(body, place)
    bit = bit if place.bit is None else str(place.bit)
    if _open(place):
        at = _open_offset(body, place, start)
        return Address(body.text.op(f"getelementptr inbounds i8, ptr {body.image}, i64 {at}"), tag, bit)
    pointer = body.text.op(f"getelementptr inbounds i8, ptr {body.image}, i64 {start}")
    return Address(_indexed(body, _shifted(body, pointer, place.offset), place.indices), tag, bit)


def load(body: Body, place: Place) -> Value:
    """The value of an elementary place."""
    known = body.counter(place)
    if known is not None:
        return known
    where = address(body, place)
    body.unit.flavour.read(body, place, where)
    return load_at(body, where, elementary(place.type))


def _direct(body: Body, place: Place) -> Address:
    start, offset = body.image, place.offset
    if place.base is Base.SELF:
        start = body.self.pointer
    elif place.base is Base.FRAME:
        offset += body.pou.frame_offset
    tag = "" if has_members(place.type) else body.module.tag(place.variable)
    if place.base is Base.IMAGE and offset < Layout.HEADER_SIZE:
        tag = ""
    pointer = _indexed(body, _shifted(body, start, offset), place.indices)
    return Address(pointer, tag, "" if place.bit is None else str(place.bit))


def _shifted(body: Body, pointer: str, offset: int) -> str:
    if offset == 0:
        return pointer
    return body.text.address(pointer, offset)


def _indexed(body: Body, pointer: str, indices: tuple[Index, ...]) -> str:
    for index in indices:
        pointer = body.text.op(f"getelementptr inbounds nuw i8, ptr {pointer}, i64 {_distance(body, index)}")
    return pointer


# ---- indices --------------------------------------------------------------------------------------------------


def _distance(body: Body, index: Index) -> str:
    """Bytes from the first element of the dimension, after the bounds check."""
    if not (isinstance(index.low, int) and isinstance(index.high, int) and isinstance(index.stride, int)):
        return _open_distance(body, index)
    steps = _steps(body, index, index.low, index.high)
    return steps if index.stride == 1 else body.text.op(f"mul nuw nsw i64 {steps}, {index.stride}")


def _steps(body: Body, index: Index, low: int, high: int) -> str:
    """Elements from the first one, as an i64; no check where it cannot fail."""
    type = elementary(index.value.type)
    value = body.scalar(index.value)
    number = widened(body, value, type)
    exact = value.low >= low and value.high <= I64_MAX and value.high - low <= I64_MAX
    flags = "nsw " if exact else ""
    steps = body.text.op(f"sub {flags}i64 {number}, {low}") if low else number
    if within(value.range, (low, high)):
        return steps
    outside = body.text.op(f"icmp ugt i64 {steps}, {high - low}")
    if value.high > I64_MAX:
        huge = body.text.op(f"icmp slt i64 {number}, 0")
        outside = body.text.op(f"or i1 {outside}, {huge}")
    body.text.trap_if(outside, index.trap)
    return steps


def _open_distance(body: Body, index: Index) -> str:
    """The bounds are computed; all numbers may be any."""
    text, type = body.text, elementary(index.value.type)
    value = body.scalar(index.value)
    number = widened(body, value, type)
    low, high, stride = (_bound(body, each) for each in (index.low, index.high, index.stride))
    below, above = text.op(f"icmp slt i64 {number}, {low}"), text.op(f"icmp sgt i64 {number}, {high}")
    outside = text.op(f"or i1 {below}, {above}")
    if value.high > I64_MAX:
        outside = text.op(f"or i1 {outside}, {text.op(f'icmp slt i64 {number}, 0')}")
    text.trap_if(outside, index.trap)
    return text.op(f"mul i64 {text.op(f'sub i64 {number}, {low}')}, {stride}")


def _bound(body: Body, part: int | Expr) -> str:
    return str(part) if isinstance(part, int) else body.scalar(part).ssa


def widened(body: Body, value: Value, type: Elementary) -> str:
    """The number as an i64; a ULINT keeps its bits."""
    if value.wide:
        return value.wide
    if type.bits == 64 or value.low == value.high:
        return value.ssa if type.bits == 64 else str(value.low)
    if type.signed and value.low < 0:
        return body.text.op(f"sext {value_type(type)} {value.ssa} to i64")
    return body.text.op(f"zext nneg {value_type(type)} {value.ssa} to i64" if type.signed else
                        f"zext {value_type(type)} {value.ssa} to i64")  # fmt: skip


# ---- references -----------------------------------------------------------------------------------------------


def reference(body: Body, place: Place, size: int = 0) -> str:
    """The place as a reference holds it. `size` is what will be taken for granted after it, if more than the type's."""
    text = body.text
    if place.slot is not None or place.reference is not None:
        start, bit = _follow(body, place, size)
        at = _open_offset(body, place, start) if _open(place) else _summed(body, place, start)
        if bit and place.bit is None:
            above = text.op(f"shl i64 {text.op(f'zext i8 {bit} to i64')}, {BIT_SHIFT}")
            return text.op(f"or i64 {at}, {above}")
    elif place.base is Base.SELF:
        at = _summed(body, place, body.self.offset)
    else:
        at = _summed(body, place, str(body.pou.frame_offset) if place.base is Base.FRAME else "0")
    return text.op(f"or i64 {at}, {place.bit << BIT_SHIFT}") if place.bit else at


def _summed(body: Body, place: Place, start: str) -> str:
    at = str(int(start) + place.offset) if start.isdigit() else start
    if place.offset and not start.isdigit():
        at = body.text.op(f"add i64 {start}, {place.offset}")
    for index in place.indices:
        at = body.text.op(f"add i64 {at}, {_distance(body, index)}")
    return at


def _follow(body: Body, place: Place, size: int = 0) -> tuple[str, str]:
    """Byte offset and bit number ('' unless it is a BOOL) in the place's slot or reference, checked."""
    text = body.text
    if place.slot is not None:
        slot = address(body, place.slot)
        whole = text.op(f"load i64, ptr {slot.pointer}, align 1{slot.tag}")
    else:
        assert place.reference is not None
        whole = body.scalar(place.reference).ssa
    bit, start = "", whole
    known = _is_bound(body, place)
    if place.type.kind is Kind.BOOL:
        high = text.op(f"lshr i64 {whole}, {BIT_SHIFT}")
        bit = text.op(f"and i8 {text.op(f'trunc i64 {high} to i8')}, 7")
    if bit or not known:
        start = text.op(f"and i64 {whole}, {NO_BIT}")
    if not known and place.null_trap:
        _check_reach(body, start, _reach(place, size), place)
    return start, bit


def _is_bound(body: Body, place: Place) -> bool:
    slot = place.slot
    in_frame = slot is not None and slot.base is Base.FRAME and slot.slot is None and slot.reference is None
    return in_frame and slot is not None and slot.offset in body.bound


def _reach(place: Place, size: int) -> int:
    """Bytes that the place may need at the reference's target."""
    fixed = sum(
        (index.high - index.low) * index.stride
        for index in place.indices
        if isinstance(index.low, int) and isinstance(index.high, int) and isinstance(index.stride, int)
    )
    return int(place.offset + fixed + max(place.type.size, size))


def _check_reach(body: Body, start: str, reach: int, place: Place) -> None:
    """Traps unless so many bytes from there lie in the image, for a reference in its state, after the header."""
    trap = place.null_trap or place.indices[-1].trap
    end = body.unit.image_size if place.reference is None else body.unit.state_size
    room = end - Layout.HEADER_SIZE - reach
    distance = body.text.op(f"sub i64 {start}, {Layout.HEADER_SIZE}")
    body.text.trap_if(body.text.op(f"icmp ugt i64 {distance}, {room}") if room >= 0 else "true", trap)


def _open(place: Place) -> bool:
    return any(not isinstance(index.low, int) for index in place.indices)


def _open_offset(body: Body, place: Place, start: str) -> str:
    """The byte offset where bounds are computed at run time and may be wrong: the place is checked like a reference."""
    at = _summed(body, place, start)
    _check_reach(body, at, place.type.size, place)
    return at
