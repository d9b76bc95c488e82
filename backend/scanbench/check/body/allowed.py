"""What only the dialect of the project allows: each use is told with W006, and says how a strict program writes the same."""

from scanbench.check.body.context import Body
from scanbench.check.dialect import Allowance
from scanbench.check.dialect_rules import said
from scanbench.problems import Span


def may(body: Body, allowance: Allowance) -> bool:
    """Whether the dialect allows it."""
    return allowance in body.dialect.allows


def used(body: Body, allowance: Allowance, span: Span, what: str, instead: str = "") -> None:
    """Tells that something was used which only the dialect allows. `what` is it, `instead` the strict way to write it."""
    body.report.warn("W006", said(body.dialect, allowance, what, instead), span)


def allowed(body: Body, allowance: Allowance, span: Span, what: str, instead: str = "") -> bool:
    """Whether the dialect allows it; if so, it is told."""
    if not may(body, allowance):
        return False
    used(body, allowance, span, what, instead)
    return True
