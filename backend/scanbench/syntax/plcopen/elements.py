"""The objects of a graphical body: what each is, what it is connected to, in which order they run."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, line_of, number_of, text_of

SOURCES = ("leftPowerRail", "inVariable", "continuation")
LAST = 1 << 60


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
        if named:
            return next((each for each in self.outputs if each.name == named), None)
        return next(
            (each for each in self.outputs if each.name.upper() != "ENO"), self.outputs[0] if self.outputs else None
        )


def things_in(body: Element) -> list[Thing]:
    """All objects with a local id, as written."""
    return [_thing(each, number) for number, each in enumerate(children(body)) if each.get("localId") is not None]


def _thing(node: Element, number: int) -> Thing:
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
        made.inputs = [Pin("", ends=_ends(each)) for each in children(node, "connectionPointIn")]
        made.outputs = [Pin(attribute(each, "formalParameter")) for each in children(node, "connectionPointOut")]
        made.outputs = made.outputs or [Pin("")]
    return made


def _pin(node: Element) -> Pin:
    into = child(node, "connectionPointIn")
    expression = text_of(child(into, "expression")) or text_of(child(node, "connectionPointOut", "expression"))
    return Pin(
        attribute(node, "formalParameter"), _is_true(node, "negated"), _said(node, "edge"),
        () if into is None else _ends(into), expression.strip(),
    )  # fmt: skip


def _is_true(node: Element, name: str) -> bool:
    return attribute(node, name) in ("true", "1")


def _said(node: Element, name: str) -> str:
    found = attribute(node, name)
    return "" if found == "none" else found


def _ends(point: Element) -> tuple[tuple[str, str], ...]:
    found = children(point, "connection")
    return tuple((attribute(each, "refLocalId"), attribute(each, "formalParameter")) for each in found)


def networks_of(things: list[Thing], in_order: bool = False, given: bool = False) -> Iterator[list[Thing]]:
    """What is connected, as one network each, from top to bottom; a power rail connects nothing. Inside they are in the order in which
    they run: sources before what they lead to, else by their place. `in_order`: networks do not run in turn. `given`: the file has the
    whole order, also where a box then reads what an other one had in the scan before."""
    by_id = {each.id: each for each in things}
    leader = {each.id: each.id for each in things}

    def find(id: str) -> str:
        while leader[id] != id:
            leader[id] = leader[leader[id]]
            id = leader[id]
        return id

    rails = {each.id for each in things if each.kind in ("leftPowerRail", "rightPowerRail")}
    names: dict[str, str] = {}
    for each in things:
        if each.kind in ("connector", "continuation"):
            leader[find(each.id)] = find(names.setdefault(each.name.upper(), each.id))
        for id in (end for pin in each.inputs for end, _ in pin.ends if end in by_id):
            if id not in rails and each.id not in rails:
                leader[find(each.id)] = find(id)
    groups: dict[str, list[Thing]] = {}
    for each in things:
        if each.id not in rails and each.kind not in ("comment", "vendorElement", "error"):
            groups.setdefault(find(each.id), []).append(each)
    found = sorted(groups.values(), key=lambda one: min(each.place for each in one))
    yield from (ordered(group, given) for group in (_apart(found) if in_order else found))


def _apart(groups: list[list[Thing]]) -> list[list[Thing]]:
    """Groups that run in turn are one network: what one writes, the other may read between two of its own boxes."""
    made: list[list[Thing]] = []
    for group in groups:
        last = max((each.place for each in made[-1] if each.kind != "inVariable"), default=None) if made else None
        if last is not None and min(each.place for each in group) < last:
            made[-1] += group
        else:
            made.append(list(group))
    return made


def ordered(group: list[Thing], given: bool = False) -> list[Thing]:
    """In the order of execution. Where there is a loop, what is first by its place goes on."""
    left = sorted(group, key=lambda each: (given and each.place[0] != LAST, each.place))
    known = {each.id for each in left if not given or each.place[0] == LAST}
    done: list[Thing] = []
    seen: set[str] = set()
    while left:
        ready = next(
            (
                each
                for each in left
                if all(end in seen or end not in known for pin in each.inputs for end, _ in pin.ends)
            ),
            left[0],
        )
        left.remove(ready)
        seen.add(ready.id)
        done.append(ready)
    return done
