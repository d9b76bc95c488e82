"""Assignments: `:=` of everything that can be copied, `S=` and `R=`."""

import re
from contextlib import suppress
from dataclasses import replace

from scanbench.check.body.allowed import allowed, may, used
from scanbench.check.body.arguments import together
from scanbench.check.body.coercion import as_type, coerce
from scanbench.check.body.context import Body, Found
from scanbench.check.body.counting import not_counter
from scanbench.check.body.growing import written
from scanbench.check.body.interfaces import attempt
from scanbench.check.body.methods import assign_property
from scanbench.check.body.places import VARIABLES, given_reference, raw_place
from scanbench.check.body.referring import refer
from scanbench.check.body.subrange_checks import arriving, keeping, noting
from scanbench.check.body.subrange_copies import landed
from scanbench.check.body.targets import declared_target, note_written
from scanbench.check.context import Rejected
from scanbench.check.declare.settings import waits
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, If, Load, Place, Sequence, Stmt
from scanbench.program.shown import shown
from scanbench.program.types import BOOL, ArrayType, Elementary, Kind, Record, Reference, Type, has_instance
from scanbench.program.untyped import ANY_INT, is_untyped, settle
from scanbench.syntax import tree


def _bind(body: Body, target: tree.Expression, value: tree.Expression, span: Span) -> tuple[Place, Expr]:
    """`target REF= value`: the reference variable, and what it is to hold."""
    place, member = raw_place(body, target)
    type = place.type
    if not isinstance(type, Reference):
        raise body.report.reject("T002", f"`REF=` binds a reference; `{shown(target)}` is {type}.", target.span)
    note_written(body, target)
    body.effects.assignable(body, place, member, target.span)
    null = isinstance(value, tree.Name) and value.name.upper() == "NULL"
    if null or isinstance(value, tree.Literal | tree.Call):
        bound = body.expression(value, replace(type, automatic=True))
        if not null and is_untyped(bound) and not (isinstance(bound, Const) and bound.value == 0):
            raise body.report.reject(
                "T002", f"`REF=` binds `{shown(target)}` to a variable; for a value write `{shown(target)} := {shown(value)}`.",
                value.span,
            )  # fmt: skip
        return place, coerce(body, bound, replace(type, automatic=False), span, f"`{shown(target)}`")
    given = given_reference(body, value)
    if given is not None:
        return place, coerce(body, given, type, span, f"`{shown(target)}`")
    source, _ = raw_place(body, value) if isinstance(value, VARIABLES) else (None, None)
    if source is not None and isinstance(source.type, Reference) and source.type.automatic:
        reference: Expr = Load(source)
    else:
        reference = refer(body, value)
        note_written(body, value, may_read=True)  # through the reference
    return place, coerce(body, reference, type, span, f"`{shown(target)}`")


def assign(body: Body, node: tree.Assignment) -> Stmt:
    """One assignment, by any operator."""
    if node.also:
        return _chained(body, node)
    match node.operator:
        case "+=" | "-=" | "*=" | "/=":
            return _combined(body, node)
        case "S=" | "R=":
            return latch(body, node, condition(body, node.value))
        case "REF=":
            return Assign(*_bind(body, node.target, node.value, node.span), node.span)
        case "?=":
            return attempt(body, node)
    setter = assign_property(body, node.target, node.value, node.span)
    if setter is not None:
        return setter
    target, member = _target(body, node)
    if has_instance(target.type) and not _copied(body, target.type, node):
        raise body.report.reject("T003", "An instance of a function block cannot be assigned.", node.span)
    what = f"`{shown(node.target)}`"
    note = noting(body, target, member)
    if isinstance(target.type, ArrayType | Record):
        return _copy(body, node, target, note, what)
    value = arriving(body, as_type(body, node.value, target.type, what), target, node.span)
    return written(body, target, keeping(body, value, note, node.span), node.span)


def _combined(body: Body, node: tree.Assignment) -> Stmt:
    """`a += b` as `a := a + b`."""
    operator, span = node.operator, node.value.span
    name = shown(node.target)
    if not allowed(
        body,
        Allowance.COMBINED_ASSIGNMENT,
        span,
        f"`{operator}` computes and assigns",
        f"`{name} := {name} {operator[0]} ...`",
    ):
        raise body.report.reject(
            "S003", f"`{operator}` is of another language; write `x := x {operator[0]} ...`.", span
        )
    return assign(body, replace(node, operator=":="))


def _chained(body: Body, node: tree.Assignment) -> Stmt:
    """`a := b := c`: `c` into `b`, and that into `a`. Types that differ, and an index that is assigned, would need a rule."""
    targets = (node.target, *node.also)
    values = [*map(shown, node.also), shown(node.value)]
    instead = " ".join(f"{shown(each)} := {value};" for each, value in reversed([*zip(targets, values, strict=True)]))
    if not allowed(body, Allowance.CHAINED_ASSIGNMENT, node.span, "This is several assignments in one", f"`{instead}`"):
        message = "Several assignments in one (`a := b := c`) are not supported; write one for each."
        raise body.report.reject("X001", message, node.span)
    names = {re.split(r"\W", shown(each).upper())[0] for each in targets}
    types = {_target(body, replace(node, target=each))[0].type for each in targets}
    documented = may(body, Allowance.CHAINED_APART)
    if not documented and (len(types) > 1 or any(_indexed_by(each, names) for each in targets)):
        raise body.report.reject(
            "T002",
            f"In several assignments in one, all variables are of one type, and none is an index of the others: what "
            f"{body.dialect.title} does else is not documented. Write one assignment for each.",
            node.span,
        )
    made, value = [], node.value
    for each in reversed(targets):
        made.append(assign(body, replace(node, target=each, value=value, also=())))
        value = each
    return together(made, node.span)


def assigned_value(body: Body, node: tree.BinaryOp) -> Expr:
    """`b := x <= 0` inside of an expression: assigns, and has the value that the variable has then."""
    name, span = shown(node.left), node.span
    instead = f"`{name} := ...;` before it"
    if not allowed(body, Allowance.ASSIGNED_VALUES, span, "An assignment is used as a value", instead):
        raise body.report.reject("S003", f"`:=` assigns. To compare write `=`; to assign, write {instead}.", span)
    if body.pou is None or not body.effects.checks:
        raise body.report.reject("S003", "Only statements assign. To compare write `=`.", span)
    if _computed(node.left):
        raise body.report.reject(
            "T002", f"The index of `{name}` is computed twice here; write the assignment before, {instead}.", span
        )
    made = assign(body, tree.Assignment(node.left, node.right, span))
    return Sequence((made,), body.expression(node.left))


def _computed(node: tree.Expression) -> bool:
    """Whether something else runs where the variable is looked for: a call in an index, say."""
    match node:
        case tree.IndexOf(array, indices):
            return _computed(array) or any(_mentions(each, set()) for each in indices)
        case tree.MemberOf(owner=inner) | tree.PartialAccess(owner=inner) | tree.Dereference(reference=inner):
            return _computed(inner)
        case tree.Name() | tree.DirectAddress():
            return False
    return True


def _indexed_by(node: tree.Expression, names: set[str]) -> bool:
    """Whether an index of the variable is one of these, or a call."""
    match node:
        case tree.IndexOf(array, indices):
            return _indexed_by(array, names) or any(_mentions(each, names) for each in indices)
        case tree.MemberOf(owner=owner) | tree.PartialAccess(owner=owner):
            return _indexed_by(owner, names)
        case tree.Name():
            return False
    return True


def _mentions(node: tree.Expression, names: set[str]) -> bool:
    if isinstance(node, tree.Literal):
        return False
    plain = isinstance(node, tree.Name | tree.MemberOf | tree.BinaryOp)
    return not plain or not names.isdisjoint(re.findall(r"\w+", shown(node).upper()))


def _target(body: Body, node: tree.Assignment) -> Found:
    """What is assigned; where that is wrong, the value is checked all the same."""
    try:
        target, member = declared_target(body, node.target)
    except Rejected:
        with suppress(Rejected):
            body.expression(node.value)
        raise
    not_counter(body, target, node.target, node.span)
    return target, member


def _copy(body: Body, node: tree.Assignment, target: Place, note: Place | None, what: str) -> Stmt:
    """A whole array or structure: of this type, or an array of as many elements of the same type. The note takes it as it comes."""
    type, span = target.type, node.span
    value = body.expression(node.value, type)
    parts = may(body, Allowance.ALIKE_STRUCTURES)
    if isinstance(value, Load) and value.type != type and alike(value.type, type, parts):
        if not alike(value.type, type):
            used(body, Allowance.ALIKE_STRUCTURES, span, f"{what} takes a STRUCT of a different declaration")
        value = Load(replace(value.place, type=type))
    if value.type != type:
        value = coerce(body, value, type, node.value.span, what)
    before: list[Stmt] = []
    if note is not None:
        before = [Assign(note, value, span)]
        value = Load(note)
    copied = Assign(target, landed(body, value, type, node.value.span, what.strip("`"), target), span)
    return together([*before, copied], span) if before else copied


def latch(body: Body, node: tree.Assignment, decides: Expr) -> Stmt:
    """`x S= b`: TRUE where b is TRUE, else as it was; `x R= b`: FALSE where b is TRUE. `decides` is b."""
    literal = tree.Literal("bool", int(node.operator == "S="), None, node.span)
    plain = tree.Assignment(node.target, literal, node.span)
    mark = body.report.mark()
    if body.property_value(node.target) is None and (type := _target(body, plain)[0].type) != BOOL:
        word = "set" if node.operator == "S=" else "reset"
        raise body.report.reject("T002", f"Only a BOOL can be {word}; this is {type}.", node.target.span)
    body.report.undo(mark)
    return If(((decides, (assign(body, plain),)),), (), node.span)


def condition(body: Body, node: tree.Expression) -> Expr:
    """The condition; a wrong one is reported and taken as FALSE, so that the body is checked as well."""
    try:
        expr = body.expression(node)
        if isinstance(expr, Const) and expr.type == ANY_INT and expr.value in (0, 1):
            return Const(BOOL, expr.value)
        if expr.type != BOOL:
            type = settle(expr).type
            counts = isinstance(type, Elementary) and type.kind in (Kind.INT, Kind.UINT, Kind.BITS)
            hint = f" Write `{shown(node)} <> 0`." if counts and isinstance(node, VARIABLES) else ""
            raise body.report.reject("T006", f"A condition is BOOL, not {type}.{hint}", node.span)
    except Rejected:
        return Const(BOOL, 0)
    return expr


def _copied(body: Body, type: Type, node: tree.Assignment) -> bool:
    """Whether the dialect copies all that an instance has to one of the same block, and `value` is such a one; or a structure
    or array with instances in it."""
    if not isinstance(type, Record | ArrayType) or not isinstance(node.value, VARIABLES):
        return False
    if body.declarations.incomplete and not (isinstance(type, Record) and type.kind is Kind.BLOCK) and waits(type):
        return False  # links of what waits for an address are not copied
    mark = body.report.mark()
    given = body.place(node.value)[0].type
    body.report.undo(mark)
    what = f"All that `{shown(node.value)}` has is copied"
    return given == type and allowed(body, Allowance.INSTANCE_COPIES, node.span, what)


def alike(first: Type | None, second: Type, parts: bool = False) -> bool:
    """Whether one may be assigned to the other: the same type, arrays of the same lengths of it, or variables of one declaration
    that writes its STRUCT out. With `parts`, two that are written out have the same members. Two structures that each have a name
    differ, whatever their members are."""
    if first is None or first == second:
        return first is not None
    if isinstance(first, ArrayType) and isinstance(second, ArrayType):
        lengths = [[high - low for low, high in each.bounds] for each in (first, second)]
        return lengths[0] == lengths[1] and alike(first.element, second.element, parts)
    if not isinstance(first, Record) or not isinstance(second, Record):
        return False
    if first.kind is not Kind.STRUCT or not first.written_out:
        return False
    if parts and second.kind is Kind.STRUCT and second.written_out and [*first.members] == [*second.members]:
        pairs = zip(first.members.values(), second.members.values(), strict=True)
        return all(one.offset == other.offset and alike(one.type, other.type, parts) for one, other in pairs)
    declared = [[member.span for member in each.members.values()] for each in (first, second)]
    return declared[0] == declared[1]
