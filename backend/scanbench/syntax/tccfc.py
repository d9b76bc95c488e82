"""Continuous function charts of TwinCAT (`<CFC>` of a `.TcPOU`) -> lines of one NETWORK, in their order of execution.

The archive has one list of items. Boxes (`CFCBoxElement`) and outputs (`CFCOutputElement`) are in the order in which they run, which
is the number that TwinCAT shows at them; inputs (`CFCInputElement`) only hold a text, and connections (`CFCConnection`) join two
pins by their `Id`. The texts of a box are the names of its inputs, then of its outputs, then its type, then, of a function block, its
instance. This was read off published projects (TwinCAT 3.1.4024); what an archive has besides is refused, by its name.
"""

from dataclasses import dataclass, field

from scanbench.syntax.tcarchive import Archive, Line, Network, NotRead, Operand, Pin
from scanbench.syntax.tcnwl import OPERATORS, formal_names
from scanbench.syntax.xml_outline import Element

INPUT, OUTPUT, BOX, CONNECTION = "CFCInputElement", "CFCOutputElement", "CFCBoxElement", "CFCConnection"
COMMENT = "CFCCommentElement"


@dataclass(slots=True)
class _Pin:
    id: str
    element: Element
    name: str = ""
    negated: bool = False


@dataclass(slots=True)
class _Item:
    """An input, an output or a box."""

    kind: str
    element: Element
    inputs: list[_Pin] = field(default_factory=list)
    outputs: list[_Pin] = field(default_factory=list)
    text: Operand | None = None
    """The variable or expression; of a box its instance."""
    type: str = ""
    block: bool = False
    wire: str = ""


class _Reader:
    def __init__(self, archive: Archive, made: Network) -> None:
        self._archive, self._made = archive, made
        self._sources: dict[str, str] = {}
        """Of an input pin, the output pin."""
        self._givers: dict[str, tuple[_Item, _Pin]] = {}

    def read(self, items: list[Element], listed: str) -> None:
        found: list[_Item] = []
        for each in items:
            kind = self._archive.type(each, listed)
            if kind == CONNECTION:
                self._connect(each)
            elif kind in (INPUT, OUTPUT, BOX):
                found.append(self._item(each, kind))
            elif kind != COMMENT:
                raise NotRead(f"This CFC has a {kind or 'part without a type'}, which is not read", each)
        for number, item in enumerate((each for each in found if each.kind != INPUT), 1):
            item.wire = f"c{number}"
        for item in found:
            if item.kind == BOX:
                self._box(item)
            elif item.kind == OUTPUT:
                self._output(item)

    # ---- the archive ----------------------------------------------------------------------------------------------

    def _connect(self, each: Element) -> None:
        source, target = self._archive.value(each, "SourcePinId"), self._archive.value(each, "DestPinId")
        if target in self._sources:
            raise NotRead("Two connections of this CFC lead to one input", each)
        self._sources[target] = source

    def _item(self, each: Element, kind: str) -> _Item:
        made = _Item(kind, each)
        if kind == BOX:
            self._box_pins(made)
        else:
            text = self._archive.member(each, "Text")
            made.text = self._archive.operand(text, "Text")
            if made.text is None or made.text.text == "???":
                raise NotRead("An input or output of this CFC has no variable", each)
            pin = self._archive.member(each, "Output" if kind == INPUT else "Input")
            if pin is None:
                raise NotRead(f"The pin of {made.text.text} in this CFC is not read", each)
            (made.outputs if kind == INPUT else made.inputs).append(self._pin(pin))
        for out in made.outputs:
            self._givers[out.id] = (made, out)
        return made

    def _pin(self, each: Element) -> _Pin:
        if self._archive.value(each, "SetResetRef") not in ("", "None"):
            raise NotRead("This CFC has a pin with REF=, which is not read", each)
        return _Pin(
            self._archive.value(each, "Id"), each, negated=self._archive.value(each, "Negated").lower() == "true"
        )

    def _listed(self, each: Element, name: str) -> list[Element]:
        return [one for one in self._archive.items(self._archive.member(each, name), "InnerList") if one.tag == "o"]

    def _box_pins(self, made: _Item) -> None:
        archive, each = self._archive, made.element
        made.inputs = [self._pin(one) for one in self._listed(each, "Inputs")]
        made.outputs = [self._pin(one) for one in self._listed(each, "Outputs")]
        made.block = archive.value(each, "KindOfCall") == "FunctionBlock"
        texts = self._listed(each, "Texts")
        pins = [*made.inputs, *made.outputs]
        if len(texts) != len(pins) + (2 if made.block else 1):
            raise NotRead("A box of this CFC has texts that do not fit its pins", each)
        for pin, text in zip(pins, texts, strict=False):
            pin.name = archive.value(text, "Text")
        made.type = archive.value(texts[len(pins)], "Text")
        made.text = archive.operand(texts[-1], "Text")
        if made.text is None or made.text.text == "???":
            raise NotRead("A box of this CFC has no name", each)
        if archive.value(each, "EnEno").lower() == "true" and (not made.inputs or made.inputs[0].name.upper() != "EN"):
            raise NotRead(f"The box {made.type} of this CFC has EN, but its first input is not EN", each)
        if self._listed(each, "Parameters"):
            raise NotRead(f"The box {made.type} of this CFC has parameters, which are not read", each)

    # ---- lines ----------------------------------------------------------------------------------------------------

    def _line(self, item: _Item, *pieces: str | Operand) -> None:
        self._made.lines.append(Line(item.element.start, (*pieces, ";"), item.element.end))

    def _value(self, pin: _Pin) -> Pin:
        """What is at an input; empty where nothing is connected."""
        source = self._sources.get(pin.id)
        if source is None:
            return ()
        if source not in self._givers:
            raise NotRead("A connection of this CFC begins at a pin that there is not", pin.element)
        item, out = self._givers[source]
        if item.kind == INPUT:
            assert item.text is not None
            value: Pin = (item.text,)
        elif item.block and out.name.upper() != "ENO":
            assert item.text is not None
            value = (item.text, ".", out.name)
        else:
            main = not item.block and out is self._main(item)
            value = (f"#{item.wire}" if main else f"#{item.wire}_{out.name}",)
        if out.negated:
            value = ("NOT", "(", *value, ")")
        return ("NOT", "(", *value, ")") if pin.negated else value

    def _main(self, item: _Item) -> _Pin | None:
        """The output of a function that is its result."""
        return next((each for each in item.outputs if each.name.upper() != "ENO"), None)

    def _output(self, item: _Item) -> None:
        pin, target = item.inputs[0], item.text
        value = self._value(pin)
        assert target is not None
        if not value:
            raise NotRead(f"Nothing is connected to the output {target.text} of this CFC", item.element)
        match self._archive.value(pin.element, "SetReset"):
            case "" | "None":
                self._line(item, target, ":=", *value)
            case "Set":
                self._line(item, target, "S", "=", *value)
            case "Reset":
                self._line(item, target, "R", "=", *value)
            case other:
                raise NotRead(f"The output {target.text} of this CFC has {other}, which is not read", item.element)

    def _box(self, item: _Item) -> None:
        name = item.text
        assert name is not None
        enabled = bool(item.inputs) and item.inputs[0].name.upper() == "EN"
        names = formal_names(item.type, len(item.inputs) - 1) if enabled and not item.block else None
        call: list[str | Operand] = []
        for index, pin in enumerate(item.inputs, 1):
            value = self._value(pin)
            if not value and not (item.block or pin.name.upper() == "EN"):
                raise NotRead(f"Input {index} of the box {item.type} in this CFC is not connected", pin.element)
            if not value:
                continue
            formal = "" if item.type.upper() in OPERATORS and not item.block else pin.name
            if names is not None:
                formal = "EN" if index == 1 else names[index - 2]
            call += [*([","] if call else []), *((formal, ":=") if formal else ()), *value]
        used = set(self._sources.values())
        main = None if item.block else self._main(item)
        if call[:2] == ["EN", ":="] and main is not None and main.id in used:
            message = f"The box {item.type} of this CFC has EN and keeps its result, which is not read"
            raise NotRead(message, item.element)
        for pin in item.outputs:
            if pin is not main and pin.id in used and (not item.block or pin.name.upper() == "ENO"):
                call += [*([","] if call else []), pin.name, "=>", f"#{item.wire}_{pin.name}"]
        if main is None or main.id not in used:
            self._line(item, name, "(", *call, ")")
        else:
            self._line(item, f"#{item.wire}", "=", name, "(", *call, ")")


def network_of(body: Element, archive: Archive) -> Network:
    """The one network of a `<CFC>`. `NotRead`."""
    root = body.child("XmlArchive", "Data", "o")
    items = None if root is None else archive.member(root, "Items")
    listed = None if items is None else archive.member(items, "InnerList", "l2")
    if listed is None:
        raise NotRead("This CFC has no list of its items", body)
    made = Network(body.start, "")
    _Reader(archive, made).read([each for each in listed.children if each.tag == "o"], archive.attribute(listed, "cet"))
    return made
