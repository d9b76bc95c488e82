"""Operators -> typed operations: both operands brought to one type, every conversion written out."""

from functools import partial

from scanbench.check.body import fold, wide
from scanbench.check.body.allowed import may, used
from scanbench.check.body.bitwise import LOGIC, logical, smallest
from scanbench.check.body.coercion import coerce
from scanbench.check.body.context import Body
from scanbench.check.body.conversions import nearest
from scanbench.check.body.joining_hint import joining_hint
from scanbench.check.body.lenient import BITS, as_calculated, as_duration, bit_sum, counted, index
from scanbench.check.body.literals import as_text, in_64_bits, literal_as
from scanbench.check.body.places import plain_reference
from scanbench.check.body.references import compare_references, pointer_arithmetic
from scanbench.check.body.remainder import remainder
from scanbench.check.body.short_times import counts, cut_here, is_short, joined, of_counts
from scanbench.check.body.subrange_checks import plain
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.numbers import round_real
from scanbench.program.program import Assign, Binary, Compare, Const, Convert, Expr, If, Intrinsic, Load, Sequence
from scanbench.program.shown import OPERATORS
from scanbench.program.sites import TrapKind
from scanbench.program.types import (
    BOOL,
    ELEMENTARY,
    LINT,
    LREAL,
    LTIME,
    TIME,
    Elementary,
    Enumeration,
    Kind,
    Reference,
    StringType,
    Type,
    base_of,
)
from scanbench.program.untyped import ANY_INT, ANY_REAL, bounds, common, is_untyped, real_beside, settle

COMPARISONS = ("eq", "ne", "lt", "le", "gt", "ge")
NUMERIC = (Kind.INT, Kind.UINT, Kind.REAL)
MOMENTS = (Kind.TIME, Kind.DATE)
DAY_NS = 86_400_000_000_000


def operate(body: Body, op: str, left: Expr, right: Expr, span: Span, wanted: Type | None = None) -> Expr:
    """`left op right`, both brought to one type."""
    left, right = plain(body, left, span), plain(body, right, span)
    if op in ("and_then", "or_else"):
        return _short_circuit(body, op, left, right, span)
    if op in COMPARISONS:
        right = as_duration(body, left, right, span) if right.type == ANY_INT else right
        return _compare(body, op, left, right, span)
    if isinstance(left.type, Reference) or isinstance(right.type, Reference):
        return pointer_arithmetic(body, op, left, right, span)
    if _is_moment(left) or _is_moment(right):
        return _time(body, op, left, right, span)
    if op == "pow":
        return _power(body, left, right, span, wanted)
    left, right = _number(left), _number(right)
    if op in LOGIC and (made := logical(body, op, left, right, span)) is not None:
        return made
    if (sum := bit_sum(body, op, left, right, span, wanted)) is not None:
        return sum
    left, right, bits = counted(body, op, left, right, span)
    if op not in LOGIC:
        left, right = as_calculated(body, left, right)
    left, right, type = _same(body, op, left, right, span, wanted)
    if op == "mod" and type.kind is Kind.REAL and may(body, Allowance.REAL_MOD):
        return remainder(body, type, left, right, span)
    if op in LOGIC:
        fits = type.kind in (Kind.BOOL, Kind.BITS) or type == ANY_INT
        need = "BOOL or bit strings"
    else:
        fits = type.kind in NUMERIC and not (op == "mod" and type.kind is Kind.REAL)
        need = "integers" if op == "mod" else "numbers"
    if not fits:
        raise body.report.reject("T002", f"`{OPERATORS[op]}` needs {need}, not {type}.{_unsigned(type)}", span)
    result = _arithmetic(body, op, type, left, right, span)
    if bits is None or type.kind is Kind.REAL or type.size > bits.size:
        return result
    return wide.converted(body, bits, result)


def _compare(body: Body, op: str, left: Expr, right: Expr, span: Span) -> Expr:
    left, right = _characters(body, left, right, span), _characters(body, right, left, span)
    left, right = plain_reference(body, left, span), plain_reference(body, right, span)
    a, b = left.type, right.type
    if isinstance(a, StringType) and isinstance(b, StringType):
        if a.width != b.width:
            raise body.report.reject(
                "T002",
                f"`{OPERATORS[op]}` cannot join STRING and WSTRING; convert one with STRING_TO_WSTRING.",
                span,
            )
        return fold.compare(op, BOOL, left, right)
    if isinstance(a, Reference) or isinstance(b, Reference):
        return compare_references(body, op, left, right, span)
    if isinstance(a, Enumeration) and isinstance(b, Enumeration) and a != b:
        raise body.report.reject(
            "T002", f"`{OPERATORS[op]}` cannot join {a} and {b}: they are different enumerations.", span
        )
    left, right, _ = counted(body, op, _number(left), _number(right), span)
    left, right = as_calculated(body, left, right)
    left, right, type = _same(body, op, left, right, span)
    if wide.is_wide(body, left, right):
        left, right = wide.sixty_four(body, type, left), wide.sixty_four(body, type, right)
    return fold.compare(op, BOOL, left, right)


def _characters(body: Body, one: Expr, other: Expr, span: Span) -> Expr:
    """A string and a character as operands: a literal of one character becomes a character, else the character becomes a string."""
    if other.type is None:
        return one
    constant = isinstance(one, Const)
    if isinstance(other.type, StringType) and not constant and isinstance(other, Const) and _is_character(one):
        return one  # the literal becomes a character instead
    return as_text(body, one, other.type, span) or one


def _arithmetic(body: Body, op: str, type: Elementary, left: Expr, right: Expr, span: Span) -> Expr:
    trap = 0
    if op == "div" and type.kind is not Kind.REAL:
        if isinstance(right, Const) and right.value == 0:
            raise body.report.reject("S004", "This divides by the constant zero.", span)
        if not isinstance(right, Const):
            trap = body.trap(TrapKind.DIVISION, span, "division by zero")
    if type.kind in wide.WHOLE and type.size and may(body, Allowance.WIDE_RESULTS):
        if op in wide.WIDENING or wide.is_wide(body, left, right):
            operands = wide.sixty_four(body, type, left), wide.sixty_four(body, type, right)
            return wide.cut(body, type, fold.binary(op, wide.wide_of(type), *operands, trap))
    made = fold.binary(op, type, left, right, trap)
    return in_64_bits(body, made, span) if isinstance(made, Const) and type == ANY_INT else made


def _same(
    body: Body, op: str, left: Expr, right: Expr, span: Span, wanted: Type | None = None
) -> tuple[Expr, Expr, Elementary]:
    """Both operands in their common type."""
    a, b = left.type, right.type
    if not isinstance(a, Elementary) or not isinstance(b, Elementary):
        both = f"{settle(left).type} and {settle(right).type}"
        texts = op == "add" and (isinstance(a, StringType) or isinstance(b, StringType))
        hint = " Texts are joined with CONCAT(a, b); convert what is no text, as TO_STRING(a)." if texts else ""
        raise body.report.reject("T002", f"`{OPERATORS[op]}` cannot join {both}.{hint}", span)
    if is_untyped(left) and is_untyped(right):
        type = ANY_REAL if ANY_REAL in (a, b) else ANY_INT
        return Const(type, _plain(left)), Const(type, _plain(right)), type
    if is_untyped(left):
        left, a = _beside(body, left, b, span, wanted), b
    elif is_untyped(right):
        right, b = _beside(body, right, a, span, wanted), a
    assert isinstance(left.type, Elementary)
    assert isinstance(right.type, Elementary)
    type_or_none = common(left.type, right.type)
    if type_or_none is None:
        hint = joining_hint(op, left.type, right.type)
        raise body.report.reject("T002", f"`{OPERATORS[op]}` cannot join {left.type} and {right.type}.{hint}", span)
    return wide.converted(body, type_or_none, left), wide.converted(body, type_or_none, right), type_or_none


def _beside(body: Body, literal: Expr, type: Elementary, span: Span, wanted: Type | None) -> Expr:
    """An untyped literal whose other operand has `type`: it gets that type, or a larger one if it does not fit."""
    assert isinstance(literal, Const)
    if literal.type == ANY_INT and type.kind in (Kind.INT, Kind.UINT):
        low, high = bounds(type)
        if not low <= int(literal.value) <= high:
            return settle(literal)
    if literal.type == ANY_INT and type.kind is Kind.BITS and int(literal.value) > bounds(type)[1]:
        if may(body, Allowance.LITERAL_SIZES):
            bits = ELEMENTARY[BITS[smallest(int(literal.value))]]
            what = f"{literal.value!r} does not fit {type}, and is {bits}"
            used(body, Allowance.LITERAL_SIZES, span, what, f"`{bits}#{literal.value!r}`")
            return Const(bits, literal.value)
    if literal.type == ANY_REAL and type.kind in (Kind.INT, Kind.UINT):
        return literal_as(body, literal, real_beside([type], wanted), span, "The other operand")
    return literal_as(body, literal, type, span, "The other operand")


def _time(body: Body, op: str, left: Expr, right: Expr, span: Span) -> Expr:
    if op in ("add", "sub"):
        right = as_duration(body, left, right, span)
    a, b = left.type, right.type
    if isinstance(a, Elementary) and isinstance(b, Elementary):
        if a.kind in MOMENTS and b.kind in MOMENTS and op in ("add", "sub"):
            made = _moments(body, op, left, right, a, b)
            if made is not None:
                return made
        if a.kind is Kind.TIME and op in ("mul", "div"):
            return _scaled(body, op, left, a, right, span)
        if b.kind is Kind.TIME and op == "mul":
            return _scaled(body, op, right, b, left, span)
    raise _no_time(body, op, left, right, span)


def _no_time(body: Body, op: str, left: Expr, right: Expr, span: Span) -> Exception:
    both = f"{settle(left).type} and {settle(right).type}"
    return body.report.reject(
        "T002", f"`{OPERATORS[op]}` cannot join {both}; a TIME can be added to a TIME, DT or TOD, or scaled by a "
        "number, and the difference of two dates is a TIME.", span,
    )  # fmt: skip


def _moments(body: Body, op: str, left: Expr, right: Expr, a: Elementary, b: Elementary) -> Expr | None:
    """Sums and differences of durations and dates."""
    long = LTIME if a.name.startswith("L") or b.name.startswith("L") else TIME
    if a.kind is Kind.TIME and b.kind is Kind.TIME:
        return cut_here(body, fold.binary(op, long, fold.convert(long, left), fold.convert(long, right)))
    if a.kind is Kind.DATE and b.kind is Kind.DATE:
        if op != "sub" or a.name.removeprefix("L") != b.name.removeprefix("L"):
            return None
        return cut_here(body, fold.binary("sub", long, fold.convert(long, left), fold.convert(long, right)))
    if a.kind is Kind.TIME:
        if op != "add":
            return None
        left, right, a = right, left, b
    if a.name.removeprefix("L") == "DATE":
        return None
    short = is_short(body, a)
    made = joined(op, left, right) if short else fold.binary(op, a, left, fold.convert(a, right))
    if a.name.removeprefix("L") == "TIME_OF_DAY":
        # the clock begins again at midnight
        day = Const(a, DAY_NS)
        made = fold.binary("mod", a, fold.binary("add", a, fold.binary("mod", a, made, day), day), day)
    return made


def _scaled(body: Body, op: str, time: Expr, type: Elementary, factor: Expr, span: Span) -> Expr:
    factor = settle(factor)
    factor = index(body, factor, span, "The number that scales a TIME") or factor
    short = is_short(body, type)
    if isinstance(factor.type, Elementary) and factor.type.kind in (Kind.INT, Kind.UINT):
        if short:
            return of_counts(type, _arithmetic(body, op, LINT, counts(time), fold.convert(LINT, factor), span))
        return _arithmetic(body, op, type, time, fold.convert(type, factor), span)
    if isinstance(factor.type, Elementary) and factor.type.kind is Kind.REAL:
        start = counts(time) if short else time
        scaled = fold.binary(op, LREAL, fold.convert(LREAL, start), fold.convert(LREAL, factor))
        return of_counts(type, nearest(scaled, partial(_library, body))) if short else fold.convert(type, scaled)
    raise _no_time(body, op, time, factor, span)


def _library(body: Body, name: str, *args: Expr) -> Expr | None:
    return body.effects.library(body, name, args)


def _power(body: Body, left: Expr, right: Expr, span: Span, wanted: Type | None) -> Expr:
    if is_untyped(left) and isinstance(wanted, Elementary) and wanted.kind is Kind.REAL:
        left = Const(wanted, round_real(float(_plain(left)), wanted))
    left, right = settle(left), settle(right)
    right = index(body, right, span, "The exponent") or right
    types = (left.type, right.type)
    if not all(isinstance(type, Elementary) and type.kind in NUMERIC for type in types):
        raise body.report.reject("T002", f"`**` needs numbers, not {types[0]} and {types[1]}.", span)
    type = ELEMENTARY["REAL"] if left.type == ELEMENTARY["REAL"] else LREAL
    return Intrinsic("EXPT", type, (fold.convert(type, left), fold.convert(type, right)))


def _short_circuit(body: Body, op: str, left: Expr, right: Expr, span: Span) -> Expr:
    """The right side is only evaluated where it decides."""
    left = coerce(body, left, BOOL, span, "Each operand")
    right = coerce(body, right, BOOL, span, "Each operand")
    operator = "and" if op == "and_then" else "or"
    if isinstance(left, Const) or _is_harmless(right):
        if isinstance(left, Const) and bool(left.value) == (op == "or_else"):
            return left
        return Binary(operator, BOOL, left, right, short=True) if not isinstance(left, Const) else right
    held = body.temporary(BOOL, span)
    goes_on: Expr = Load(held) if op == "and_then" else fold.unary("not", BOOL, Load(held))
    decide = If(((goes_on, (Assign(held, right, span),)),), (), span)
    return Sequence((Assign(held, left, span), decide), Load(held))


def _is_harmless(expr: Expr) -> bool:
    """Whether evaluating it can neither trap nor change anything, and costs next to nothing."""
    match expr:
        case Const():
            return True
        case Load(place):
            return not place.indices and place.slot is None and place.reference is None
        case Convert(operand=operand):
            return _is_harmless(operand)
        case Compare(left=left, right=right):
            return _is_harmless(left) and _is_harmless(right)
        case Binary(op, left=left, right=right):
            return op in ("and", "or", "xor") and _is_harmless(left) and _is_harmless(right)
    return False


def _is_moment(expr: Expr) -> bool:
    return isinstance(expr.type, Elementary) and expr.type.kind in MOMENTS


def _is_character(expr: Expr) -> bool:
    return isinstance(expr.type, Elementary) and expr.type.kind is Kind.CHAR


def _number(expr: Expr) -> Expr:
    """An enumeration as the number it is."""
    if isinstance(expr.type, Enumeration):
        return fold.convert(base_of(expr.type), expr)
    return expr


def _plain(expr: Expr) -> int | float:
    assert isinstance(expr, Const)
    assert not isinstance(expr.value, bytes)
    return expr.value


def _unsigned(type: Elementary) -> str:
    names = {1: "USINT", 2: "UINT", 4: "UDINT", 8: "ULINT"}
    return f" Convert it with {type}_TO_{names[type.size]}." if type.kind is Kind.BITS else ""
