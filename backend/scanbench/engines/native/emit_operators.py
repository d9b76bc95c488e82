"""Operators on scalars: arithmetic, logic, comparison, conversion."""

from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_places import widened
from scanbench.engines.native.emit_types import integer, is_real, value_type
from scanbench.engines.native.ranges import arithmetic, within
from scanbench.program.types import Elementary, Kind
from scanbench.program.untyped import bounds

REAL_OPS = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv"}
REAL_COMPARE = {"eq": "oeq", "ne": "une", "lt": "olt", "le": "ole", "gt": "ogt", "ge": "oge"}


def intrinsic(body: Body, name: str, type: str, *args: str, flag: str = "") -> str:
    """A call of an LLVM intrinsic whose operands and result have one type."""
    symbol = f"@llvm.{name}.{ {'float': 'f32', 'double': 'f64'}.get(type, type) }".replace(" ", "")
    end = ", i1" if flag else ""
    body.module.declare(symbol, f"declare {type} {symbol}({', '.join([type] * len(args))}{end})")
    given = ", ".join(f"{type} {arg}" for arg in args) + (f", i1 {flag}" if flag else "")
    return body.text.op(f"call {type} {symbol}({given})")


# ---- unary ----------------------------------------------------------------------------------------------------


def unary(body: Body, op: str, type: Elementary, value: Value) -> Value:
    """`neg` or `not`."""
    name = value_type(type)
    if op == "not":
        return Value(body.text.op(f"xor {name} {value.ssa}, {'true' if type.bits == 1 else '-1'}"), *bounds(type))
    if is_real(type):
        return Value(body.text.op(f"fneg {name} {value.ssa}"))
    return binary(body, "sub", type, Value("0", 0, 0), value, 0)


# ---- binary ---------------------------------------------------------------------------------------------------


def binary(body: Body, op: str, type: Elementary, left: Value, right: Value, trap: int) -> Value:
    """`left op right`, both of this type."""
    if is_real(type):
        return Value(body.text.op(f"{REAL_OPS[op]} {value_type(type)} {left.ssa}, {right.ssa}"))
    (low, high), exact = arithmetic(op, type, left.range, right.range)
    match op:
        case "add" | "sub" | "mul":
            flags = ("nsw " if type.signed else "nuw ") if exact else ""
            ssa = body.text.op(f"{op} {flags}{value_type(type)} {left.ssa}, {right.ssa}")
            wide = _wide(body, op, type, left, right) if exact else ""
            return Value(ssa, low, high, wide)
        case "div":
            return Value(_divide(body, type, left, right, trap), low, high)
        case "mod":
            return Value(_remainder(body, type, left, right), low, high)
    return Value(body.text.op(f"{op} {value_type(type)} {left.ssa}, {right.ssa}"), low, high)


def _wide(body: Body, op: str, type: Elementary, left: Value, right: Value) -> str:
    """The result as an i64 too, where an operand came from a loop counter: so addresses are computed in 64 bits."""
    if type.bits >= 64 or not (left.wide or right.wide):
        return ""
    if not all(each.wide or each.low == each.high for each in (left, right)):
        return ""
    a, b = widened(body, left, type), widened(body, right, type)
    return body.text.op(f"{op} nsw i64 {a}, {b}")


def _divide(body: Body, type: Elementary, left: Value, right: Value, trap: int) -> str:
    text, name = body.text, value_type(type)
    if right.low <= 0 <= right.high:
        text.trap_if(text.op(f"icmp eq {name} {right.ssa}, 0"), trap)
    if not type.signed or (left.low >= 0 and right.low >= 0):
        return text.op(f"udiv {name} {left.ssa}, {right.ssa}")
    if left.low > bounds(type)[0] or not right.low <= -1 <= right.high:
        return text.op(f"sdiv {name} {left.ssa}, {right.ssa}")
    # the smallest number / -1 would be an exception of the processor
    minus = text.op(f"icmp eq {name} {right.ssa}, -1")
    safe = text.op(f"select i1 {minus}, {name} 1, {name} {right.ssa}")
    quotient = text.op(f"sdiv {name} {left.ssa}, {safe}")
    negated = text.op(f"sub {name} 0, {left.ssa}")
    return text.op(f"select i1 {minus}, {name} {negated}, {name} {quotient}")


def _remainder(body: Body, type: Elementary, left: Value, right: Value) -> str:
    text, name = body.text, value_type(type)
    divisor = right.ssa
    odd = [each for each in ((0, -1) if type.signed else (0,)) if right.low <= each <= right.high]
    for each in odd:
        # a MOD 0 and a MOD -1 are 0, as is a MOD 1
        is_odd = text.op(f"icmp eq {name} {right.ssa}, {each}")
        divisor = text.op(f"select i1 {is_odd}, {name} 1, {name} {divisor}")
    plain = not type.signed or (left.low >= 0 and right.low >= 0)
    return text.op(f"{'urem' if plain else 'srem'} {name} {left.ssa}, {divisor}")


# ---- comparison -----------------------------------------------------------------------------------------------


def compare(body: Body, op: str, type: Elementary, left: Value, right: Value) -> Value:
    """`left op right` as a BOOL."""
    if is_real(type):
        ssa = body.text.op(f"fcmp {REAL_COMPARE[op]} {value_type(type)} {left.ssa}, {right.ssa}")
        return Value(ssa, 0, 1)
    sign = "" if op in ("eq", "ne") else ("s" if type.signed else "u")
    return Value(body.text.op(f"icmp {sign}{op} {value_type(type)} {left.ssa}, {right.ssa}"), 0, 1)


# ---- conversion -----------------------------------------------------------------------------------------------


def convert(body: Body, source: Elementary, target: Elementary, value: Value) -> Value:
    """The value, converted to the elementary type `target`."""
    if (source.kind, source.size) == (target.kind, target.size):
        return value
    if is_real(source):
        return _from_real(body, source, target, value)
    name = value_type(source)
    if is_real(target):
        how = "sitofp" if source.signed else "uitofp"
        return Value(body.text.op(f"{how} {name} {value.ssa} to {value_type(target)}"), clean=True)
    if target.kind is Kind.BOOL:
        return Value(body.text.op(f"icmp ne {name} {value.ssa}, {integer(0, source)}"), 0, 1)
    return _resized(body, source, target, value)


def _resized(body: Body, source: Elementary, target: Elementary, value: Value) -> Value:
    fits = within(value.range, bounds(target))
    low, high = value.range if fits else bounds(target)
    ssa = value.ssa
    if source.bits < target.bits:
        how = "sext" if source.signed and value.low < 0 else "zext"
        ssa = body.text.op(f"{how} {value_type(source)} {ssa} to {value_type(target)}")
    elif source.bits > target.bits:
        ssa = body.text.op(f"trunc {value_type(source)} {ssa} to {value_type(target)}")
    return Value(ssa, low, high, value.wide if fits and source.bits < 64 else "")


def _from_real(body: Body, source: Elementary, target: Elementary, value: Value) -> Value:
    text, name = body.text, value_type(source)
    if is_real(target):
        how = "fpext" if source.size < target.size else "fptrunc"
        return Value(text.op(f"{how} {name} {value.ssa} to {value_type(target)}"))
    if target.kind is Kind.BOOL:
        return Value(text.op(f"fcmp une {name} {value.ssa}, 0.0"), 0, 1)
    even = intrinsic(body, "roundeven", name, value.ssa)
    return saturated(body, source, target, even)


def saturated(body: Body, source: Elementary, target: Elementary, ssa: str) -> Value:
    """Towards zero, saturated at the target's bounds, NaN is 0."""
    name, result = value_type(source), value_type(target)
    how = "fptosi" if target.signed else "fptoui"
    symbol = f"@llvm.{how}.sat.{result}.{'f32' if name == 'float' else 'f64'}"
    body.module.declare(symbol, f"declare {result} {symbol}({name})")
    return Value(body.text.op(f"call {result} {symbol}({name} {ssa})"), *bounds(target))
