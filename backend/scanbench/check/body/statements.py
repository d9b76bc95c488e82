"""Statements -> checked statements. A rejected statement is left out and the next one is checked all the same."""

from bisect import bisect
from dataclasses import replace

from scanbench.check.body import targets
from scanbench.check.body.action_calls import action_call
from scanbench.check.body.allowed import allowed, may, used
from scanbench.check.body.arguments import together
from scanbench.check.body.assignments import assign, condition
from scanbench.check.body.bare import bare_call
from scanbench.check.body.calls import call_statement
from scanbench.check.body.catching import leaves, try_statement
from scanbench.check.body.coercion import as_type, value_of
from scanbench.check.body.context import Body
from scanbench.check.body.jumps import jump
from scanbench.check.body.lenient import unsigned
from scanbench.check.body.loop_ends import computed_again
from scanbench.check.body.spelled_out import spelled_out
from scanbench.check.body.subrange_checks import arriving, into
from scanbench.check.body.text_cases import TEXT_CASE, as_comparisons, is_text
from scanbench.check.body.unreached import never_chosen, unreached
from scanbench.check.body.variants import variant_copy, with_type_labels
from scanbench.check.context import Rejected
from scanbench.check.dialect import Allowance
from scanbench.program.bodies import bodies
from scanbench.program.program import (
    Assign,
    Case,
    Const,
    Continue,
    Exit,
    Expr,
    For,
    If,
    Jump,
    Limit,
    Place,
    Repeat,
    Return,
    Sequence,
    Stmt,
    Try,
    While,
)
from scanbench.program.shown import shown
from scanbench.program.sites import TrapKind
from scanbench.program.types import LINT, Elementary, Enumeration, Kind, Subrange, base_of
from scanbench.program.untyped import bounds, settle
from scanbench.syntax import tree

COUNTED = (Kind.INT, Kind.UINT)


def block(body: Body, statements: tuple[tree.Statement, ...]) -> tuple[Stmt, ...]:
    """Statements one after the other."""
    made = []
    for node in statements:
        try:
            checked = statement(body, node)
        except Rejected:
            continue
        if checked is not None:
            made.append(checked)
    unreached(body, statements)
    return tuple(made)


def statement(body: Body, node: tree.Statement) -> Stmt | None:
    """One statement; None for one that has no effect."""
    match node:
        case tree.Assignment():
            return assign(body, node)
        case tree.ExpressionStatement():
            return _expression(body, node)
        case tree.IfStatement():
            branches = [(condition(body, test), block(body, inner)) for test, inner in node.branches]
            never_chosen(body, node)
            return If(tuple(branches), block(body, node.orelse), node.span)
        case tree.CaseStatement():
            return _case(body, node)
        case tree.ForStatement():
            return _for(body, node)
        case tree.WhileStatement():
            trap = body.trap(TrapKind.LOOP, node.span, "this WHILE does not end")
            return While(condition(body, node.condition), _loop(body, node.body), trap, node.span)
        case tree.RepeatStatement():
            trap = body.trap(TrapKind.LOOP, node.span, "this REPEAT does not end")
            inner = _loop(body, node.body)
            return Repeat(inner, condition(body, node.until), trap, node.span)
        case tree.ExitStatement() | tree.ContinueStatement():
            return _leave(body, node)
        case tree.ReturnStatement():
            return _return(body, node)
        case tree.LabelStatement() | tree.JumpStatement():
            return jump(body, node)
        case tree.TryStatement():
            return try_statement(body, node, block)


def _leave(body: Body, node: tree.ExitStatement | tree.ContinueStatement) -> Stmt:
    word, made = (
        ("EXIT", Exit(node.span)) if isinstance(node, tree.ExitStatement) else ("CONTINUE", Continue(node.span))
    )
    if body.loops == 0:
        raise body.report.reject("T009", f"{word} is in no loop; RETURN leaves the POU.", node.span)
    leaves(body, word, node.span, body.loops)
    return made


def _return(body: Body, node: tree.ReturnStatement) -> Stmt:
    leaves(body, "RETURN", node.span)
    if node.condition is None:
        return Return(node.span)
    test = condition(body, node.condition)
    instead = f"`IF {shown(node.condition)} THEN RETURN; END_IF`"
    if not allowed(body, Allowance.RETURN_CONDITION, node.span, "RETURN has a condition", instead):
        raise body.report.reject(
            "S003", f"`;` expected after RETURN. Where it depends on something, write {instead}.", node.span
        )
    return If(((test, (Return(node.span),)),), (), node.span)


def _loop(body: Body, inner: tuple[tree.Statement, ...]) -> tuple[Stmt, ...]:
    body.loops += 1
    try:
        return block(body, inner)
    finally:
        body.loops -= 1


def _expression(body: Body, node: tree.ExpressionStatement) -> Stmt | None:
    call = node.expression
    if not isinstance(call, tree.Call) and (bare := bare_call(body, call)) is not None:
        call = bare
    if not isinstance(call, tree.Call):
        try:
            body.expression(call)
        finally:
            body.report.warn("W001", "This computes a value and drops it; is an assignment missing?", node.span)
        return None
    spelled = spelled_out(body, call)
    if spelled is not None:
        return together(list(block(body, spelled)), node.span)
    return variant_copy(body, call) or action_call(body, call, block) or call_statement(body, call)


def _case(body: Body, node: tree.CaseStatement) -> Stmt:
    node = with_type_labels(body, node)
    selector = value_of(body, node.selector)
    type = selector.type
    if type is not None and is_text(type) and allowed(body, Allowance.TEXT_CASES, node.selector.span, TEXT_CASE):
        held = body.temporary(type, node.span)
        chosen = statement(body, as_comparisons(body, node, type, held.variable.rpartition(".")[2]))
        assert isinstance(chosen, If)
        test, inside = chosen.branches[0]
        kept = Sequence((Assign(held, selector, node.span),), test)
        return replace(chosen, branches=((kept, inside), *chosen.branches[1:]))
    if not isinstance(type, Elementary) or type.kind not in (*COUNTED, Kind.BITS):
        raise body.report.reject(
            "T002", f"CASE needs an integer or an enumeration, not {type}; write IF and ELSIF.", node.selector.span
        )
    branches = []
    taken: list[tuple[int, int]] = []  # in order
    for labels, inner in node.branches:
        ranges = []
        for first, last in labels:
            try:
                ranges.append(_label(body, first, last, type, taken))
            except Rejected:
                continue
        branches.append((tuple(ranges), block(body, inner)))
    return Case(selector, tuple(branches), block(body, node.orelse), node.span)


def _label(
    body: Body, first: tree.Expression, last: tree.Expression | None, type: Elementary, taken: list[tuple[int, int]]
) -> tuple[int, int]:
    low = _label_value(body, first, type)
    high = low if last is None else _label_value(body, last, type)
    if low > high:
        raise body.report.reject("T007", f"The range {low}..{high} is empty.", first.span)
    at = bisect(taken, (low, high))
    for other in taken[max(at - 1, 0) : at + 1]:
        if low <= other[1] and other[0] <= high:
            number = max(low, other[0])
            raise body.report.reject("T007", f"{_named(number, type)} is a label already.", first.span)
    taken.insert(at, (low, high))
    return low, high


def _label_value(body: Body, node: tree.Expression, type: Elementary) -> int:
    expr = body.expression(node, type)
    if not isinstance(expr, Const):
        raise body.report.reject("T007", "A label is a constant; for a variable write IF.", node.span)
    return int(_plain_label(body, expr, type, node).value)


def _plain_label(body: Body, expr: Const, type: Elementary, node: tree.Expression) -> Const:
    other = expr.type
    kinds = (*COUNTED, Kind.BITS)
    if not isinstance(other, Elementary) or other.kind not in kinds or isinstance(expr.value, bytes):
        raise body.report.reject("T007", f"A label is {type}, not {settle(expr).type}.", node.span)
    if isinstance(other, Enumeration) and isinstance(type, Enumeration) and other != type:
        raise body.report.reject("T007", f"A label is a value of {type}, not of {other}.", node.span)
    low, high = bounds(type)
    if not low <= expr.value <= high:
        raise body.report.reject("T007", f"{expr.value} can never be reached: {type} is {low} to {high}.", node.span)
    return expr


def _for(body: Body, node: tree.ForStatement) -> Stmt:
    counter = targets.target(body, node.variable)
    body.report.lent.append(targets.variable(node.variable).span)
    counter = _counted(body, counter, node)
    type = counter.type
    plain = isinstance(type, Elementary) and type.kind in COUNTED and not isinstance(type, Enumeration)
    if not plain or counter.indices or counter.reference is not None:
        raise body.report.reject("T008", f"FOR counts with a plain integer variable, not {type}.", node.variable.span)
    assert isinstance(type, Elementary)
    for outer in body.counters:
        if (outer.base, outer.offset, outer.slot) == (counter.base, counter.offset, counter.slot):
            raise body.report.reject("T008", "This variable counts a loop around already.", node.variable.span)
    base = base_of(type)
    start = as_type(body, node.start, type, "The start value" if type is base else f"`{shown(node.variable)}`")
    start = arriving(body, start, counter, node.start.span)
    end = as_type(body, node.end, base, "The end value")
    step = Const(base, 1) if node.step is None else _downward(body, node.step, base) or _step(body, node.step, base)
    if isinstance(type, Subrange):
        end = _for_end(body, node, type, end, step)
    trap = body.trap(TrapKind.LOOP, node.span, "this FOR has more rounds than a scan may take")
    body.counters.append(counter)
    inner = _loop(body, node.body)
    body.counters.pop()
    limits = (type.low, type.high) if isinstance(type, Subrange) else None
    follows = counter in body.followed
    if follows:
        body.followed.remove(counter)
        if not isinstance(step, Const):
            told = "The step of a FOR whose counter is assigned in the loop is a constant."
            raise body.report.reject("T008", told, (node.step or node.end).span)
    again = computed_again(body, counter, end, step, inner, node.end.span)
    leaves = follows or again or _leaves(inner, outer=True)
    return For(counter, start, end, step, inner, leaves, trap, node.span, limits, follows=follows, again=again)


def _counted(body: Body, counter: Place, node: tree.ForStatement) -> Place:
    """A bit string that counts, as the unsigned integer of its size, where the dialect has that."""
    type = counter.type
    if not isinstance(type, Elementary) or type.kind is not Kind.BITS or counter.bit is not None:
        return counter
    what = f"`{shown(node.variable)}`, which counts a FOR loop, is {type}"
    number = unsigned(type)
    if not allowed(body, Allowance.BIT_NUMBERS, node.variable.span, what, f"`{shown(node.variable)} : {number}`"):
        return counter
    return replace(counter, type=number)


def _for_end(body: Body, node: tree.ForStatement, type: Subrange, end: Expr, step: Expr) -> Expr:
    """The end value of a counter with a subrange, which the counter must not pass; short of it, no round is run."""
    if not isinstance(step, Const):
        raise body.report.reject(
            "T008", "The step of a counter with a subrange is a constant.", (node.step or node.end).span
        )
    low, high = bounds(base_of(type))
    upward = _whole(step) > 0
    if isinstance(end, Const) and (_whole(end) > type.high if upward else _whole(end) < type.low):
        raise body.report.reject(
            "S004", f"{end.value!r} is outside of {type.low}..{type.high}, so `{shown(node.variable)}` would leave it.",
            node.end.span,
        )  # fmt: skip
    reach = replace(type, low=low, policy="limit") if upward else replace(type, high=high, policy="limit")
    made = into(body, end, reach, node.end.span, shown(node.variable))
    if isinstance(made, Limit):
        sites = body.report.checks
        sites[made.site - 1] = replace(sites[made.site - 1], low=type.low, high=type.high)
    return made


def _downward(body: Body, node: tree.Expression, type: Elementary) -> Expr | None:
    """A constant below 0 as the step of an unsigned counter, where the dialect has that; None of others."""
    if type.kind is not Kind.UINT or type.size == LINT.size or not may(body, Allowance.WIDE_RESULTS):
        return None
    mark = body.report.mark()
    step = settle(body.expression(node))
    if isinstance(step, Const) and isinstance(step.value, int) and step.value < 0:
        what = f"The counter is {type}, and its step is negative"
        used(body, Allowance.WIDE_RESULTS, node.span, what, "a counter of a signed type")
        return Const(LINT, step.value)
    body.report.undo(mark)
    return None


def _step(body: Body, node: tree.Expression, type: Elementary) -> Expr:
    step = as_type(body, node, type, "The step")
    if isinstance(step, Const) and step.value == 0:
        raise body.report.reject("T008", "A step of 0 never ends.", node.span)
    return step


def _whole(constant: Const) -> int:
    assert isinstance(constant.value, int)
    return constant.value


def _named(number: int, type: Elementary) -> str:
    """A label for people: the name that an enumeration has for it."""
    names = [name for name, value in type.values if value == number] if isinstance(type, Enumeration) else []
    return f"`{names[0]}`" if names else str(number)


def _leaves(statements: tuple[Stmt, ...], outer: bool) -> bool:
    """Whether the loop around this body can end before its count: by its own EXIT, or by RETURN."""
    for each in statements:
        match each:
            case Exit():
                if outer:
                    return True
            case Return() | Jump():
                return True
            case If(branches, orelse):
                if any(_leaves(inner, outer) for _, inner in branches) or _leaves(orelse, outer):
                    return True
            case Case(_, branches, orelse):
                if any(_leaves(inner, outer) for _, inner in branches) or _leaves(orelse, outer):
                    return True
            case For(body=inner) | While(body=inner) | Repeat(body=inner):
                if _leaves(inner, outer=False):
                    return True
            case Try():
                if any(_leaves(inner, outer) for inner in bodies(each)):
                    return True
    return False
