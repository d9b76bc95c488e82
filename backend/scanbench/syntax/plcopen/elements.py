"""The objects of a graphical body: what each is, what it is connected to, in which order they run."""

from dataclasses import dataclass, field

from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, line_of, number_of, text_of

SOURCES = ("leftPowerRail", "inVariable", "continuation")
LAST = 1 << 60
RESULTS = frozenset(("", "OUT", "OUT1", "RESULT"))
"""How tools name the result of a function."""


@dataclass(frozen=True, slots=True)
class Pin:
    """An input or output. `ends` are the objects and outputs that lead to an input."""

    name: str
    negated: bool = False
    edge: str = ""
    """`rising` or `falling`."""
    ends: tuple[tuple[str, str], ...] = ()
    """Object, and its output; empty for the only one, or the first that is not ENO."""
    expression: str = ""


@dataclass(slots=True)
class Thing:
    """An object of a body."""

    id: str
    kind: str
    line: int
    place: tuple[int, float, float, int]
    """What orders it: the number that the file gives, else top to bottom and left to right, else as written."""
    name: str = ""
    """Type of a block, variable, label or name."""
    instance: str = ""
    negated: bool = False
    edge: str = ""
    storage: str = ""
    inputs: list[Pin] = field(default_factory=list)
    outputs: list[Pin] = field(default_factory=list)

    def output(self, named: str) -> Pin | None:
        """The output that a connection means."""
        exact = next((each for each in self.outputs if each.name == named), None)
        if named or exact is not None:
            return exact
        return next(
            (each for each in self.outputs if each.name.upper() != "ENO"), self.outputs[0] if self.outputs else None
        )


def things_in(body: Element) -> list[Thing]:
    """All objects with a local id, as written."""
    return [thing_of(each, number) for number, each in enumerate(children(body)) if each.get("localId") is not None]


def thing_of(node: Element, number: int) -> Thing:
    position = child(node, "position")
    order = attribute(node, "executionOrderId", "0")
    place = (
        int(order) if order.isdecimal() and order != "0" else LAST,
        number_of(position, "y"), number_of(position, "x"), number,
    )  # fmt: skip
    made = Thing(attribute(node, "localId"), kind(node), line_of(node), place)
    made.negated, made.edge = _is_true(node, "negated"), _said(node, "edge")
    made.storage = _said(node, "storage")
    match made.kind:
        case "block":
            made.name, made.instance = attribute(node, "typeName"), attribute(node, "instanceName")
            for group in ("inputVariables", "inOutVariables"):
                made.inputs += [_pin(each) for each in children(child(node, group), "variable")]
            for group in ("outputVariables", "inOutVariables"):
                made.outputs += [_pin(each) for each in children(child(node, group), "variable")]
        case "contact" | "coil":
            made.name = text_of(child(node, "variable")).strip()
        case "inVariable" | "outVariable" | "inOutVariable":
            made.name = text_of(child(node, "expression")).strip()
        case "jump" | "label":
            made.name = attribute(node, "label")
        case "comment":
            made.name = " ".join(text_of(child(node, "content")).split())
        case "connector" | "continuation" | "step" | "unread":
            made.name = attribute(node, "name")
        case "jumpStep":
            made.name = attribute(node, "targetName")
    if made.kind != "block":
        made.inputs = [Pin("", ends=ends_of(each)) for each in children(node, "connectionPointIn")]
        made.outputs = [Pin(attribute(each, "formalParameter")) for each in children(node, "connectionPointOut")]
        made.outputs = made.outputs or [Pin("")]
    return made


def _pin(node: Element) -> Pin:
    into = child(node, "connectionPointIn")
    expression = text_of(child(into, "expression")) or text_of(child(node, "connectionPointOut", "expression"))
    return Pin(
        attribute(node, "formalParameter"), _is_true(node, "negated"), _said(node, "edge"),
        () if into is None else ends_of(into), expression.strip(),
    )  # fmt: skip


def _is_true(node: Element, name: str) -> bool:
    return attribute(node, name) in ("true", "1")


def _said(node: Element, name: str) -> str:
    found = attribute(node, name)
    return "" if found == "none" else found


def ends_of(point: Element) -> tuple[tuple[str, str], ...]:
    """The objects, and their outputs, that lead to a point."""
    found = children(point, "connection")
    return tuple((attribute(each, "refLocalId"), attribute(each, "formalParameter")) for each in found)
