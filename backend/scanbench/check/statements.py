"""Statements -> checked statements. A rejected statement is left out and the next one is checked all the same."""

from contextlib import suppress

from scanbench.check.calls import CallChecker
from scanbench.check.context import Rejected
from scanbench.check.program import (
    Assign,
    Base,
    CallFunction,
    Case,
    Const,
    Evaluate,
    Exit,
    Expr,
    For,
    If,
    Place,
    Repeat,
    Return,
    SetBytes,
    Stmt,
    TrapKind,
    While,
)
from scanbench.check.scopes import decode, place_of
from scanbench.check.types import BOOL, Elementary, Kind, Record, Section, StringType, has_instance
from scanbench.check.untyped import ANY_INT, bounds, settle
from scanbench.syntax import tree

COUNTED = (Kind.INT, Kind.UINT)


class StatementChecker(CallChecker):
    _counters: list[Place]
    """Control variables of the FOR loops around."""
    _loops: int

    def body(self, statements: tuple[tree.Statement, ...]) -> tuple[Stmt, ...]:
        self._counters, self._loops = [], 0
        return (*self._prologue(), *self.block(statements))

    def _prologue(self) -> list[Stmt]:
        """Temporaries start afresh at every call."""
        frame = self.scope.frame
        made: list[Stmt] = []
        for member in frame.members.values() if frame else ():
            if member.section in (Section.INPUT, Section.IN_OUT) or frame is None:
                continue
            place = place_of(member, Base.FRAME, frame, 0)
            data = member.initial or bytes(member.type.size)
            constant = decode(member.type, data)
            if constant is not None and not isinstance(member.type, StringType):
                made.append(Assign(place, constant, member.span))
            else:
                made.append(SetBytes(place, data, member.span))
        return made

    def block(self, statements: tuple[tree.Statement, ...]) -> tuple[Stmt, ...]:
        made = []
        for statement in statements:
            try:
                checked = self._statement(statement)
            except Rejected:
                continue
            if checked is not None:
                made.append(checked)
        return tuple(made)

    def _statement(self, node: tree.Statement) -> Stmt | None:
        match node:
            case tree.Assignment():
                return self._assign(node)
            case tree.ExpressionStatement():
                return self._expression(node)
            case tree.IfStatement():
                branches = [(self._condition(condition), self.block(body)) for condition, body in node.branches]
                return If(tuple(branches), self.block(node.orelse), node.span)
            case tree.CaseStatement():
                return self._case(node)
            case tree.ForStatement():
                return self._for(node)
            case tree.WhileStatement():
                trap = self.trap(TrapKind.LOOP, node.span, "this WHILE does not end")
                return While(self._condition(node.condition), self._loop(node.body), trap, node.span)
            case tree.RepeatStatement():
                trap = self.trap(TrapKind.LOOP, node.span, "this REPEAT does not end")
                body = self._loop(node.body)
                return Repeat(body, self._condition(node.until), trap, node.span)
            case tree.ExitStatement(span):
                if self._loops == 0:
                    raise self.report.reject("T009", "EXIT stands in no loop; RETURN leaves the POU.", span)
                return Exit(span)
            case tree.ReturnStatement(span):
                return Return(span)

    def _loop(self, body: tuple[tree.Statement, ...]) -> tuple[Stmt, ...]:
        self._loops += 1
        try:
            return self.block(body)
        finally:
            self._loops -= 1

    def _condition(self, node: tree.Expression) -> Expr:
        """The condition; a wrong one is reported and taken as FALSE, so that the body is checked as well."""
        try:
            expr = self.expr(node)
            if isinstance(expr, Const) and expr.type == ANY_INT and expr.value in (0, 1):
                return Const(BOOL, expr.value)
            if expr.type != BOOL:
                raise self.report.reject("T006", f"A condition is BOOL, not {settle(expr).type}.", node.span)
        except Rejected:
            return Const(BOOL, 0)
        return expr

    def _assign(self, node: tree.Assignment) -> Stmt:
        try:
            target = self.target(node.target)
        except Rejected:
            self._try(node.value)
            raise
        if has_instance(target.type):
            raise self.report.reject("T003", "An instance of a function block cannot be assigned.", node.span)
        self._not_counter(target, node)
        value = self.as_type(node.value, target.type, f"`{_shown(node.target)}`")
        return Assign(target, value, node.span)

    def _try(self, node: tree.Expression) -> None:
        with suppress(Rejected):
            self.expr(node)

    def _not_counter(self, target: Place, node: tree.Assignment) -> None:
        for counter in self._counters:
            same = (counter.base, counter.offset, counter.slot, counter.bit)
            if (target.base, target.offset, target.slot, target.bit) == same and target.type == counter.type:
                raise self.report.reject(
                    "T008", f"`{_shown(node.target)}` counts this FOR loop and cannot be assigned in it; use EXIT to leave.",
                    node.span,
                )  # fmt: skip

    def _expression(self, node: tree.ExpressionStatement) -> Stmt | None:
        call = node.expression
        if not isinstance(call, tree.Call):
            self._try(call)
            self.report.warn("W001", "This computes a value and drops it; is an assignment missing?", node.span)
            return None
        if self._is_instance(call.callee):
            return self.call_block(call)
        value = self.call(call)
        if isinstance(value, CallFunction):
            return Evaluate(value, node.span)
        self.report.warn("W001", "The result of this call is dropped.", node.span)
        return None

    def _is_instance(self, callee: tree.Expression) -> bool:
        if isinstance(callee, tree.Name):
            found = self.scope.find(callee.name)
            return found is not None and isinstance(found[0].type, Record)
        return True

    def _case(self, node: tree.CaseStatement) -> Stmt:
        selector = self.value(node.selector)
        type = selector.type
        if not isinstance(type, Elementary) or type.kind not in (*COUNTED, Kind.BITS):
            raise self.report.reject("T002", f"CASE needs an integer, not {type}.", node.selector.span)
        branches = []
        taken: list[tuple[int, int]] = []
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
        for other in taken:
            if low <= other[1] and other[0] <= high:
                raise self.report.reject("T007", f"{max(low, other[0])} is a label already.", first.span)
        taken.append((low, high))
        return low, high

    def _label_value(self, node: tree.Expression, type: Elementary) -> int:
        expr = self.expr(node)
        if not isinstance(expr, Const):
            raise self.report.reject("T007", "A label is a constant.", node.span)
        return int(self._plain_label(expr, type, node).value)

    def _plain_label(self, expr: Const, type: Elementary, node: tree.Expression) -> Const:
        low, high = bounds(type)
        kinds = (*COUNTED, Kind.BITS)
        if not isinstance(expr.type, Elementary) or expr.type.kind not in kinds or isinstance(expr.value, bytes):
            raise self.report.reject("T007", f"A label is {type}, not {settle(expr).type}.", node.span)
        if not low <= expr.value <= high:
            raise self.report.reject(
                "T007", f"{expr.value} can never be reached: {type} is {low} to {high}.", node.span
            )
        return expr

    def _for(self, node: tree.ForStatement) -> Stmt:
        counter = self.target(node.variable)
        type = counter.type
        if not isinstance(type, Elementary) or type.kind not in COUNTED or counter.indices:
            raise self.report.reject(
                "T008", f"FOR counts with a plain integer variable, not {type}.", node.variable.span
            )
        for outer in self._counters:
            if (outer.base, outer.offset, outer.slot) == (counter.base, counter.offset, counter.slot):
                raise self.report.reject("T008", "This variable counts a loop around already.", node.variable.span)
        start = self.as_type(node.start, type, "The start value")
        end = self.as_type(node.end, type, "The end value")
        step = Const(type, 1) if node.step is None else self._step(node.step, type)
        trap = self.trap(TrapKind.LOOP, node.span, "this FOR has more rounds than a scan may take")
        self._counters.append(counter)
        body = self._loop(node.body)
        self._counters.pop()
        return For(counter, start, end, step, body, _leaves(body, outer=True), trap, node.span)

    def _step(self, node: tree.Expression, type: Elementary) -> Expr:
        step = self.as_type(node, type, "The step")
        if isinstance(step, Const) and step.value == 0:
            raise self.report.reject("T008", "A step of 0 never ends.", node.span)
        return step


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


def _shown(node: tree.Expression) -> str:
    match node:
        case tree.Name(name):
            return name
        case tree.MemberOf(owner, name):
            return f"{_shown(owner)}.{name}"
        case tree.IndexOf(array):
            return f"{_shown(array)}[...]"
        case tree.DirectAddress(text):
            return text
    return "the target"
