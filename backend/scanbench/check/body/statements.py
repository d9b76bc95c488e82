"""Statements -> checked statements. A rejected statement is left out and the next one is checked all the same."""

from bisect import bisect
from dataclasses import replace

from scanbench.check.body.assignments import AssignmentChecker
from scanbench.check.body.by_value import around
from scanbench.check.body.edges import edges
from scanbench.check.body.il import InstructionList
from scanbench.check.body.notes import SUFFIX as NOTE
from scanbench.check.body.redundant_checks import without_needless
from scanbench.check.context import Rejected
from scanbench.check.declare.scopes import decode, place_of
from scanbench.program.program import (
    Assign,
    Base,
    Case,
    Const,
    Continue,
    Exit,
    Expr,
    For,
    If,
    Limit,
    Repeat,
    Return,
    SetBytes,
    Stmt,
    TrapKind,
    While,
)
from scanbench.program.shown import shown
from scanbench.program.types import (
    Elementary,
    Enumeration,
    Kind,
    Member,
    Section,
    StringType,
    Subrange,
    base_of,
)
from scanbench.program.untyped import bounds, settle
from scanbench.syntax import tree

COUNTED = (Kind.INT, Kind.UINT)


class StatementChecker(AssignmentChecker):
    _loops: int

    def body(self, body: tuple[tree.Statement, ...] | tree.IlBody) -> tuple[Stmt, ...]:
        """The body of a POU, in ST or IL."""
        self._counters, self._loops = [], 0
        prologue, checks = self._prologue(), len(self.report.checks)
        if self.pou is not None and self.pou.kind != "function":
            prologue += edges(self.pou.instance)
        made = InstructionList(self, body).statements() if isinstance(body, tree.IlBody) else self.block(body)
        if len(self.report.checks) > checks:
            made = without_needless(self.report, tuple(made))
        if self.pou is not None and self.pou.kind == "function_block":
            made = around(self.pou.instance, tuple(made), self._not_connected)
        return (*prologue, *made)

    def _not_connected(self, member: Member) -> int:
        return self.trap(TrapKind.NULL, member.span, f"the in-out {member.name} is not connected")

    def _prologue(self) -> list[Stmt]:
        """Temporaries start afresh at every call."""
        frame = self.scope.frame
        made: list[Stmt] = []
        for member in frame.members.values() if frame else ():
            made_up = member.hidden and not member.name.endswith(NOTE)
            if member.section in (Section.INPUT, Section.IN_OUT) or frame is None or made_up:
                continue
            place = place_of(member, Base.FRAME, frame, 0)
            data = member.initial or bytes(member.type.size)
            constant = decode(member.type, data)
            if constant is not None and not isinstance(member.type, StringType):
                made.append(Assign(place, constant, member.span))
            else:
                made.append(SetBytes(place, data, member.span))
        instance = self.scope.instance
        if self.pou is not None and self.pou.kind == "function_block" and instance is not None:
            # what this block wrote to an in-out at an earlier call says nothing of what is bound to it now
            for each in instance.members.values():
                if each.section is Section.IN_OUT and each.note is not None:
                    made.append(SetBytes(place_of(each.note, Base.SELF, instance, 0), each.note.initial, each.span))
        return made

    def block(self, statements: tuple[tree.Statement, ...]) -> tuple[Stmt, ...]:
        """Statements one after the other."""
        made = []
        for statement in statements:
            try:
                checked = self.statement(statement)
            except Rejected:
                continue
            if checked is not None:
                made.append(checked)
        return tuple(made)

    def statement(self, node: tree.Statement) -> Stmt | None:
        """One statement; None for one that has no effect."""
        match node:
            case tree.Assignment():
                return self.assign(node)
            case tree.ExpressionStatement():
                return self._expression(node)
            case tree.IfStatement():
                branches = [(self.condition(condition), self.block(body)) for condition, body in node.branches]
                return If(tuple(branches), self.block(node.orelse), node.span)
            case tree.CaseStatement():
                return self._case(node)
            case tree.ForStatement():
                return self._for(node)
            case tree.WhileStatement():
                trap = self.trap(TrapKind.LOOP, node.span, "this WHILE does not end")
                return While(self.condition(node.condition), self._loop(node.body), trap, node.span)
            case tree.RepeatStatement():
                trap = self.trap(TrapKind.LOOP, node.span, "this REPEAT does not end")
                body = self._loop(node.body)
                return Repeat(body, self.condition(node.until), trap, node.span)
            case tree.ExitStatement(span):
                if self._loops == 0:
                    raise self.report.reject("T009", "EXIT stands in no loop; RETURN leaves the POU.", span)
                return Exit(span)
            case tree.ContinueStatement(span):
                if self._loops == 0:
                    raise self.report.reject("T009", "CONTINUE stands in no loop; RETURN leaves the POU.", span)
                return Continue(span)
            case tree.ReturnStatement(span):
                return Return(span)

    def _loop(self, body: tuple[tree.Statement, ...]) -> tuple[Stmt, ...]:
        self._loops += 1
        try:
            return self.block(body)
        finally:
            self._loops -= 1

    def _expression(self, node: tree.ExpressionStatement) -> Stmt | None:
        call = node.expression
        if not isinstance(call, tree.Call):
            try:
                self.expr(call)
            finally:
                self.report.warn("W001", "This computes a value and drops it; is an assignment missing?", node.span)
            return None
        return self.call_statement(call)

    def _case(self, node: tree.CaseStatement) -> Stmt:
        selector = self.value(node.selector)
        type = selector.type
        if not isinstance(type, Elementary) or type.kind not in (*COUNTED, Kind.BITS):
            raise self.report.reject(
                "T002", f"CASE needs an integer or an enumeration, not {type}.", node.selector.span
            )
        branches = []
        taken: list[tuple[int, int]] = []  # in order
        for labels, body in node.branches:
            ranges = []
            for first, last in labels:
                try:
                    ranges.append(self._label(first, last, type, taken))
                except Rejected:
                    continue
            branches.append((tuple(ranges), self.block(body)))
        return Case(selector, tuple(branches), self.block(node.orelse), node.span)

    def _label(
        self, first: tree.Expression, last: tree.Expression | None, type: Elementary, taken: list[tuple[int, int]]
    ) -> tuple[int, int]:
        low = self._label_value(first, type)
        high = low if last is None else self._label_value(last, type)
        if low > high:
            raise self.report.reject("T007", f"The range {low}..{high} is empty.", first.span)
        at = bisect(taken, (low, high))
        for other in taken[max(at - 1, 0) : at + 1]:
            if low <= other[1] and other[0] <= high:
                number = max(low, other[0])
                raise self.report.reject("T007", f"{_named(number, type)} is a label already.", first.span)
        taken.insert(at, (low, high))
        return low, high

    def _label_value(self, node: tree.Expression, type: Elementary) -> int:
        expr = self.expr(node, type)
        if not isinstance(expr, Const):
            raise self.report.reject("T007", "A label is a constant.", node.span)
        return int(self._plain_label(expr, type, node).value)

    def _plain_label(self, expr: Const, type: Elementary, node: tree.Expression) -> Const:
        other = expr.type
        kinds = (*COUNTED, Kind.BITS)
        if not isinstance(other, Elementary) or other.kind not in kinds or isinstance(expr.value, bytes):
            raise self.report.reject("T007", f"A label is {type}, not {settle(expr).type}.", node.span)
        if isinstance(other, Enumeration) and isinstance(type, Enumeration) and other != type:
            raise self.report.reject("T007", f"A label is a value of {type}, not of {other}.", node.span)
        low, high = bounds(type)
        if not low <= expr.value <= high:
            raise self.report.reject(
                "T007", f"{expr.value} can never be reached: {type} is {low} to {high}.", node.span
            )
        return expr

    # ---- FOR --------------------------------------------------------------------------------------------

    def _for(self, node: tree.ForStatement) -> Stmt:
        counter = self.target(node.variable)
        type = counter.type
        plain = isinstance(type, Elementary) and type.kind in COUNTED and not isinstance(type, Enumeration)
        if not plain or counter.indices or counter.reference is not None:
            raise self.report.reject(
                "T008", f"FOR counts with a plain integer variable, not {type}.", node.variable.span
            )
        assert isinstance(type, Elementary)
        for outer in self._counters:
            if (outer.base, outer.offset, outer.slot) == (counter.base, counter.offset, counter.slot):
                raise self.report.reject("T008", "This variable counts a loop around already.", node.variable.span)
        base = base_of(type)
        start = self.as_type(node.start, type, "The start value" if type is base else f"`{shown(node.variable)}`")
        end = self.as_type(node.end, base, "The end value")
        step = Const(base, 1) if node.step is None else self._step(node.step, base)
        if isinstance(type, Subrange):
            end = self._for_end(node, type, end, step)
        trap = self.trap(TrapKind.LOOP, node.span, "this FOR has more rounds than a scan may take")
        self._counters.append(counter)
        body = self._loop(node.body)
        self._counters.pop()
        limits = (type.low, type.high) if isinstance(type, Subrange) else None
        return For(counter, start, end, step, body, _leaves(body, outer=True), trap, node.span, limits)

    def _for_end(self, node: tree.ForStatement, type: Subrange, end: Expr, step: Expr) -> Expr:
        """The end value of a counter with a subrange, which the counter must not pass; short of it, no round is run."""
        if not isinstance(step, Const):
            raise self.report.reject(
                "T008", "The step of a counter with a subrange is a constant.", (node.step or node.end).span
            )
        low, high = bounds(base_of(type))
        upward = _whole(step) > 0
        if isinstance(end, Const) and (_whole(end) > type.high if upward else _whole(end) < type.low):
            raise self.report.reject(
                "S004", f"{end.value!r} is outside of {type.low}..{type.high}, so `{shown(node.variable)}` would leave it.",
                node.end.span,
            )  # fmt: skip
        reach = replace(type, low=low) if upward else replace(type, high=high)
        made = self.into(end, reach, node.end.span, shown(node.variable))
        if isinstance(made, Limit):
            sites = self.report.checks
            sites[made.site - 1] = replace(sites[made.site - 1], low=type.low, high=type.high)
        return made

    def _step(self, node: tree.Expression, type: Elementary) -> Expr:
        step = self.as_type(node, type, "The step")
        if isinstance(step, Const) and step.value == 0:
            raise self.report.reject("T008", "A step of 0 never ends.", node.span)
        return step


def _whole(constant: Const) -> int:
    assert isinstance(constant.value, int)
    return constant.value


def _named(number: int, type: Elementary) -> str:
    """A label for people: the name that an enumeration has for it."""
    names = [name for name, value in type.values if value == number] if isinstance(type, Enumeration) else []
    return f"`{names[0]}`" if names else str(number)


def _leaves(body: tuple[Stmt, ...], outer: bool) -> bool:
    """Whether the loop around this body can end before its count: by its own EXIT, or by RETURN."""
    for statement in body:
        match statement:
            case Exit():
                if outer:
                    return True
            case Return():
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
    return False
