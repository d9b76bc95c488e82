"""Function block diagrams -> checked statements: a line after the other, as the text has them.

A wire is a hidden temporary with the name that it is written with, `#low`; one that is read above its line is a variable that keeps its value.
"""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.callees import called_by
from scanbench.check.body.coercion import as_type
from scanbench.check.body.enabling import enabling, told
from scanbench.check.body.il_operands import type_of
from scanbench.check.body.network_code import NetworkCode
from scanbench.check.context import Rejected
from scanbench.problems import Severity, Span
from scanbench.program.types import BOOL, INT, Record, Type, has_instance
from scanbench.program.untyped import settle
from scanbench.syntax import networks, tree


class FunctionBlocks:
    """The function block diagrams of one body."""

    def __init__(self, code: NetworkCode) -> None:
        self._code = code
        self._body = code.body
        self._report = code.report
        self._wires: dict[str, networks.Wire] = {}
        """Those of the network, by name in upper case."""

    def diagram(self, diagram: networks.Diagram) -> None:
        self._wires = {}
        for wire in diagram.wires:
            key = wire.name.upper()
            if key in self._wires:
                line = self._wires[key].span.line
                self._report.error("D001", f"`{wire.name}` is a wire of line {line} already; rename one.", wire.span)
                continue
            self._wires[key] = wire
            if wire.loop and not self._code.loop(wire):
                self._body.unmade.add(key)
                self._report.error(
                    "T010",
                    f"`{wire.name}` is read above its line, so it keeps its value, and a FUNCTION or METHOD keeps nothing; "
                    f"move the line up.",
                    wire.span,
                )
        for item in diagram.items:
            self._untyped_loops(item)
        set_here = {wire for item in diagram.items for wire in _wires_of(item)}
        self._body.unmade.update(self._wires.keys() - set_here)
        for item in diagram.items:
            try:
                self._item(item)
            except Rejected:
                self._body.unmade.update(_wires_of(item))

    def _untyped_loops(self, item: networks.Item) -> None:
        """Refuses wires that keep the value of an output and do not say its type, before a line above reads them as BOOL."""
        for each in item.value.arguments if isinstance(item.value, networks.Function) else ():
            target = networks.wire_at(each) if isinstance(each, tree.Argument) else None
            wire = None if target is None else self._wires.get(target.name.upper())
            if target is None or wire is None or not wire.loop or wire.type is not None:
                continue
            assert isinstance(item.value, networks.Function)
            type = self._output(item.value, each.name or "")
            if type is not None and type != BOOL:
                self._body.unmade.add(wire.name.upper())
                del self._body.scope.wires[wire.name.upper()]
                self._report.error(
                    "T002",
                    f"`{wire.name}` is read above its line, and the output is {type}: write `{each.name} => {wire.name} : {type}`.",
                    each.span,
                )

    def _item(self, item: networks.Item) -> None:
        if item.leave is not None:
            condition = None if item.value is None else self._condition(item.value, item.span)
            self._code.leave_later(item.leave, condition)
        elif isinstance(item.value, networks.Function):
            self._function(item, item.value)
        elif item.value is not None and item.target is not None:
            self._set(item, self._plain(item.value, item.span))

    def _condition(self, value: networks.Function | networks.Pin | tree.Expression, span: Span) -> tree.Name:
        assert not isinstance(value, networks.Function)
        return self._code.note(as_type(self._body, self._plain(value, span), BOOL, "A condition"), span, "pin")

    def _plain(self, value: networks.Pin | tree.Expression, span: Span) -> tree.Expression:
        """The value of a pin; an edge is looked for now, as a part of the line at `span`."""
        if not isinstance(value, networks.Pin):
            return value
        found = self._code.edge(value.edge, as_type(self._body, value.edge.operand, BOOL, "An edge"), span, "pin")
        found = fold.unary("not", BOOL, found) if value.negated else found
        return self._code.note(found, span, "pin")

    # ---- boxes ------------------------------------------------------------------------------------------------------

    def _function(self, item: networks.Item, box: networks.Function) -> None:
        arguments = tuple(self._argument(each, box, item.span) for each in box.arguments)
        call = tree.Call(box.callee, arguments, item.span)
        apart = enabling(call)
        if item.target is None:
            self._code.run(tree.ExpressionStatement(call, item.span))
        elif item.operator == ":=" and (apart.en is not None or apart.eno is not None):
            ok = self._code.temporary("ok", BOOL, item.span)
            own = replace(apart, eno=tree.Argument("ENO", True, ok, item.span))
            self._code.enabled_result(item.target, own, ok, item.span)
            if apart.eno is not None and apart.eno.value is not None:
                self._code.run(tree.Assignment(apart.eno.value, told(apart.eno, ok), apart.eno.span))
        else:
            self._set(item, call)

    def _argument(self, each: tree.Argument | networks.Pin, box: networks.Function, span: Span) -> tree.Argument:
        if isinstance(each, networks.Pin):
            return tree.Argument(each.name, False, self._plain(each, span), each.span)
        if each.output and isinstance(each.value, tree.Name) and each.value.name.startswith(networks.WIRE):
            name = each.value.name
            wire = self._wires.get(name.upper())
            if wire is not None and wire.loop:
                if name.upper() in self._body.unmade:  # reported
                    raise Rejected
                return each
            stated = each.value.type if isinstance(each.value, networks.TypedWire) else None
            type = self._output(box, each.name or "") if stated is None else self._body.declarations.type_of(stated)
            if type is None:
                raise self._report.reject(
                    "T010", f"The type of `{name}` is not known here; write `{name} = ...` below the call.", each.span
                )
            self._code.wire(name, type, each.span)
        return each

    def _output(self, box: networks.Function, name: str) -> Type | None:
        """The type of an output of a block, FUNCTION or method, or of ENO, which all boxes have."""
        if name.upper() == "ENO":
            return BOOL
        record = type_of(self._body.scope, box.callee)
        if not isinstance(record, Record):
            pins = (
                tree.Argument(each.name, False, each.edge.operand, each.span)
                if isinstance(each, networks.Pin)
                else each
                for each in box.arguments
            )
            call = tree.Call(box.callee, tuple(each for each in pins if not each.output), box.span)
            pou = called_by(self._body, call)
            record = None if pou is None else pou.frame
        member = record.members.get(name.upper()) if isinstance(record, Record) else None
        return None if member is None else member.type

    def _set(self, item: networks.Item, value: tree.Expression) -> None:
        """Assigns to a variable, or sets a wire, which then has the type of the value unless it says one."""
        assert item.target is not None
        wire = self._wires.get(item.target.name.upper()) if isinstance(item.target, tree.Name) else None
        if item.operator != "=":
            self._code.run(tree.Assignment(item.target, value, item.span, item.operator))
            return
        assert wire is not None
        if wire.type is not None and not wire.loop:
            self._code.wire(wire.name, self._body.declarations.type_of(wire.type), wire.span)
        if wire.type is not None or wire.loop:
            mark = self._report.mark()
            with suppress(Rejected):  # told below, or reported
                self._code.run(tree.Assignment(item.target, value, item.span))
            wrong = [each for each in self._report.problems[mark[0] :] if each.severity is Severity.ERROR]
            if wrong and wire.type is None and all(each.code == "T002" for each in wrong):
                self._report.undo(mark)
                self._check_type(wire, value)
                self._code.run(tree.Assignment(item.target, value, item.span))  # tells it again
            if wrong:
                raise Rejected
            return
        found = settle(self._body.expression(value))
        if found.type is None or has_instance(found.type):
            raise self._report.reject("T002", "This gives no value, so a wire cannot have it.", item.span)
        self._code.store(self._code.wire(wire.name, found.type, wire.span), found, item.span)

    def _check_type(self, wire: networks.Wire, value: tree.Expression) -> None:
        """Refuses a wire that is read above its line and says no type where its value is no BOOL, or is
        calculated from the wire itself."""
        mark, key = self._report.mark(), wire.name.upper()
        others, self._body.unmade = self._body.unmade, self._body.unmade | {key}
        kept = self._body.scope.wires.pop(key)
        try:
            type = settle(self._body.expression(value)).type
        except Rejected:  # for the wire itself nothing is reported
            type = None if self._report.mark()[0] > mark[0] else INT
        finally:
            self._body.unmade, self._body.scope.wires[key] = others, kept
            self._report.undo(mark)
        if type is not None and type != BOOL:
            message = f"`{wire.name}` is read above its line, so it is BOOL unless the line says a type: write `{wire.name} : {type} = ...`."
            raise self._report.reject("T002", message, wire.span)


def _wires_of(item: networks.Item) -> Iterator[str]:
    """The wires that a line sets, in upper case."""
    outputs = item.value.arguments if isinstance(item.value, networks.Function) else ()
    targets = (each.value for each in outputs if isinstance(each, tree.Argument) and each.output)
    for target in (item.target, *targets):
        if isinstance(target, tree.Name) and target.name.startswith(networks.WIRE):
            yield target.name.upper()
