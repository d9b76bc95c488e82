"""A function block diagram -> objects of FBD, with the order of execution as the text has it."""

from scanbench.syntax import networks, tree
from scanbench.syntax.plcopen.write_ladder import EDGES
from scanbench.syntax.plcopen.write_objects import CannotWrite, End, Known, Objects, Outputs, is_wire, text, uses_wires

STORED = {":=": "none", "S=": "set", "R=": "reset"}
Input = tuple[str, list[End], str, bool]


class DiagramWriter:
    """The networks of one body."""

    def __init__(self, objects: Objects, known: Known) -> None:
        self._objects = objects
        self._known = known
        self._wires: dict[str, tuple[End, bool]] = {}
        """What a wire comes from, and whether it is negated on the way."""
        self._enabled: set[str] = set()
        """Boxes that are not called without EN: their wires are FALSE or 0 then, but a variable at the box keeps its value."""

    def diagram(self, diagram: networks.Diagram) -> None:
        try:
            self._diagram(diagram)
        except CannotWrite as why:
            raise why.at(diagram.span) from None

    def _diagram(self, diagram: networks.Diagram) -> None:
        if diagram.off:
            raise CannotWrite("a network that is switched off")
        if any(each.loop for each in diagram.wires):
            raise CannotWrite("a wire that is read above the line that sets it")
        self._objects.next_network()
        self._objects.head(diagram.label, diagram.span)
        self._wires, self._enabled = {}, set()
        leaves: list[tuple[str, list[End]]] = []
        last = max((number for number, each in enumerate(diagram.items) if each.leave is None), default=-1)
        for number, item in enumerate(diagram.items):
            if item.leave is None:
                self._item(item)
            else:
                leaves.append((item.leave.label, self._decided(item, number < last)))
        for label, ends in leaves:  # decided in their line, taken when all of the network is done
            _, made = self._objects.make("jump" if label else "return", **({"label": label} if label else {}))
            self._objects.connect(made, ends)

    def _decided(self, item: networks.Item, early: bool) -> list[End]:
        """The condition of a jump, which is looked at now: `early`, before other lines."""
        if item.value is None:
            return []
        if isinstance(item.value, networks.Function):
            return [self._box(item.value, True)]
        pin = self._input("", item.value)
        end = self._plain(pin)
        of_variable = not (pin[2] or pin[3] or is_wire(item.value))
        return [self._moved(end) if early and of_variable else end]

    def _moved(self, end: End) -> End:
        id = self._objects.block("MOVE", "", [("IN", [end], "", False)], {"OUT": False})
        return id, "OUT"

    def _item(self, item: networks.Item) -> None:
        wire = item.target.name if is_wire(item.target) else ""
        if isinstance(item.value, networks.Function):
            end = self._box(item.value, item.target is not None)
        elif item.value is not None:
            pin = self._input("", item.value)
            of_wire = is_wire(item.value.operand if isinstance(item.value, tree.UnaryOp) else item.value)
            if wire and of_wire:
                self._wires[wire.upper()] = (pin[1][0], pin[3])
                return
            end = self._plain(pin)
            # the variable is read now, wherever the wire leads to
            if (wire and not pin[2]) or (not wire and item.operator == ":=" and end[0] in self._enabled):
                end = self._moved(end)
        else:
            return
        if wire:
            self._wires[wire.upper()] = (end, False)
        elif item.target is not None:
            self._objects.result(text(item.target), [end], STORED[item.operator])

    def _plain(self, pin: Input) -> End:
        """A value without edge and negation: where these are, a box takes them."""
        _, ends, edge, negated = pin
        if not edge and not negated:
            return ends[0]
        id = self._objects.block(
            "AND", "", [("IN1", ends, edge, negated), ("IN2", [self._objects.value("TRUE")], "", False)], {"OUT": False}
        )
        return id, "OUT"

    def _input(self, name: str, value: networks.Pin | tree.Expression) -> Input:
        if isinstance(value, networks.Pin):
            inner = self._input(name, value.edge.operand)
            if inner[3]:
                raise CannotWrite("an edge of a negated value")
            return name, inner[1], EDGES[value.edge.mode], value.negated
        if isinstance(value, tree.UnaryOp) and value.op == "not" and is_wire(value.operand):
            inner = self._input(name, value.operand)
            return name, inner[1], "", not inner[3]
        if isinstance(value, tree.Name) and is_wire(value):
            if value.name.upper() not in self._wires:
                raise CannotWrite(f"the wire {value.name}, which comes from nothing")
            end, negated = self._wires[value.name.upper()]
            return name, [end], "", negated
        if uses_wires(value):
            raise CannotWrite(f"the expression {text(value)}")
        return name, [self._objects.value(text(value))], "", False

    def _box(self, call: networks.Function, has_target: bool) -> End:
        callee = text(call.callee)
        block = self._known.types.get(callee.upper(), "")
        inputs: list[Input] = []
        outputs = Outputs()
        count = sum(isinstance(each, networks.Pin) or not each.output for each in call.arguments)
        for number, argument in enumerate(call.arguments):
            if isinstance(argument, networks.Pin):
                inputs.append(self._input(argument.name or self._known.formal(callee, number, count), argument))
            elif argument.output:
                outputs.take(argument)
            elif argument.value is not None:
                inputs.append(self._input(argument.name or self._known.formal(callee, number, count), argument.value))
        result = self._known.result(callee)
        if has_target or (not block and self._known.has_result(callee, outputs)):
            outputs.negated[result] = False
        id = self._objects.block(block or callee, callee if block else "", inputs, outputs.negated)
        if any(name.upper() == "EN" for name, *_ in inputs):
            self._enabled.add(id)
        for name, variable, negated in outputs.variables:
            self._objects.result(variable, [(id, name)], negated=negated)
        for name, wire in outputs.wires:
            self._wires[wire.upper()] = ((id, name), False)
        return id, result
