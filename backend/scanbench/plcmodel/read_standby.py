"""The standby CPU Unit of a model file: where its state is shown, and for which errors it takes over."""

from collections.abc import Mapping, Sequence
from typing import cast

from lxml import etree

from scanbench.plcmodel.areas import Location
from scanbench.plcmodel.catalogue import ErrorEntry
from scanbench.plcmodel.model import ClockField, Standby
from scanbench.plcmodel.reading import Reader, nearest


def standby(layers: Sequence[Reader], errors: Mapping[str, ErrorEntry]) -> Standby | None:
    """That of the last file that has one."""
    for reader in reversed(layers):
        node = reader.root.find("System/Standby")
        if node is not None:
            return _standby(reader, node, errors)
    return None


def _standby(reader: Reader, node: etree._Element, errors: Mapping[str, ErrorEntry]) -> Standby | None:
    duplex, side = _bit(reader, node, "Duplex"), _bit(reader, node, "Side")
    active = None if node.get("Active") is None else _bit(reader, node, "Active")
    causes = []
    for child in node.iterchildren("Cause"):
        id, place = child.get("Error", ""), _bit(reader, child, "Address")
        error = errors.get(id)
        if error is None:
            reader.problem("M010", f"there is no error {id!r}{nearest(id, errors)}", child, "Error")
        elif error.severity != "fatal":
            reader.problem("M010", f"{id} is nonfatal: nobody takes over, as the program goes on", child, "Error")
        elif place is not None:
            causes.append((id, place))
    time, fields = _time(reader, node)
    if duplex is None or side is None:
        return None
    return Standby(duplex, active, side, tuple(causes), time, fields)


def _bit(reader: Reader, node: etree._Element, attribute: str) -> Location | None:
    place = reader.place(node, attribute, bits=1)
    return place if place is not None and reader.engine_writes(node, attribute, place) else None


def _time(reader: Reader, node: etree._Element) -> tuple[Location | None, tuple[ClockField, ...]]:
    fields = cast(tuple[ClockField, ...], tuple(node.get("Fields", "").split()))
    if node.get("Time") is None and not fields:
        return None, ()
    if node.get("Time") is None or len(fields) % 2 or not fields:
        message = f"Time goes with Fields, two of which fill a word, here are {len(fields)}"
        reader.problem("M010", message, node, "Time" if node.get("Time") is not None else "Fields")
        return None, ()
    time = reader.place(node, "Time", bits=16)
    if time is None or not reader.engine_writes(node, "Time", time, len(fields) // 2):
        return None, ()
    return time, fields
