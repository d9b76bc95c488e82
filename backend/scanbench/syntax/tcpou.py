"""TwinCAT's files (.TcPOU, .TcDUT, .TcGVL, .TcIO): XML around Structured Text -> the same tree, with places in the XML.

The XML is read once to find the positions of its texts. The tokens of those texts, with the words between them that the XML says in
its own way (METHOD's end, an ACTION's name), then make up the POU that a plain text would have.
"""

import re

from scanbench.problems import Problem
from scanbench.syntax import tccfc, tcsfc, tree
from scanbench.syntax.cursor import Cursor
from scanbench.syntax.lexer import AHEAD, Lex, Tokens, tokenize
from scanbench.syntax.parse_pou import ENDS
from scanbench.syntax.parse_st import whole
from scanbench.syntax.source import Source
from scanbench.syntax.tcarchive import Archive, Network, NotRead, Operand, Piece, made, write
from scanbench.syntax.tcnwl import networks_in
from scanbench.syntax.xml_outline import Element, NotWellFormed, Outline, Refused, reason

NAME_ATTRIBUTE = re.compile(r"""\sName\s*=\s*["']([^"']*)["']""")
OBJECTS = ("POU", "Itf", "DUT", "GVL")


def parse_tc(source: Source) -> tuple[tree.File, list[Problem]]:
    """The tree of one TwinCAT file, and every problem on the way."""
    outline = Outline(source.text)
    try:
        text = outline.read()
    except NotWellFormed as error:
        at = _position(source.text, error.lineno, error.offset)
        message = f"This is no well-formed XML: {reason(error)}. Export the file again."
        return tree.File(source.name), [Problem("S003", message, source.span(at, at + 1))]
    except Refused as error:
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
        self._object = Element("", 0)
        """The POU that is read."""

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
        self._object = element
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
            case "Transition" if self._object.child("Implementation", "SFC") is None:
                self._refuse("This POU has no chart, so its transition is not read; remove it.", element)

    def _body(self, element: Element) -> None:
        implementation = element.child("Implementation")
        if implementation is None:
            return
        for each in implementation.children:
            if each.tag in ("ST", "IL"):
                self._text(each)
            else:
                try:
                    self._drawn(each, Archive(self.xml, self.source.text))
                except NotRead as not_read:
                    message = f"{not_read.message}; in TwinCAT export this POU as PLCopen XML and import that, or write the body as Structured Text."
                    self._refuse(message, not_read.element)

    def _drawn(self, element: Element, archive: Archive) -> None:
        """A body that is drawn: nothing of it is written if a part of it is not read."""
        match element.tag:
            case "NWL" | "CFC":
                found = (
                    list(networks_in(element, archive))
                    if element.tag == "NWL"
                    else [tccfc.network_of(element, archive)]
                )
                for each in found:
                    self._refuse_in_line(each, element)
                for each in found:
                    write(each, self._add, self._operand)
            case "SFC":
                declared = self._object.child("Declaration")
                flag = tcsfc.FLAGS.search(self.source.text, declared.begin, declared.end) if declared else None
                if flag is not None:
                    message = f"This POU has {flag.group()}, with which a chart is driven in TwinCAT, which is not read"
                    raise NotRead(message, element)
                for line in tcsfc.chart_lines(element, archive, self._condition):
                    made(line.pieces, line.at, self._add, self._operand, line.end)
            case _:
                raise NotRead(f"A body drawn in {element.tag} is not read from a file of TwinCAT", element)

    def _condition(self, condition: Operand) -> tuple[Piece, ...]:
        """What a transition tests: an expression, or the body of the transition of this POU that has this name."""
        found = next((each for each in self._object.children if self._is_transition(each, condition.text)), None)
        if found is None:
            return (condition,)
        body = found.child("Implementation", "ST")
        if body is None:
            raise NotRead(f"The transition {condition.text} is drawn, which is not read", found)
        text = self.source.text[body.begin : body.end]
        said = re.match(rf"\s*(?:{re.escape(condition.text)}\s*:=)?", text, re.IGNORECASE)
        begin = body.begin + (said.end() if said else 0)
        end = body.begin + len(text.rstrip().removesuffix(";"))
        if ";" in self.source.text[begin:end] or not self.source.text[begin:end].strip():
            raise NotRead(f"The transition {condition.text} is more than one expression, which is not read", found)
        return (Operand(begin, end, self.source.text[begin:end]),)

    def _is_transition(self, each: Element, name: str) -> bool:
        return each.tag == "Transition" and self.name(each)[0].upper() == name.upper()

    def _refuse_in_line(self, network: Network, element: Element) -> None:
        """Where a network begins is seen by its lines."""
        first = network.lines[0].at if network.lines else element.end
        if "\n" not in self.xml[network.at : first]:
            raise NotRead("These networks are written in one line, which TwinCAT does not", element)

    def _operand(self, operand: Operand, at: int) -> int:
        """Its tokens, at their own places where they follow `at`: where they end."""
        tokens, problems = tokenize(self.source, operand.begin, operand.end, long_texts=True)
        self.problems += problems
        moved = 0 if operand.begin >= at else at - operand.begin
        last = at
        for kind, text, start in zip(tokens.kinds[:-AHEAD], tokens.texts[:-AHEAD], tokens.starts[:-AHEAD], strict=True):
            self._add(kind, text, start + moved)
            last = start + moved + len(text)
        return last

    def _refuse(self, message: str, element: Element) -> None:
        self.problems.append(Problem("X001", message, self.source.span(element.start, element.start + 1)))

    def _text(self, element: Element | None) -> None:
        if element is None:
            return
        tokens, problems = tokenize(self.source, element.begin, element.end, long_texts=True)
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
