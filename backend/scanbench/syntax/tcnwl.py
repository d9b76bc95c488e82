"""Networks of TwinCAT (`<NWL>`: ladder and function block diagrams of a `.TcPOU`) -> tokens of our own networks, with places in the XML.

The archive holds a tree for each coil and box: what is nearer to the leaves runs first, inputs from top to bottom. So each box becomes a
line of a NETWORK, and wires between them get names, of network and box: `#n1_1 = AND(a, b);`. Only the shapes below are read; what a network has besides is
refused, by its name.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from scanbench.syntax.lexer import Lex
from scanbench.syntax.xml_outline import Element

NEGATION, SET, JUMP, RETURN, RISING, FALLING = 1, 2, 4, 8, 16, 32
"""Bits of `Flags`, at operands, targets and inputs of boxes. Of a target NEGATION and SET together mean reset."""
OPERATORS = frozenset(
    "AND OR XOR NOT ADD SUB MUL DIV MOD GT GE EQ LE LT NE MOVE SEL MUX LIMIT MIN MAX SHL SHR ROL ROR ABS SQRT EXPT TRUNC".split()
)
"""Boxes whose inputs have no names in our text."""
PLAIN = re.compile(r"[^\W\d][\w.]*(?:\[[^\[\]]*\])?[\w.^]*|%\w[\d.]*")
_ATTRIBUTES: dict[str, re.Pattern[str]] = {
    name: re.compile(rf"""\s{name}\s*=\s*["']([^"']*)["']""") for name in ("n", "t", "cet")
}


class NotRead(Exception):
    """A shape that is not read: why, and the element that has it."""

    def __init__(self, message: str, element: Element) -> None:
        super().__init__(message)
        self.message, self.element = message, element


@dataclass(frozen=True, slots=True)
class Operand:
    """A variable or an expression, where it is written."""

    begin: int
    end: int
    text: str


Piece = str | Operand
Pin = tuple[Piece, ...]
"""What is at an input: made texts, and operands of the file."""


@dataclass(slots=True)
class Line:
    """A line of a network; `at`: the element that it is of."""

    at: int
    pieces: Pin


@dataclass(slots=True)
class Network:
    """One network that is not commented out."""

    at: int
    label: str
    lines: list[Line] = field(default_factory=list)


class Archive:
    """Reads the values of the archive's elements: `<o>` an object, `<v>` a value, `<l2>` a list, `<n/>` nothing."""

    def __init__(self, xml: str, text: str) -> None:
        """`text`: the same with blanks for everything that is markup."""
        self._xml, self._text = xml, text

    def attribute(self, element: Element, name: str) -> str:
        """`n` is the member that it is, `t` its type, `cet` the type of what a list has."""
        found = _ATTRIBUTES[name].search(self._xml, element.start, element.begin)
        return found.group(1) if found else ""

    def member(self, element: Element, name: str, tag: str = "o") -> Element | None:
        """The member of an object."""
        return next((each for each in element.children if each.tag == tag and self.attribute(each, "n") == name), None)

    def value(self, element: Element | None, name: str) -> str:
        """The text of a member, without the quotes."""
        found = self.operand(element, name)
        return found.text if found else ""

    def operand(self, element: Element | None, name: str) -> Operand | None:
        """A member with its place; None where it has none, or is empty."""
        found = None if element is None else self.member(element, name, "v")
        if found is None:
            return None
        begin, end = found.begin, found.end
        while begin < end and self._text[begin] in " \t\r\n":
            begin += 1
        while end > begin and self._text[end - 1] in " \t\r\n":
            end -= 1
        if end - begin >= 2 and self._text[begin] == self._text[end - 1] == '"':
            begin, end = begin + 1, end - 1
        text = self._text[begin:end].strip()
        return Operand(begin, end, text) if text else None

    def items(self, element: Element | None, name: str) -> list[Element]:
        """What a list has."""
        found = None if element is None else self.member(element, name, "l2")
        return [] if found is None else found.children

    def names(self, element: Element | None) -> list[str]:
        """The names of the pins of a box."""
        found = None if element is None else self.member(element, "Names", "l2")
        return [self._text[each.begin : each.end].strip().strip('"') for each in found.children] if found else []

    def flags(self, element: Element | None) -> int:
        """Its flags: of an object that has them, or of such an object itself."""
        if element is None:
            return 0
        inner = self.member(element, "Flags")
        text = self.value(inner if inner is not None else element, "Flags")
        return int(text) if text.isdigit() else 0

    def type(self, element: Element, listed: str) -> str:
        """The type of an object; in a list with one type for all it is said there."""
        return self.attribute(element, "t") or listed


class _Reader:
    """Reads one network."""

    def __init__(self, archive: Archive, made: Network, number: int) -> None:
        self._archive, self._made, self._number = archive, made, number
        self._wires = 0

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
        if not name:
            self._wires += 1
            name = f"n{self._number}_{self._wires}"
        self._line(element, "#", name, "=", *value)
        return (f"#{name}",)

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

    def _box(self, element: Element, used: bool) -> Pin:
        archive = self._archive
        name = archive.value(element, "BoxType")
        instance = archive.operand(archive.member(element, "Instance"), "Operand")
        self._refuse_box(element, name)
        call: list[Piece] = []
        named = archive.names(archive.member(element, "InputParam"))
        inputs, flags = self._inputs(element), archive.items(element, "InputFlags")
        for index, pin in enumerate(inputs):
            formal = named[index] if index < len(named) and name.upper() not in OPERATORS else ""
            if not pin and not (instance and formal):
                raise NotRead(
                    f"Input {index + 1} of the box {name} in network {self._number} is not connected", element
                )
            if pin:
                own = archive.flags(flags[index]) if index < len(flags) else 0
                call += [*([","] if call else []), *((formal, ":=") if formal else ()), *self._with(own, pin, element)]
        outs = archive.names(archive.member(element, "OutputParam"))
        targets = archive.items(archive.member(element, "OutputItems"), "OutputItems")
        if instance is None:
            return self._function(element, name, (name, "(", *call, ")"), targets, used)
        self._line(element, instance, "(", *call, ")")
        for index, target in enumerate(targets):
            if archive.operand(target, "Operand") and index < len(outs) and outs[index]:
                self._target(target, archive.flags(target), (instance, ".", outs[index]))
        if not used:
            return ()
        main = archive.value(element, "MainOutputIndex")
        which = int(main) if main.isdigit() else 0
        if which >= len(outs) or not outs[which]:
            raise NotRead(f"What the block {instance.text} in network {self._number} gives out has no name", element)
        return (instance, ".", outs[which])

    def _inputs(self, element: Element) -> list[Pin]:
        listed = self._archive.member(element, "InputItems", "l2")
        kind = "" if listed is None else self._archive.attribute(listed, "cet")
        found = [] if listed is None else listed.children
        return [() if each.tag == "n" else self._value(each, kind) for each in found]

    def _refuse_box(self, element: Element, name: str) -> None:
        archive = self._archive
        enabled = archive.member(element, "EN") or archive.value(element, "EN").lower() == "true"
        if enabled:
            raise NotRead(f"The box {name} in network {self._number} has EN, which is not read", element)
        if archive.value(element, "ProvidesSTSnippet").lower() == "true":
            raise NotRead(f"Network {self._number} has a box with statements (EXECUTE), which is not read", element)
        if not name:
            raise NotRead(f"A box in network {self._number} has no name", element)

    def _function(self, element: Element, name: str, call: Pin, targets: list[Element], used: bool) -> Pin:
        written = [each for each in targets if self._archive.operand(each, "Operand")]
        if len([each for each in targets[1:] if each in written]) > 0:
            raise NotRead(f"The box {name} in network {self._number} has several outputs, which is not read", element)
        if not written and not used:
            self._line(element, *call)
            return ()
        value = self._wire(element, call)
        for target in written:
            self._target(target, self._archive.flags(target), value)
        return value


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


def write(network: Network, add: Callable[[Lex, str, int], None], operand: Callable[[Operand, int], int]) -> None:
    """The tokens of a network. `operand` adds those of an operand, at their own places where they follow what was there last: where they end."""
    at = network.at
    _made(("NETWORK", *((network.label, ":") if network.label else ())), at, add, operand)
    for line in network.lines:
        at = _made(line.pieces, line.at, add, operand)
    _made(("END_NETWORK",), at, add, operand)


def _made(pieces: Pin, at: int, add: Callable[[Lex, str, int], None], operand: Callable[[Operand, int], int]) -> int:
    for piece in pieces:
        if isinstance(piece, Operand):
            at = operand(piece, at)
            continue
        for text in ("#", piece[1:]) if piece.startswith("#") and len(piece) > 1 else (piece,):
            add(_kind(text), text.upper() if _kind(text) is Lex.KEYWORD else text, at)
            at += len(text)
    return at


def _kind(text: str) -> Lex:
    if text.upper() in ("NOT", "AND", "OR", "XOR", "MOD", "RETURN", "TRUE"):
        return Lex.KEYWORD
    return Lex.NAME if text[0].isalpha() or text[0] == "_" else Lex.OPERATOR
