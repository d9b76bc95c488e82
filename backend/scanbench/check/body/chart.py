"""A sequential function chart -> checked statements: the control of its actions, and its transitions (6.7.4.6 and 6.7.5).

One evaluation: the time of the active steps, the control of every action, the actions that only end, the others, the transitions. What a
transition does counts from the next evaluation on, so every action sees the same steps.
"""

from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial

from scanbench.check.body import fold
from scanbench.check.body.chart_rules import check_chart
from scanbench.check.body.context import Body
from scanbench.check.body.il_operands import hidden
from scanbench.check.body.ladder import Ladder
from scanbench.check.body.network_code import NetworkCode
from scanbench.check.body.objects import own
from scanbench.check.body.places import inside
from scanbench.check.body.short_times import clock
from scanbench.check.context import Rejected
from scanbench.check.declare.scopes import place_of
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, For, If, Load, Place, Stmt
from scanbench.program.sites import TrapKind
from scanbench.program.types import BOOL, ELEMENTARY, INT, Record, Type
from scanbench.syntax import chart, tree
from scanbench.syntax.networks import Rung

TRUE, FALSE = Const(BOOL, 1), Const(BOOL, 0)
TIME = ELEMENTARY["TIME"]


def chart_statements(body: Body, written: chart.Chart) -> tuple[Stmt, ...]:
    """One evaluation of the chart."""
    with suppress(Rejected):  # reported
        check_chart(body, written)
        return ChartCode(body, written).statements()
    return ()


class ChartCode:
    """The code of one chart. What the text does not say has the place of the POU, so no tool takes it for a statement."""

    def __init__(self, body: Body, written: chart.Chart) -> None:
        self._body = body
        self._chart = written
        self._code = NetworkCode(body, written.conditions)
        assert body.pou is not None
        self._made = body.pou.span
        self._steps = {each.name.name.upper(): each for each in written.steps}
        self._uses = chart.uses(written)

    def statements(self) -> tuple[Stmt, ...]:
        self._begin()
        if any(each in chart.TIMED for use in self._uses for each in use.by_qualifier):
            self._set(self._temporary("$now", TIME), clock(self._body, TIME, beyond=True))
        for step in self._steps.values():
            self._when(self._active(step), partial(self._call, step.name, step.span))
        for use in self._uses:
            self._control(use)
        if self._uses:
            self._run_actions()
        self._transitions()
        return self._code.whole()

    # ---- places -----------------------------------------------------------------------------------------------

    def _place(self, name: str) -> Place:
        found = self._body.scope.find(name)
        if found is None:  # its declaration was refused, and reported
            raise Rejected
        member, base, owner = found
        return own(self._body, place_of(member, base, owner, 0))

    def _of(self, name: str, member: str) -> Place:
        place = self._place(name)
        if not isinstance(place.type, Record) or member not in place.type.members:
            raise Rejected
        return inside(place, place.type, place.type.members[member])

    def _kept(self, use: chart.Use, what: str) -> Place:
        return self._place(chart.kept(self._chart, use.name, what))

    def _temporary(self, name: str, type: Type = BOOL) -> Place:
        member = hidden(self._body, name, type, self._made)
        found = self._body.scope.find(member.name)
        assert found is not None
        return place_of(member, found[1], found[2], 0)

    def _step(self, step: chart.Step, member: str) -> Place:
        return self._of(step.name.name, member)

    def _active(self, step: chart.Step) -> Expr:
        return Load(self._step(step, "X"))

    # ---- statements -------------------------------------------------------------------------------------------

    def _set(self, place: Place, value: Expr) -> None:
        self._code.emit(Assign(place, value, self._made))

    def _when(self, condition: Expr, inner: Callable[[], None]) -> None:
        made = self._code.apart(inner)
        if made:
            self._code.emit(If(((condition, made),), (), self._made))

    def _call(self, name: tree.Expression, span: Span) -> None:
        self._body.chart = True
        try:
            self._code.run(tree.ExpressionStatement(tree.Call(name, (), span), span))
        finally:
            self._body.chart = False

    def _begin(self) -> None:
        """The first evaluation begins with the initial steps."""
        started = self._place(chart.begun(self._chart))

        def first() -> None:
            self._set(started, TRUE)
            for step in self._steps.values():
                if step.initial:
                    self._set(self._step(step, "X"), TRUE)

        self._when(fold.unary("not", BOOL, Load(started)), first)

    # ---- actions ----------------------------------------------------------------------------------------------

    def _control(self, use: chart.Use) -> None:
        """Q of the action, whether it runs now, and whether it only ends."""
        active = {name: any_of(self._active(step) for step, _ in pairs) for name, pairs in use.by_qualifier.items()}
        ended = active.get("R", FALSE)
        on = [active["N"]] if "N" in active else []
        for qualifier, memory in (("S", "S"), ("SD", "SD"), ("SL", "SL")):
            if qualifier in active:
                active[qualifier] = self._stored(use, memory, active[qualifier], ended)
        for qualifier in ("L", "D", "SD", "DS", "SL"):
            if qualifier in active:
                over = self._timer(use, qualifier, active[qualifier])
                limited = qualifier in ("L", "SL")
                active[qualifier] = both(active[qualifier], no(over)) if limited else over
        if "DS" in active:
            active["DS"] = self._stored(use, "DS", active["DS"], ended)
        if "P" in active:
            active["P"] = self._rose(use, "P", active["P"])
        on += [active[name] for name in ("S", "L", "D", "P", "SD", "DS", "SL") if name in active]
        first = self._rose(use, "P1", active["P1"]) if "P1" in active else FALSE
        last = self._rose(use, "P0", no(active["P0"]), also_first=False) if "P0" in active else FALSE
        q, before = self._kept(use, "Q"), self._temporary(f"$before.{use.name}")
        self._set(before, Load(q))
        self._set(q, both(any_of(on), no(ended)) if "R" in active else any_of(on))
        fell = both(Load(before), no(Load(q)))
        ends = self._temporary(f"$ends.{use.name}")
        self._note_uses(use)
        self._set(ends, both(any_of((fell, last)), both(no(Load(q)), no(first))))
        if not self._is_variable(use):
            self._set(self._temporary(f"$runs.{use.name}"), any_of((Load(q), Load(ends), first)))

    def _note_uses(self, use: chart.Use) -> None:
        """The action is checked, and known as used, wherever a step names it; it runs at one place."""
        for _, each in (pair for pairs in use.by_qualifier.values() for pair in pairs):
            if each.span is use.first.span:
                continue
            if self._is_variable(use):
                self._body.place(each.action)
            else:
                self._code.apart(partial(self._call, each.action, each.span))

    def _stored(self, use: chart.Use, memory: str, value: Expr, ended: Expr) -> Expr:
        """A flip-flop that the step sets and R clears."""
        place = self._kept(use, memory)
        self._set(place, both(any_of((value, Load(place))), no(ended)))
        return Load(place)

    def _rose(self, use: chart.Use, qualifier: str, value: Expr, also_first: bool = True) -> Expr:
        """Whether the value rose since the last evaluation. P0 keeps the opposite: nothing has ended before the first one."""
        place, rose = self._kept(use, qualifier), self._temporary(f"$rose.{qualifier}.{use.name}")
        if also_first:
            self._set(rose, both(value, no(Load(place))))
            self._set(place, value)
        else:
            self._set(rose, both(value, Load(place)))
            self._set(place, no(value))
        return Load(rose)

    def _timer(self, use: chart.Use, qualifier: str, value: Expr) -> Expr:
        """Whether the time of the association is over that began last."""
        time = chart.kept(self._chart, use.name, f"{qualifier}.time")
        for step, each in use.by_qualifier[qualifier]:
            if each.duration is not None:
                wanted = tree.Assignment(tree.Name(time, each.span), each.duration, self._made)
                self._when(self._active(step), partial(self._code.run, wanted))
        on, since = self._kept(use, f"{qualifier}.on"), self._kept(use, f"{qualifier}.since")
        now = Load(self._temporary("$now", TIME))
        self._when(both(value, no(Load(on))), partial(self._set, since, now))
        self._set(on, value)
        elapsed = fold.binary("sub", TIME, now, Load(since))
        return both(Load(on), fold.compare("ge", TIME, elapsed, Load(self._place(time))))

    def _is_variable(self, use: chart.Use) -> bool:
        if not isinstance(use.first.action, tree.Name):
            return True
        return self._body.scope.find(use.first.action.name) is not None

    def _run_actions(self) -> None:
        """First what only ends, so that what the old step closes can be opened by the new one; then the others."""
        turn = self._temporary("$turn", INT)
        ending = fold.compare("eq", INT, Load(turn), Const(INT, 0))

        def run() -> None:
            for use in self._uses:
                due = fold.compare("eq", BOOL, Load(self._temporary(f"$ends.{use.name}")), ending)
                if self._is_variable(use):
                    self._when(due, partial(self._written, use))
                else:
                    runs = Load(self._temporary(f"$runs.{use.name}"))
                    self._when(both(runs, due), partial(self._call, use.first.action, use.first.span))

        inner = self._code.apart(run)
        trap = self._body.trap(TrapKind.LOOP, self._made, "the actions of the chart do not end")
        self._code.emit(For(turn, Const(INT, 0), Const(INT, 1), Const(INT, 1), inner, False, trap, self._made))

    def _written(self, use: chart.Use) -> None:
        """A Boolean action is its Q, at every evaluation."""
        name = tree.Name(chart.kept(self._chart, use.name, "Q"), use.first.span)
        self._code.run(tree.Assignment(use.first.action, name, use.first.span))

    # ---- transitions ------------------------------------------------------------------------------------------

    def _transitions(self) -> None:
        for step in self._steps.values():
            self._set(self._here(step), self._active(step))
            self._set(self._comes(step), FALSE)
        for each in self._chart.in_order:
            sources = [self._steps[name.name.upper()] for name in each.sources if name.name.upper() in self._steps]
            targets = [self._steps[name.name.upper()] for name in each.targets if name.name.upper() in self._steps]
            if len(sources) != len(each.sources) or len(targets) != len(each.targets):
                continue  # reported
            for name in (*each.sources, *each.targets):
                self._body.place(name)  # it is used here
            enabled: Expr = TRUE
            for step in sources:
                enabled = both(enabled, Load(self._here(step)))
            self._when(enabled, partial(self._test, each, sources, targets))
        for step in self._steps.values():
            comes = Load(self._comes(step))
            self._set(self._step(step, "X"), any_of((Load(self._here(step)), comes)))
            self._when(comes, partial(self._enter, step))

    def _here(self, step: chart.Step) -> Place:
        return self._temporary(f"$here.{step.name.name}")

    def _comes(self, step: chart.Step) -> Place:
        return self._temporary(f"$comes.{step.name.name}")

    def _enter(self, step: chart.Step) -> None:
        """Its time begins with its first evaluation."""
        time = self._step(step, "T")
        self._set(time, Const(TIME, 0))
        self._set(self._step(step, "SEEN"), FALSE)

    def _test(self, each: chart.Transition, sources: list[chart.Step], targets: list[chart.Step]) -> None:
        condition = self._condition(each)
        if condition is None:
            return

        def clear() -> None:
            for step in sources:
                self._set(self._here(step), FALSE)
            for step in targets:
                self._set(self._comes(step), TRUE)

        self._code.emit(If(((condition, self._code.apart(clear)),), (), each.span))

    def _condition(self, each: chart.Transition) -> Expr | None:
        try:
            if isinstance(each.condition, Rung):
                return Ladder(self._code).condition(each.condition)
            if each.condition is None:
                return None
            return self._code.truth(each.condition)
        except Rejected:
            return None


def no(value: Expr) -> Expr:
    return fold.unary("not", BOOL, value)


def both(one: Expr, other: Expr) -> Expr:
    return fold.binary("and", BOOL, one, other)


def any_of(values: Iterable[Expr]) -> Expr:
    found: Expr = FALSE
    for each in values:
        found = each if found == FALSE else fold.binary("or", BOOL, found, each)
    return found
