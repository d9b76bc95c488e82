"""Loads and stores at an address."""

from dataclasses import dataclass

from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import UNLIKELY, Value
from scanbench.engines.native.emit_types import NAN, is_real, stored, value_type
from scanbench.program.types import Elementary, Kind
from scanbench.program.untyped import bounds


@dataclass(frozen=True, slots=True)
class Address:
    """Where to load and store: a pointer, the alias tag, and the bit in the byte, if it is one bit of it."""

    pointer: str
    tag: str = ""
    bit: str = ""


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
