"""Calls through interfaces that come back: a method may lead to itself on a different instance, as in a tree of instances.

Which instance is called is known at run time only. So a circle is allowed where each way around leads through a call of an
interface: the POU that finds the method then counts how deep such calls are, and traps where they are too deep. As each POU has
one frame, the engines keep what is in it while it is called again (`Pou.recursive`).
"""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from scanbench.check.body import fold
from scanbench.check.context import Report
from scanbench.check.declare.scopes import Pous
from scanbench.problems import Span
from scanbench.program.layout import Layout
from scanbench.program.program import Assign, Base, CallFunction, Compare, Const, Halt, If, Load, Place, Pou, Stmt
from scanbench.program.sites import TrapKind, TrapSite
from scanbench.program.types import BOOL, LINT, UDINT, Section

MOST_KEPT = 8192
"""Bytes of frames that one way around a circle may keep, on the stack of the engine."""
DEPTH = Place(UDINT, Base.IMAGE, Layout.DEPTH, variable="#depth")
BUDGET = Place(LINT, Base.IMAGE, Layout.BUDGET, variable="#budget")


def allow(report: Report, pous: Pous) -> None:
    """Finds the circles that are allowed, and makes their calls count. The same for each check of a body."""
    for pou in (*pous.uses, *pous.plain):
        pou.recursive = False
    for pou, body in pous.plain.items():
        pou.body = body
        report.parts[pou].traps.pop()
    pous.plain.clear()
    dispatchers = {pou for name, pou in pous.dispatchers.items() if _of_interface(pous, name)}
    for circle in _circles(pous.uses) if dispatchers else ():
        if _is_allowed(report, circle, dispatchers, pous):
            for pou in circle:
                pou.recursive = True
            for pou in circle & dispatchers:
                _count(report, pous, pou)


def _of_interface(pous: Pous, name: str) -> bool:
    known = pous.classes.by_key
    above = name.removesuffix(".dispatch").rpartition(".")[0].upper()
    owner = known.get(above) or known.get(above.rpartition(".")[0])  # of a method, or of half of a property
    return owner is not None and owner.kind == "interface"


def _is_allowed(report: Report, circle: set[Pou], dispatchers: set[Pou], pous: Pous) -> bool:
    if any(pou.kind != "function" or pou.inline for pou in circle):
        return False
    rest = circle - dispatchers
    inner = {pou: {callee: 1 for callee in pous.uses.get(pou, {}) if callee in rest} for pou in rest}
    if next(_circles(inner), None) is not None:
        return False
    kept = sum(callee.frame.size for pou in circle for callee in pous.uses.get(pou, {}) if callee in circle)
    if kept > MOST_KEPT:
        _refuse(report, rest, f"the variables of its calls take {kept} bytes, of which at most {MOST_KEPT} are kept")
        return True
    for pou in rest:
        if pou.addressed:
            _refuse(report, rest, f"`{pou.name}` makes a reference to a variable of its own call")
            return True
        for call in _calls(pou.body):
            if call.pou in circle and any(
                _is_own(call, name, given) for name, given in zip(call.pou.parameters, call.args, strict=True)
            ):
                _refuse(report, rest, f"`{pou.name}` passes a variable of its own call to an in-out")
                return True
    return True


def _refuse(report: Report, pous: set[Pou], why: str) -> None:
    pou = min(pous, key=lambda each: (each.span.file, each.span.line, each.name))
    report.error("D009", f"`{pou.name}` may lead to itself through an interface, and {why}.", pou.span)


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


def _count(report: Report, pous: Pous, pou: Pou) -> None:
    """Makes a POU that finds the method count how deep it is called, and take from the budget of loops."""
    span, part = pou.span, report.parts[pou]
    message = f"calls of interfaces nest more than {Layout.DEPTH_LIMIT} deep: an instance leads to itself"
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
        If(((too_deep, halt), (ended, halt)), (), span), *pou.body, Assign(DEPTH, less, span),
    )  # fmt: skip


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
