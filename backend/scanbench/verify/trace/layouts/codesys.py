"""Traces of CODESYS.

2.3, *Extras, Save values to ASCII file* (`.txt`): two lines about the project, then `Cycle` and the names, separated by blanks;
then a line for each sample. Layout: help of ABB Automation Builder 2.2, *Trace in ASCII-File*. If a sampling rate was set, the
first column is milliseconds.

V3, *Save trace to file* (`.trace`, XML): no description of it is published. It is read by its shape: an element with the name of a
variable (an attribute or a child whose name has `name` in it), and two children with as many texts each, of which one has
`time` in its name: the samples. Times are microseconds in the controller's trace buffers.
"""

import itertools
import re
from collections.abc import Iterator
from dataclasses import replace
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from scanbench.verify.trace.clock import number
from scanbench.verify.trace.layouts.sheet import Series, Sheet, is_value, joined, table_of, unique
from scanbench.verify.trace.table import Table, bad

LAYOUT_TEXT, LAYOUT_XML = "CODESYS 2.3 sampling trace", "CODESYS trace (XML)"
_BLANKS = re.compile(r"\s+")
_PARTS = re.compile(r"[\s;,|]+")


def read_text(text: str, name: str, note: str) -> Table | None:
    """The table in a text of CODESYS 2.3; None where it is no such file."""
    lines = [(line.strip(), at) for at, line in enumerate(text.splitlines(), 1) if line.strip()]
    if len(lines) < 4 or not lines[0][0].lower().endswith("trace"):
        return None
    names = _BLANKS.split(lines[2][0])
    if len(names) < 2 or names[0].lower() not in ("cycle", "time", "zyklus", "zeit"):
        return None
    rows, numbers = [], []
    for line, at in lines[3:]:
        cells = _BLANKS.split(line)
        if len(cells) != len(names):
            raise bad(f"The row has {len(cells)} cells, but there are {len(names)} columns.", at)
        rows.append(tuple(cells))
        numbers.append(at)
    counted = names[0].lower() in ("cycle", "zyklus") and _by_one([row[0] for row in rows])
    axis = names[0] if counted else "Time [ms]"
    table = table_of(Sheet(name, note, " ", (), ()), (axis, *unique(names[1:])), rows, numbers)
    return replace(
        table, header=lines[2][1], layout=LAYOUT_TEXT, axis=axis, unit="scan" if counted else "ms", from_start=False,
        durations="ms",
    )  # fmt: skip


def _by_one(texts: list[str]) -> bool:
    return all(each.isdigit() for each in texts) and all(
        int(other) - int(one) == 1 for one, other in itertools.pairwise(texts)
    )


def read_xml(data: str, name: str, note: str) -> Table:
    """The table in an XML file. Raises `BadTraceFile`."""
    if "<!DOCTYPE" in data or "<!ENTITY" in data:
        raise bad("The XML file has a DOCTYPE, which a trace does not need: remove it.")
    try:
        root = ElementTree.fromstring(re.sub(r"^\s*<\?xml[^>]*\?>", "", data))
    except ElementTree.ParseError as error:
        raise bad(f"The file is not XML: {error}.", error.position[0]) from None
    found = list(_signals(root))
    if not found:
        raise bad("The XML file has no signal with a name, times and values.")
    rows, numbers = joined(found, False)
    table = table_of(Sheet(name, note, ",", (), ()), ("Time [us]", *unique(each.name for each in found)), rows, numbers)
    return replace(table, layout=LAYOUT_XML, axis="Time [us]", unit="us", from_start=False, durations="ms")


def _signals(root: Element) -> Iterator[Series]:
    for node in root.iter():
        lists = {_tag(child): child for child in node}
        times = next((_texts(child) for tag, child in lists.items() if "time" in tag), [])
        values = next((_texts(child) for tag, child in lists.items() if "value" in tag or "sample" in tag), [])
        title = _title(node, lists)
        if title and times and len(times) == len(values) and all(map(_is_number, times)):
            yield Series(title, times, values, [1] * len(times))


def _tag(node: Element) -> str:
    """Without its namespace."""
    return node.tag.rpartition("}")[2].lower()


def _title(node: Element, children: dict[str, Element]) -> str:
    named = [value for key, value in node.attrib.items() if "name" in key.lower()]
    named += [child.text or "" for tag, child in children.items() if "name" in tag]
    return next((each.strip() for each in named if each.strip()), "")


def _texts(node: Element) -> list[str]:
    """One for each child, or the parts of a single text."""
    if len(node):
        return [(child.text or "").strip() for child in node]
    return [each for each in _PARTS.split((node.text or "").strip()) if each]


def _is_number(text: str) -> bool:
    try:
        number(text, False)
    except ValueError:
        return False
    return is_value(text)
