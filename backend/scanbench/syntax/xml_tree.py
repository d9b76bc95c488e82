"""An XML file of another tool as a tree of elements, read without any of XML's dangers."""

from collections.abc import Iterator
from math import isfinite
from typing import cast

from lxml import etree

LARGEST = 64 << 20
"""Bytes."""
Element = etree._Element


class BadXml(ValueError):
    """Why a file cannot be read at all, for people."""


def parse_xml(data: bytes, *roots: str) -> Element:
    """The element that a file has to begin with, of one of these names; entities, DTDs and the network are never used."""
    if len(data) > LARGEST:
        raise BadXml(f"the file is larger than {LARGEST >> 20} MiB")
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, load_dtd=False, remove_comments=True, remove_pis=True
    )
    try:
        found = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as bad:
        raise BadXml(f"this is no XML: {bad.msg}") from bad
    if found.getroottree().docinfo.internalDTD is not None:
        raise BadXml("the file has a DOCTYPE, which it does not need; remove it")
    if kind(found) not in roots:
        raise BadXml(f"the file begins with <{kind(found)}>, not with {' or '.join(f'<{each}>' for each in roots)}")
    return found


def kind(node: Element) -> str:
    """The name of an element, without its namespace, which differs by version."""
    return etree.QName(node).localname


def children(node: Element | None, *names: str) -> Iterator[Element]:
    """Those with one of these names; all of them without a name."""
    for each in node if node is not None else ():
        if not names or kind(each) in names:
            yield each


def child(node: Element | None, *path: str) -> Element | None:
    """The first one, down a path of names."""
    for name in path:
        node = next(children(node, name), None)
    return node


def text_of(node: Element | None) -> str:
    """All text inside, as of ST in its XHTML."""
    return "" if node is None else "".join(str(each) for each in node.itertext())


def attribute(node: Element | None, name: str, default: str = "") -> str:
    if node is None:
        return default
    found = node.get(name)
    return default if found is None else str(found)


def number_of(node: Element | None, name: str) -> float:
    """An attribute as a finite number; 0 without one, and for what is none."""
    try:
        found = float(attribute(node, name) or 0)
    except ValueError:
        return 0
    return found if isfinite(found) else 0


def of_type(node: Element | None) -> str:
    """What `xsi:type` says that an element is, without its namespace."""
    return attribute(node, "{http://www.w3.org/2001/XMLSchema-instance}type").rpartition(":")[2]


def line_of(node: Element) -> int:
    """Its line in the file, from 1."""
    return cast(int | None, node.sourceline) or 1
