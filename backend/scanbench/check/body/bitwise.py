"""AND, OR, XOR and NOT of integers, bit by bit, in the dialects that have them.

In Logix an integer of less than 32 bits becomes a DINT for that, with zeros before its bits, where all other instructions repeat its sign;
so does the smaller of two integers (1756-RM006, Data conversions: "Logical instructions use zero fill").
"""

from scanbench.check.body import fold
from scanbench.check.body.allowed import allowed, may, used
from scanbench.check.body.context import Body
from scanbench.check.body.lenient import BITS, INTEGRAL, NUMBERS, bits_of
from scanbench.check.body.wide import WHOLE
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Const, Expr
from scanbench.program.shown import OPERATORS
from scanbench.program.types import DINT, ELEMENTARY, LINT, Elementary, Kind, Type, base_of
from scanbench.program.untyped import ANY_INT, ANY_REAL, bounds, common, is_untyped, wrap

LOGIC = ("and", "or", "xor")
SIGNED = {1: "SINT", 2: "INT", 4: "DINT", 8: "LINT"}


def logical(body: Body, op: str, left: Expr, right: Expr, span: Span) -> Expr | None:
    """AND, OR, XOR of integers, bit by bit, where the dialect has that; None where it is a matter of the strict language."""
    a, b = left.type, right.type
    if not isinstance(a, Elementary) or not isinstance(b, Elementary):
        return None
    typed = [each for each in (a, b) if each not in (ANY_INT, ANY_REAL)]
    if not any(each.kind in WHOLE for each in typed) or any(each.kind not in INTEGRAL for each in typed):
        return None
    if ANY_REAL in (a, b) or not may(body, Allowance.INTEGER_BITS):
        return None
    zeros = _fills(body) and Kind.BITS not in (each.kind for each in typed)
    result = (_filled if zeros else _joined)(body, op, (left, right), typed, span)
    if result is None:
        return None
    whole = next(each for each in typed if each.kind in WHOLE)
    name = bits_of(whole).name
    used(
        body, Allowance.INTEGER_BITS, span, f"`{OPERATORS[op]}` works on the bits of {whole}",
        f"`{whole}_TO_{name}(...)`, and back with `{name}_TO_{whole}(...)`",
    )  # fmt: skip
    bits = bits_of(result)
    if not zeros:
        made = fold.binary(op, bits, fold.convert(bits, left), fold.convert(bits, right))
        return fold.convert(result, made)
    made = fold.binary(op, bits, _with_zeros(bits, left), _with_zeros(bits, right))
    return _told(body, fold.convert(result, made), max(_held(body, left), _held(body, right)))


def inverted(body: Body, expr: Expr, span: Span) -> Expr | None:
    """NOT of an integer, bit by bit, where the dialect has that."""
    type = expr.type
    if not isinstance(type, Elementary) or type.kind not in WHOLE or is_untyped(expr):
        return None
    bits = bits_of(type)
    instead = f"`{bits}_TO_{type}(NOT {type}_TO_{bits}(...))`"
    if not allowed(body, Allowance.INTEGER_BITS, span, f"`NOT` works on the bits of {type}", instead):
        return None
    if not _fills(body):
        return fold.convert(type, fold.unary("not", bits, fold.convert(bits, expr)))
    result = type if type.size >= DINT.size else DINT
    made = fold.unary("not", bits_of(result), _with_zeros(bits_of(result), expr))
    return _told(body, fold.convert(result, made), _held(body, expr))


def literal_inverted(body: Body, expr: Expr, wanted: Type | None, span: Span) -> Const | None:
    """NOT of a number without a type: with 250 and -6 for `NOT 5`, only a type of as many bits tells what it is."""
    if (typed := literal_of(body, expr, wanted)) is not None:
        used(body, Allowance.INTEGER_SHIFTS, span, f"`NOT` works on the bits of {typed.type}")
        assert isinstance(typed.type, Elementary)
        assert isinstance(typed.value, int)
        return Const(typed.type, wrap(~typed.value, typed.type))
    if not isinstance(expr, Const) or expr.type != ANY_INT or not may(body, Allowance.INTEGER_BITS):
        return None
    number, made = int(expr.value), None
    size = smallest(number)
    if number < 0 or (_fills(body) and number <= bounds(DINT)[1]):  # a DINT, in Logix
        made = Const(ANY_INT, ~number)
    elif isinstance(wanted, Elementary) and wanted.kind in WHOLE and wanted.size == size:
        made = Const(base_of(wanted), wrap(~number, base_of(wanted)))
    if made is None:
        raise body.report.reject(
            "T002", f"NOT of the number {number}: {body.dialect.title} takes it as the smallest type that holds it; whether that has a "
            f"sign is not documented. Write its type, e.g. `INT#{number}`.", span,
        )  # fmt: skip
    instead = f"`WORD_TO_INT(NOT WORD#{number})`"
    used(body, Allowance.INTEGER_BITS, span, f"`NOT` works on the bits of the number {number}", instead)
    return made


def _fills(body: Body) -> bool:
    """Whether zeros are put before the bits of a smaller integer, and none has less than 32 bits."""
    return may(body, Allowance.DINT_RESULTS)


def _filled(body: Body, op: str, operands: tuple[Expr, Expr], typed: list[Elementary], span: Span) -> Elementary | None:
    """The type of the result in Logix: the larger of both, and at least DINT, which a number without a type is."""
    largest = max(typed, key=lambda each: each.size)
    if any(each.size == largest.size and each.kind is not largest.kind for each in typed):
        return None  # with and without a sign: nobody documents which it is
    number = next((int(each.value) for each in operands if isinstance(each, Const) and each.type == ANY_INT), 0)
    wide = largest.size > DINT.size or smallest(number) > DINT.size
    if number < 0 and wide:
        raise body.report.reject(
            "T002", f"`{OPERATORS[op]}` of {largest} and {number}: whether {body.dialect.title} puts zeros before the 32 bits of this "
            "number is not documented. Write a number of 64 bits, e.g. `16#FFFF_FFFF_FFFF_FF00`.", span,
        )  # fmt: skip
    if largest.size >= DINT.size:
        return LINT if wide and largest.size == DINT.size else largest
    return LINT if wide else DINT


def _with_zeros(bits: Elementary, expr: Expr) -> Expr:
    """An integer as bits, with zeros before its own; a number without a type has 32, or 64."""
    assert isinstance(expr.type, Elementary)
    if expr.type == ANY_INT:
        return fold.convert(bits, expr)
    return fold.convert(bits, fold.convert(bits_of(base_of(expr.type)), expr))


def _held(body: Body, expr: Expr) -> int:
    """The bytes that hold what was given: of an operation with zeros before, those of its operands."""
    if isinstance(expr, Const) and expr.type == ANY_INT:
        return smallest(int(expr.value))
    assert isinstance(expr.type, Elementary)
    return body.bitwise.get(id(expr), (expr, expr.type.size))[1]


def _told(body: Body, made: Expr, size: int) -> Expr:
    """A result that fits where its operands do: nothing more is told where it is stored there."""
    body.bitwise[id(made)] = made, size
    return made


def smallest(number: int) -> int:
    """The bytes of the smallest type that holds a number."""
    return next((size for size in BITS if -(1 << 8 * size - 1) <= number < 1 << 8 * size), 0)


def _joined(body: Body, op: str, operands: tuple[Expr, Expr], typed: list[Elementary], span: Span) -> Elementary | None:
    """The type of the result: of two integers what both widen to, with a bit string the larger bit string."""
    for each in operands:
        if each.type == ANY_INT and isinstance(each, Const):
            return _beside_number(body, op, typed[0], int(each.value), span)
    first, second = typed
    if Kind.BITS not in (first.kind, second.kind):
        signed, other = (first, second) if first.kind is Kind.INT else (second, first)
        clear = (
            first.kind is second.kind or signed.size > other.size
        )  # else the sign decides, in a way that nobody documents
        return common(first, second) if clear else None
    whole, bits = (first, second) if first.kind in WHOLE else (second, first)
    return bits if whole.size <= bits.size else bits_of(whole)


def _beside_number(body: Body, op: str, type: Elementary, number: int, span: Span) -> Elementary:
    """The type of the result of an integer and a number without a type, which has the smallest that holds it."""
    size = smallest(number)
    if size <= type.size:
        return type
    if number >= 0 and type.kind is Kind.UINT:
        return ELEMENTARY[NUMBERS[size]]
    raise body.report.reject(
        "T002", f"`{OPERATORS[op]}` of {type} and {number}: {body.dialect.title} takes the number as the smallest type that holds it; "
        f"whether that has a sign is not documented. Write its type, e.g. `{SIGNED[size]}#{number}`.", span,
    )  # fmt: skip


def literal_of(body: Body, expr: Expr, wanted: Type | None) -> Const | None:
    """A number without a type as one of the integer that is wanted, as TIA takes it; None of others, and in other dialects."""
    if not may(body, Allowance.INTEGER_SHIFTS) or may(body, Allowance.INTEGER_BITS) or not isinstance(expr, Const):
        return None
    if (
        expr.type != ANY_INT
        or not isinstance(wanted, Elementary)
        or wanted.kind not in WHOLE
        or not isinstance(expr.value, int)
    ):
        return None
    low, high = bounds(base_of(wanted))
    return Const(base_of(wanted), expr.value) if low <= expr.value <= high else None
