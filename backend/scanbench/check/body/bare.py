"""A method, function or program that is called by its name alone, where the dialect has that: `reset;`."""

from contextlib import suppress

from scanbench.check.body.allowed import may, used
from scanbench.check.body.callees import called
from scanbench.check.body.context import Body
from scanbench.check.context import Rejected
from scanbench.check.declare.programs import PROGRAMS
from scanbench.check.dialect import Allowance
from scanbench.program.shown import shown
from scanbench.program.types import Member, Section
from scanbench.syntax import tree


def bare_call(body: Body, node: tree.Expression) -> tree.Call | None:
    """The call that a statement of only a name means: of a POU that needs no arguments; None where it means none."""
    if not may(body, Allowance.BARE_CALLS) or not isinstance(node, tree.Name | tree.MemberOf):
        return None
    mark = body.report.mark()
    with suppress(Rejected):
        pou = called(body, node)
        if _is_program(body, node) or (
            pou is not None and not any(_is_needed(pou.frame.members[key]) for key in pou.parameters)
        ):
            used(
                body,
                Allowance.BARE_CALLS,
                node.span,
                f"`{shown(node)}` is called without parentheses",
                f"`{shown(node)}();`",
            )
            return tree.Call(node, (), node.span)
    body.report.undo(mark)
    return None


def _is_program(body: Body, node: tree.Expression) -> bool:
    found = body.scope.find(node.name) if isinstance(node, tree.Name) else None
    return found is not None and found[2].name == PROGRAMS


def _is_needed(member: Member) -> bool:
    return member.section in (Section.INPUT, Section.IN_OUT) and not member.hidden
