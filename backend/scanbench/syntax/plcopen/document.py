"""What is of a PLCopen file alone, TC6 or IEC 61131-10: how it is known, its root, and what tools add to it."""

import re
from collections.abc import Iterator

from lxml import etree

from scanbench.syntax.plcopen.part10 import POUS, to_tc6
from scanbench.syntax.xml_tree import Element, kind, parse_xml

NAMESPACE = re.compile(rb"http://www\.plcopen\.org/xml/tc6(?:\.xsd|_\d+)?")
PART10 = b"www.iec.ch/public/TC65SC65BWG7TF10"


def is_plcopen(data: bytes) -> bool:
    """Whether the beginning of a file says that it is one of TC6, or of IEC 61131-10."""
    return NAMESPACE.search(data[:4000]) is not None or PART10 in data[:4000]


def parse(data: bytes) -> Element:
    """The root, in the names of TC6."""
    if PART10 in data[:4000]:
        return to_tc6(parse_xml(data, "Project", *POUS))
    return parse_xml(data, "project")


def own_data(node: Element, *names: str) -> Iterator[Element]:
    """What a tool keeps in data of its own, inside of `addData`."""
    for each in node.iter(etree.Element):
        if kind(each) in names and any(kind(above) == "addData" for above in each.iterancestors()):
            yield each
