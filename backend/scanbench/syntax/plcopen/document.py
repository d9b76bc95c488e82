"""A PLCopen file as a tree of elements, read without any of XML's dangers."""

import re
from collections.abc import Iterator
from typing import cast

from lxml import etree

LARGEST = 64 << 20
"""Bytes."""
NAMESPACE = re.compile(rb"http://www\.plcopen\.org/xml/tc6(?:\.xsd|_\d+)?")
Element = etree._Element


class BadPlcOpen(ValueError):
    """Why a file cannot be read at all, for people."""


def is_plcopen(data: bytes) -> bool:
    """Whether the beginning of a file says that it is one of TC6."""
    return NAMESPACE.search(data[:4000]) is not None


def parse(data: bytes) -> Element:
    """The root; entities, DTDs and the network are never used."""
    if len(data) > LARGEST:
        raise BadPlcOpen(f"the file is larger than {LARGEST >> 20} MiB")
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, load_dtd=False, remove_comments=True, remove_pis=True
    )
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as bad:
        raise BadPlcOpen(f"this is no XML: {bad.msg}") from bad
    if b"<!DOCTYPE" in data[: data.find(b"<project")]:
        raise BadPlcOpen("the file has a DOCTYPE, which a PLCopen file does not need; remove it")
    if kind(root) != "project":
        raise BadPlcOpen(f"a PLCopen file begins with <project>, not with <{kind(root)}>")
    return root


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


def own_data(node: Element, *names: str) -> Iterator[Element]:
    """What a tool keeps in data of its own, inside of `addData`."""
    for each in node.iter(etree.Element):
        if kind(each) in names and any(kind(above) == "addData" for above in each.iterancestors()):
            yield each


def text_of(node: Element | None) -> str:
    """All text inside, as of ST in its XHTML."""
    return "" if node is None else "".join(str(each) for each in node.itertext())


def attribute(node: Element | None, name: str, default: str = "") -> str:
    if node is None:
        return default
    found = node.get(name)
    return default if found is None else str(found)


def line_of(node: Element) -> int:
    """Its line in the file, from 1."""
    return cast(int | None, node.sourceline) or 1
