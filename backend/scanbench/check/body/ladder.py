"""Rungs -> checked statements, one an element, so that every rule of ST holds for ladder diagrams by itself.

The power that reaches an element is a hidden temporary that the element before it has set; at the rail it is TRUE.
"""

from contextlib import suppress
from dataclasses import replace

from scanbench.check.body import fold, statements
from scanbench.check.body.coercion import as_type
from scanbench.check.body.context import Body
from scanbench.check.body.enabling import Enabling, enabled, enabling
from scanbench.check.body.il_operands import hidden
from scanbench.check.context import Rejected
from scanbench.problems import Span
from scanbench.program.program import Assign, Blocks, Expr, If, Jump, Load, Return, Stmt
from scanbench.program.sites import TrapKind
from scanbench.program.types import BOOL
from scanbench.syntax import networks, tree

RAIL = None
"""The power at the left rail."""
Power = tree.Name | None


class Ended(Exception):
    """A path ended with a jump or a link: no power comes out of it."""


class Ladder:
    """One body of rungs."""

    def __init__(self, body: Body, written: networks.NetworkBody) -> None:
        self._body = body
        self._report = body.report
        self._written = written
        self._memories = {id(each): name for each, name in networks.edges(written)}
        self._blocks: list[list[Stmt]] = [[]]
        self._labels: dict[str, int] = {}
        self._count = 0
        """Temporaries of the rung."""
        self._sent: set[str] = set()
        """Links of the rung that have their power, in upper case."""
        self._leaving: list[tuple[networks.Leave, Power]] = []

    def statements(self) -> tuple[Stmt, ...]:
        """The statements of the body; with labels, one `Blocks`."""
        self._find_labels()
        for rung in self._written.networks:
            if rung.label:
                self._blocks.append([])
            if not rung.off:
                self._rung(rung)
        if len(self._blocks) == 1:
            return tuple(self._blocks[0])
        return (Blocks(tuple(tuple(block) for block in self._blocks), self._written.span),)

    def _find_labels(self) -> None:
        labelled = [rung for rung in self._written.networks if rung.label]
        for number, rung in enumerate(labelled, 1):
            if rung.label.upper() in self._labels:
                self._report.error("D001", f"The label `{rung.label}` is there already; rename one.", rung.span)
            self._labels.setdefault(rung.label.upper(), number)

    def _rung(self, rung: networks.Rung) -> None:
        self._count, self._leaving = 0, []
        self._sent.clear()
        with suppress(Ended):
            self._path(rung.path, RAIL, used=False)
        # a network is complete only when all its elements are (8.1.5)
        for leave, power in self._leaving:
            try:
                self._leave(leave, power)
            except Rejected:
                continue

    def _path(self, path: networks.Path, power: Power, used: bool) -> Power:
        """The power at the end of a path; `used` says whether anything takes it."""
        for number, each in enumerate(path):
            try:
                power = self._element(each, power, used or number + 1 < len(path))
            except Rejected:
                continue
        return power

    def _element(self, each: networks.Element, power: Power, used: bool) -> Power:
        match each:
            case networks.Contact():
                return self._contact(each, power)
            case networks.Coil():
                self._coil(each, power)
                return power
            case networks.Box():
                return self._box(each, power)
            case networks.Parallel():
                return self._parallel(each, power, used)
            case networks.Link():
                return self._link(each, power)
            case networks.Leave():
                self._leaving.append((each, power if power is RAIL else self._note(self._load(power), each.span)))
                raise Ended

    # ---- what the elements share ------------------------------------------------------------------------------------

    def _emit(self, statement: Stmt | None) -> None:
        if statement is not None:
            self._blocks[-1].append(statement)

    def _run(self, node: tree.Statement) -> None:
        self._emit(statements.statement(self._body, node))

    def _note(self, value: Expr, span: Span) -> tree.Name:
        """Keeps a BOOL for what comes after it."""
        self._count += 1
        name = tree.Name(hidden(self._body, f"$power{self._count}", BOOL, span).name, span)
        self._emit(Assign(self._body.place(name)[0], value, span))
        return name

    def _load(self, name: tree.Name) -> Expr:
        return Load(self._body.place(name)[0])

    def _with(self, power: Power, value: Expr) -> Expr:
        return value if power is RAIL else fold.binary("and", BOOL, self._load(power), value)

    def _value(self, power: Power, span: Span) -> tree.Expression:
        """The power as an expression of the tree."""
        return tree.Literal("bool", 1, None, span) if power is RAIL else tree.Name(power.name, span)

    def _memory(self, each: networks.Contact | networks.Coil) -> tree.Name:
        pou = self._body.pou
        if pou is None or pou.kind not in ("program", "function_block"):
            what = "contact" if isinstance(each, networks.Contact) else "coil"
            raise self._report.reject(
                "T010",
                f"An edge {what} remembers the last evaluation, and a FUNCTION or METHOD keeps nothing; use R_TRIG or F_TRIG of the caller.",
                each.span,
            )
        return tree.Name(self._memories[id(each)], each.span)

    # ---- elements ---------------------------------------------------------------------------------------------------

    def _contact(self, each: networks.Contact, power: Power) -> Power:
        value = as_type(self._body, each.operand, BOOL, "A contact")
        if each.mode == "/":
            value = fold.unary("not", BOOL, value)
        if each.mode in ("", "/"):
            return self._note(self._with(power, value), each.span)
        memory = self._memory(each)
        now = self._note(value, each.span)
        risen = self._edge(self._load(now), self._load(memory), each.mode)
        out = self._note(self._with(power, risen), each.span)
        self._emit(Assign(self._body.place(memory)[0], self._load(now), each.span))
        return out

    def _edge(self, now: Expr, before: Expr, mode: str) -> Expr:
        """Whether it rose (P) or fell (N)."""
        first, second = (now, before) if mode == "P" else (before, now)
        return fold.binary("and", BOOL, first, fold.unary("not", BOOL, second))

    def _coil(self, each: networks.Coil, power: Power) -> None:
        value = self._value(power, each.span)
        if each.mode in ("S", "R"):
            self._run(tree.Assignment(each.target, value, each.span, f"{each.mode}="))
        elif each.mode in ("", "/"):
            value = tree.UnaryOp("not", value, each.span) if each.mode == "/" else value
            self._run(tree.Assignment(each.target, value, each.span))
        else:
            memory = self._memory(each)
            first, second = (value, memory) if each.mode == "P" else (memory, value)
            edge = tree.BinaryOp("and", first, tree.UnaryOp("not", second, each.span), each.span)
            self._run(tree.Assignment(each.target, edge, each.span))
            self._run(tree.Assignment(memory, value, each.span))

    def _parallel(self, each: networks.Parallel, power: Power, used: bool) -> Power:
        ends: list[Power] = []
        for branch in each.branches:
            try:
                ends.append(self._path(branch, power, used))
            except Ended:
                continue
        if not ends:
            raise Ended
        if not used or RAIL in ends:
            return RAIL if RAIL in ends else power
        joined = self._load(ends[0]) if ends[0] else None
        for end in ends[1:]:
            if joined is not None and end is not None:
                joined = fold.binary("or", BOOL, joined, self._load(end))
        return power if joined is None else self._note(joined, each.span)

    def _link(self, each: networks.Link, power: Power) -> Power:
        wire = self._wire(each.name, each.span)
        if each.sends:
            if each.name.upper() in self._sent:
                raise self._report.reject("D001", f"`#{each.name}` has its power already; rename one.", each.span)
            self._sent.add(each.name.upper())
            self._run(tree.Assignment(wire, self._value(power, each.span), each.span))
            raise Ended
        if each.name.upper() not in self._sent:
            raise self._report.reject(
                "T001", f"Nothing sends its power to `#{each.name}` above in this rung; write `-> #{each.name}`.",
                each.span,
            )  # fmt: skip
        return self._note(self._with(power, self._load(wire)), each.span)

    def _wire(self, name: str, span: Span) -> tree.Name:
        return tree.Name(hidden(self._body, f"$wire.{name}", BOOL, span).name, span)

    def _leave(self, each: networks.Leave, power: Power) -> None:
        taken: Stmt = Return(each.span)
        if each.label:
            target = self._labels.get(each.label.upper())
            if target is None:
                names = [rung.label for rung in self._written.networks if rung.label]
                hint = self._report.near(each.label, lambda: names, "label")
                raise self._report.reject("T001", f"There is no label `{each.label}` to jump to.{hint}", each.span)
            trap = self._body.trap(TrapKind.LOOP, each.span, f"the jumps to {each.label} do not end")
            taken = Jump(target, target < len(self._blocks), trap, each.span)
        self._emit(taken if power is RAIL else If(((self._load(power), (taken,)),), (), each.span))

    # ---- boxes ------------------------------------------------------------------------------------------------------

    def _box(self, each: networks.Box, power: Power) -> Power:
        branched = any(isinstance(argument, networks.Branch) for argument in each.arguments)
        # what is inside of an argument runs first, and the text goes on after it
        span = each.after if branched else each.span
        arguments = tuple(self._argument(argument, power) for argument in each.arguments)
        call = tree.Call(each.callee, arguments, span)
        apart = enabling(call)
        if apart.en is not None or apart.eno is not None or each.output.upper() == "ENO":
            return self._enabled(each, call, power, span)
        if each.result is None:
            self._run(tree.ExpressionStatement(call, span))
        else:
            self._run(tree.Assignment(each.result, call, span))
        if not each.output:
            return power
        output = tree.MemberOf(each.callee, each.output, each.after)
        return self._note(as_type(self._body, output, BOOL, "The power after a box"), span)

    def _enabled(self, each: networks.Box, call: tree.Call, power: Power, span: Span) -> Power:
        """With EN or ENO: without power nothing is called and nothing is written."""
        apart, self._count = enabling(call), self._count + 1
        ok = tree.Name(hidden(self._body, f"$ok{self._count}", BOOL, span).name, span)
        own = replace(apart, eno=tree.Argument("ENO", True, ok, span))
        if each.result is None:
            given = tuple(argument for argument in (own.en, own.eno) if argument is not None)
            called = replace(own.call, arguments=(*given, *own.call.arguments))
            self._run(tree.ExpressionStatement(called, span))
        else:
            self._result(each.result, own, ok, span)
        if apart.eno is not None and apart.eno.value is not None:
            self._run(tree.Assignment(apart.eno.value, ok, apart.eno.span))
        if each.output and each.output.upper() != "ENO":
            output = tree.MemberOf(each.callee, each.output, each.after)
            return self._note(self._with(ok, as_type(self._body, output, BOOL, "The power after a box")), span)
        return ok if each.output else power

    def _result(self, target: tree.Expression, apart: Enabling, ok: tree.Name, span: Span) -> None:
        """Writes the result of an enabled call, where it worked."""
        run, value = enabled(self._body, apart, None)
        if value is None or value.type is None:
            raise self._report.reject("T002", "This gives no value, so nothing can be assigned.", span)
        for statement in run:
            self._emit(statement)
        made = tree.Name(hidden(self._body, f"$result.{value.type}", value.type, span).name, span)
        self._emit(Assign(self._body.place(made)[0], value, span))
        self._run(tree.IfStatement(((ok, (tree.Assignment(target, made, span),)),), (), span))

    def _argument(self, each: tree.Argument | networks.Branch, power: Power) -> tree.Argument:
        if isinstance(each, networks.Branch):
            value = self._value(self._path((each.parallel,), RAIL, used=True), each.span)
            return tree.Argument(each.name, False, value, each.span)
        if isinstance(each.value, tree.Name):
            if each.value.name == networks.POWER:
                return replace(each, value=self._value(power, each.span))
            if each.value.name.startswith(networks.WIRE):
                name = each.value.name.removeprefix(networks.WIRE)
                self._sent.add(name.upper())
                return replace(each, value=self._wire(name, each.span))
        return each
