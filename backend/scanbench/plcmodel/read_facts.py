"""The facts that the elements of a model file state, each with its own Source or with that of its element."""

from collections.abc import Iterable, Iterator, Sequence

from lxml import etree

from scanbench.plcmodel.catalogue import ErrorEntry
from scanbench.plcmodel.facts import KINDS, Fact, Kind
from scanbench.plcmodel.reading import LANGUAGE, Element, Reader, merged, nearest, text_of

_SYSTEM = {
    "Fatal": "fatal",
    "ErrorLog": "error-log",
    "ErrorReset": "error-reset",
    "ErrorTime": "error-time",
    "Standby": "standby",
}


def read_facts(layers: Sequence[Reader], errors: Iterable[tuple[Element, ErrorEntry]]) -> tuple[Fact, ...]:
    """Every fact of the model that the layers make together; `errors` as they were read."""
    found: list[Fact] = []
    for element in merged(layers, "Memory/Area", "Name", "Areas").values():
        found += _of(element, "area", element[1].get("Name", ""), dict(_area(element[1])))
    found += _system(layers)
    for element in merged(layers, "System/Special", "Name", "Specials").values():
        found += _of(element, "special", element[1].get("Name", ""), dict(_special(element[1])))
    for element in merged(layers, "Instructions/*", "Name", "Instructions").values():
        found += _of(element, "instruction", element[1].get("Name", ""), dict(_instruction(element[1])))
    for element, error in errors:
        found += _of(element, "error", error.id, dict(_error(element[1], error)))
    return tuple(found)


def _of(element: Element, kind: Kind, subject: str, values: dict[str, str]) -> Iterator[Fact]:
    """The facts that the element states, in the order of the format."""
    reader, node = element
    own = _own(reader, node, values)
    for of in KINDS[node.tag]:
        if of not in values:
            continue
        stated = own.get(of)
        origin = node if stated is None else stated
        verified = origin.get("Verified") == "yes"
        yield Fact(kind, subject, of, values[of], origin.get("Source", ""), verified, stated is None)


def _own(reader: Reader, node: etree._Element, values: dict[str, str]) -> dict[str, etree._Element]:
    """The elements Fact, by what they are about."""
    own: dict[str, etree._Element] = {}
    for child in node.iterchildren("Fact"):
        for of in child.get("Of", "").split():
            if of not in values:
                message = f"this {node.tag} states no fact {of!r}, it has {', '.join(values)}{nearest(of, values)}"
                reader.problem("M010", message, child, "Of")
            if of in own:
                reader.problem("M004", f"Fact {of!r} is there twice", child, "Of")
            own[of] = child
    return own


def _system(layers: Sequence[Reader]) -> Iterator[Fact]:
    for reader in reversed(layers):
        node = reader.root.find("System")
        if node is not None and node.get("ErrorCode") is not None:
            yield from _of((reader, node), "system", "error-code", {"code-word": node.get("ErrorCode", "")})
            break
    for tag, subject in _SYSTEM.items():
        for reader in reversed(layers):
            node = reader.root.find(f"System/{tag}")
            if node is not None:
                yield from _of((reader, node), "system", subject, dict(_part(node)))
                break


def _part(node: etree._Element) -> Iterator[tuple[str, str]]:
    match node.tag:
        case "Fatal":
            ranges = (f"{each.get('Area')} {each.get('First')}-{each.get('Last')}" for each in node.iter("Outputs"))
            yield "outputs", ", ".join(ranges) or "none"
            yield "cleared", node.get("Clears", "none")
            yield "hold", node.get("HoldBit", "none")
        case "ErrorLog":
            yield "place", node.get("First", "")
            yield "records", node.get("Records", "")
            yield "format", node.get("RecordWords", "")
            yield "counter", node.get("Counter", "")
        case "ErrorReset":
            yield "reset", f"{node.get('Bit')} {node.get('Code')}"
        case "ErrorTime":
            yield "place", node.get("First", "")
            yield "format", node.get("Fields", "")
        case "Standby":
            yield "status", " ".join(node.get(each, "") for each in ("Duplex", "Active", "Side") if node.get(each))
            yield "switches", ", ".join(each.get("Error", "") for each in node.iterchildren("Cause"))
            yield "time", node.get("Time", "none")


def _area(node: etree._Element) -> Iterator[tuple[str, str]]:
    yield "words", node.get("Words", "")
    ranges = (f"{each.get('First')}-{each.get('Last')} {each.get('Program')}" for each in node.iterchildren("Access"))
    yield "access", ", ".join(ranges) or "write"
    yield "retention", "kept" if node.get("Retain") == "yes" else "cleared"
    yield from _text(node, "Description")


def _special(node: etree._Element) -> Iterator[tuple[str, str]]:
    yield "address", node.get("Address", "")
    yield "meaning", node.get("Role", "") or node.get("Symbol", "") or node.get("Name", "")
    yield from _text(node, "Description")


def _instruction(node: etree._Element) -> Iterator[tuple[str, str]]:
    match node.tag:
        case "Reset":
            yield "effect", node.get("Flags", "")
        case "Query":
            yield "effect", f"{node.get('Flags')} {node.get('Code')}"
            yield "numbers", f"{node.get('Bits')}: {node.get('Levels')}"
        case "Message":
            yield "numbers", _numbers(node)
        case _:
            yield "effect", ", ".join([node.get("Error", ""), *(each.get("Error", "") for each in node.iter("Range"))])
            yield "numbers", ", ".join(map(_numbers, [node, *node.iter("Range")]))
            if node.get("Clears") is not None:
                yield "clearing", node.get("Clears", "")
            if node.get("SystemErrors") is not None:
                yield "system-errors", node.get("SystemErrors", "")
    yield from _text(node, "Description")


def _numbers(node: etree._Element) -> str:
    return f"{node.get('Min')}-{node.get('Max')}"


def _error(node: etree._Element, error: ErrorEntry) -> Iterator[tuple[str, str]]:
    yield "flag", error.flag_text
    yield "code", error.code_text or "none"
    yield "severity", error.severity
    yield "priority", str(error.priority)
    yield "cause", "lasting" if error.lasting else "passing"
    if error.severity == "fatal":
        yield "memory", "kept" if error.keeps_memory else "cleared"
    yield "log", "details" if error.details and error.coded else "none"
    if error.details:
        yield "details", ", ".join(detail.name for detail in error.details)
    yield from _text(node, "Name")


def _text(node: etree._Element, tag: str) -> Iterator[tuple[str, str]]:
    if any(child.get(LANGUAGE, "en") == "en" for child in node.iterchildren(tag)):
        yield "text", text_of(node, tag)
