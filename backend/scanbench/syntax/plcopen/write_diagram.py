"""A function block diagram -> objects of FBD, with the order of execution as the text has it."""

from scanbench.syntax import networks, tree
from scanbench.syntax.plcopen.write_ladder import EDGES
from scanbench.syntax.plcopen.write_objects import CannotWrite, End, Known, Objects, text, uses_wires

STORED = {":=": "none", "S=": "set", "R=": "reset"}
Input = tuple[str, list[End], str, bool]


class DiagramWriter:
    """The networks of one body."""

    def __init__(self, objects: Objects, known: Known) -> None:
        self._objects = objects
        self._known = known
        self._wires: dict[str, tuple[End, bool]] = {}
        """What a wire comes from, and whether it is negated on the way."""

    def diagram(self, diagram: networks.Diagram) -> None:
        if diagram.off:
            raise CannotWrite("a network that is switched off")
        if any(each.loop for each in diagram.wires):
            raise CannotWrite("a wire that is read above the line that sets it")
        self._objects.next_network()
        self._objects.head(diagram.label, diagram.span)
        self._wires = {}
        for item in diagram.items:
            self._item(item)

    def _item(self, item: networks.Item) -> None:
        if item.leave is not None:
            name = item.leave.label
            pin = (
                self._input("", item.value)
                if item.value is not None and not isinstance(item.value, networks.Function)
                else None
            )
            _, made = self._objects.make("jump" if name else "return", **({"label": name} if name else {}))
            ends = [] if pin is None else [self._plain(pin)]
            self._objects.connect(made, ends)
            return
        wire = (
            item.target.name
            if isinstance(item.target, tree.Name) and item.target.name.startswith(networks.WIRE)
            else ""
        )
        if isinstance(item.value, networks.Function):
            end = self._box(item.value, item.target is not None)
        elif item.value is not None:
            pin = self._input("", item.value)
            of_wire = _is_wire(item.value.operand if isinstance(item.value, tree.UnaryOp) else item.value)
            if wire and of_wire:
                self._wires[wire.upper()] = (pin[1][0], pin[3])
                return
            end = self._plain(pin)
            if wire and not pin[2]:  # the variable is read now, wherever the wire leads to
                end = self._objects.block("MOVE", "", [("IN", [end], "", False)], ["OUT"]), "OUT"
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
            "AND", "", [("IN1", ends, edge, negated), ("IN2", [self._objects.value("TRUE")], "", False)], ["OUT"]
        )
        return id, "OUT"

    def _input(self, name: str, value: networks.Pin | tree.Expression) -> Input:
        if isinstance(value, networks.Pin):
            inner = self._input(name, value.edge.operand)
            if inner[3]:
                raise CannotWrite("an edge of a negated value")
            return name, inner[1], EDGES[value.edge.mode], value.negated
        if isinstance(value, tree.UnaryOp) and value.op == "not" and _is_wire(value.operand):
            inner = self._input(name, value.operand)
            return name, inner[1], "", not inner[3]
        if isinstance(value, tree.Name) and _is_wire(value):
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
        taken: list[tuple[str, str]] = []
        wires: list[tuple[str, str]] = []
        count = sum(isinstance(each, networks.Pin) or not each.output for each in call.arguments)
        for number, argument in enumerate(call.arguments):
            if isinstance(argument, networks.Pin):
                inputs.append(self._input(argument.name or self._known.formal(callee, number, count), argument))
            elif argument.output:
                value = argument.value
                if isinstance(value, tree.Name) and _is_wire(value):
                    wires.append((argument.name or "", value.name))
                elif value is not None:
                    taken.append((argument.name or "", text(value)))
            elif argument.value is not None:
                inputs.append(self._input(argument.name or self._known.formal(callee, number, count), argument.value))
        outputs = [*(name for name, _ in taken + wires), *(["OUT"] if has_target else [])]
        id = self._objects.block(block or callee, callee if block else "", inputs, outputs)
        for name, variable in taken:
            self._objects.result(variable, [(id, name)])
        for name, wire in wires:
            self._wires[wire.upper()] = ((id, name), False)
        return id, "OUT"


def _is_wire(value: networks.Pin | networks.Function | tree.Expression) -> bool:
    return isinstance(value, tree.Name) and value.name.startswith(networks.WIRE)
