"""A model file as text and tree: read without any of XML's dangers, and able to say where an element stands."""

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import cast

from lxml import etree

from scanbench.problems import Problem, Span

SCHEMA = "model.xsd"
SIZE_LIMIT = 4 * 1024 * 1024
"""Bytes; the largest file we ship has a hundredth of it."""


class Document:
    """A validated model file."""

    def __init__(self, file: str, text: str, root: etree._Element) -> None:
        self.file = file
        self.root = root
        self._text = text
        self._starts = [0, *(match.end() for match in re.finditer("\n", text))]

    def span(self, node: etree._Element, attribute: str = "") -> Span:
        """Where the element, or the value of its attribute, stands in the file."""
        start = self._tag_start(node)
        end = start + 1 + len(node.tag)
        if attribute:
            tag_end = self._text.find(">", start)
            pattern = re.compile(rf"\s{re.escape(attribute)}\s*=\s*([\"'])(.*?)\1", re.DOTALL)
            if found := pattern.search(self._text, start, tag_end + 1 if tag_end >= 0 else len(self._text)):
                start, end = found.span(2)
        line, column = self._position(start)
        end_line, end_column = self._position(end)
        return Span(self.file, line, column, end_line, end_column)

    def _tag_start(self, node: etree._Element) -> int:
        """libxml2 keeps the line on which a start tag ends, and no column: look for the tag from there upward."""
        line = line_of(node)
        pattern = re.compile(rf"<{re.escape(node.tag)}(?=[\s/>])")
        before = sum(1 for _ in self._same_line(node, line))
        end = self._starts[line] if line < len(self._starts) else len(self._text)
        on_line = [match.start() for match in pattern.finditer(self._text, self._starts[line - 1], end)]
        if before < len(on_line):
            return on_line[before]
        starts = [match.start() for match in pattern.finditer(self._text, 0, end)]
        return starts[-1] if starts else self._starts[line - 1]

    def _same_line(self, node: etree._Element, line: int) -> Iterator[etree._Element]:
        for other in self.root.iter(node.tag):
            if other is node:
                return
            if line_of(other) == line:
                yield other

    def _position(self, offset: int) -> tuple[int, int]:
        line = self._text.count("\n", 0, offset) + 1
        return line, offset - self._starts[line - 1] + 1


def line_of(node: etree._Element) -> int:
    """The line on which the element's start tag ends."""
    return cast("int | None", node.sourceline) or 1


def schema_of(directory: Path) -> etree.XMLSchema:
    """The schema in a directory of models."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    return etree.XMLSchema(etree.parse(str(directory / SCHEMA), parser))


def read(path: Path, file: str, schema: etree.XMLSchema) -> Document | list[Problem]:
    """The file as a document that follows the schema, or everything that is wrong with it."""
    try:
        if path.stat().st_size > SIZE_LIMIT:
            return [_unreadable(file, f"the file is larger than {SIZE_LIMIT // 1024 // 1024} MiB, no model needs that")]
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        return [_unreadable(file, f"the file cannot be read: {error.strerror}")]
    except UnicodeDecodeError as error:
        return [_unreadable(file, f"byte {error.start} is not UTF-8: save the file as UTF-8")]
    return parse(text, file, schema, "Model")


def parse(
    text: str, file: str, schema: etree.XMLSchema, root_tag: str, what: str = "a model file"
) -> Document | list[Problem]:
    """The text as a document with this root that follows the schema, or everything that is wrong with it; `what` it is."""
    text = text.removeprefix("\ufeff").replace("\r\n", "\n")
    if len(text) > SIZE_LIMIT:
        return [_unreadable(file, f"the file is larger than {SIZE_LIMIT // 1024 // 1024} MiB, {what} never is")]
    if (surrogate := re.search("[\ud800-\udfff]", text)) is not None:
        return [
            _unreadable(file, "half a character, which no file can hold: remove it", *_where(text, surrogate.start()))
        ]
    if (offset := _doctype(text)) is not None:
        message = f"{what} has no DOCTYPE (entities and external parts are refused): remove it"
        return [_unreadable(file, message, *_where(text, offset))]
    parser = etree.XMLParser(
        encoding="utf-8", resolve_entities=False, load_dtd=False, no_network=True, huge_tree=False, remove_comments=True
    )
    try:
        root = etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        line, column = error.position
        return [_unreadable(file, f"not well-formed XML: {error.msg}", max(line or 1, 1), max(column or 1, 1))]
    document = Document(file, text, root)
    if root.tag != root_tag:
        return [Problem("M002", f"this is <{root.tag}>, here belongs <{root_tag}>", document.span(root))]
    return document if schema.validate(root) else list(_violations(document, schema))


def _where(text: str, offset: int) -> tuple[int, int]:
    """Line and column."""
    return text.count("\n", 0, offset) + 1, offset - text.rfind("\n", 0, offset)


def _unreadable(file: str, message: str, line: int = 1, column: int = 1) -> Problem:
    return Problem("M001", message, Span(file, line, column, line, column + 1))


def _violations(document: Document, schema: etree.XMLSchema) -> Iterator[Problem]:
    told = set()
    for entry in cast("Iterable[etree._LogEntry]", schema.error_log):
        # libxml2 reports a bad value twice, the second time only that it is "not a valid value": the first says more.
        attribute = match[1] if (match := re.search(r"attribute '(\w+)'", entry.message)) else ""
        place = (entry.path, attribute)
        if place in told:
            continue
        told.add(place)
        found = document.root.xpath(entry.path) if entry.path else []
        node = found[0] if isinstance(found, list) and found else None
        element = node if isinstance(node, etree._Element) else document.root
        yield Problem("M002", entry.message, document.span(element, attribute))


def _doctype(text: str) -> int | None:
    """Where a DOCTYPE stands; only comments, processing instructions and space can come before it."""
    at = 0
    while True:
        while at < len(text) and text[at].isspace():
            at += 1
        for opening, closing in (("<!--", "-->"), ("<?", "?>")):
            if text.startswith(opening, at):
                end = text.find(closing, at + len(opening))
                if end < 0:
                    return None
                at = end + len(closing)
                break
        else:
            return at if text[at : at + 9].upper() == "<!DOCTYPE" else None
