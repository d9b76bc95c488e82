"""Texts of SIMATIC AX that a character written after their end makes longer.

From the tests of the package simatic-ax/conversion, whose `ToString` writes an empty STRING character by character. What happens to
the characters between, where a character is written further after the end, is said nowhere: that traps, as everywhere. Of SCL in
the TIA Portal nothing is known, so its texts do not grow.
"""

from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.arguments import together
from scanbench.check.body.context import Body
from scanbench.check.body.harmless import again
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, If, Index, Intrinsic, Load, Place, Stmt
from scanbench.program.types import LINT, UINT, StringType
from scanbench.syntax.scl import is_scl


def is_ax(body: Body, span: Span) -> bool:
    """Whether this is text of SIMATIC AX, which has the dialect of SCL."""
    return body.dialect.name == "siemens" and not is_scl(span.file)


def written(body: Body, target: Place, value: Expr, span: Span) -> Stmt:
    """The assignment of a value; where the target is a character of a text that may grow, the one after its end is there, too."""
    plain = Assign(target, value, span)
    if not target.indices or not is_ax(body, span):
        return plain
    one = target.indices[-1]
    match one:
        case Index(high=Intrinsic("LEN", args=(Load(text),))) if isinstance(text.type, StringType):
            pass
        case _:
            return plain
    position = again(one.value)
    if position is None:  # with a call, which is not made twice
        return plain
    length = one.high
    assert not isinstance(length, int)
    after = fold.binary("add", LINT, length, Const(LINT, 1))
    high = Intrinsic("MIN", LINT, (after, Const(LINT, text.type.capacity)))
    grown = replace(target, indices=(*target.indices[:-1], replace(one, high=high)))
    longer = fold.convert(UINT, after)
    last = fold.compare("eq", LINT, position, after)
    return together(
        [Assign(grown, value, span), If(((last, (Assign(replace(text, type=UINT), longer, span),)),), (), span)], span
    )
