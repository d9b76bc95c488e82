"""Calls through interfaces that come back: a method may lead to itself on a different instance, as in a tree of instances.

Which instance is called is known at run time only. So a circle is allowed where each way around leads through a call of an
interface: the POU that finds the method then counts how deep such calls are, and traps where they are too deep. Where the dialect
has functions and methods that call themselves, each POU of the circle counts. As each POU has one frame, the engines keep what is
in it while it is called again (`Pou.recursive`).
"""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace

from scanbench.check.body import fold
from scanbench.check.body.arguments import together
from scanbench.check.context import Report
from scanbench.check.declare.scopes import Pous
from scanbench.check.dialect import Allowance, Dialect
from scanbench.check.dialect_rules import said
from scanbench.problems import Span
from scanbench.program.layout import Layout
from scanbench.program.program import (
    Assign,
    Base,
    Blocks,
    CallFunction,
    Case,
    Compare,
    Const,
    For,
    Halt,
    If,
    Load,
    Place,
    Pou,
    Repeat,
    Return,
    Stmt,
    Try,
    While,
)
from scanbench.program.sites import TrapKind, TrapSite
from scanbench.program.types import BOOL, LINT, UDINT, Section

MOST_KEPT = 8192
"""Bytes of frames that one way around a circle may keep, on the stack of the engine."""
DEPTH = Place(UDINT, Base.IMAGE, Layout.DEPTH, variable="#depth")
BUDGET = Place(LINT, Base.IMAGE, Layout.BUDGET, variable="#budget")


def allow(report: Report, pous: Pous, dialect: Dialect) -> None:
    """Finds the circles that are allowed, and makes their calls count. The same for each check of a body."""
    for pou in (*pous.uses, *pous.plain):
        pou.recursive = False
    for pou, body in pous.plain.items():
        pou.body = body
        report.parts[pou].traps.pop()
    pous.plain.clear()
    dispatchers = {pou for name, pou in pous.dispatchers.items() if _of_interface(pous, name)}
    everywhere = Allowance.RECURSION in dialect.allows
    for circle in _circles(pous.uses) if dispatchers or everywhere else ():
        if any(pou.kind != "function" or pou.inline for pou in circle):
            continue
        through = _leads_through(circle, dispatchers, pous)
        if not through and not everywhere:
            continue
        if not through:
            first = _first(circle)
            report.warn("W006", said(dialect, Allowance.RECURSION, f"`{first.name}` calls itself"), first.span)
        _check(report, circle, dispatchers, pous, through)
        for pou in circle:
            pou.recursive = True
        for pou in sorted(circle & dispatchers if through else circle, key=_place):
            _count(report, pous, pou, through)


def _of_interface(pous: Pous, name: str) -> bool:
    known = pous.classes.by_key
    above = name.removesuffix(".dispatch").rpartition(".")[0].upper()
    owner = known.get(above) or known.get(above.rpartition(".")[0])  # of a method, or of half of a property
    return owner is not None and owner.kind == "interface"


def _leads_through(circle: set[Pou], dispatchers: set[Pou], pous: Pous) -> bool:
    """Whether each way around leads through a call of an interface."""
    rest = circle - dispatchers
    inner = {pou: {callee: 1 for callee in pous.uses.get(pou, {}) if callee in rest} for pou in rest}
    return next(_circles(inner), None) is None


def _check(report: Report, circle: set[Pou], dispatchers: set[Pou], pous: Pous, through: bool) -> None:
    """Refuses what a call cannot keep while its POU is called again."""
    rest = circle - dispatchers
    kept = sum(callee.frame.size for pou in circle for callee in pous.uses.get(pou, {}) if callee in circle)
    if kept > MOST_KEPT:
        why = f"the variables of its calls take {kept} bytes, of which at most {MOST_KEPT} are kept"
        _refuse(report, rest, why, through)
        return
    for pou in sorted(rest, key=_place):
        if pou.addressed:
            _refuse(report, rest, f"`{pou.name}` makes a reference to a variable of its own call", through)
            return
        for call in _calls(pou.body):
            if call.pou in circle and any(
                _is_own(call, name, given) for name, given in zip(call.pou.parameters, call.args, strict=True)
            ):
                _refuse(report, rest, f"`{pou.name}` passes a variable of its own call to an in-out", through)
                return


def _place(pou: Pou) -> tuple[str, int, str]:
    return pou.span.file, pou.span.line, pou.name


def _first(pous: set[Pou]) -> Pou:
    return min(pous, key=_place)


def _refuse(report: Report, pous: set[Pou], why: str, through: bool) -> None:
    pou = _first(pous)
    told = (
        f"`{pou.name}` may lead to itself through an interface, and {why}."
        if through
        else f"`{pou.name}` leads to itself, and {why}."
    )
    report.error("D009", told, pou.span)


def _is_own(call: CallFunction, name: str, given: object) -> bool:
    """Whether an in-out is bound to a variable in the frame of the caller, which the next call would write over."""
    bound = call.pou.frame.members[name].section is Section.IN_OUT
    return (
        bound
        and isinstance(given, Place)
        and given.base is Base.FRAME
        and given.slot is None
        and given.reference is None
    )


def _calls(node: object) -> Iterator[CallFunction]:
    """The calls of functions and methods in statements, at any depth."""
    if isinstance(node, tuple):
        for each in node:
            yield from _calls(each)
    elif is_dataclass(node) and not isinstance(node, Pou | Span | type):
        if isinstance(node, CallFunction):
            yield node
        for each in fields(node):
            yield from _calls(getattr(node, each.name))


def _count(report: Report, pous: Pous, pou: Pou, through: bool) -> None:
    """Makes a POU count how deep it is called, and take from the budget of loops."""
    span, part = pou.span, report.parts[pou]
    message = (
        f"calls of interfaces nest more than {Layout.DEPTH_LIMIT} deep: an instance leads to itself"
        if through
        else f"calls of `{pou.name}` nest more than {Layout.DEPTH_LIMIT} deep: it leads to itself"
    )
    part.traps.append(TrapSite(TrapKind.LOOP, span, pou.name, message))
    halt: tuple[Stmt, ...] = (Halt(len(part.traps), span),)
    deeper = fold.binary("add", UDINT, Load(DEPTH), Const(UDINT, 1))
    less = fold.binary("sub", UDINT, Load(DEPTH), Const(UDINT, 1))
    left = fold.binary("sub", LINT, Load(BUDGET), Const(LINT, 1))
    ended = Compare("lt", BOOL, Load(BUDGET), Const(LINT, 0))
    too_deep = Compare("gt", BOOL, Load(DEPTH), Const(UDINT, Layout.DEPTH_LIMIT))
    pous.plain[pou] = pou.body
    pou.body = (
        Assign(DEPTH, deeper, span), Assign(BUDGET, left, span),
        If(((too_deep, halt), (ended, halt)), (), span), *_leaving(pou.body, Assign(DEPTH, less, span)),
        Assign(DEPTH, less, span),
    )  # fmt: skip


def _leaving(body: tuple[Stmt, ...], first: Stmt) -> tuple[Stmt, ...]:
    """The statements, with this one before each RETURN."""
    return tuple(_before_return(each, first) for each in body)


def _before_return(node: Stmt, first: Stmt) -> Stmt:
    match node:
        case Return(span):
            return together([first, node], span)
        case If(branches, orelse):
            tested = tuple((test, _leaving(inner, first)) for test, inner in branches)
            return replace(node, branches=tested, orelse=_leaving(orelse, first))
        case Case(_, chosen, orelse):
            labelled = tuple((labels, _leaving(inner, first)) for labels, inner in chosen)
            return replace(node, branches=labelled, orelse=_leaving(orelse, first))
        case For(body=inner) | While(body=inner) | Repeat(body=inner):
            return replace(node, body=_leaving(inner, first))
        case Blocks(blocks):
            return replace(node, blocks=tuple(_leaving(each, first) for each in blocks))
        case Try():
            return replace(
                node, body=_leaving(node.body, first), handler=_leaving(node.handler, first),
                final=_leaving(node.final, first),
            )  # fmt: skip
    return node


def _circles(uses: dict[Pou, dict[Pou, int]]) -> Iterator[set[Pou]]:
    """POUs that lead to each other, and those that lead to themselves."""
    number: dict[Pou, int] = {}
    low: dict[Pou, int] = {}
    stack: list[Pou] = []
    on_stack: set[Pou] = set()
    for root in list(uses):
        if root in number:
            continue
        work = [(root, iter(list(uses.get(root, {}))))]
        number[root] = low[root] = len(number)
        stack.append(root)
        on_stack.add(root)
        while work:
            pou, callees = work[-1]
            callee = next(callees, None)
            if callee is None:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[pou])
                if low[pou] == number[pou]:
                    found = set(stack[stack.index(pou) :])
                    del stack[stack.index(pou) :]
                    on_stack -= found
                    if len(found) > 1 or pou in uses.get(pou, {}):
                        yield found
            elif callee not in number:
                number[callee] = low[callee] = len(number)
                stack.append(callee)
                on_stack.add(callee)
                work.append((callee, iter(list(uses.get(callee, {})))))
            elif callee in on_stack:
                low[pou] = min(low[pou], number[callee])
