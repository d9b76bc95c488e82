"""Calls of instances of function blocks."""

from contextlib import nullcontext
from dataclasses import replace

from scanbench.check.body.arguments import by_formal, in_out, open_bound, output_value, together
from scanbench.check.body.coercion import coerce
from scanbench.check.body.context import Body
from scanbench.check.body.counting import lent_counter
from scanbench.check.body.direct import as_argument
from scanbench.check.body.dispatch import Dispatcher
from scanbench.check.body.enabling import condition_of, enabling, given_enable, store_eno, without_call
from scanbench.check.body.notes import note_of
from scanbench.check.body.objects import named_itself, own
from scanbench.check.body.receivers import Receiver, is_own_property, receiver_of
from scanbench.check.body.subrange_checks import arriving, explicitly, keeping, noting
from scanbench.check.body.targets import declared_target
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Class
from scanbench.check.declare.scopes import place_of
from scanbench.problems import Span
from scanbench.program.program import Assign, Base, CallBlock, Const, Expr, If, Load, Place, Pou, Stmt
from scanbench.program.shown import shown
from scanbench.program.sites import TrapKind
from scanbench.program.types import BOOL, ULINT, Member, Record, Reference, Section, Subrange, actual_of, base_of
from scanbench.syntax import tree


def names_instance(body: Body, callee: tree.Expression) -> bool:
    """Whether a call as a statement may mean an instance."""
    if named_itself(callee, "THIS") or named_itself(callee, "SUPER"):
        return True
    if isinstance(callee, tree.Name):
        found = body.scope.find(callee.name)
        if found is None and is_own_property(body, callee.name):
            return True
        return found is not None and isinstance(found[0].type, Record | Reference)
    return True


def call_block(body: Body, node: tree.Call) -> Stmt:
    """`instance(...)` as a statement."""
    apart = enabling(node)
    instance, callee, name = _instance(body, apart.call)
    record = callee.instance
    condition = condition_of(body, apart.en)
    told = {
        key: _inside(instance, record, member)
        for key, section in (("EN", Section.INPUT), ("ENO", Section.OUTPUT))
        if (member := record.members.get(key)) is not None and member.section is section and member.type == BOOL
    }
    given = given_enable(apart, told)
    with explicitly(body, given) if apart.en is not None or apart.eno is not None else nullcontext():
        statements = _block_statements(body, given, instance, callee, name)
    if apart.eno is not None:
        ok: Expr = Load(told["ENO"]) if "ENO" in told else Const(BOOL, 1)
        statements.append(store_eno(body, ok, apart.eno))
    if condition is None:
        return together(statements, node.span)
    skipped = without_call(body, given)
    skipped += [Assign(place, Const(BOOL, 0), node.span) for place in told.values()]
    if apart.eno is not None:
        skipped.append(store_eno(body, Const(BOOL, 0), apart.eno))
    return If(((condition, tuple(statements)),), tuple(skipped), node.span)


def _instance(body: Body, node: tree.Call) -> tuple[Place, Pou, str]:
    """The instance that is called, the POU that runs, and the name of its type."""
    receiver = receiver_of(body, node.callee)
    if receiver is None:
        place, _ = body.place(node.callee)
        raise body.report.reject("T010", f"{place.type} has no body and cannot be called.", node.span)
    member = None if receiver.place.reference else _declared(body, node.callee)
    if member is not None and member.constant:
        raise body.report.reject("T003", f"`{member.name}` is CONSTANT, so it cannot run.", node.span)
    owner = receiver.owner
    callee = _body_of(body, receiver, owner)
    if callee is None and owner.open:
        raise Rejected  # it may be of a kind that has one
    if callee is None:
        raise body.report.reject(
            "T010", f"`{owner.name}` has no body that could be called; call one of its methods.", node.span
        )
    return replace(receiver.place, type=callee.instance), callee, owner.name


def _declared(body: Body, callee: tree.Expression) -> Member | None:
    if named_itself(callee, "THIS") or named_itself(callee, "SUPER"):
        return None
    return body.place(callee)[1]


def _body_of(body: Body, receiver: Receiver, owner: Class) -> Pou | None:
    own = body.pous.blocks.get(owner.name.upper())
    if owner.kind not in ("function_block", "program"):
        return None
    if receiver.exact or receiver.above:
        return own
    through = receiver.place.reference is not None
    return Dispatcher(body.report, body.pous).body(owner, always=through)


def _block_statements(body: Body, node: tree.Call, instance: Place, callee: Pou, name: str) -> list[Stmt]:
    record = callee.instance
    formals = list(record.members.values())
    given = by_formal(body, node, [each for each in formals if each.section is not Section.VAR], record, name)
    before: list[Stmt] = []
    after: list[Stmt] = []
    in_outs, bound = [], {}
    for each in formals:
        if each.section is Section.IN_OUT and not each.hidden:
            argument = given.get(each.name.upper())
            target = in_out(body, each, record, argument.value if argument else None, node.span, before)
            bound[each.name.upper()] = target
            slot = actual_of(record, each) if each.copied else each
            if not each.copied or _rebinds(body, node, record, each, target, before):
                in_outs.append((_slot(record, slot), target))
    inputs, outputs = [], []
    for key, argument in given.items():
        formal = record.members[key]
        if argument.value is None or formal.section is Section.IN_OUT:
            continue
        own = own_place(record, formal)
        if formal.section is Section.INPUT:
            value = as_argument(body, argument.value, formal.type, f"`{formal.name}`")
            inside = None if formal.located else _inside(instance, record, formal)
            value = arriving(body, value, own, argument.span, inside)
            inputs += _noted_input(body, own, value, formal, argument.span)
            continue
        target, member = declared_target(body, argument.value)
        lent_counter(body, target, argument.value)
        if isinstance(target.type, Subrange):  # checked as a variable of the caller, which it is
            note = noting(body, target, member)
            taken = body.temporary(base_of(target.type), argument.span)
            outputs.append((output_value(body, Load(own), taken.type, argument), taken))
            value = coerce(body, Load(taken), target.type, argument.span, f"`{shown(argument.value)}`")
            value = arriving(body, value, target, argument.span)
            kept = value if note is None else keeping(body, value, note, argument.span)
            after.append(Assign(target, kept, argument.span))
            continue
        outputs.append((output_value(body, Load(own), target.type, argument), target))
    for each in formals:
        if each.hidden and each.section is Section.INPUT:
            inputs.append((own_place(record, each), open_bound(each, bound)))
    body.pous.use(body.pou, callee)
    site = body.calls_at(node.span)
    call = CallBlock(instance, callee, tuple(inputs), tuple(in_outs), tuple(outputs), node.span, site)
    return [*before, call, *after]


def _noted_input(body: Body, own: Place, value: Expr, formal: Member, span: Span) -> list[tuple[Place, Expr]]:
    """An input, and its note: what the caller gave before it was limited."""
    note = note_of(own, formal, None)
    if note is None or not isinstance(formal.type, Subrange):
        return [(own, value)]
    kept = body.temporary(base_of(formal.type), span)
    return [(own, keeping(body, value, kept, span)), (note, Load(kept))]


def _rebinds(body: Body, node: tree.Call, record: Record, member: Member, target: Place, before: list[Stmt]) -> bool:
    """Whether an in-out by value is bound to something else by this call: SUPER runs in the same instance. So what this body
    made of it goes back first, and when it is passed on as it is, it stays bound to what was passed here."""
    if not named_itself(node.callee, "SUPER"):
        return True
    inside = own(body, place_of(member, Base.SELF, record, 0))
    trap = body.trap(TrapKind.NULL, node.span, f"the in-out {member.name} is not connected")
    outside = own(body, place_of(actual_of(record, member), Base.SELF, record, trap))
    if not member.constant:
        before.append(Assign(outside, Load(inside), node.span))
    return target != inside


def own_place(record: Record, member: Member) -> Place:
    """A member of a block, seen from its own body."""
    if member.located:
        return Place(member.type, Base.IMAGE, member.offset, bit=member.bit, variable="@")
    return Place(member.type, Base.SELF, member.offset, bit=member.bit, variable=_variable(record, member))


def _slot(record: Record, member: Member) -> Place:
    return Place(ULINT, Base.SELF, member.offset, variable=_variable(record, member))


def _inside(instance: Place, record: Record, member: Member) -> Place:
    """An output of an instance, seen from outside."""
    free = instance.slot is not None or instance.reference is not None or instance.variable.startswith("@")
    variable = instance.variable if free else _variable(record, member)
    return replace(instance, type=member.type, offset=instance.offset + member.offset, variable=variable)


def _variable(record: Record, member: Member) -> str:
    return f"{member.home or record.name}.{member.name}".upper()
