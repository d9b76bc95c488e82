"""The system part of a model file: code word, status words, fatal behaviour, error log, special places."""

from collections.abc import Iterator, Sequence
from typing import cast

from lxml import etree

from scanbench.plcmodel.areas import Location
from scanbench.plcmodel.model import (
    ClockField,
    ErrorLog,
    ErrorReset,
    ErrorTime,
    FatalBehaviour,
    Role,
    Special,
    WordRange,
)
from scanbench.plcmodel.reading import Reader, duration_ns, merged, text_of

_TIMES = ("cycle-time", "longest-cycle-time", "shortest-cycle-time")
_BITS = ("on", "off", "first-cycle", "pulse")


def code_word(layers: Sequence[Reader]) -> Location | None:
    """Where the error code of the most serious error is shown."""
    for reader in reversed(layers):
        system = reader.root.find("System")
        if system is None or system.get("ErrorCode") is None:
            continue
        found = reader.place(system, "ErrorCode", bits=16)
        if found is None:
            return None
        if reader.code_form == "hex8":
            found = found._replace(bits=32)
        return found if reader.engine_writes(system, "ErrorCode", found, found.bits // 16) else None
    return None


def status_words(layers: Sequence[Reader]) -> tuple[str, ...]:
    """Addresses worth showing; a file that names any replaces those of its base."""
    for reader in reversed(layers):
        nodes = list(reader.root.iterfind("System/Status"))
        if nodes:
            return tuple(
                node.get("Address", "") for node in nodes if reader.place(node, "Address", bits=16) is not None
            )
    return ()


def fatal_behaviour(layers: Sequence[Reader]) -> FatalBehaviour:
    """What a fatal error does to the memory."""
    for reader in reversed(layers):
        node = reader.root.find("System/Fatal")
        if node is not None:
            return _fatal(reader, node)
    return FatalBehaviour()


def _fatal(reader: Reader, node: etree._Element) -> FatalBehaviour:
    outputs = []
    for child in node.iterchildren("Outputs"):
        area = reader.area(child, "Area", child.get("Area", ""))
        first, last = int(child.get("First", "0")), int(child.get("Last", "0"))
        if area is None:
            continue
        if not first <= last < area.words:
            reader.problem("M003", f"words {first} to {last} are no range of {area.name}", child, "Last")
        outputs.append(WordRange(area, first, last))
    cleared = [reader.area(node, "Clears", name) for name in node.get("Clears", "").split()]
    return FatalBehaviour(
        outputs=tuple(outputs),
        cleared=tuple(area for area in cleared if area is not None),
        hold=reader.place(node, "HoldBit", bits=1),
    )


def error_log(layers: Sequence[Reader]) -> ErrorLog | None:
    """The device's own error log."""
    for reader in reversed(layers):
        node = reader.root.find("System/ErrorLog")
        if node is not None:
            return _log(reader, node)
    return None


def _log(reader: Reader, node: etree._Element) -> ErrorLog | None:
    first, counter = reader.place(node, "First", bits=16), reader.place(node, "Counter", bits=16)
    records, words = int(node.get("Records", "0")), int(node.get("RecordWords", "0"))
    if first is None or counter is None:
        return None
    if not (
        reader.engine_writes(node, "First", first, records * words) and reader.engine_writes(node, "Counter", counter)
    ):
        return None
    return ErrorLog(first, records, words, counter)


def error_reset(layers: Sequence[Reader]) -> ErrorReset | None:
    """The bit and the word with which a program or tool clears errors."""
    for reader in reversed(layers):
        node = reader.root.find("System/ErrorReset")
        if node is not None:
            bit, code = reader.place(node, "Bit", bits=1), reader.place(node, "Code", bits=16)
            return ErrorReset(bit, code) if bit is not None and code is not None else None
    return None


def error_time(layers: Sequence[Reader]) -> ErrorTime | None:
    """The words that hold the time of the latest error."""
    for reader in reversed(layers):
        node = reader.root.find("System/ErrorTime")
        if node is None:
            continue
        first = reader.place(node, "First", bits=16)
        fields = cast(tuple[ClockField, ...], tuple(node.get("Fields", "").split()))
        if len(fields) % 2 or not fields:
            reader.problem("M010", f"two Fields fill a word, here are {len(fields)}", node, "Fields")
            return None
        if first is None or not reader.engine_writes(node, "First", first, len(fields) // 2):
            return None
        return ErrorTime(first, fields)
    return None


# ---- special places ---------------------------------------------------------------------------------------------


def specials(layers: Sequence[Reader]) -> tuple[Special, ...]:
    """Every special place; one with the name of the base's takes its place."""
    found: list[Special] = []
    for reader, node in merged(layers, "System/Special", "Name", "Specials").values():
        symbol = node.get("Symbol", "")
        if symbol and any(other.symbol.upper() == symbol.upper() for other in found):
            reader.problem("M004", f"Symbol {symbol!r} is there twice", node, "Symbol")
        special = _special(reader, node)
        if special is not None:
            found.append(special)
    return tuple(found)


def _special(reader: Reader, node: etree._Element) -> Special | None:
    location = reader.place(node, "Address")
    if location is None:
        return None
    if (width := node.get("Width")) is not None:
        location = location._replace(bits=int(width))
        if location.bit is not None or location.byte + int(width) // 8 > location.area.size:
            reader.problem("M007", f"there are no {width} bits at {node.get('Address')}", node, "Width")
            return None
    role = cast(Role, node.get("Role", ""))
    if not _check_role(reader, node, role, location):
        return None
    return Special(
        name=node.get("Name", ""),
        location=location,
        text=node.get("Address", ""),
        description=text_of(node, "Description"),
        source=node.get("Source", ""),
        verified=node.get("Verified") == "yes",
        symbol=node.get("Symbol", ""),
        role=role,
        period_ns=duration_ns(node.get("Period", "0us")),
        unit_ns=duration_ns(node.get("Unit", "0us")),
        fields=cast(tuple[ClockField, ...], tuple(node.get("Fields", "").split())),
        bcd=node.get("Base") == "BCD",
    )


def _check_role(reader: Reader, node: etree._Element, role: Role, location: Location) -> bool:
    """Whether the place and the other attributes fit the role; if not, that is a problem."""
    wrong = list(_wrong_with(node, role, location))
    for message, attribute in wrong:
        reader.problem("M010", message, node, attribute)
    if role and not wrong:
        words = max(location.bits // 16, 1)
        return reader.engine_writes(node, "Address", location, words)
    return not wrong


def _wrong_with(node: etree._Element, role: Role, location: Location) -> Iterator[tuple[str, str]]:
    bits = location.bits
    if role in _BITS and bits != 1:
        yield f"role {role} needs a bit, {node.get('Address')} has {bits}", "Address"
    if role in (*_TIMES, "scan-count") and bits not in (16, 32, 64):
        yield f"role {role} needs 16, 32 or 64 bits, {node.get('Address')} has {bits}", "Address"
    fields = node.get("Fields", "").split()
    if role == "clock" and (not fields or len(fields) * 8 != bits):
        yield f"the clock here needs Fields for {bits // 8} bytes, one each, there are {len(fields)}", "Fields"
    for attribute, roles in (
        ("Period", ("pulse",)),
        ("Unit", _TIMES),
        ("Fields", ("clock",)),
        ("Base", ("clock",)),
    ):
        given = node.get(attribute)
        if given is None and role in roles and attribute in ("Period", "Unit"):
            yield f"role {role} needs a {attribute}, such as 1s or 0.1ms", "Role"
        if given is not None and role not in roles:
            yield f"{attribute} goes with role {' or '.join(roles)} only", attribute
        if given is not None and attribute in ("Period", "Unit") and duration_ns(given) < 1:
            yield f"{attribute} must be longer than 0", attribute
