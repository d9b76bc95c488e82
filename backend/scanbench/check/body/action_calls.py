"""Calls of an ACTION with inputs, outputs and in-outs of its block, as CODESYS has them: `table.Add(key := 3, ok => done)`."""

from collections.abc import Callable
from dataclasses import replace

from scanbench.check.body.allowed import allowed
from scanbench.check.body.arguments import by_formal, in_out, together
from scanbench.check.body.context import Body
from scanbench.check.body.il_operands import hidden
from scanbench.check.body.objects import named_itself
from scanbench.check.body.receivers import Receiver, method_called, receiver_of
from scanbench.check.body.references import reference_type
from scanbench.check.declare.classes import Method
from scanbench.check.dialect import Allowance
from scanbench.program.program import Assign, Base, Const, RefOf, Stmt
from scanbench.program.shown import shown
from scanbench.program.types import Member, Record, Section
from scanbench.syntax import tree
from scanbench.syntax.parse_pou import ACTION

Block = Callable[[Body, tuple[tree.Statement, ...]], tuple[Stmt, ...]]


def action_call(body: Body, node: tree.Call, block: Block) -> Stmt | None:
    """Assignments of the inputs, the call, and assignments of the outputs; None for other calls. `block` checks statements."""
    found = _action(body, node)
    if found is None:
        return None
    receiver, action = found
    record = receiver.owner.record
    if record is None:
        return None
    instead = f"an assignment to each of them, and `{shown(node.callee)}();`"
    what = f"`{action.name}` is an ACTION, and is called with inputs or outputs of its block"
    if not allowed(body, Allowance.ACTION_ARGUMENTS, node.span, what, instead):
        raise body.report.reject(
            "T004",
            f"`{action.name}` is an ACTION, which has no arguments. Write {instead}",
            node.arguments[0].span,
        )
    first, callee, receiver = _bound(body, receiver, node.callee)
    given = [each for each in record.members.values() if each.given in (Section.INPUT, Section.OUTPUT, Section.IN_OUT)]
    before: list[tree.Statement] = []
    after: list[tree.Statement] = []
    connected: list[Stmt] = []
    for key, argument in by_formal(body, node, given, record, action.name).items():
        if argument.value is None:
            continue
        if record.members[key].section is Section.IN_OUT:
            connected += _connected(body, receiver, record, record.members[key], argument, argument.value)
            continue
        inside = _inside(callee, record.members[key].name, argument)
        if argument.output:
            value = tree.UnaryOp("not", inside, argument.span) if argument.negated else inside
            after.append(tree.Assignment(argument.value, value, argument.span))
        else:
            before.append(tree.Assignment(inside, argument.value, argument.span))
    call = tree.ExpressionStatement(tree.Call(callee, (), node.span), node.span)
    inputs = block(body, tuple(before)) if before else ()
    return together([*first, *inputs, *connected, *block(body, (call, *after))], node.span)


def _action(body: Body, node: tree.Call) -> tuple[Receiver, Method] | None:
    named = node.callee
    if not isinstance(named, tree.Name | tree.MemberOf) or named.name.upper() not in body.pous.classes.actions:
        return None
    if not node.arguments or any(each.name and each.name.upper() in ("EN", "ENO") for each in node.arguments):
        return None
    mark = body.report.mark()
    found = method_called(body, named)
    body.report.undo(mark)
    return found if found is not None and ACTION in found[1].declaration.modifiers else None


def _bound(body: Body, receiver: Receiver, callee: tree.Expression) -> tuple[list[Stmt], tree.Expression, Receiver]:
    """What keeps the instance while it is called, and the callee by that: an argument may change the index or pointer that says which
    instance it is. Nothing, and the callee as it is, where there is none."""
    place = receiver.place
    fixed = place.reference is None and all(isinstance(each.value, Const) for each in place.indices)
    if fixed or not isinstance(callee, tree.MemberOf) or named_itself(callee.owner, "SUPER"):
        return [], callee, receiver
    if place.base is Base.FRAME and place.slot is None and place.reference is None:
        raise body.report.reject(
            "T010",
            f"`{shown(callee.owner)}` is a temporary with an index, and its ACTION is called with arguments. Assign the inputs, then "
            "call the ACTION without arguments.",
            callee.span,
        )
    method_called(body, callee)  # for what uses it
    type = reference_type(place.type, pointer=True)
    kept = tree.Name(hidden(body, "$called", type, callee.span).name, callee.span)
    instance = tree.Dereference(kept, callee.span)
    by = receiver_of(body, instance)
    assert by is not None
    store = Assign(body.place(kept)[0], RefOf(place, type), callee.span)
    return [store], tree.MemberOf(instance, callee.name, callee.span), by


def _inside(callee: tree.Expression, name: str, argument: tree.Argument) -> tree.Expression:
    """A variable of the block whose ACTION is called."""
    span = argument.place or argument.span
    if isinstance(callee, tree.MemberOf) and not named_itself(callee.owner, "SUPER"):
        return tree.MemberOf(callee.owner, name, span)
    return tree.Name(name, span)


def _connected(
    body: Body, receiver: Receiver, record: Record, member: Member, argument: tree.Argument, value: tree.Expression
) -> list[Stmt]:
    """Connects an in-out of the block for this and later calls, as a call of the block does."""
    made: list[Stmt] = []
    target = in_out(body, member, record, value, argument.span, made)
    if member.copied or (target.base is Base.FRAME and target.slot is None):
        raise body.report.reject(
            "T005",
            f"The in-out `{member.name}` is connected where the block itself is called, and not by its ACTION. "
            "Call the block with it before, or write a METHOD with a VAR_IN_OUT.",
            argument.span,
        )
    place = receiver.place
    free = place.slot is not None or place.reference is not None or place.variable.startswith("@")
    variable = place.variable if free else f"{member.home or record.name}.{member.name}".upper()
    type = reference_type(member.type)
    slot = replace(place, type=type, offset=place.offset + member.offset, variable=variable)
    return [*made, Assign(slot, RefOf(target, type), argument.span)]
