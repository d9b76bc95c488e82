"""Types that do not fit by the standard, and fit in some dialects: bit strings as numbers, integers as bits, lossy conversions.

Where the value depends on something that no documentation of the vendor tells, it is refused, as it is in the strict language.
"""

from scanbench.check.body import fold, wide
from scanbench.check.body.allowed import allowed, may, used
from scanbench.check.body.context import Body
from scanbench.check.body.short_times import cut_here
from scanbench.check.body.standard_fold import intrinsic
from scanbench.check.body.wide import WHOLE
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, Load, Sequence
from scanbench.program.shown import OPERATORS
from scanbench.program.types import (
    BOOL,
    DINT,
    ELEMENTARY,
    LINT,
    REAL,
    TIME,
    ULINT,
    Elementary,
    Enumeration,
    Kind,
    Reference,
    Subrange,
    Type,
    base_of,
)
from scanbench.program.untyped import ANY_INT, ANY_REAL, bounds, common, is_untyped

INTEGRAL = (*WHOLE, Kind.BITS)
CALCULATIONS = ("add", "sub", "mul", "div", "mod")
MILLISECONDS = (DINT, ELEMENTARY["UDINT"], ELEMENTARY["DWORD"])
"""Types that TIA has TIME as, of so many milliseconds."""
MILLISECOND_NS = 1_000_000
TIME_OF_DAY = ELEMENTARY["TIME_OF_DAY"]
NUMBERS = {1: "USINT", 2: "UINT", 4: "UDINT", 8: "ULINT"}
BITS = {1: "BYTE", 2: "WORD", 4: "DWORD", 8: "LWORD"}


def unsigned(type: Elementary) -> Elementary:
    """The unsigned integer of the same size."""
    return ELEMENTARY[NUMBERS[type.size]]


def bits_of(type: Elementary) -> Elementary:
    """The bit string of the same size."""
    return ELEMENTARY[BITS[type.size]]


def counted(body: Body, op: str, left: Expr, right: Expr, span: Span) -> tuple[Expr, Expr, Elementary | None]:
    """Bit strings among the operands as numbers, where the dialect has them so; and the bit string that the result is."""
    types = [each.type for each in (left, right) if isinstance(each.type, Elementary)]
    kinds, bits = [each.kind for each in types], [each for each in types if each.kind is Kind.BITS]
    if not bits or len(kinds) < 2 or not set(kinds) <= {*INTEGRAL, Kind.REAL}:
        return left, right, None
    literal = is_untyped(left) or is_untyped(right)
    if op not in CALCULATIONS and (kinds[0] is kinds[1] or (literal and not wide.is_wide(body, left, right))):
        return left, right, None  # compared bit by bit, which is the same
    first = bits[0]
    what = f"`{OPERATORS[op]}` takes {first} as the unsigned number {unsigned(first)}"
    if not may(body, Allowance.BIT_NUMBERS):
        return left, right, None
    if op not in wide.WIDENING:
        _same_sign(body, op, left, right, span)
    name = unsigned(first).name
    used(body, Allowance.BIT_NUMBERS, span, what, f"`{first}_TO_{name}(...)`, and back with `{name}_TO_{first}(...)`")
    fits = (len(bits) == 2 or literal) and ANY_REAL not in types
    largest = max(bits, key=lambda each: each.size)
    return _as_number(body, left), _as_number(body, right), largest if fits else None


def bit_sum(body: Body, op: str, left: Expr, right: Expr, span: Span, wanted: Type | None) -> Expr | None:
    """A sum of bit strings where one of no more bits is wanted, which is the same whatever sign they have; None of all else."""
    bits = [each.type for each in (left, right) if isinstance(each.type, Elementary) and each.type.kind is Kind.BITS]
    literal = left.type == ANY_INT or right.type == ANY_INT
    if op not in wide.WIDENING or len(bits) + literal != 2 or not may(body, Allowance.BIT_SUMS):
        return None
    largest = max(bits, key=lambda each: each.size)
    if not isinstance(wanted, Elementary) or wanted.kind not in INTEGRAL or wanted.size > largest.size:
        return None
    name = unsigned(largest).name
    instead = f"`{name}_TO_{largest}({largest}_TO_{name}(...) {OPERATORS[op]} ...)`"
    used(body, Allowance.BIT_SUMS, span, f"`{OPERATORS[op]}` joins bit strings", instead)
    whole = unsigned(largest)
    made = fold.binary(op, whole, fold.convert(whole, left), fold.convert(whole, right))
    return fold.convert(largest, made)


def _is_bits(expr: Expr) -> bool:
    return isinstance(expr.type, Elementary) and expr.type.kind is Kind.BITS


def _size(type: Type | None) -> int:
    return type.size if type is not None else 0


def _as_number(body: Body, expr: Expr) -> Expr:
    if isinstance(expr.type, Elementary) and expr.type.kind is Kind.BITS:
        return wide.converted(body, unsigned(expr.type), expr)
    return expr


def _same_sign(body: Body, op: str, left: Expr, right: Expr, span: Span) -> None:
    """Refuses a comparison or division of a bit string and a signed integer that does not hold all its values."""
    for bits, other in ((left, right), (right, left)):
        if not _is_bits(bits) or not isinstance(other.type, Elementary) or other.type.kind is not Kind.INT:
            continue
        if is_untyped(other) or other.type.size > _size(bits.type):
            continue
        if isinstance(other, Const) and isinstance(other.value, int) and other.value >= 0:
            continue
        raise body.report.reject(
            "T002",
            f"`{OPERATORS[op]}` of {bits.type} and {other.type}: what {body.dialect.title} computes with a negative number here is "
            f"not documented. Convert one of them by its name, e.g. {bits.type}_TO_{other.type}.",
            span,
        )


def as_calculated(body: Body, left: Expr, right: Expr) -> tuple[Expr, Expr]:
    """Operands of a calculation or comparison as the numbers that Logix calculates with: DINT for what is smaller, REAL beside a REAL."""
    if not may(body, Allowance.DINT_RESULTS):
        return left, right
    real = any(each.type in (REAL, ANY_REAL) for each in (left, right))
    return _calculated(left, real), _calculated(right, real)


def _calculated(expr: Expr, real: bool) -> Expr:
    type = expr.type
    if is_untyped(expr) or not isinstance(type, Elementary) or type.kind not in WHOLE:
        return expr
    if real:
        return fold.convert(REAL, expr)
    return fold.convert(DINT, expr) if type.size < DINT.size else expr


def negative(body: Body, type: Elementary, operand: Expr) -> Expr:
    """`-x`, in as many bits as the dialect has for sums."""
    operand, _ = as_calculated(body, operand, operand)
    type = operand.type if isinstance(operand.type, Elementary) else type
    if type.kind in WHOLE and type.size and may(body, Allowance.WIDE_RESULTS):
        return wide.cut(body, type, fold.unary("neg", wide.wide_of(type), wide.sixty_four(body, type, operand)))
    return cut_here(body, fold.unary("neg", type, operand))


def enumerated(body: Body, expr: Const, type: Enumeration, span: Span, what: str) -> Const | None:
    """A literal number as a value of an enumeration, where the dialect has that."""
    low, high = bounds(base_of(type))
    if not isinstance(expr.value, int) or not low <= expr.value <= high or expr.type == ANY_REAL:
        return None
    named = next((f"`{type}#{name}`" for name, number in type.values if number == expr.value), "")
    if not allowed(body, Allowance.ENUM_NUMBERS, span, f"{what} is {type}, and this is the number {expr.value}", named):
        return None
    return Const(type, expr.value)


def shifted(body: Body, name: str, expr: Expr, span: Span) -> tuple[Expr, Elementary, Elementary] | None:
    """An integer as the bits that a shift moves, their type, and the type of the result, where the dialect has that."""
    type = expr.type
    if not isinstance(type, Elementary) or type.kind not in WHOLE or is_untyped(expr):
        return None
    if not may(body, Allowance.INTEGER_BITS):
        return None
    bits = bits_of(type)
    if name == "SHR" and type.kind is Kind.INT:
        raise body.report.reject(
            "T002",
            f"SHR of {type}: whether {body.dialect.title} fills with zeros or with the sign is not documented. Convert the value: "
            f"{type}_TO_{bits} for zeros, or divide it by a power of two.",
            span,
        )
    instead = f"`{bits}_TO_{type}({name}({type}_TO_{bits}(...), ...))`"
    used(body, Allowance.INTEGER_BITS, span, f"`{name}` works on the bits of {type}", instead)
    return fold.convert(bits, expr), bits, type


def shifted_with_sign(body: Body, name: str, expr: Expr, count: Expr, span: Span) -> Expr | None:
    """A shift of an integer, where the dialect has that: SHR of a negative number fills with ones."""
    type = expr.type
    if not isinstance(type, Elementary) or type.kind not in WHOLE or is_untyped(expr):
        return None
    if not may(body, Allowance.INTEGER_SHIFTS):
        return None
    if may(body, Allowance.INTEGER_BITS) and (name != "SHR" or type.kind is not Kind.INT):
        return None
    bits = bits_of(type)
    used(body, Allowance.INTEGER_SHIFTS, span, f"`{name}` works on the bits of {type}")
    if name != "SHR" or type.kind is not Kind.INT:
        return fold.convert(type, intrinsic(name, bits, (fold.convert(bits, expr), count)))
    kept = body.temporary(type, span)
    plain = fold.convert(bits, Load(kept))
    ones = fold.unary("not", bits, intrinsic(name, bits, (fold.unary("not", bits, plain), count)))
    negative = fold.compare("lt", BOOL, Load(kept), Const(type, 0))
    chosen = intrinsic("SEL", bits, (negative, intrinsic(name, bits, (plain, count)), ones))
    return Sequence((Assign(kept, expr, span),), fold.convert(type, chosen))


def literal_shifted(body: Body, name: str, expr: Expr, count: Expr, span: Span) -> Const | None:
    """A shift of a number without a type, where the dialect has that: such a number has the smallest type that holds it
    (TwinCAT and CODESYS, typed literals; Machine Expert, SHL), so what depends on how many bits that has is refused."""
    if not isinstance(expr, Const) or expr.type != ANY_INT or not may(body, Allowance.INTEGER_BITS):
        return None
    number, sizes = int(expr.value), [size for size in BITS if int(expr.value) < 1 << 8 * size]
    if number < 0 or not sizes:
        return None
    types = [ELEMENTARY[BITS[size]] for size in sizes]
    found = [intrinsic(name, type, (Const(type, number), count)) for type in types]
    values = {each.value if isinstance(each, Const) else None for each in found}
    if len(values) > 1 or None in values:
        raise body.report.reject(
            "T002", f"`{name}` of the number {number}: {body.dialect.title} takes it as {types[0]}, the smallest type that holds it, "
            f"so bits may be lost that are wanted here. Write its type, e.g. `DWORD#{number}`.", span,
        )  # fmt: skip
    what = f"`{name}` works on the bits of the number {number}"
    used(body, Allowance.INTEGER_BITS, span, what, f"`{types[0]}_TO_INT({name}({types[0]}#{number}, ...))`")
    return Const(ANY_INT, next(value for value in values if value is not None))


def index(body: Body, expr: Expr, span: Span, what: str) -> Expr | None:
    """A bit string as an index or a count, where the dialect has that."""
    type = expr.type
    if not isinstance(type, Elementary) or type.kind is not Kind.BITS:
        return None
    if not allowed(body, Allowance.BIT_NUMBERS, span, f"{what} is {type}", f"`{type}_TO_{unsigned(type)}(...)`"):
        return None
    return fold.convert(unsigned(type), expr)


def joined(body: Body, one: Type | None, other: Type | None) -> Elementary | None:
    """The type that a bit string and a number as arguments of one function have in common, where the dialect converts them."""
    if not isinstance(one, Elementary) or not isinstance(other, Elementary) or not may(body, Allowance.BIT_NUMBERS):
        return None
    kinds = {one.kind, other.kind}
    if Kind.BITS not in kinds or len(kinds) < 2 or not kinds <= {*INTEGRAL, Kind.REAL}:
        return None
    bits = one if one.kind is Kind.BITS else other
    signed = next((each for each in (one, other) if each.kind is Kind.INT), None)
    if signed is not None and signed.size <= bits.size:  # a negative one: not documented
        return None
    first, second = (unsigned(each) if each.kind is Kind.BITS else each for each in (one, other))
    return common(first, second)


def coerced(body: Body, expr: Expr, type: Type, span: Span, what: str) -> Expr | None:
    """The value as one of `type`, where only the dialect converts it; None where that does not either."""
    source = expr.type
    address = _address(body, expr, type, span, what)
    if address is not None:
        return address
    if not isinstance(type, Elementary) or not isinstance(source, Elementary) or isinstance(type, Subrange):
        return None
    if isinstance(type, Enumeration):
        return _enumerated(body, expr, source, type, span, what)
    allowance = _allowance(base_of(source), type)
    if allowance is None or is_untyped(expr):
        return None
    if allowance is Allowance.NARROWING and id(expr) in body.bitwise and body.bitwise[id(expr)][1] <= type.size:
        return fold.convert(type, expr)  # as many bits as its operands have
    name = base_of(source).name
    instead = f"`{name}_TO_{type}(...)`"
    if allowance is Allowance.BITS_AS_REALS:
        number = unsigned(base_of(source))
        instead = f"`{number}_TO_{type}({name}_TO_{number}(...))`"
    if not allowed(body, allowance, span, f"{what} is {type}, and this is {source}", instead):
        return None
    if type.kind is Kind.REAL and base_of(source).kind is Kind.BITS:
        return fold.convert(type, _as_number(body, expr))
    if allowance is Allowance.TIME_NUMBERS:
        return milliseconds(type, expr)
    if allowance is Allowance.ROUNDING and type.size < LINT.size and may(body, Allowance.WRAPPED_REALS):
        return fold.convert(type, fold.convert(LINT, expr))
    return wide.converted(body, type, fold.convert(base_of(source), expr) if source is not base_of(source) else expr)


def _address(body: Body, expr: Expr, type: Type, span: Span, what: str) -> Expr | None:
    """A pointer as a number of its size, or such a number as a pointer, where the dialect has that."""
    source = expr.type
    pointers = [each for each in (source, type) if isinstance(each, Reference) and each.pointer]
    numbers = [
        each
        for each in (source, type)
        if isinstance(each, Elementary) and each.kind in INTEGRAL and each.size >= DINT.size
    ]
    if len(pointers) != 1 or len(numbers) != 1 or is_untyped(expr):
        return None
    if not allowed(body, Allowance.POINTER_NUMBERS, span, f"{what} is {type}, and this is {source}", f"{pointers[0]}"):
        return None
    assert isinstance(type, Elementary)  # as references are, too
    return fold.convert(type, fold.convert(ULINT, expr))


def address_number(body: Body, expr: Expr, span: Span) -> Expr | None:
    """A pointer, or a number that is compared with one, as a number; None of what is neither, or where the dialect has no such."""
    type = expr.type
    pointer = isinstance(type, Reference) and type.pointer
    number = isinstance(type, Elementary) and type.kind in INTEGRAL and type.size >= DINT.size and not is_untyped(expr)
    if not (pointer or number) or not may(body, Allowance.POINTER_NUMBERS):
        return None
    if number:
        used(body, Allowance.POINTER_NUMBERS, span, f"A pointer is compared with {type}")
    return fold.convert(ULINT, expr)


def _allowance(source: Elementary, target: Elementary) -> Allowance | None:
    """What allows a conversion without a name that the standard does not have."""
    if source.kind in INTEGRAL and target.kind in INTEGRAL:
        if target.size < source.size:
            return Allowance.NARROWING
        if source.kind is Kind.INT and target.kind is Kind.BITS and target.size > source.size:
            return Allowance.SIGNED_BITS
        return Allowance.NARROWING if Kind.BITS not in (source.kind, target.kind) else Allowance.BIT_CONVERSION
    if target.kind is Kind.REAL and source.kind in INTEGRAL:
        return Allowance.BITS_AS_REALS if source.kind is Kind.BITS else Allowance.REAL_CONVERSION
    if source.kind is Kind.REAL and target.kind in WHOLE:
        return Allowance.ROUNDING
    if Kind.CHAR in (source.kind, target.kind):
        other = target if source.kind is Kind.CHAR else source
        return Allowance.CHAR_NUMBERS if other.kind in INTEGRAL else None
    if (target == TIME and source in MILLISECONDS) or (source in (TIME, TIME_OF_DAY) and target in MILLISECONDS):
        return Allowance.TIME_NUMBERS
    return Allowance.REAL_CONVERSION if source.kind is Kind.REAL and target == REAL else None


def as_duration(body: Body, left: Expr, right: Expr, span: Span) -> Expr:
    """A number that is added to a TIME or TIME_OF_DAY as milliseconds, where the dialect has that."""
    number = fold.convert(DINT, right) if right.type == ANY_INT else right
    if left.type not in (TIME, TIME_OF_DAY) or not isinstance(number.type, Elementary):
        return right
    if number.type.kind is not Kind.INT or number.type.size > DINT.size:
        return right
    what = f"{left.type} is joined with the number of milliseconds that {number.type} is"
    return milliseconds(TIME, number) if allowed(body, Allowance.TIME_NUMBERS, span, what) else right


def milliseconds(type: Elementary, expr: Expr) -> Expr:
    """A number as a TIME of so many milliseconds, with the sign that 32 bits have; or a TIME or TIME_OF_DAY as such a number."""
    unit = Const(LINT, MILLISECOND_NS)
    if type == TIME:
        return fold.convert(TIME, fold.binary("mul", LINT, fold.convert(LINT, fold.convert(DINT, expr)), unit))
    return fold.convert(type, fold.binary("div", LINT, fold.convert(LINT, expr), unit))


def _enumerated(body: Body, expr: Expr, source: Elementary, type: Enumeration, span: Span, what: str) -> Expr | None:
    if isinstance(source, Enumeration) or source.kind not in WHOLE:
        return None
    instead = f"`{type}#{type.values[0][0]}`" if type.values else ""
    if not allowed(body, Allowance.ENUM_NUMBERS, span, f"{what} is {type}, and this is a number", instead):
        return None
    return fold.convert(type, expr)
