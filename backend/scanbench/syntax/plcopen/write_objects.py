"""Objects of a graphical body, as they are written: local ids, connections, places from left to right and from top to bottom."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeGuard

from lxml import etree

from scanbench.problems import Span
from scanbench.syntax import networks, tree
from scanbench.syntax.plcopen.elements import RESULTS, Thing, thing_of
from scanbench.syntax.plcopen.grouping import networks_of
from scanbench.syntax.source import Stretch
from scanbench.syntax.xml_tree import Element

End = tuple[str, str]
"""An object, and its output; empty for the only one."""
COLUMN, ROW, NETWORK = 120, 40, 2000
OF_NETWORK = "network"
"""The number of the network that an object is in: an attribute that no file gets."""
_STANDARD = {"SEL": ("G", "IN0", "IN1"), "MUX": ("K", "IN0"), "LIMIT": ("MN", "IN", "MX")}
_TITLE = re.compile(r"""(['"])((?:(?!\1)[^$]|\$.)*)\1""")
_ESCAPED = re.compile(r"""\$(['"$])""")
_WIRE = re.compile(r"(?<![\w#])#\w")


class CannotWrite(ValueError):
    """What PLCopen has no form for, for people."""

    def at(self, span: Span) -> "CannotWrite":
        """With its place in the program."""
        return CannotWrite(f"{self} ({span.file}, line {span.line})")


def text(node: tree.Expression | tree.TypeSpec | tree.Initial) -> str:
    """As it is written in the program."""
    span = node.span
    assert isinstance(span, Stretch)
    return span.source.text[span.start : span.end]


def paragraph(parent: Element, written: str) -> None:
    made = parent.makeelement("{http://www.w3.org/1999/xhtml}p", {}, nsmap={"xhtml": "http://www.w3.org/1999/xhtml"})
    made.text = written
    parent.append(made)


def add(parent: Element, name: str, /, **attributes: str) -> Element:
    return etree.SubElement(parent, name, attributes)


class Objects:
    """What a body is made of."""

    def __init__(self, body: Element) -> None:
        self.body = body
        self._network = 0
        self._made: list[Element] = []
        self._count = 0
        self._row = 0
        self._column = 0

    def next_network(self) -> None:
        """What comes now is below all that was there."""
        self._network += 1
        self._made = []
        self._row = (self._row // NETWORK + 1) * NETWORK if self._count else 0
        self._column = 0

    def networks(self) -> list[list[Thing]]:
        """The networks that a reader finds in what was made since the last `next_network`."""
        rails = [each for each in self.body.iterchildren("leftPowerRail") if each not in self._made]
        made = [thing_of(each, number) for number, each in enumerate((*rails, *self._made))]
        return list(networks_of(made, ladder=True))

    def local_id(self) -> str:
        """One that no other object of the body has."""
        self._count += 1
        return str(self._count)

    def head(self, label: str, written: Span) -> None:
        """Title and label, which come before all that is in a network; the title is text in its first line."""
        assert isinstance(written, Stretch)
        title = _TITLE.search(written.source.text, written.start, written.end)
        if title is not None:
            _, made = self.make("comment", height="20", width="200")
            paragraph(add(made, "content"), _ESCAPED.sub(r"\1", title[2]))
        if label:
            self.make("label", label=label)

    def make(self, kind: str, **attributes: str) -> tuple[str, Element]:
        """A new object with its place."""
        id = self.local_id()
        made = add(self.body, kind, localId=id, **attributes)
        made.set(OF_NETWORK, str(self._network))
        self._made.append(made)
        self._row, self._column = self._row + ROW, self._column + 1
        add(made, "position", x=str(self._column * COLUMN), y=str(self._row))
        return id, made

    def connect(self, node: Element, ends: Sequence[End]) -> None:
        """Its input, with all that leads there."""
        into = add(node, "connectionPointIn")
        for id, output in ends:
            add(into, "connection", refLocalId=id, **({"formalParameter": output} if output else {}))

    def value(self, written: str, negated: bool = False) -> End:
        """An object that gives a value."""
        id, made = self.make("inVariable", negated="true" if negated else "false")
        add(made, "connectionPointOut")
        add(made, "expression").text = written
        return id, ""

    def result(self, written: str, ends: Sequence[End], storage: str = "none", negated: bool = False) -> None:
        """An object that takes one."""
        _, made = self.make("outVariable", storage=storage, **({"negated": "true"} if negated else {}))
        self.connect(made, ends)
        add(made, "expression").text = written

    def block(
        self,
        callee: str,
        instance: str,
        inputs: Sequence[tuple[str, Sequence[End], str, bool]],
        outputs: Mapping[str, bool],
    ) -> str:
        """A box; an input has its name, what leads to it, its edge, and whether it is negated; an output its name and whether it is."""
        own, made = self.make("block", typeName=callee, **({"instanceName": instance} if instance else {}))
        pins = add(made, "inputVariables")
        for name, ends, edge, negated in inputs:
            marks = ({"edge": edge} if edge else {}) | ({"negated": "true"} if negated else {})
            self.connect(add(pins, "variable", formalParameter=name, **marks), ends)
        add(made, "inOutVariables")
        pins = add(made, "outputVariables")
        for name, negated in outputs.items():
            marks = {"negated": "true"} if negated else {}
            add(add(pins, "variable", formalParameter=name, **marks), "connectionPointOut")
        return own


@dataclass(slots=True)
class Outputs:
    """What takes the outputs of a box: variables and links of the text, by output."""

    negated: dict[str, bool] = field(default_factory=dict)
    """All outputs of the box."""
    variables: list[tuple[str, str, bool]] = field(default_factory=list)
    """By output; and whether it is negated on the way, where the output itself is not."""
    wires: list[tuple[str, str]] = field(default_factory=list)
    turned: list[str] = field(default_factory=list)
    """Links that the output which goes on as power goes to negated."""
    power: str = ""
    """The output whose value goes on as power, '' if none does. That may be taken besides."""

    shared: bool = False
    """Whether it is."""

    def __post_init__(self) -> None:
        if self.power:
            self.negated[self.power] = False

    def take(self, argument: tree.Argument) -> None:
        """`Q => q`, `NOT Q => #q`."""
        name, value = argument.name or "", argument.value
        if value is None:
            return
        shared = bool(self.power) and name.upper() == self.power.upper()
        if shared and argument.negated and is_wire(value):
            self.turned.append(value.name)
            return
        if shared:
            name, self.shared = self.power, True
        self.negated[name] = argument.negated and not shared
        if is_wire(value):
            self.wires.append((name, value.name))
        else:
            self.variables.append((name, text(value), argument.negated and shared))


@dataclass(frozen=True, slots=True)
class Known:
    """What the boxes of a body call."""

    types: Mapping[str, str]
    """Of instances of blocks, by upper-case name."""
    inputs: Mapping[str, tuple[str, ...]]
    """Of functions of the project, by upper-case name."""

    def result(self, function: str) -> str:
        """What the result of a function is named: as the function itself is, since one of the project may have an output of any name."""
        return function if function.upper() in self.inputs else "OUT"

    def has_result(self, function: str, outputs: Outputs) -> bool:
        """Whether the result is written though nothing takes it: an output could be taken for it."""
        return function.upper() in self.inputs and any(name.upper() in RESULTS for name in outputs.negated)

    def formal(self, function: str, number: int, count: int) -> str:
        """The name of an input that the text gives by its place."""
        names = self.inputs.get(function.upper()) or _STANDARD.get(function.upper())
        if names is not None:
            return names[number] if number < len(names) else f"IN{number - 1}"
        return "IN" if count == 1 else f"IN{number + 1}"


def is_wire(value: object) -> TypeGuard[tree.Name]:
    return isinstance(value, tree.Name) and value.name.startswith(networks.WIRE)


def uses_wires(expression: tree.Expression) -> bool:
    return _WIRE.search(text(expression)) is not None
