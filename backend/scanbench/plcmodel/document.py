"""A model file as text and tree: read without any of XML's dangers, with the position of each element."""

import re
import threading
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import cast

from lxml import etree

from scanbench.plcmodel.schema_words import in_words
from scanbench.problems import Problem, Span

SCHEMA = "model.xsd"
SIZE_LIMIT = 4 * 1024 * 1024
"""Bytes; the largest file we ship has a hundredth of it."""
TOLD = 50
"""Problems of a file that are told at once: nobody mends more before the next try."""
_WIDE = 1000
"""Children of one element up to which `libxml2` may be asked for the place of a violation: it counts them for each."""
_PIECE = 1 << 16
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_NO_ELEMENT = r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>"
_START_TAG = re.compile(rf"{_NO_ELEMENT}|(<[^\s<>/!?]+)(?:[^<>\"']++|\"[^\"]*\"|'[^']*')*+>", re.DOTALL)
_ATTRIBUTE = re.compile(r"\s([^\s=]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')")


class Document:
    """A validated model file."""

    def __init__(self, file: str, text: str, root: etree._Element) -> None:
        self.file = file
        self.root = root
        self._text = text
        self._lines = [0, *(match.end() for match in re.finditer("\n", text))]

    def span(self, node: etree._Element, attribute: str = "") -> Span:
        """The position in the file of the element, or of the value of its attribute."""
        tag = self._tags[node]
        start, end = tag.span(1)
        for each in _ATTRIBUTE.finditer(self._text, end, tag.end()) if attribute else ():
            if each[1] == attribute:
                start, end = each.span(3 if each[2] is None else 2)
        return Span(self.file, *self._position(start), *self._position(end))

    @cached_property
    def _tags(self) -> dict[etree._Element, re.Match[str]]:
        """libxml2 keeps of a start tag only the line on which it ends; but tags and elements come in the same order."""
        tags = (match for match in _START_TAG.finditer(self._text) if match[1])
        return dict(zip(self.root.iter(etree.Element), tags, strict=True))

    def _position(self, offset: int) -> tuple[int, int]:
        line = bisect_right(self._lines, offset)
        return line, offset - self._lines[line - 1] + 1


def xml_text(text: str) -> str:
    """The text with U+FFFD for what XML has no character for."""
    return _NOT_XML.sub("\ufffd", text)


def first_of(problems: Iterable[Problem]) -> list[Problem]:
    """The first ones, and that there are more. A file of megabytes may have one in every line: the rest is not looked for."""
    found = iter(problems)
    told = list(islice(found, TOLD))
    more = next(found, None)
    if more is not None:
        told.append(replace(more, message="there are more problems from here on: mend those above first"))
    return told


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
    if any(len(node) > _WIDE for node in root.iter()):
        return first_of(_violations_by_line(file, text, schema)) or document
    with _validating:
        if schema.validate(root):
            return document
        entries = list(cast("Iterable[etree._LogEntry]", schema.error_log))
    return first_of(_violations(document, entries))


_validating = threading.Lock()  # a schema tells of its last validation only


def _where(text: str, offset: int) -> tuple[int, int]:
    """Line and column."""
    return text.count("\n", 0, offset) + 1, offset - text.rfind("\n", 0, offset)


def _unreadable(file: str, message: str, line: int = 1, column: int = 1) -> Problem:
    return Problem("M001", message, Span(file, line, column, line, column + 1))


def _violations(document: Document, entries: Iterable[etree._LogEntry]) -> Iterator[Problem]:
    told = set()
    for entry in entries:
        # libxml2 reports a bad value twice, the second time only that it is "not a valid value": the first says more.
        attribute = match[1] if (match := re.search(r"attribute '(\w+)'", entry.message)) else ""
        place = (entry.path, attribute)
        if place in told:
            continue
        told.add(place)
        found = document.root.xpath(entry.path) if entry.path else []
        node = found[0] if isinstance(found, list) and found else None
        element = node if isinstance(node, etree._Element) else document.root
        yield Problem("M002", in_words(entry.message), document.span(element, attribute))


def _violations_by_line(file: str, text: str, schema: etree.XMLSchema) -> Iterator[Problem]:
    """Reads line by line, and sees what each adds to the log: that takes no longer for a file that is wrong throughout."""
    parser = etree.XMLParser(encoding="utf-8", schema=schema, resolve_entities=False, no_network=True)
    seen = 0
    for number, match in enumerate(re.finditer(".*\n?", text), 1):
        line = match[0]
        for start in range(0, len(line), _PIECE):
            parser.feed(line[start : start + _PIECE].encode())
            log = parser.feed_error_log
            new, seen = list(cast("Iterable[etree._LogEntry]", log))[seen:], len(log)
            for entry in new:
                yield Problem("M002", in_words(entry.message), Span(file, number, 1, number, 2))


def _doctype(text: str) -> int | None:
    """The position of a DOCTYPE, None if there is none. Only comments, processing instructions and space can come before it."""
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
