"""Standard functions on scalars."""

from collections.abc import Callable

from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_memory import canonical
from scanbench.engines.native.emit_operators import convert, intrinsic, saturated
from scanbench.engines.native.emit_types import elementary, is_real, value_type
from scanbench.program.layout import Layout
from scanbench.program.program import Intrinsic
from scanbench.program.types import BOOL, LINT, LREAL, TIME, Elementary
from scanbench.program.untyped import bounds

LIBM = {
    "LN": "log", "LOG": "log10", "EXP": "exp", "SIN": "sin", "COS": "cos", "TAN": "tan", "ASIN": "asin",
    "ACOS": "acos", "ATAN": "atan", "ATAN2": "atan2", "EXPT": "pow",
}  # fmt: skip
LIBM_PREFIX = "libm."
"""Keeps LLVM from knowing these functions, and from replacing a call by something that rounds differently."""


def of_intrinsic(body: Body, expr: Intrinsic) -> Value:
    """The value of a standard function without strings."""
    type = elementary(expr.type)
    types = [elementary(arg.type) for arg in expr.args]
    return FUNCTIONS[expr.name](body, expr.name, type, types, [body.scalar(arg) for arg in expr.args])


def _libm(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    symbol = f"@{LIBM_PREFIX}{LIBM[name]}"
    taken = ", ".join(["double"] * len(args))
    body.module.declare(symbol, f"declare double {symbol}({taken}) nounwind willreturn memory(none)")
    doubles = [convert(body, source, LREAL, arg).ssa for source, arg in zip(types, args, strict=True)]
    given = ", ".join(f"double {each}" for each in doubles)
    return convert(body, LREAL, type, Value(body.text.op(f"call double {symbol}({given})")))


def _sqrt(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    return Value(intrinsic(body, "sqrt", value_type(type), args[0].ssa))


def _abs(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    if is_real(type):
        return Value(intrinsic(body, "fabs", value_type(type), args[0].ssa))
    low, high = args[0].range
    if not type.signed or low >= 0:
        return args[0]
    if low == bounds(type)[0]:
        return Value(intrinsic(body, "abs", value_type(type), args[0].ssa, flag="false"), *bounds(type))
    return Value(intrinsic(body, "abs", value_type(type), args[0].ssa, flag="false"), 0, max(-low, high))


def _trunc(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    return saturated(body, types[0], type, args[0].ssa)


def _extreme(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    a, b = args
    if is_real(type):
        order = "olt" if name == "MIN" else "ogt"
        first = body.text.op(f"fcmp {order} {value_type(type)} {a.ssa}, {b.ssa}")
        return Value(body.text.op(f"select i1 {first}, {value_type(type)} {a.ssa}, {value_type(type)} {b.ssa}"))
    op = ("s" if type.signed else "u") + name.lower()
    choose = min if name == "MIN" else max
    ssa = intrinsic(body, op, value_type(type), a.ssa, b.ssa)
    return Value(ssa, choose(a.low, b.low), choose(a.high, b.high))


def _select(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    guard, a, b = args
    llvm = value_type(type)
    ssa = body.text.op(f"select i1 {guard.ssa}, {llvm} {b.ssa}, {llvm} {a.ssa}")
    return Value(ssa, min(a.low, b.low), max(a.high, b.high), clean=a.clean and b.clean)


def _multiplex(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    chosen, llvm = args[1], value_type(type)
    for position, each in enumerate(args[2:], 1):
        holds = body.text.op(f"icmp sge {value_type(types[0])} {args[0].ssa}, {position}")
        ssa = body.text.op(f"select i1 {holds}, {llvm} {each.ssa}, {llvm} {chosen.ssa}")
        low, high = min(each.low, chosen.low), max(each.high, chosen.high)
        chosen = Value(ssa, low, high, clean=each.clean and chosen.clean)
    return chosen


def _swap(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    if type.bits <= 8:
        return args[0]
    return Value(intrinsic(body, "bswap", value_type(type), args[0].ssa), *bounds(type))


def _shift(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    text, llvm = body.text, value_type(type)
    count = convert(body, types[1], LINT, args[1]).ssa
    inside = text.op(f"icmp ult i64 {count}, {type.bits}")
    narrow = text.op(f"trunc i64 {count} to {llvm}") if type.bits < 64 else count
    moved = text.op(f"{'shl' if name == 'SHL' else 'lshr'} {llvm} {args[0].ssa}, {narrow}")
    return Value(text.op(f"select i1 {inside}, {llvm} {moved}, {llvm} 0"), *bounds(type))


def _rotate(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    llvm = value_type(type)
    count = convert(body, types[1], LINT, args[1]).ssa
    narrow = body.text.op(f"trunc i64 {count} to {llvm}") if type.bits < 64 else count
    op = "fshl" if name == "ROL" else "fshr"
    return Value(intrinsic(body, op, llvm, args[0].ssa, args[0].ssa, narrow), *bounds(type))


def _bitcast(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    # the bits of a NaN depend on how it came about, so they are those that it would be stored with
    bits = canonical(body, types[0], args[0]) if is_real(types[0]) else args[0].ssa
    ssa = body.text.op(f"bitcast {value_type(types[0])} {bits} to {value_type(type)}")
    return Value(ssa) if is_real(type) else Value(ssa, *bounds(type))


def _clock(body: Body, name: str, type: Elementary, types: list[Elementary], args: list[Value]) -> Value:
    pointer = body.text.address(body.image, Layout.CLOCK)
    return Value(body.text.op(f"load i64, ptr {pointer}, align 8{body.module.tag('#clock')}"), *bounds(TIME))


FUNCTIONS: dict[str, Callable[[Body, str, Elementary, list[Elementary], list[Value]], Value]] = {
    **dict.fromkeys(LIBM, _libm),
    "SQRT": _sqrt,
    "ABS": _abs,
    "TRUNC": _trunc,
    "MIN": _extreme,
    "MAX": _extreme,
    "SEL": _select,
    "MUX": _multiplex,
    "SWAP": _swap,
    "SHL": _shift,
    "SHR": _shift,
    "ROL": _rotate,
    "ROR": _rotate,
    "BITCAST": _bitcast,
    "CLOCK": _clock,
}
"""The type of the arguments of a shift's count is LINT; a BOOL guards SEL."""

__all__ = ["BOOL", "FUNCTIONS", "LIBM", "LIBM_PREFIX", "of_intrinsic"]
