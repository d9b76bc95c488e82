"""Places: addresses, loads, stores and references."""

from dataclasses import dataclass

from scanbench.check.program import Base, Index, Place
from scanbench.check.types import Elementary, Kind
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import UNLIKELY, Value
from scanbench.engines.native.emit_types import NAN, bounds, elementary, has_members, is_real, stored, value_type
from scanbench.engines.native.ranges import within

I64_MAX = (1 << 63) - 1


@dataclass(frozen=True, slots=True)
class Address:
    """Where to load and store: a pointer, the alias tag, and the bit in the byte, if it is one bit of it."""

    pointer: str
    tag: str = ""
    bit: str = ""


# ---- addresses ------------------------------------------------------------------------------------------------


def address(body: Body, place: Place) -> Address:
    """The address, after the checks that the place asks for."""
    if place.slot is None:
        if place.base is Base.FRAME and place.offset in body.registers and not place.indices:
            return Address(body.registers[place.offset])
        return _direct(body, place)
    tag = body.module.tag(place.variable)
    reference = follow(body, place)
    bit = ""
    if place.type.kind is Kind.BOOL:
        high = body.text.op(f"lshr i64 {reference}, 32")
        bit = body.text.op(f"trunc i64 {high} to i8")
        reference = body.text.op(f"and i64 {reference}, 4294967295")
    pointer = body.text.op(f"getelementptr inbounds i8, ptr {body.image}, i64 {reference}")
    return Address(_indexed(body, _shifted(body, pointer, place.offset), place.indices), tag, bit)


def _direct(body: Body, place: Place) -> Address:
    start, offset = body.image, place.offset
    if place.base is Base.SELF:
        start = body.self.pointer
    elif place.base is Base.FRAME:
        offset += body.pou.frame_offset
    tag = "" if has_members(place.type) else body.module.tag(place.variable)
    pointer = _indexed(body, _shifted(body, start, offset), place.indices)
    return Address(pointer, tag, "" if place.bit is None else str(place.bit))


def _shifted(body: Body, pointer: str, offset: int) -> str:
    if offset == 0:
        return pointer
    return body.text.op(f"getelementptr inbounds nuw i8, ptr {pointer}, i64 {offset}")


def _indexed(body: Body, pointer: str, indices: tuple[Index, ...]) -> str:
    for index in indices:
        steps = index_steps(body, index)
        distance = steps if index.stride == 1 else body.text.op(f"mul nuw nsw i64 {steps}, {index.stride}")
        pointer = body.text.op(f"getelementptr inbounds nuw i8, ptr {pointer}, i64 {distance}")
    return pointer


def index_steps(body: Body, index: Index) -> str:
    """Elements from the first one of the dimension, as an i64, after the bounds check; no check where it cannot fail."""
    type = elementary(index.value.type)
    value = body.scalar(index.value)
    number = widened(body, value, type)
    exact = value.low >= index.low and value.high <= I64_MAX and value.high - index.low <= I64_MAX
    flags = "nsw " if exact else ""
    steps = body.text.op(f"sub {flags}i64 {number}, {index.low}") if index.low else number
    if within(value.range, (index.low, index.high)):
        return steps
    outside = body.text.op(f"icmp ugt i64 {steps}, {index.high - index.low}")
    if value.high > I64_MAX:
        huge = body.text.op(f"icmp slt i64 {number}, 0")
        outside = body.text.op(f"or i1 {outside}, {huge}")
    body.text.trap_if(outside, index.trap)
    return steps


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


def follow(body: Body, place: Place) -> str:
    """The reference in the place's slot, checked for being bound."""
    assert place.slot is not None
    slot = address(body, place.slot)
    reference = body.text.op(f"load i64, ptr {slot.pointer}, align 1{slot.tag}")
    if place.null_trap:
        body.text.trap_if(body.text.op(f"icmp eq i64 {reference}, 0"), place.null_trap)
    return reference


def reference(body: Body, place: Place) -> str:
    """The place as an in-out slot holds it."""
    text = body.text
    if place.slot is not None:
        start = follow(body, place)
        if place.offset:
            start = text.op(f"add i64 {start}, {place.offset}")
    elif place.base is Base.SELF:
        start = text.op(f"add i64 {body.self.offset}, {place.offset}")
    else:
        start = str(place.offset + (body.pou.frame_offset if place.base is Base.FRAME else 0))
    for index in place.indices:
        steps = index_steps(body, index)
        distance = text.op(f"mul nuw nsw i64 {steps}, {index.stride}")
        start = text.op(f"add i64 {start}, {distance}")
    if place.bit:
        start = text.op(f"or i64 {start}, {place.bit << 32}")
    return start


# ---- loads and stores -----------------------------------------------------------------------------------------


def load(body: Body, place: Place) -> Value:
    """The value of an elementary place."""
    known = body.counter(place)
    return known if known is not None else load_at(body, address(body, place), elementary(place.type))


def load_at(body: Body, where: Address, type: Elementary) -> Value:
    """The value of this type at an address."""
    text = body.text
    raw = text.op(f"load {stored(type)}, ptr {where.pointer}, align 1{where.tag}")
    if type.kind is Kind.BOOL:
        if where.bit not in ("", "0"):
            raw = text.op(f"lshr i8 {raw}, {where.bit}")
        return Value(text.op(f"trunc i8 {raw} to i1"), 0, 1)
    if is_real(type):
        return Value(raw)
    return Value(raw, *bounds(type))


def store(body: Body, where: Address, type: Elementary, value: Value) -> None:
    """Stores a value; a NaN becomes the canonical one."""
    ssa = canonical(body, type, value) if is_real(type) else value.ssa
    put(body, where, type, ssa)


def put(body: Body, where: Address, type: Elementary, ssa: str) -> None:
    """Stores the bits as they are."""
    text = body.text
    if type.kind is Kind.BOOL:
        ssa = text.op(f"zext i1 {ssa} to i8") if ssa not in ("true", "false") else str(int(ssa == "true"))
        if where.bit:
            byte = text.op(f"load i8, ptr {where.pointer}, align 1{where.tag}")
            mask = text.op(f"xor i8 {text.op(f'shl i8 1, {where.bit}')}, -1")
            kept = text.op(f"and i8 {byte}, {mask}")
            ssa = text.op(f"or i8 {kept}, {text.op(f'shl i8 {ssa}, {where.bit}')}")
    text.do(f"store {stored(type)} {ssa}, ptr {where.pointer}, align 1{where.tag}")


def canonical(body: Body, type: Elementary, value: Value) -> str:
    """The value as it is stored. A branch that is never taken keeps the check off the way of the data."""
    if value.clean:
        return value.ssa
    text, real = body.text, value_type(type)
    is_nan = text.op(f"fcmp uno {real} {value.ssa}, 0.0")
    before, nan, number = text.block, text.name("nan"), text.name("num")
    text.choose(is_nan, nan, number, UNLIKELY)
    text.begin(nan)
    text.go(number)
    text.begin(number)
    return text.op(f"phi {real} [ {value.ssa}, %{before} ], [ {NAN[type.size]}, %{nan} ]")


def move(body: Body, to: str, source: str, size: int) -> str:
    """Copies bytes between two places that may overlap; gives the target."""
    body.module.declare("@llvm.memmove", "declare void @llvm.memmove.p0.p0.i64(ptr, ptr, i64, i1)")
    body.text.do(f"call void @llvm.memmove.p0.p0.i64(ptr {to}, ptr {source}, i64 {size}, i1 false)")
    return to
