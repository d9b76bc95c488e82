"""The system part of a model file: code word, status words, fatal behaviour, error log, special places, instructions."""

from collections.abc import Iterator, Sequence
from typing import cast

from lxml import etree

from scanbench.plcmodel.areas import Location
from scanbench.plcmodel.catalogue import ErrorEntry
from scanbench.plcmodel.model import (
    ClockField,
    ErrorLog,
    FatalBehaviour,
    Instruction,
    Role,
    Special,
    WordRange,
)
from scanbench.plcmodel.reading import Reader, duration_ns, merged, nearest, number_of, text_of

_TIMES = ("cycle-time", "longest-cycle-time", "shortest-cycle-time")
_BITS = ("on", "off", "first-cycle", "pulse")


def code_word(layers: Sequence[Reader]) -> Location | None:
    """Where the error code of the most serious error is shown."""
    for reader in reversed(layers):
        system = reader.root.find("System")
        if system is None or system.get("ErrorCode") is None:
            continue
        found = reader.place(system, "ErrorCode", bits=16)
        if found is not None and reader.engine_writes(system, "ErrorCode", found):
            return found
        return None
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


# ---- special places ---------------------------------------------------------------------------------------------


def specials(layers: Sequence[Reader]) -> tuple[Special, ...]:
    """Every special place; one with the name of the base's takes its place."""
    found: list[Special] = []
    for reader, node in merged(layers, "System/Special", "Name", "Specials").values():
        symbol = node.get("Symbol", "")
        if symbol and any(other.symbol.upper() == symbol.upper() for other in found):
            reader.problem("M004", f"Symbol {symbol!r} stands twice", node, "Symbol")
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


# ---- instructions -----------------------------------------------------------------------------------------------


def instructions(layers: Sequence[Reader], errors: dict[str, ErrorEntry]) -> tuple[Instruction, ...]:
    """Every instruction; one with the name of the base's takes its place. `errors` by id."""
    found: list[Instruction] = []
    for reader, node in merged(layers, "Instructions/Instruction", "Name", "Instructions").values():
        name = node.get("Name", "")
        if any(other.name.upper() == name.upper() for other in found):
            reader.problem("M004", f"Instruction {name!r} stands twice", node, "Name")
        instruction = _instruction(reader, node, errors)
        if instruction is not None:
            found.append(instruction)
    return tuple(found)


def _instruction(reader: Reader, node: etree._Element, errors: dict[str, ErrorEntry]) -> Instruction | None:
    id, detail = node.get("Error", ""), node.get("Detail", "")
    error = errors.get(id)
    if error is None:
        reader.problem("M010", f"there is no error {id!r}{nearest(id, errors)}", node, "Error")
        return None
    known = error.detail(detail)
    if known is None or known.control == "List":
        numbers = [each.name for each in error.details if each.control != "List"]
        which = f"it has {', '.join(numbers)}" if numbers else "it has none"
        hint = nearest(detail, numbers)
        reader.problem("M010", f"error {id} has no detail {detail!r} that is a number: {which}{hint}", node, "Detail")
        return None
    low, high = number_of(node.get("Min", "0")), number_of(node.get("Max", "0"))
    clears = None if (text := node.get("Clears")) is None else number_of(text)
    if low > high:
        reader.problem("M007", f"Min {low} is greater than Max {high}", node, "Min")
    lowest, highest = known.addresses[0].minimum, known.addresses[0].maximum
    # Limits of the detail that make no sense have been told.
    if lowest is not None and highest is not None and lowest <= highest and not lowest <= low <= high <= highest:
        message = f"{low} to {high} is more than detail {detail} takes: {lowest} to {highest}"
        reader.problem("M007", message, node, "Min" if low < lowest else "Max")
    if clears is not None and low <= clears <= high:
        reader.problem("M007", f"{clears} cannot both raise the error and clear it", node, "Clears")
    return Instruction(
        name=node.get("Name", ""),
        error=id,
        parameter=node.get("Parameter", ""),
        detail=detail,
        minimum=low,
        maximum=high,
        clears=clears,
        description=text_of(node, "Description"),
        source=node.get("Source", ""),
        verified=node.get("Verified") == "yes",
    )
