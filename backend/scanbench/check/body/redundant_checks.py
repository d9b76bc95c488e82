"""Which subrange checks of a body are needless, because of what went before in straight-line code.

A variable that was assigned with a check, and not touched since, holds a value that is inside. One that was read with a
check, and not touched since, is brought to its bounds again, but not recorded a second time. Facts live until something
may have changed the variable; where ways meet, what all of them know; a loop begins and ends with none.
"""

from dataclasses import dataclass, replace

from scanbench.check.body.harmless import harmless
from scanbench.check.body.true_values import value_range
from scanbench.check.context import Report
from scanbench.program.bodies import every
from scanbench.program.program import (
    Assign,
    Binary,
    Blocks,
    CallBlock,
    CallFunction,
    Case,
    Compare,
    Const,
    Continue,
    Convert,
    Evaluate,
    Expr,
    For,
    If,
    Index,
    Intrinsic,
    Limit,
    Load,
    Place,
    RefOf,
    Repeat,
    Sequence,
    SetBytes,
    Stmt,
    Try,
    Unary,
    Violates,
    While,
)
from scanbench.program.types import Elementary, Subrange

Key = tuple[object, ...]
LARGEST = 40
"""Statements of a loop that is compiled in two versions."""


@dataclass(frozen=True, slots=True)
class Fact:
    """What is known of a variable: it was assigned in range, or only looked at, in this line."""

    assigned: bool
    line: int
    low: int
    high: int
    variable: str


Facts = dict[Key, Fact]


def without_needless(report: Report, body: tuple[Stmt, ...]) -> tuple[Stmt, ...]:
    """The body without the checks that can be left out; the report says why, at each."""
    return _Needless(report).block(body)


class _Needless:
    def __init__(self, report: Report, facts: Facts | None = None, tries: bool = False) -> None:
        """`tries`: what is found is not told."""
        self.report, self._tries = report, tries
        self.facts: Facts = facts or {}
        self.checked: dict[Key, Limit] = {}
        """The first check of each variable that was read before anything was known of it."""

    # ---- statements -------------------------------------------------------------------------------------

    def block(self, body: tuple[Stmt, ...]) -> tuple[Stmt, ...]:
        return tuple(self.statement(each) for each in body)

    def statement(self, node: Stmt) -> Stmt:
        match node:
            case Assign():
                return self.assign(node)
            case SetBytes(target):
                made = replace(node, target=self.place(target))
                self.forget(target)
                return made
            case Evaluate(call):
                value = self.call(call)
                return replace(node, call=value)
            case CallBlock():
                return self.call_block(node)
            case If():
                return self.choose(node)
            case Case(selector, branches, orelse):
                selector = self.expr(selector)
                *bodies, last = self.ways([*(body for _, body in branches), orelse])
                kept = tuple((labels, body) for (labels, _), body in zip(branches, bodies, strict=True))
                return replace(node, selector=selector, branches=kept, orelse=last)
            case For() | While() | Repeat():
                return self.loop(node)
            case Blocks(blocks):
                return replace(node, blocks=tuple(self.alone(block) for block in blocks))
            case Try(body, handler=handler, final=final):
                body, handler, final = (self.alone(each) for each in (body, handler, final))
                return replace(node, body=body, handler=handler, final=final)
        return node  # EXIT, CONTINUE, RETURN, a jump

    def alone(self, body: tuple[Stmt, ...]) -> tuple[Stmt, ...]:
        """Statements that are come to from anywhere, and left to anywhere."""
        self.facts = {}
        made = self.block(body)
        self.facts = {}
        return made

    def assign(self, node: Assign) -> Stmt:
        value, target = self.expr(node.value), self.place(node.target)
        self.forget(target)
        if isinstance(target.type, Subrange):
            low, high = value_range(value)
            key = _key(target)
            if key is not None and target.type.low <= low and high <= target.type.high:
                self.facts[key] = Fact(True, node.span.line, target.type.low, target.type.high, target.variable)
        return replace(node, value=value, target=target)

    def call_block(self, node: CallBlock) -> CallBlock:
        instance = self.place(node.instance)
        inputs = tuple((place, self.expr(value)) for place, value in node.inputs)
        self.facts = {}
        return replace(node, instance=instance, inputs=inputs)

    def choose(self, node: If) -> If:
        ends: list[Facts] = []
        branches = []
        for condition, body in node.branches:
            condition = self.expr(condition)
            before = dict(self.facts)
            branches.append((condition, self.block(body)))
            ends.append(self.facts)
            self.facts = before
        orelse = self.block(node.orelse)
        self.facts = _common([*ends, self.facts])
        return replace(node, branches=tuple(branches), orelse=orelse)

    def ways(self, bodies: list[tuple[Stmt, ...]]) -> list[tuple[Stmt, ...]]:
        """Each from the same facts; afterwards what all of them leave."""
        before, ends, made = self.facts, [], []
        for body in bodies:
            self.facts = dict(before)
            made.append(self.block(body))
            ends.append(self.facts)
        self.facts = _common(ends)
        return made

    def loop(self, node: For | While | Repeat) -> Stmt:
        if isinstance(node, For):
            start = self.expr(node.start)
            self.facts = {} if node.again else self.facts
            end, step = self.expr(node.end), self.expr(node.step)
            self.facts = {}
            given, inside = ((), ()) if self._tries or node.follows or node.again else self.versions(node)
            made: Stmt = replace(
                node, start=start, end=end, step=step, body=self.block(node.body), given=given, inside=inside
            )
        elif isinstance(node, While):
            self.facts = {}
            condition = self.expr(node.condition)
            made = replace(node, condition=condition, body=self.block(node.body))
        else:
            self.facts = {}
            body = self.block(node.body)
            self.facts = {}  # CONTINUE comes here as well
            made = replace(node, body=body, until=self.expr(node.until))
        self.facts = {}
        return made

    def versions(self, node: For) -> tuple[tuple[tuple[Place, int, int], ...], tuple[Stmt, ...]]:
        """The variables that are between their bounds in every round if they are as the loop begins, and its body for that case: none
        of the checks of them is needed there."""
        nested = tuple(every(node.body))
        if len(nested) > LARGEST or any(isinstance(each, Continue | For | While | Repeat) for each in nested):
            return (), ()
        if not all(harmless(each) for each in (node.start, node.end, node.step)):
            return (), ()
        first = _Needless(self.report, tries=True)
        first.block(node.body)
        tried = first.checked
        while tried:
            facts = {key: Fact(True, 0, each.low, each.high, _variable(each)) for key, each in tried.items()}
            again = _Needless(self.report, facts, tries=True)
            again.forget(node.variable)
            began = set(again.facts)
            inside = again.block(node.body)
            kept = {key: each for key, each in tried.items() if key in began and _keeps(again.facts.get(key), each)}
            if len(kept) == len(tried):
                return tuple((_place(each), each.low, each.high) for each in tried.values()), inside
            tried = kept
        return (), ()

    # ---- expressions ------------------------------------------------------------------------------------

    def expr(self, node: Expr) -> Expr:
        match node:
            case Limit():
                return self.limit(node)
            case Load(place):
                return replace(node, place=self.place(place))
            case Unary(operand=operand) | Convert(operand=operand):
                return replace(node, operand=self.expr(operand))
            case Binary(left=left, right=right) | Compare(left=left, right=right):
                left = self.expr(left)
                return replace(node, left=left, right=self.expr(right))
            case Intrinsic(args=args):
                return replace(node, args=tuple(self.expr(arg) for arg in args))
            case CallFunction():
                return self.call(node)
            case RefOf(place):
                return replace(node, place=self.place(place))
            case Violates(value=value):
                return replace(node, value=self.expr(value))
            case Sequence(body, value):
                body = self.block(body)
                return Sequence(body, self.expr(value))
            case Const():
                return node
        raise AssertionError(node)

    def call(self, node: CallFunction) -> CallFunction:
        args = tuple(
            self.place(arg) if isinstance(arg, Place) else None if arg is None else self.expr(arg) for arg in node.args
        )
        self.facts = {}
        return replace(node, args=args)

    def limit(self, node: Limit) -> Expr:
        value = self.expr(node.value)
        # of a plain variable that is assigned to two with a subrange, each has a violation of its own
        own = isinstance(value, Load) and isinstance(value.place.type, Subrange)
        key = _key(value.place) if own and isinstance(value, Load) else None
        if key is None or not isinstance(value, Load) or not node.site:
            return replace(node, value=value)
        fact = self.facts.get(key)
        if fact is None or not (node.low <= fact.low and fact.high <= node.high):
            self.checked.setdefault(key, node)
            line = self.report.checks[node.site - 1].span.line
            self.facts[key] = Fact(False, line, node.low, node.high, value.place.variable)
            return replace(node, value=value)
        how = "assigned with a check" if fact.assigned else "checked already"
        if not self._tries:
            self.report.needless(node.site, f"{how} in line {fact.line}")
        if fact.assigned:
            return replace(node, value=value, site=0)
        low, high = Const(node.type, node.low), Const(node.type, node.high)
        return Intrinsic("MIN", node.type, (Intrinsic("MAX", node.type, (value, low)), high))

    def place(self, node: Place) -> Place:
        if node.reference is None and not node.indices and node.slot is None:
            return node
        reference = None if node.reference is None else self.expr(node.reference)
        slot = None if node.slot is None else self.place(node.slot)
        indices = tuple(self.index(index) for index in node.indices)
        return replace(node, reference=reference, slot=slot, indices=indices)

    def index(self, node: Index) -> Index:
        return replace(node, value=self.expr(node.value))

    def forget(self, target: Place) -> None:
        """What a write to this place may have changed."""
        name = target.variable
        if name == "" or not isinstance(target.type, Elementary):
            self.facts = {}
            return
        area = name.startswith("@")
        self.facts = {
            key: fact
            for key, fact in self.facts.items()
            if fact.variable and fact.variable != name and not (area and fact.variable.startswith("@"))
        }


def _place(check: Limit) -> Place:
    assert isinstance(check.value, Load)
    return replace(check.value.place, type=check.type)


def _variable(check: Limit) -> str:
    return _place(check).variable


def _keeps(fact: Fact | None, check: Limit) -> bool:
    return fact is not None and fact.assigned and check.low <= fact.low and fact.high <= check.high


def _key(place: Place) -> Key | None:
    """Names a variable that is found at the same place every time; None where that may change."""
    if place.indices or place.reference is not None:
        return None
    slot = place.slot
    if slot is not None and (slot.indices or slot.slot is not None or slot.reference is not None):
        return None
    where = None if slot is None else (slot.base, slot.offset)
    return place.base, place.offset, place.bit, where


def _common(ends: list[Facts]) -> Facts:
    first, *others = ends
    return {key: fact for key, fact in first.items() if all(other.get(key) == fact for other in others)}
