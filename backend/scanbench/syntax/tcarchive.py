"""The archive in which a file of TwinCAT (`.TcPOU`) keeps what is drawn -> tokens of our own text, with places in the XML.

`<o>` is an object with its members, `<v>` a value, `<l2>` a list, `<n/>` nothing. What is read of it is made of pieces: texts of ours,
and operands that stay where the file has them.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field

from scanbench.syntax.lexer import KEYWORDS, Lex
from scanbench.syntax.xml_outline import Element

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
    """A line of a network; `at` and `end`: the element that it is of. Without `end` its pieces follow each other."""

    at: int
    pieces: Pin
    end: int = 0


@dataclass(slots=True)
class Network:
    """One network that is not commented out."""

    at: int
    label: str
    end: int = 0
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


def write(network: Network, add: Callable[[Lex, str, int], None], operand: Callable[[Operand, int], int]) -> None:
    """The tokens of a network. `operand` adds those of an operand, at their own places where they follow what was there last: where they end."""
    at = network.at
    made(("NETWORK", *((network.label, ":") if network.label else ())), at, add, operand)
    for line in network.lines:
        at = made(line.pieces, line.at, add, operand, line.end)
    made(("END_NETWORK",), max(at, network.end), add, operand)


def made(
    pieces: Pin,
    at: int,
    add: Callable[[Lex, str, int], None],
    operand: Callable[[Operand, int], int],
    end: int = 0,
) -> int:
    """The tokens of pieces that begin at `at`: where they end. With `end`, operands may be anywhere, and the last piece is at the end."""
    for index, piece in enumerate(pieces):
        if isinstance(piece, Operand):
            if end and (piece.begin < at or piece.end > end):
                operand(piece, 0)
            else:
                at = operand(piece, at)
            continue
        if end and index == len(pieces) - 1:
            at = max(at, end)
        for text in ("#", piece[1:]) if piece.startswith("#") and len(piece) > 1 else (piece,):
            kind = kind_of(text)
            add(kind, text.upper() if kind is Lex.KEYWORD else text, at)
            at += len(text)
    return at


def kind_of(text: str) -> Lex:
    """What kind of token a made text is."""
    if text.upper() in KEYWORDS:
        return Lex.KEYWORD
    return Lex.NAME if text[0].isalpha() or text[0] == "_" else Lex.OPERATOR
