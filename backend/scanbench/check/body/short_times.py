"""Values of TIME, TIME_OF_DAY, DATE and DATE_AND_TIME that have 32 bits without a sign, as CODESYS and TwinCAT compute them.

They stay nanoseconds in 64 bits; each operation that makes one brings its result to the value that 32 bits would have.
"""

from scanbench.check.body import fold
from scanbench.check.body.allowed import may
from scanbench.check.body.context import Body
from scanbench.check.body.standard_fold import intrinsic
from scanbench.check.dialect import Allowance
from scanbench.check.vendor_sizes import UNITS, unit_name
from scanbench.problems import Span
from scanbench.program.program import Const, Expr
from scanbench.program.types import DATE_AND_TIME, ELEMENTARY, LINT, TIME, UDINT, Elementary, Type
from scanbench.symbols.values import format_date, format_time


def is_short(body: Body, type: Type | None) -> bool:
    """Whether values of this type have 32 bits in the dialect."""
    return isinstance(type, Elementary) and type.name in UNITS and may(body, Allowance.SHORT_TIMES)


def counts(time: Expr) -> Expr:
    """The number of milliseconds or seconds that a value is, as a LINT."""
    assert isinstance(time.type, Elementary)
    return fold.binary("div", LINT, fold.convert(LINT, time), Const(LINT, UNITS[time.type.name]))


def of_counts(type: Elementary, number: Expr) -> Expr:
    """The value of so many milliseconds or seconds, a LINT of which 32 bits count."""
    kept = fold.convert(LINT, fold.convert(UDINT, number))
    return fold.convert(type, fold.binary("mul", LINT, kept, Const(LINT, UNITS[type.name])))


def cut(type: Elementary, time: Expr) -> Expr:
    """A value of nanoseconds as one of `type`, with what 32 bits have of it."""
    return of_counts(type, counts(fold.convert(type, time)))


def cut_here(body: Body, value: Expr) -> Expr:
    """A value that the library or a conversion gives, as the dialect has it."""
    return cut(value.type, value) if isinstance(value.type, Elementary) and is_short(body, value.type) else value


def whole(time: Expr) -> Expr:
    """Without what is below a millisecond or second; a value may go beyond 32 bits."""
    assert isinstance(time.type, Elementary)
    unit = Const(LINT, UNITS[time.type.name])
    return fold.convert(time.type, fold.binary("mul", LINT, counts(time), unit))


def clock(body: Body, type: Elementary, beyond: bool = False) -> Expr:
    """The virtual time of the scan. The library's timers, and charts (`beyond`), measure with one that does not begin again at 0."""
    now = intrinsic("CLOCK", type, ())
    if type.name not in UNITS or Allowance.SHORT_TIMES not in body.declarations.dialect.allows:
        return now
    return cut(type, now) if is_short(body, type) and not beyond else whole(now)


def joined(op: str, moment: Expr, duration: Expr) -> Expr:
    """A DT or TOD with a TIME: of that a DT takes whole seconds. A time of day begins again at midnight."""
    type = moment.type
    assert isinstance(type, Elementary)
    if type == DATE_AND_TIME:
        seconds = fold.binary("div", LINT, fold.convert(LINT, duration), Const(LINT, UNITS[type.name]))
        return of_counts(type, fold.binary(op, LINT, counts(moment), seconds))
    return fold.binary(op, type, moment, fold.convert(type, whole(fold.convert(TIME, duration))))


def literal_here(body: Body, made: Const, span: Span) -> Const:
    """A literal as the dialect has it: one that does not fit is refused, and what is below its unit is cut and told."""
    type = made.type
    if not isinstance(type, Elementary) or not is_short(body, type) or not isinstance(made.value, int):
        return made
    unit = UNITS[type.name]
    text = _text(type, made.value)
    if not 0 <= made.value // unit < 1 << 32:
        raise body.report.reject(
            "S004",
            f"{text} does not fit {type}, which is a number of {unit_name(type)} from 0 to 4294967295 in {body.dialect.title}: "
            f"{_text(type, 0)} to {_text(type, ((1 << 32) - 1) * unit)}. An L{type} has more.",
            span,
        )
    rest = made.value % unit
    if rest:
        body.report.warn(
            "W004",
            f"{type} has whole {unit_name(type)} in {body.dialect.title}, so {text} is {_text(type, made.value - rest)}. An L{type} has nanoseconds.",
            span,
        )
    return Const(type, made.value - rest)


def _text(type: Elementary, ns: int) -> str:
    return format_time(ns) if type == TIME else format_date(ELEMENTARY[type.name], ns)
