"""Rungs -> checked statements, one an element, so that every rule of ST holds for ladder diagrams by itself.

The power that reaches an element is a hidden temporary that the element before it has set; at the rail it is TRUE.
"""

from contextlib import suppress
from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.callees import called_by
from scanbench.check.body.coercion import as_type
from scanbench.check.body.enabling import enabling, told
from scanbench.check.body.network_code import NetworkCode
from scanbench.check.context import Rejected
from scanbench.problems import Span
from scanbench.program.program import Const, Expr
from scanbench.program.types import BOOL
from scanbench.syntax import networks, tree

RAIL = None
"""The power at the left rail."""
Power = tree.Name | None


class Ended(Exception):
    """A path ended with a jump or a link: no power comes out of it."""


class Ladder:
    """The rungs of one body."""

    def __init__(self, code: NetworkCode) -> None:
        self._code = code
        self._body = code.body
        self._report = code.report
        self._sent: set[str] = set()
        """Links of the rung that have their power, in upper case."""

    def rung(self, rung: networks.Rung) -> None:
        self._sent.clear()
        with suppress(Ended):
            self._path(rung.path, RAIL, used=False)

    def condition(self, rung: networks.Rung) -> Expr:
        """The power at the end of a rung: the condition of a transition."""
        self._sent.clear()
        for each in networks.elements(rung.path):
            if isinstance(each, networks.Leave):
                raise self._report.reject(
                    "T010",
                    "The rung of a condition only gives power; a jump or RETURN in it has nowhere to go.",
                    each.span,
                )
        with suppress(Ended):
            power = self._path(rung.path, RAIL, used=True)
            return Const(BOOL, 1) if power is RAIL else self._code.load(power)
        raise self._report.reject(
            "T010", "A condition is the power at the end of its rung; this one ends elsewhere.", rung.span
        )

    def _path(self, path: networks.Path, power: Power, used: bool) -> Power:
        """The power at the end of a path; `used` says whether anything takes it."""
        for number, each in enumerate(path):
            try:
                power = self._element(each, power, used or number + 1 < len(path))
            except Rejected:
                continue
            except Ended:
                if number + 1 == len(path):
                    raise
                power = self._no_power("this", path[number + 1].span)
        return power

    def _no_power(self, what: str, span: Span) -> tree.Name:
        """Refuses what comes after branches that all end. It is checked with a power that is FALSE."""
        self._report.error(
            "T010", f"No power comes to {what}: each branch before it ends with a jump, RETURN or `->`; move it to a rung of its own.",
            span,
        )  # fmt: skip
        return self._code.note(Const(BOOL, 0), span)

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
                self._code.leave_later(each, power and self._code.note(self._code.load(power), each.span, "leave"))
                raise Ended

    def _with(self, power: Power, value: Expr) -> Expr:
        return value if power is RAIL else fold.binary("and", BOOL, self._code.load(power), value)

    def _value(self, power: Power, span: Span) -> tree.Expression:
        """The power as an expression of the tree."""
        return tree.Literal("bool", 1, None, span) if power is RAIL else tree.Name(power.name, span)

    # ---- elements ---------------------------------------------------------------------------------------------------

    def _contact(self, each: networks.Contact, power: Power) -> Power:
        value = as_type(self._body, each.operand, BOOL, "A contact")
        if each.mode == "/":
            value = fold.unary("not", BOOL, value)
        if each.mode in ("", "/"):
            return self._code.note(self._with(power, value), each.span)
        return self._code.note(self._with(power, self._code.edge(each, value, each.span)), each.span)

    def _coil(self, each: networks.Coil, power: Power) -> None:
        value = self._value(power, each.span)
        if each.mode in ("S", "R"):
            self._code.run(tree.Assignment(each.target, value, each.span, f"{each.mode}="))
        elif each.mode in ("", "/"):
            value = tree.UnaryOp("not", value, each.span) if each.mode == "/" else value
            self._code.run(tree.Assignment(each.target, value, each.span))
        else:
            memory = self._code.memory(each)
            first, second = (value, memory) if each.mode == "P" else (memory, value)
            edge = tree.BinaryOp("and", first, tree.UnaryOp("not", second, each.span), each.span)
            self._code.run(tree.Assignment(each.target, edge, each.span))
            self._code.run(tree.Assignment(memory, value, each.span))

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
        joined = self._code.load(ends[0]) if ends[0] else None
        for end in ends[1:]:
            if joined is not None and end is not None:
                joined = fold.binary("or", BOOL, joined, self._code.load(end))
        return power if joined is None else self._code.note(joined, each.span)

    def _link(self, each: networks.Link, power: Power) -> Power:
        wire = self._wire(each.name, each.span)
        if each.sends:
            if each.name.upper() in self._sent:
                raise self._report.reject("D001", f"`#{each.name}` has its power already; rename one.", each.span)
            self._sent.add(each.name.upper())
            self._code.run(tree.Assignment(wire, self._value(power, each.span), each.span))
            raise Ended
        if each.name.upper() not in self._sent:
            raise self._report.reject(
                "T001", f"Nothing sends its power to `#{each.name}` above in this rung; write `-> #{each.name}`.",
                each.span,
            )  # fmt: skip
        return self._code.note(self._with(power, self._code.load(wire)), each.span)

    def _wire(self, name: str, span: Span) -> tree.Name:
        return self._code.wire(networks.WIRE + name, BOOL, span)

    # ---- boxes ------------------------------------------------------------------------------------------------------

    def _box(self, each: networks.Box, power: Power) -> Power:
        branched = any(isinstance(argument, networks.Branch) for argument in each.arguments)
        # what is inside of an argument runs first, and the text goes on after it
        span = each.after if branched else each.span
        arguments = tuple(self._argument(argument, power) for argument in each.arguments)
        call = tree.Call(each.callee, arguments, span)
        output: tree.Expression = tree.MemberOf(each.callee, each.output, each.after)
        if each.output and each.output.upper() != "ENO" and called_by(self._body, enabling(call).call) is not None:
            output = self._code.temporary("out", BOOL, span)
            call = replace(call, arguments=(*arguments, tree.Argument(each.output, True, output, each.after)))
        apart = enabling(call)
        if apart.en is not None or apart.eno is not None or each.output.upper() == "ENO":
            return self._enabled(each, call, power, output)
        if each.result is None:
            self._code.run(tree.ExpressionStatement(call, span))
        else:
            self._code.run(tree.Assignment(each.result, call, span))
        if not each.output:
            return power
        return self._code.note(as_type(self._body, output, BOOL, "The power after a box"), span)

    def _enabled(self, each: networks.Box, call: tree.Call, power: Power, output: tree.Expression) -> Power:
        """With EN or ENO: without power nothing is called and nothing is written."""
        span = call.span
        apart, ok = enabling(call), self._code.temporary("ok", BOOL, span)
        own = replace(apart, eno=tree.Argument("ENO", True, ok, span))
        if each.result is None:
            given = tuple(argument for argument in (own.en, own.eno) if argument is not None)
            called = replace(own.call, arguments=(*given, *own.call.arguments))
            self._code.run(tree.ExpressionStatement(called, span))
        else:
            self._code.enabled_result(each.result, own, ok, span)
        if apart.eno is not None and apart.eno.value is not None:
            self._code.run(tree.Assignment(apart.eno.value, told(apart.eno, ok), apart.eno.span))
        if each.output and each.output.upper() != "ENO":
            return self._code.note(self._with(ok, as_type(self._body, output, BOOL, "The power after a box")), span)
        return ok if each.output else power

    def _argument(self, each: tree.Argument | networks.Branch, power: Power) -> tree.Argument:
        if isinstance(each, networks.Branch):
            try:
                power = self._path((each.parallel,), RAIL, used=True)
            except Ended:
                power = self._no_power(f"`{each.name}`", each.span)
            return tree.Argument(each.name, False, self._value(power, each.span), each.span)
        if isinstance(each.value, tree.Name):
            if each.value.name == networks.POWER:
                return replace(each, value=self._value(power, each.span))
            if each.value.name.startswith(networks.WIRE):
                name = each.value.name.removeprefix(networks.WIRE)
                self._sent.add(name.upper())
                return replace(each, value=self._wire(name, each.span))
        return each
