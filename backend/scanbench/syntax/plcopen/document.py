"""What is of a PLCopen file alone: how it is known, its root, and what tools add to it."""

import re
from collections.abc import Iterator

from lxml import etree

from scanbench.syntax.xml_tree import Element, kind, parse_xml

NAMESPACE = re.compile(rb"http://www\.plcopen\.org/xml/tc6(?:\.xsd|_\d+)?")


def is_plcopen(data: bytes) -> bool:
    """Whether the beginning of a file says that it is one of TC6."""
    return NAMESPACE.search(data[:4000]) is not None


def parse(data: bytes) -> Element:
    """The root."""
    return parse_xml(data, "project")


def own_data(node: Element, *names: str) -> Iterator[Element]:
    """What a tool keeps in data of its own, inside of `addData`."""
    for each in node.iter(etree.Element):
        if kind(each) in names and any(kind(above) == "addData" for above in each.iterancestors()):
            yield each
