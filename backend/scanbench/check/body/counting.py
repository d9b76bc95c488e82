"""The counter of a FOR loop, and what writes to it inside of the loop."""

from scanbench.check.body.allowed import may, used
from scanbench.check.body.context import Body
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Place
from scanbench.program.shown import shown
from scanbench.program.types import LINT, Subrange
from scanbench.syntax import tree


def not_counter(body: Body, target: Place, node: tree.Expression, span: Span) -> None:
    """Refuses an assignment to the counter of a loop around, where the dialect does not have it."""
    for counter in body.counters:
        if not _same(counter, target):
            continue
        if not may(body, Allowance.COUNTER_WRITES):
            raise body.report.reject(
                "T008", f"`{shown(node)}` counts this FOR loop and cannot be assigned in it; use EXIT to leave.", span
            )
        _follows(body, counter, node, span)


def lent_counter(body: Body, target: Place, node: tree.Expression) -> None:
    """Where the dialect has that, the loop follows a counter that is passed to an in-out, or takes an output."""
    for counter in body.counters if may(body, Allowance.COUNTER_WRITES) else ():
        if _same(counter, target):
            _follows(body, counter, node, node.span)


def _same(counter: Place, target: Place) -> bool:
    same = (counter.base, counter.offset, counter.slot, counter.bit)
    return (target.base, target.offset, target.slot, target.bit) == same and target.type.size == counter.type.size


def _follows(body: Body, counter: Place, node: tree.Expression, span: Span) -> None:
    if isinstance(counter.type, Subrange) or counter.type.size == LINT.size:
        raise body.report.reject(
            "X001", f"`{shown(node)}` counts this FOR loop and is {counter.type}: only counters of up to 32 bits without a "
            "subrange can be assigned in the loop here. Write a WHILE loop.", span,
        )  # fmt: skip
    used(body, Allowance.COUNTER_WRITES, span, f"`{shown(node)}` counts this FOR loop and is assigned in it")
    if counter not in body.followed:
        body.followed.append(counter)
