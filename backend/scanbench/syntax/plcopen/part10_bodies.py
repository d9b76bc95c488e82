"""Bodies of IEC 61131-10 -> bodies of TC6: the networks are given, outputs have ids of their own, and what an object is says its xsi:type."""

from collections.abc import Iterator

from lxml import etree

from scanbench.syntax.plcopen.write_objects import add
from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, number_of, of_type, text_of

LANGUAGES = {"LdSection": "LD"}
"""Sysmac Studio's name for a section of a ladder."""
OBJECTS = ("CommonObject", "LdObject", "FbdObject")
KINDS = {
    "Block": "block", "DataSource": "inVariable", "DataSink": "outVariable", "Contact": "contact", "Coil": "coil",
    "LeftPowerRail": "leftPowerRail", "RightPowerRail": "rightPowerRail", "Jump": "jump", "Return": "return",
    "Comment": "comment", "Connector": "connector", "Continuation": "continuation",
}  # fmt: skip
SIGNS = {
    "=": "EQ", "<>": "NE", "<": "LT", "<=": "LE", ">": "GT", ">=": "GE", "+": "ADD", "-": "SUB", "*": "MUL", "/": "DIV",
    "&": "AND",
}  # fmt: skip
"""What boxes are called in drawings."""
NETWORK = 1_000_000
"""From the top of a network to that of the next one."""
PINS = {"InputVariables": "inputVariables", "InOutVariables": "inOutVariables", "OutputVariables": "outputVariables"}


def add_body(parent: Element, node: Element | None) -> None:
    """One element `body` for each section of a body."""
    for each in sorted(children(node, "BodyContent"), key=_order):
        body, language = add(parent, "body"), of_type(each)
        body.sourceline = each.sourceline
        language = LANGUAGES.get(language, language)
        if language in ("ST", "IL"):
            add(body, language).text = text_of(child(each, language))
        elif language in ("LD", "FBD"):
            made = add(body, language)
            if next(_priorities(each), None) is not None:
                made.set("order", "given")
            networks = sorted(children(each, "Rung", "Network"), key=_order)
            for number, network in enumerate(networks, 1):
                _Network(made, network, number).write()
        else:
            add(body, "unread", name=language)


def _order(node: Element) -> float:
    return number_of(node, "evaluationOrder")


def _priorities(node: Element) -> Iterator[Element]:
    """Where Bachmann's tool gives the order of the boxes."""
    return (each for each in node.iter(etree.Element) if kind(each) == "EvaluationPriority")


class _Network:
    """One rung or network. Ids of outputs are its own; those of objects are made unique in the body."""

    def __init__(self, body: Element, node: Element, number: int) -> None:
        self._body, self._node, self._number = body, node, number
        self._ends: dict[str, tuple[str, str]] = {}
        """Object and output, by the id of the output."""
        self._open: set[str] = set()
        """Ids of outputs that say that a pin is not connected."""

    def write(self) -> None:
        top = self._number * NETWORK
        label = attribute(self._node, "label")
        if label:
            made = add(self._body, "label", localId=f"{self._number}.label", label=label)
            add(made, "position", x="0", y=str(top - 0.25))
        objects = [(f"{self._number}.{at}", each) for at, each in enumerate(children(self._node, *OBJECTS), 1)]
        for id, each in objects:
            self._outputs(id, each)
        for id, each in objects:
            if of_type(each) != "Unconnected":
                self._object(id, each, top)

    def _outputs(self, id: str, node: Element) -> None:
        for each in node.iter(etree.Element):
            if kind(each) != "ConnectionPointOut":
                continue
            own, around = attribute(each, "connectionPointOutId"), each.getparent()
            if of_type(node) == "Unconnected":
                self._open.add(own)
            output = "ENO" if around is not None and kind(around) == "Eno" else attribute(around, "parameterName")
            self._ends[own] = id, "" if around is node else output

    def _object(self, id: str, node: Element, top: int) -> None:
        what = KINDS.get(of_type(node))
        made = add(self._body, what or "unread", localId=id)
        made.sourceline = node.sourceline
        if what is None:
            made.set("name", of_type(node))
        place = child(node, "RelPosition")
        y = number_of(place, "y") if what != "comment" else -0.5
        add(made, "position", x=str(number_of(place, "x")), y=str(top + y))
        priority = next(_priorities(node), None)
        if priority is not None:
            made.set("executionOrderId", str(int(number_of(priority, "priorityInNetwork")) + 1))
        for word in ("negated", "edge"):
            if attribute(node, word):
                made.set(word, attribute(node, word))
        self._of_kind(made, node, what)
        if what != "block":
            for each in children(node, "ConnectionPointIn"):
                self._connect(made, each)
            for _ in children(node, "ConnectionPointOut"):
                add(made, "connectionPointOut")

    def _of_kind(self, made: Element, node: Element, what: str | None) -> None:
        match what:
            case "block":
                self._block(made, node)
            case "contact" | "coil":
                add(made, "variable").text = attribute(node, "operand")
                made.set("storage", attribute(node, "latch", "none"))
            case "inVariable" | "outVariable":
                add(made, "expression").text = attribute(node, "identifier")
                mode = next((each for each in node.iter(etree.Element) if kind(each) == "StorageMode"), None)
                made.set("storage", attribute(mode, "mode", "none").lower())
            case "jump":
                made.set("label", attribute(node, "targetLabel") or attribute(node, "label"))
            case "connector" | "continuation":
                made.set("name", attribute(node, "label"))
            case "comment":
                add(made, "content").text = text_of(child(node, "Content"))

    def _block(self, made: Element, node: Element) -> None:
        name = attribute(node, "typeName")
        made.set("typeName", SIGNS.get(name, name))
        if attribute(node, "instanceName"):
            made.set("instanceName", attribute(node, "instanceName"))
        groups = {name: add(made, name) for name in PINS.values()}
        for each in node.iter(etree.Element):
            match kind(each):
                case "En":
                    self._pin(groups["inputVariables"], each, "EN")
                case "Eno":
                    self._pin(groups["outputVariables"], each, "ENO")
        for group, own in PINS.items():
            for each in children(child(node, group)):
                self._pin(groups[own], each, attribute(each, "parameterName"))

    def _pin(self, group: Element, node: Element, name: str) -> None:
        marks = {word: attribute(node, word) for word in ("negated", "edge") if attribute(node, word)}
        made = add(group, "variable", formalParameter=name, **marks)
        for each in children(node, "ConnectionPointIn"):
            self._connect(made, each)
        for _ in children(node, "ConnectionPointOut"):
            add(made, "connectionPointOut")

    def _connect(self, made: Element, node: Element) -> None:
        into = add(made, "connectionPointIn")
        for each in children(node, "Connection"):
            own = attribute(each, "refConnectionPointOutId")
            if own in self._open:
                continue
            id, output = self._ends.get(own, ("", ""))
            add(into, "connection", refLocalId=id, **({"formalParameter": output} if output else {}))
