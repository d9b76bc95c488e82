"""XML that is read for the positions of its texts: elements, and the text with blanks for everything that is markup."""

import re
from dataclasses import dataclass, field
from xml.parsers import expat

MAX_XML_DEPTH = 400
"""A rung of TwinCAT nests five elements for each contact."""
NOT_A_LINE_END = re.compile(r"[^\n]")


NotWellFormed = expat.ExpatError


def reason(error: NotWellFormed) -> str:
    """What is wrong with it."""
    return expat.ErrorString(error.code)


@dataclass(slots=True)
class Element:
    """One element of the XML: where it begins, and where its content is."""

    tag: str
    start: int
    begin: int = 0
    end: int = 0
    children: list["Element"] = field(default_factory=list)

    def child(self, *path: str) -> "Element | None":
        """The first descendant along these tags."""
        found: Element | None = self
        for tag in path:
            found = next((each for each in found.children if each.tag == tag), None) if found else None
        return found


class Refused(Exception):
    """XML that is not read."""


class Outline:
    """Elements of a file, and its text with blanks for everything that is markup."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.root = Element("", 0)
        self._open = [self.root]
        self._parts: list[str] = []
        self._at = 0
        self._escaped = -1
        """Where the last escaped character ended."""

    def read(self) -> str:
        # one byte a character, so that positions in bytes are positions in the text; what is kept is taken from the text
        parser = expat.ParserCreate("iso-8859-1")
        self._parser = parser
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._data
        parser.StartDoctypeDeclHandler = self._doctype
        parser.Parse(self.text.encode("latin-1", "replace"), True)
        self._blank(len(self.text))
        return "".join(self._parts)

    def _start(self, tag: str, _: dict[str, str]) -> None:
        at = self._parser.CurrentByteIndex
        if len(self._open) > MAX_XML_DEPTH:
            raise Refused(f"its elements nest more than {MAX_XML_DEPTH} deep")
        element = Element(tag, at, self.text.index(">", at) + 1)
        self._open[-1].children.append(element)
        self._open.append(element)

    def _end(self, _: str) -> None:
        element = self._open.pop()
        element.end = max(self._parser.CurrentByteIndex, element.begin)

    def _data(self, data: str) -> None:
        at = self._parser.CurrentByteIndex
        if self.text[at] == "&":
            # an escaped character takes the end of its entity that is nearer to its neighbour: `&lt;=` stays one operator
            last = self.text.index(";", at)
            at = at if self._escaped == at else last
            self._blank(at)
            self._parts.append(data)
            self._at += 1
            self._blank(last + 1)
            self._escaped = last + 1
            return
        self._blank(at)
        self._parts.append(self.text[at : at + len(data)])
        self._at += len(data)

    def _doctype(self, *_: object) -> None:
        raise Refused("it has a DOCTYPE, which such files do not")

    def _blank(self, end: int) -> None:
        """Fills up with blanks to here; lines stay lines."""
        if end > self._at:
            self._parts.append(NOT_A_LINE_END.sub(" ", self.text[self._at : end]))
            self._at = end
