"""The memory part of a model file: areas, their access ranges, where %I, %Q and %M lie."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Literal, cast

from lxml import etree

from scanbench.plcmodel.areas import Access, AccessRange, Area, IecMap
from scanbench.plcmodel.reading import Reader, merged, text_of

_Radix = Literal[10, 16]


def read_memory(layers: Sequence[Reader]) -> None:
    """Gives every reader the areas and maps of the model that the layers make together, the base first."""
    areas: list[Area] = []
    for reader, node in merged(layers, "Memory/Area", "Name", "Areas").values():
        area = _area(reader, node)
        _prefixes(reader, node, area, areas)
        areas.append(area)
    for reader in layers:
        reader.areas = tuple(areas)
    maps = [_iec_map(*each) for each in merged(layers, "Memory/IecMap", "Letter", "IecMaps").values()]
    for reader in layers:
        reader.iec_maps = tuple(each for each in maps if each is not None)


def _area(reader: Reader, node: etree._Element) -> Area:
    words = int(node.get("Words", "0"))
    return Area(
        name=node.get("Name", ""),
        words=words,
        ranges=_ranges(reader, node, words),
        retain=node.get("Retain") == "yes",
        description=text_of(node, "Description"),
        prefix=node.get("Prefix", ""),
        aliases=tuple(node.get("Aliases", "").split()),
        first=int(node.get("FirstNumber", "0")),
        unit="bit" if node.get("Unit") == "bit" else "word",
        radix=cast(_Radix, int(node.get("Radix", "10"))),
        bit_radix=cast(_Radix, int(node.get("BitRadix", "10"))),
        bare_bits=node.get("BareBits") == "yes",
        source=node.get("Source", ""),
        verified=node.get("Verified") == "yes",
        texts=node.get("Texts") == "yes",
    )


def _prefixes(reader: Reader, node: etree._Element, area: Area, areas: list[Area]) -> None:
    """Areas may share a prefix as long as they share no number."""
    mine = {area.written, *area.aliases}
    for other in areas:
        shared = mine & {other.written, *other.aliases}
        if shared and _overlap(_numbers(area), _numbers(other)):
            message = f"two areas have the prefix {min(shared)!r}: {other.name} and {area.name}"
            reader.problem("M004", message, node)


def _numbers(area: Area) -> range:
    return range(area.first, area.first + area.words * (16 if area.unit == "bit" else 1))


def _overlap(a: range, b: range) -> bool:
    return a.start < b.stop and b.start < a.stop


def _ranges(reader: Reader, area: etree._Element, words: int) -> tuple[AccessRange, ...]:
    nodes = list(area.iterchildren("Access"))
    if not nodes:
        return (AccessRange(0, words - 1),)
    ranges = [
        AccessRange(
            first=int(node.get("First", "0")),
            last=int(node.get("Last", "0")),
            program=cast(Access, node.get("Program")),
            tool=cast(Access, node.get("Tool")),
            engine=cast(Access, node.get("Engine")),
        )
        for node in nodes
    ]
    edges = [-1, *(edge for entry in ranges for edge in (entry.first, entry.last)), words]
    gapless = all(first + 1 == second for first, second in list(pairwise(edges))[::2])
    if not gapless or any(entry.first > entry.last for entry in ranges):
        message = f"the Access ranges must cover words 0 to {words - 1} in order, without gap or overlap"
        reader.problem("M006", message, nodes[0])
    return tuple(ranges)


def _iec_map(reader: Reader, node: etree._Element) -> IecMap | None:
    letter, name = node.get("Letter", ""), node.get("Area", "")
    area = reader.area(node, "Area", name)
    first, words = int(node.get("First", "0")), int(node.get("Words", "0"))
    if area is None:
        return None
    if first + words > area.words:
        message = f"words {first} to {first + words - 1} are outside of {name}, which has {area.words}"
        reader.problem("M003", message, node, "Words")
    return IecMap(letter, area, first, words)
