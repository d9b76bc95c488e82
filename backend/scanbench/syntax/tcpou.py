"""TwinCAT's files (.TcPOU, .TcDUT, .TcGVL, .TcIO): XML around Structured Text -> the same tree, with places in the XML.

The XML is read once to find the positions of its texts. The tokens of those texts, with the words between them that the XML says in
its own way (METHOD's end, an ACTION's name), then make up the POU that a plain text would have.
"""

import re
from dataclasses import dataclass, field
from xml.parsers import expat

from scanbench.problems import Problem
from scanbench.syntax import tree
from scanbench.syntax.cursor import Cursor
from scanbench.syntax.lexer import AHEAD, Lex, Tokens, tokenize
from scanbench.syntax.parse_pou import ENDS
from scanbench.syntax.parse_st import whole
from scanbench.syntax.source import Source

MAX_XML_DEPTH = 64
NAME_ATTRIBUTE = re.compile(r"""\sName\s*=\s*["']([^"']*)["']""")
NOT_A_LINE_END = re.compile(r"[^\n]")
OBJECTS = ("POU", "Itf", "DUT", "GVL")


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


class _Refused(Exception):
    """XML that is not read."""


class _Outline:
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
            raise _Refused(f"its elements nest more than {MAX_XML_DEPTH} deep")
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
        raise _Refused("it has a DOCTYPE, which such files do not")

    def _blank(self, end: int) -> None:
        """Fills up with blanks to here; lines stay lines."""
        if end > self._at:
            self._parts.append(NOT_A_LINE_END.sub(" ", self.text[self._at : end]))
            self._at = end


def parse_tc(source: Source) -> tuple[tree.File, list[Problem]]:
    """The tree of one TwinCAT file, and every problem on the way."""
    outline = _Outline(source.text)
    try:
        text = outline.read()
    except expat.ExpatError as error:
        at = _position(source.text, error.lineno, error.offset)
        message = f"This is no well-formed XML: {expat.ErrorString(error.code)}. Export the file again."
        return tree.File(source.name), [Problem("S003", message, source.span(at, at + 1))]
    except _Refused as error:
        return tree.File(source.name), [Problem("S003", f"This XML is not read: {error}.", source.span(0, 1))]
    root = outline.root.children[0] if outline.root.children else outline.root
    found = next((each for each in root.children if each.tag in OBJECTS), None)
    if found is None:
        message = f"A file of TwinCAT has one of the elements {', '.join(OBJECTS)} in it, but this has none."
        return tree.File(source.name), [Problem("S003", message, source.span(root.start, root.start + 1))]
    if found.child("Declaration") is None:
        message = f"This {found.tag} has no Declaration, so nothing is known of it. Export the file again."
        return tree.File(source.name), [Problem("S003", message, source.span(found.start, found.start + 1))]
    writer = _Writer(Source(source.name, text, defined=source.defined), source.text)
    writer.object(found)
    list_name = writer.name(found)[0] if found.tag == "GVL" else ""
    cursor = Cursor(writer.source, writer.tokens())
    cursor.list_name = list_name
    cursor.problems += writer.problems
    return whole(cursor)


class _Writer:
    """Collects the tokens of the POU in the order of a plain text."""

    def __init__(self, source: Source, xml: str) -> None:
        self.source, self.xml = source, xml
        self.problems: list[Problem] = []
        self._made = Tokens([], [], [], [])

    def tokens(self) -> Tokens:
        """Everything written, closed."""
        for _ in range(AHEAD):
            self._add(Lex.END, "", len(self.xml))
        return self._made

    def name(self, element: Element) -> tuple[str, int]:
        """The attribute Name, and its position in the XML."""
        found = NAME_ATTRIBUTE.search(self.xml, element.start, element.begin)
        return (found.group(1), found.start(1)) if found else ("", element.start)

    def object(self, element: Element) -> None:
        """A POU, interface, type or list of variables."""
        first = len(self._made.texts)
        self._text(element.child("Declaration"))
        self._body(element)
        for each in element.children:
            self._member(each)
        if element.tag in ("POU", "Itf"):
            kinds = (ENDS[text.upper()] for text in self._made.texts[first:] if text.upper() in ENDS)
            self._add(Lex.KEYWORD, next(kinds, "END_FUNCTION_BLOCK"), element.end)

    def _member(self, element: Element) -> None:
        match element.tag:
            case "Method":
                self._text(element.child("Declaration"))
                self._body(element)
                self._add(Lex.KEYWORD, "END_METHOD", element.end)
            case "Action":
                name, at = self.name(element)
                self._add(Lex.NAME, "ACTION", element.start)
                self._add(Lex.NAME, name, at)
                self._add(Lex.OPERATOR, ":", at + len(name))
                self._body(element)
                self._add(Lex.KEYWORD, "END_ACTION", element.end)
            case "Property":
                self._text(element.child("Declaration"))
                for part in element.children:
                    if part.tag in ("Get", "Set"):
                        self._add(Lex.NAME, part.tag.upper(), part.start)
                        self._text(part.child("Declaration"))
                        self._body(part)
                        self._add(Lex.KEYWORD, f"END_{part.tag.upper()}", part.end)
                self._add(Lex.KEYWORD, "END_PROPERTY", element.end)
            case "Transition":
                self._refuse("A Transition of a chart (SFC) is not supported; write Structured Text.", element)

    def _body(self, element: Element) -> None:
        implementation = element.child("Implementation")
        if implementation is None:
            return
        for each in implementation.children:
            if each.tag in ("ST", "IL"):
                self._text(each)
            else:
                message = (
                    f"A body drawn in {each.tag} is not read from a file of TwinCAT; in TwinCAT export this POU as PLCopen XML "
                    "and import that, or write the body as Structured Text."
                )
                self._refuse(message, each)

    def _refuse(self, message: str, element: Element) -> None:
        self.problems.append(Problem("X001", message, self.source.span(element.start, element.start + 1)))

    def _text(self, element: Element | None) -> None:
        if element is None:
            return
        tokens, problems = tokenize(self.source, element.begin, element.end)
        self.problems += problems
        self._made.kinds += tokens.kinds[:-AHEAD]
        self._made.texts += tokens.texts[:-AHEAD]
        self._made.starts += tokens.starts[:-AHEAD]
        self._made.pragmas += tokens.pragmas

    def _add(self, kind: Lex, text: str, at: int) -> None:
        self._made.kinds.append(kind)
        self._made.texts.append(text)
        self._made.starts.append(at)


def _position(text: str, line: int, column: int) -> int:
    at = 0
    for _ in range(line - 1):
        at = text.find("\n", at) + 1
    return min(at + column, max(len(text) - 1, 0))
