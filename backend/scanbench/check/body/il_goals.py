"""Where the current result of IL goes: on its way to a variable with a subrange, what it was before it wrapped is remembered.

`LD u; SUB 2; ST u` computes in a temporary that no text names, so a difference that wraps there is checked as the number that it was, as in
`u := u - 2`. That is known in instructions that follow each other, not across a label.
"""

from dataclasses import dataclass

from scanbench.check.body.context import Body, Truth
from scanbench.check.body.il_operands import hidden, type_of
from scanbench.check.body.subrange_checks import policy_of
from scanbench.check.body.true_values import Way, elementary, wrapped
from scanbench.problems import Span
from scanbench.program.program import Assign, Expr, Place, Sequence
from scanbench.program.shown import shown
from scanbench.program.types import Elementary, Kind, Record, Section, Subrange
from scanbench.syntax import tree


@dataclass(frozen=True, slots=True)
class Goal:
    """A variable with a subrange, as it is written, and where a value is on its way to it."""

    variable: str
    type: Subrange
    span: Span


def goals(body: Body, written: tree.IlBody) -> list[Goal | None]:
    """Of each instruction, the variable with a subrange that its result may be stored in next."""
    found: list[Goal | None] = []
    goal: Goal | None = None
    for node in reversed(written.instructions):
        found.append(goal)
        if (taken := _taken(body, node)) is not None:
            goal = taken
        elif node.operator == "LD" or (node.operator in ("JMP", "RET") and not node.conditional):
            goal = None
        if node.label is not None:
            goal = None
    return found[::-1]


def _taken(body: Body, node: tree.IlInstruction) -> Goal | None:
    """What the instruction stores the current result in, if that has a subrange."""
    operand, scope = node.operand, body.scope
    type, name = None, node.operator
    if node.operator == "ST" and operand is not None:
        type, name = type_of(scope, operand), shown(operand)
    elif (function := body.pous.functions.get(node.operator)) is not None and function.parameters:
        first = function.frame.members[function.parameters[0]]
        type, name = (first.type if first.section is Section.INPUT else None), first.name
    elif operand is not None and isinstance(record := type_of(scope, operand), Record) and record.kind is Kind.BLOCK:
        member = record.members.get(node.operator)
        type = None if member is None else member.type
    return Goal(name, type, node.span) if isinstance(type, Subrange) else None


def remembered(body: Body, value: Expr, register: Place, goal: Goal | None) -> Expr:
    """A new current result. Where it may wrap, and goes where that counts, what it was before is kept beside it."""
    way, carried = None, None
    if goal is not None and body.pou is not None and _is_whole(value) and policy_of(body, goal.type) != "off":
        way = Way(body, goal.span, goal.variable, policy_of(body, goal.type))
        carried = way.carried(value, elementary(value))
    if way is None or goal is None or carried is None:
        made = value if way is None else way.exact(value)
        body.truths.pop(register.offset, None)
        return made
    number, reach = carried
    kept = hidden(body, f"$true.{elementary(number)}.{register.offset}", elementary(number), goal.span)
    place = body.place(tree.Name(kept.name, goal.span))[0]
    body.truths[register.offset] = Truth(place, reach)
    return Sequence((Assign(place, number, goal.span),), wrapped(value, place))


def _is_whole(value: Expr) -> bool:
    return isinstance(value.type, Elementary) and value.type.kind in (Kind.INT, Kind.UINT)
