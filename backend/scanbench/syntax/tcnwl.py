"""Networks of TwinCAT (`<NWL>`: ladder and function block diagrams of a `.TcPOU`) -> tokens of our own networks, with places in the XML.

The archive holds a tree for each coil and box: what is nearer to the leaves runs first, inputs from top to bottom. So each box becomes a
line of a NETWORK, and wires between them get names, of network and box: `#n1_1 = AND(a, b);`. Only the shapes below are read; what a network has besides is
refused, by its name.
"""

import re
from collections.abc import Iterator

from scanbench.syntax.tcarchive import Archive, Line, Network, NotRead, Operand, Piece, Pin
from scanbench.syntax.xml_outline import Element

NEGATION, SET, JUMP, RETURN, RISING, FALLING = 1, 2, 4, 8, 16, 32
"""Bits of `Flags`, at operands, targets and inputs of boxes. Of a target NEGATION and SET together mean reset."""
OPERATORS = frozenset(
    "AND OR XOR NOT ADD SUB MUL DIV MOD GT GE EQ LE LT NE MOVE SEL MUX LIMIT MIN MAX SHL SHR ROL ROR ABS SQRT EXPT TRUNC".split()
)
"""Boxes whose inputs have no names in our text, unless they have EN."""
FORMALS = {"SEL": ("G", "IN0", "IN1"), "LIMIT": ("MN", "IN", "MX"), "SHL": ("IN", "N"), "SHR": ("IN", "N"), "ROL": ("IN", "N"), "ROR": ("IN", "N")}  # fmt: skip
SINGLE = frozenset(("NOT", "MOVE", "ABS", "SQRT", "TRUNC"))
PLAIN = re.compile(r"[^\W\d][\w.]*(?:\[[^\[\]]*\])?[\w.^]*|%\w[\d.]*")


def formal_names(name: str, count: int) -> tuple[str, ...] | None:
    """Of an operator with so many inputs besides EN, which then need names; None of any other box, and where the count is not possible."""
    name = name.upper()
    if name not in OPERATORS:
        return None
    if name == "MUX":
        return ("K", *(f"IN{at}" for at in range(count - 1)))
    names = ("IN",) if name in SINGLE else FORMALS.get(name) or tuple(f"IN{at}" for at in range(1, count + 1))
    return names if len(names) == count else None


class _Reader:
    """Reads one network."""

    def __init__(self, archive: Archive, made: Network, number: int) -> None:
        self._archive, self._made, self._number = archive, made, number
        self._wires = 0
        self._calls = 0
        """Of what may do more than give a value."""

    def item(self, element: Element, listed: str) -> None:
        """A coil, a box or a wire of the network."""
        self._value(element, listed, used=False)

    def _value(self, element: Element, listed: str = "", *, used: bool = True) -> Pin:
        kind = self._archive.type(element, listed) or self._shape(element)
        match kind:
            case "BoxTreeOperand":
                return self._leaf(element)
            case "BoxTreeAssign":
                return self._assign(element)
            case "BoxTreeBox":
                return self._box(element, used)
            case "BoxTreeParallel":
                return self._parallel(element)
            case "BoxTreeDemux":
                return self._demux(element)
            case "BoxTreeTerminator":
                return self._input(element) or ("TRUE",)
        raise NotRead(f"Network {self._number} has a {kind or 'part without a type'}, which is not read", element)

    def _shape(self, element: Element) -> str:
        """Of an object without a type, by its members."""
        archive = self._archive
        if archive.member(element, "BoxType", "v"):
            return "BoxTreeBox"
        if archive.member(element, "RValue") or archive.member(element, "OutputItems"):
            return "BoxTreeAssign"
        return "BoxTreeOperand" if archive.member(element, "Operand") else ""

    def _input(self, element: Element) -> Pin:
        inner = self._archive.member(element, "Input")
        return () if inner is None else self._value(inner)

    def _leaf(self, element: Element) -> Pin:
        inner = self._archive.member(element, "Operand")
        found = self._archive.operand(inner, "Operand")
        if found is None or found.text == "???":
            return ()
        return self._with(self._archive.flags(inner), (found,), element)

    def _with(self, flags: int, pin: Pin, element: Element) -> Pin:
        """A value that is negated, or whose edge counts."""
        if flags & (RISING | FALLING):
            first = pin[0]
            plain = len(pin) == 1 and (isinstance(first, str) or PLAIN.fullmatch(first.text))
            pin = ("R_EDGE" if flags & RISING else "F_EDGE", *(pin if plain else self._wire(element, pin)))
            return ("NOT", *pin) if flags & NEGATION else pin
        return ("NOT", "(", *pin, ")") if flags & NEGATION else pin

    def _wire(self, element: Element, value: Pin, name: str = "") -> Pin:
        """A line that gives a wire its value. What reads it."""
        name = name or self._name()
        self._line(element, "#", name, "=", *value)
        return (f"#{name}",)

    def _name(self) -> str:
        """Of a wire that is made."""
        self._wires += 1
        return f"n{self._number}_{self._wires}"

    def _line(self, element: Element, *pieces: Piece) -> None:
        self._made.lines.append(Line(element.start, (*pieces, ";")))

    def _demux(self, element: Element) -> Pin:
        name = f"v{self._number}_{self._archive.value(element, 'VarId').rstrip('Ll') or '0'}"
        value = self._input(element)
        return self._wire(element, value, name) if value else (f"#{name}",)

    def _assign(self, element: Element) -> Pin:
        archive = self._archive
        inner = archive.member(element, "RValue")
        value = () if inner is None else self._value(inner)
        if not value and inner is not None and archive.type(inner, "") != "BoxTreeTerminator":
            raise NotRead(f"In network {self._number} nothing is connected to a coil or assignment", element)
        value = value or ("TRUE",)
        targets = archive.items(archive.member(element, "OutputItems"), "OutputItems")
        if len(targets) > 1 and len(value) > 1:
            value = self._wire(element, value)
        for target in targets:
            self._target(target, archive.flags(target) | archive.flags(element), value)
        return value

    def _target(self, target: Element, flags: int, value: Pin) -> None:
        found = self._archive.operand(target, "Operand")
        if flags & RETURN:
            self._line(target, "RETURN", *(() if value == ("TRUE",) else ("IF", *value)))
        elif found is None or found.text == "???":
            raise NotRead(f"In network {self._number} a coil or assignment has no variable", target)
        elif flags & JUMP:
            self._line(target, "JMP", found, *(() if value == ("TRUE",) else ("IF", *value)))
        elif flags & SET:
            self._line(target, found, "R" if flags & NEGATION else "S", "=", *value)
        else:
            self._line(target, found, ":=", *(("NOT", "(", *value, ")") if flags & NEGATION else value))

    def _parallel(self, element: Element) -> Pin:
        """Branches: what comes in, AND the OR of what they give; those after one that is closed are not skipped, unless they hold boxes."""
        archive = self._archive
        before = self._input(element)
        calls = self._calls
        branches = [self._value(each) for each in archive.items(element, "Trees")]
        if not branches or not all(branches):
            raise NotRead(f"A parallel branch in network {self._number} has nothing in it", element)
        if self._calls > calls and archive.value(element, "Mode") != "Sequential":
            raise NotRead(
                f"Network {self._number} calls a block in a branch with short circuit, which is not read", element
            )
        either = tuple(piece for each in branches for piece in ("OR", "(", *each, ")"))[1:]
        return self._wire(element, (*before, "AND", "(", *either, ")") if before and before != ("TRUE",) else either)

    def _box(self, element: Element, used: bool) -> Pin:
        archive = self._archive
        name = archive.value(element, "BoxType")
        instance = archive.operand(archive.member(element, "Instance"), "Operand")
        named = archive.names(archive.member(element, "InputParam"))
        inputs, flags = self._inputs(element), archive.items(element, "InputFlags")
        enabled = bool(named) and named[0].upper() == "EN"
        self._refuse_box(element, name, enabled)
        if enabled and name.upper() in OPERATORS:
            named = ["EN", *(formal_names(name, len(inputs) - 1) or named[1:])]
        call: list[Piece] = []
        for index, pin in enumerate(inputs):
            formal = named[index] if index < len(named) and (enabled or name.upper() not in OPERATORS) else ""
            if not pin and not (formal and (instance or formal.upper() == "EN")):
                raise NotRead(
                    f"Input {index + 1} of the box {name} in network {self._number} is not connected", element
                )
            if pin and not (formal.upper() == "EN" and pin == ("TRUE",)):
                own = archive.flags(flags[index]) if index < len(flags) else 0
                call += [*([","] if call else []), *((formal, ":=") if formal else ()), *self._with(own, pin, element)]
        outs = archive.names(archive.member(element, "OutputParam"))
        targets = archive.items(archive.member(element, "OutputItems"), "OutputItems")
        main = archive.value(element, "MainOutputIndex")
        which = int(main) if main.isdigit() else 0
        if instance is None:
            return self._function(element, (name, "(", *call, ")"), outs, targets, which if used else -1)
        return self._block(element, instance, call, outs, targets, which if used else -1)

    def _block(
        self, element: Element, instance: Operand, call: list[Piece], outs: list[str], targets: list[Element], used: int
    ) -> Pin:
        """A call of a function block; `used`: which output goes on, -1 for none."""
        archive, eno = self._archive, ""
        self._calls += 1
        written = [
            (index, target)
            for index, target in enumerate(targets)
            if archive.operand(target, "Operand") and index < len(outs) and outs[index]
        ]
        if any(outs[index].upper() == "ENO" for index in [*(at for at, _ in written), used] if 0 <= index < len(outs)):
            eno = self._name()
            call = [*call, *([","] if call else []), "ENO", "=>", f"#{eno}"]
        self._line(element, instance, "(", *call, ")")
        values: list[Pin] = [(f"#{eno}",) if each.upper() == "ENO" else (instance, ".", each) for each in outs]
        for index, target in written:
            self._target(target, archive.flags(target), values[index])
        if used < 0:
            return ()
        if used >= len(outs) or not outs[used]:
            raise NotRead(f"What the block {instance.text} in network {self._number} gives out has no name", element)
        return values[used]

    def _inputs(self, element: Element) -> list[Pin]:
        listed = self._archive.member(element, "InputItems", "l2")
        kind = "" if listed is None else self._archive.attribute(listed, "cet")
        found = [] if listed is None else listed.children
        return [() if each.tag == "n" else self._value(each, kind) for each in found]

    def _refuse_box(self, element: Element, name: str, enabled: bool) -> None:
        archive = self._archive
        if not enabled and (archive.member(element, "EN") or archive.value(element, "EN").lower() == "true"):
            raise NotRead(f"The box {name} in network {self._number} has EN, but its first input is not EN", element)
        if archive.value(element, "ProvidesSTSnippet").lower() == "true":
            raise NotRead(f"Network {self._number} has a box with statements (EXECUTE), which is not read", element)
        if not name:
            raise NotRead(f"A box in network {self._number} has no name", element)

    def _function(self, element: Element, call: Pin, outs: list[str], targets: list[Element], used: int) -> Pin:
        """A call of a function; its result is the first output that is not ENO, and the others are named."""
        result = 1 if outs[:1] and outs[0].upper() == "ENO" else 0
        written = [at for at, each in enumerate(targets) if self._archive.operand(each, "Operand")]
        values: dict[int, Pin] = {}
        for at in sorted({*written, used} - {result, -1}):
            if at >= len(outs) or not outs[at]:
                raise NotRead(f"Output {at + 1} of the box {call[0]} in network {self._number} has no name", element)
            name = self._name()
            call = (*call[:-1], *([","] if len(call) > 3 else []), outs[at], "=>", f"#{name}", ")")
            values[at] = (f"#{name}",)
        self._calls += call[0] not in OPERATORS
        enabled = call[2:4] == ("EN", ":=")
        if enabled and result in written and used != result and not self._archive.flags(targets[result]):
            self._target(targets[result], 0, call)  # without EN the variable keeps its value, so there is no wire
            written.remove(result)
        elif enabled and (result in written or used == result):
            message = f"The result of the box {call[0]} in network {self._number}, which has EN, goes to more than a variable, which is not read"
            raise NotRead(message, element)
        elif result in written or used == result:
            values[result] = self._wire(element, call)
        else:
            self._line(element, *call)
        for at in written:
            self._target(targets[at], self._archive.flags(targets[at]), values[at])
        return values[used] if used >= 0 else ()


def networks_in(body: Element, archive: Archive) -> Iterator[Network]:
    """The networks of an `<NWL>`, in their order; those that are commented out are left out. `NotRead`."""
    root = body.child("XmlArchive", "Data", "o")
    if root is None or archive.member(root, "NetworkList", "l2") is None:
        raise NotRead("These networks have no list of them", body)
    for number, each in enumerate(archive.items(root, "NetworkList"), 1):
        if archive.value(each, "OutCommented").lower() == "true":
            continue
        listed = archive.member(each, "NetworkItems", "l2")
        items = [] if listed is None else [item for item in listed.children if item.tag == "o"]
        if not items and archive.items(each, "ILLines"):
            raise NotRead(f"Network {number} is written in Instruction List, which is not read here", each)
        made = Network(each.start, archive.value(each, "Label"))
        reader = _Reader(archive, made, number)
        for item in items:
            reader.item(item, archive.attribute(listed, "cet") if listed is not None else "")
        yield made
