"""A rung -> objects of LD."""

from scanbench.syntax import networks, tree
from scanbench.syntax.plcopen import ladder
from scanbench.syntax.plcopen.grouping import LEAVES
from scanbench.syntax.plcopen.write_objects import CannotWrite, End, Known, Objects, Outputs, text

EDGES = {"P": "rising", "N": "falling"}
STORED = {"S": "set", "R": "reset"}


class LadderWriter:
    """The rungs of one body. They share a power rail."""

    def __init__(self, objects: Objects, known: Known) -> None:
        self._objects = objects
        self._known = known
        self._rail: End | None = None
        self._sent: dict[str, list[End]] = {}
        self._turned: dict[str, tuple[str, str, str]] = {}
        """Links of negated outputs that nothing has received so far: see `_turn`."""
        self._shared = False
        """Whether an output of a box with EN goes on as power, and is taken by a variable as well."""

    def rung(self, rung: networks.Rung) -> None:
        try:
            self._rung(rung)
        except CannotWrite as why:
            raise why.at(rung.span) from None

    def condition(self, rung: networks.Rung) -> list[End]:
        """The rung of a transition, drawn beside it: what gives the power at its end."""
        made = list(networks.elements(rung.path))
        if any(isinstance(each, networks.Leave) or (isinstance(each, networks.Link) and each.sends) for each in made):
            raise CannotWrite("a jump or a link in the condition of a transition").at(rung.span)
        try:
            return self._draw(rung)
        except CannotWrite as why:
            raise why.at(rung.span) from None

    def _draw(self, rung: networks.Rung) -> list[End]:
        if rung.off:
            raise CannotWrite("a rung that is switched off")
        self._sent, self._turned, self._shared = {}, {}, False
        return self._path(rung.path, [self.rail])

    def _rung(self, rung: networks.Rung) -> None:
        self._objects.next_network()
        self._objects.head(rung.label, rung.span)
        self._draw(rung)
        if self._shared and not self._is_ladder():
            raise CannotWrite(
                "a box with EN whose output goes on and is taken by a variable, in a rung that is read as a network: use its output in "
                "a rung below"
            )
        if any(isinstance(each, networks.Leave) for each in networks.elements(rung.path)):
            apart = [each for each in self._objects.networks() if any(one.kind != "label" for one in each)]
            if any(one.kind in LEAVES for each in apart[:-1] for one in each):
                raise CannotWrite(
                    "a jump or RETURN before other branches of its rung, which then do not run: give these a rung above"
                )

    def _is_ladder(self) -> bool:
        """Whether it is read as rungs: in a network a variable gets the value of a wire, also where EN keeps the box from being called."""
        try:
            for each in self._objects.networks():
                if any(one.kind != "label" for one in each):
                    ladder.Rung(each, {self.rail[0]}).elements()
        except ladder.NoLadder:
            return False
        return True

    @property
    def rail(self) -> End:
        if self._rail is None:
            id, made = self._objects.make("leftPowerRail")
            self._objects.body.remove(made)
            self._objects.body.insert(0, made)
            out = made.makeelement("connectionPointOut", {"formalParameter": ""})
            made.append(out)
            self._rail = (id, "")
        return self._rail

    def _path(self, path: networks.Path, power: list[End]) -> list[End]:
        for each in path:
            power = self._element(each, power)
        return power

    def _element(self, each: networks.Element, power: list[End]) -> list[End]:
        match each:
            case networks.Contact():
                return self._symbol("contact", each.mode, text(each.operand), power)
            case networks.Coil():
                return self._symbol("coil", each.mode, text(each.target), power)
            case networks.Parallel():
                return [end for branch in each.branches for end in self._path(branch, power)]
            case networks.Link():
                return self._link(each, power)
            case networks.Leave():
                _, made = self._objects.make(
                    "jump" if each.label else "return", **({"label": each.label} if each.label else {})
                )
                self._objects.connect(made, power)
                return []
            case networks.Box():
                return self._box(each, power)

    def _symbol(self, kind: str, mode: str, operand: str, power: list[End]) -> list[End]:
        marks = {"negated": "true" if mode == "/" else "false"}
        if mode in EDGES:
            marks["edge"] = EDGES[mode]
        if mode in STORED:
            marks["storage"] = STORED[mode]
        id, made = self._objects.make(kind, **marks)
        self._objects.connect(made, power)
        made.append(made.makeelement("connectionPointOut", {}))
        variable = made.makeelement("variable", {})
        variable.text = operand
        made.append(variable)
        return [(id, "")]

    def _link(self, each: networks.Link, power: list[End]) -> list[End]:
        name = each.name.upper()
        if each.sends:
            self._sent[name] = power
            return []
        if name in self._turned:
            self._sent[name] = [self._turn(*self._turned.pop(name))]
        sent = self._sent.get(name, [])
        if power == [self.rail] or not sent:
            return sent
        id = self._objects.block("AND", "", [("IN1", power, "", False), ("IN2", sent, "", False)], {"OUT": False})
        return [(id, "OUT")]

    def _turn(self, id: str, output: str, called: str) -> End:
        """An output, negated; `called`: the output of the box that tells that it was, else this is FALSE."""
        if called:
            pins = [("IN1", [(id, called)], "", False), ("IN2", [(id, output)], "", True)]
            return self._objects.block("AND", "", pins, {"OUT": False}), "OUT"
        return self._objects.block("NOT", "", [("IN", [(id, output)], "", False)], {"OUT": False}), "OUT"

    def _box(self, each: networks.Box, power: list[End]) -> list[End]:
        objects, callee = self._objects, text(each.callee)
        block = self._known.types.get(callee.upper(), "")
        inputs: list[tuple[str, list[End], str, bool]] = []
        outputs = Outputs(power=each.output)
        count = sum(isinstance(one, networks.Branch) or not one.output for one in each.arguments)
        for number, argument in enumerate(each.arguments):
            name = argument.name or self._known.formal(callee, number, count)
            if isinstance(argument, networks.Branch):
                inputs.append((name, self._path((argument.parallel,), [self.rail]), "", False))
            elif argument.output:
                outputs.take(argument)
            elif isinstance(argument.value, tree.Name) and argument.value.name == networks.POWER:
                inputs.append((name, power, "", False))
            elif argument.value is not None:
                inputs.append((name, [objects.value(text(argument.value))], "", False))
        result = self._known.result(callee)
        if each.result is not None or (not block and self._known.has_result(callee, outputs)):
            outputs.negated[result] = False
        if each.result is not None:
            outputs.variables.append((result, text(each.result), False))
        enabled = any(name.upper() == "EN" for name, *_ in inputs)
        self._shared |= outputs.shared and enabled
        called = next((name for name in outputs.negated if name.upper() == "ENO"), "ENO")
        if enabled and outputs.turned and outputs.negated.setdefault(called, False):
            raise CannotWrite(
                f"the output {each.output} of a box with a negated ENO, which goes on as it is and negated to a link"
            )
        id = objects.block(block or callee, callee if block else "", inputs, outputs.negated)
        for name, variable, negated in outputs.variables:
            objects.result(variable, [(id, name)], negated=negated)
        for name, link in outputs.wires:
            self._sent[link.removeprefix(networks.WIRE).upper()] = [(id, name)]
        for link in outputs.turned:
            self._turned[link.removeprefix(networks.WIRE).upper()] = (id, each.output, called if enabled else "")
        return [(id, each.output)] if each.output else power
