"""Sums, differences and products in 64 bits, as CODESYS and TwinCAT compute them on controllers of 64 bits.

`i + j` of two INT has the type INT, but its value is cut to 16 bits only where it is stored, converted by name or passed on;
compared, or stored in a DINT, it is what it is. So such a value is a conversion, which cuts, of the value in 64 bits; and who can
use the latter finds it by `uncut`.
"""

from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.context import Body
from scanbench.program.program import Const, Convert, Expr
from scanbench.program.types import LINT, ULINT, Elementary, Kind

WHOLE = (Kind.INT, Kind.UINT)
WIDENING = ("add", "sub", "mul")
"""Operations whose result may have more bits than their operands."""


def cut(body: Body, type: Elementary, value: Expr) -> Expr:
    """A value of 64 bits as one of `type`, which remembers what it was."""
    made = fold.convert(type, value)
    if made is not value:
        body.wide[id(made)] = made, value
    return made


def uncut(body: Body, expr: Expr) -> Expr | None:
    """The 64 bits that a value was cut from; None where it was not."""
    known = body.wide.get(id(expr))
    return None if known is None else known[1]


def settled(body: Body, expr: Expr) -> Expr:
    """The value, cut for good: a conversion by name does that."""
    return replace(expr) if id(expr) in body.wide and isinstance(expr, Convert | Const) else expr


def converted(body: Body, type: Elementary, expr: Expr) -> Expr:
    """The value in a different type, without the loss of having been cut."""
    value = uncut(body, expr)
    if value is None or expr.type == type:
        return fold.convert(type, expr)
    return cut(body, type, value) if type.kind in (*WHOLE, Kind.BITS) else fold.convert(type, value)


def wide_of(type: Elementary) -> Elementary:
    """The integer of 64 bits with the sign of a type."""
    return LINT if type.kind is Kind.INT else ULINT


def sixty_four(body: Body, type: Elementary, operand: Expr) -> Expr:
    """An operand of `type` in 64 bits."""
    return fold.convert(wide_of(type), uncut(body, operand) or operand)


def is_wide(body: Body, *operands: Expr) -> bool:
    """Whether any of them was cut."""
    return any(id(each) in body.wide for each in operands)
