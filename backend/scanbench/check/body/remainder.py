"""MOD of REALs, in the dialects that have it: `a - TRUNC(a / b) * b`, each step rounded to the type (1756-RM003, Modulo)."""

from scanbench.check.body import fold
from scanbench.check.body.allowed import used
from scanbench.check.body.context import Body
from scanbench.check.body.standard_arguments import hold
from scanbench.check.body.standard_fold import intrinsic
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Const, Expr, Sequence
from scanbench.program.types import BOOL, LINT, REAL, Elementary
from scanbench.program.untyped import ANY_REAL

WHOLE_BEYOND = 1.0e18
"""A quotient of that size has no fraction, and not much larger ones fit no integer."""


def remainder(body: Body, type: Elementary, left: Expr, right: Expr, span: Span) -> Expr:
    """What is left of a division whose quotient is cut to a whole number; of a division by 0.0 it is no number."""
    used(body, Allowance.REAL_MOD, span, "`MOD` divides REALs")
    if type == ANY_REAL:
        type = REAL
    if isinstance(right, Const) and right.value == 0:
        raise body.report.reject("S004", "This divides by the constant zero.", span)
    before, left = hold(body, fold.convert(type, left), span)
    more, right = hold(body, fold.convert(type, right), span)
    last, quotient = hold(body, fold.binary("div", type, left, right), span)
    fits = fold.compare("lt", BOOL, intrinsic("ABS", type, (quotient,)), Const(type, WHOLE_BEYOND))
    cut = fold.convert(type, intrinsic("TRUNC", LINT, (quotient,)))
    whole = intrinsic("SEL", type, (fits, quotient, cut))
    made = fold.binary("sub", type, left, fold.binary("mul", type, whole, right))
    run = (*before, *more, *last)
    return Sequence(run, made) if run else made
