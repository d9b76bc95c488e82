"""The catalogue part of a model file: groups, errors, details. Checks what the schema cannot say."""

from typing import cast, get_args

from lxml import etree

from scanbench.plcmodel.catalogue import (
    Control,
    ErrorAddress,
    ErrorDetail,
    ErrorEntry,
    ErrorGroup,
    Kind,
    Severity,
)
from scanbench.plcmodel.document import line_of
from scanbench.plcmodel.reading import Reader, number_of, text_of, wordings_of

FIELD_WIDTH: dict[Kind, int] = {"Bit": 1, "Nibble": 4, "Byte": 8, "BCD": 16, "Word": 16, "BitArray": 1}


def read_catalogue(reader: Reader, root: etree._Element) -> tuple[ErrorGroup, ...]:
    """Every `ErrorGroup` below the root; ids and pairs of code and flag are unique across all of them."""
    groups = tuple(_group(reader, node) for node in root.iterchildren("ErrorGroup"))
    _unique(reader, root)
    return groups


def _unique(reader: Reader, root: etree._Element) -> None:
    ids: dict[str, int] = {}
    pairs: dict[tuple[str, str], str] = {}
    for node in root.iter("Error"):
        id, line = node.get("Id", ""), line_of(node)
        if id in ids:
            reader.problem("M004", f"Id {id!r} is used in line {ids[id]} already", node, "Id")
        ids.setdefault(id, line)
        location = reader.find(node.get("ErrorFlag", ""))
        if location is None:
            continue  # `_error` has said so
        code = node.get("ErrorCode", "").upper()
        flag = f"{location.area.name}.{location.byte}.{location.bit}"
        if (code, flag) in pairs:
            other = pairs[code, flag]
            message = f"code {code} with flag {node.get('ErrorFlag')} belongs to {other!r} already"
            reader.problem("M005", message, node, "ErrorCode")
        pairs.setdefault((code, flag), id)


def _group(reader: Reader, node: etree._Element) -> ErrorGroup:
    errors = [_error(reader, child) for child in node.iterchildren("Error")]
    return ErrorGroup(
        name=text_of(node, "Name"),
        groups=tuple(_group(reader, child) for child in node.iterchildren("ErrorSubGroup")),
        errors=tuple(error for error in errors if error is not None),
        wordings=wordings_of(node),
    )


def _error(reader: Reader, node: etree._Element) -> ErrorEntry | None:
    flag = reader.place(node, "ErrorFlag", bits=1)
    inherited = node.get("AddToErrorCode") in ("true", "1")
    code = int(node.get("ErrorCode", "0"), 16)
    details = tuple(_detail(reader, control, inherited) for control in node.iter("ErrorControl"))
    names = [detail.name for detail in details]
    for name in {name for name in names if names.count(name) > 1}:
        reader.problem("M004", f"two details are named {name!r}", node)
    largest = code + sum(_largest_addition(detail) for detail in details)
    if largest > 0xFFFF:
        message = f"with its details added the error code can grow to {largest:X}, beyond FFFF"
        reader.problem("M007", message, node, "ErrorCode")
    if flag is None or not reader.engine_writes(node, "ErrorFlag", flag):
        return None
    return ErrorEntry(
        id=node.get("Id", ""),
        name=text_of(node, "Name"),
        description=text_of(node, "Description"),
        code=code,
        flag=flag,
        flag_text=node.get("ErrorFlag", ""),
        severity=cast(Severity, node.get("Severity")),
        priority=int(node.get("Priority", "0")),
        details=details,
        source=node.get("Source", ""),
        verified=node.get("Verified") == "yes",
        keeps_memory=node.get("Memory") == "keep",
        wordings=wordings_of(node),
    )


def _largest_addition(detail: ErrorDetail) -> int:
    added = [entry for entry in detail.addresses if entry.add_to_code]
    return max((entry.maximum if entry.value is None else entry.value) or 0 for entry in added) if added else 0


def _detail(reader: Reader, node: etree._Element, inherited: bool) -> ErrorDetail:
    control = cast(Control, node.get("Type"))
    children = list(node.iterchildren("ErrorAddress"))
    if control != "List" and len(children) > 1:
        reader.problem("M008", f"a {control} has exactly one ErrorAddress, here are {len(children)}", node)
    addresses = tuple(_address(reader, child, control, inherited) for child in children)
    ids = [address.id for address in addresses]
    if control == "List":
        for child, address in zip(children, addresses, strict=True):
            if not address.id:
                reader.problem("M008", "a choice of a List needs an Id", child)
            elif ids.count(address.id) > 1:
                reader.problem("M004", f"Id {address.id!r} is used by two choices of this List", child, "Id")
    default = node.get("Default")
    if default is not None and default not in ids:
        reader.problem("M008", f"Default {default!r} is none of the choices: {', '.join(ids)}", node, "Default")
    description = text_of(node, "Description")
    return ErrorDetail(node.get("Name", ""), control, description, addresses, default, wordings_of(node))


def _address(reader: Reader, node: etree._Element, control: Control, inherited: bool) -> ErrorAddress:
    kind = cast(Kind, node.get("Type"))
    assert kind in get_args(Kind)
    optional = {key: None if (text := node.get(key)) is None else number_of(text) for key in _NUMBERS}
    width = optional["Width"] if optional["Width"] is not None else FIELD_WIDTH[kind]
    address = ErrorAddress(
        id=node.get("Id", ""),
        description=text_of(node, "Description"),
        location=reader.place(node, "Address", bits=1 if kind == "Bit" else 16),
        text=node.get("Address", ""),
        kind=kind,
        shift=optional["Shift"] or 0,
        width=width,
        value=optional["Value"],
        minimum=optional["Min"],
        maximum=optional["Max"],
        base=16 if node.get("Base") == "16" else 10,
        default=optional["Default"],
        add_to_code=inherited if (own := node.get("AddToErrorCode")) is None else own in ("true", "1"),
        wordings=wordings_of(node),
    )
    _check_numbers(reader, node, control, address)
    _check_place(reader, node, address)
    return address


_NUMBERS = ("Shift", "Width", "Value", "Min", "Max", "Default")


def _check_numbers(reader: Reader, node: etree._Element, control: Control, address: ErrorAddress) -> None:
    if address.shift + address.width > 16 or address.width < 1:
        reader.problem("M007", f"bits {address.shift} to {address.shift + address.width - 1} are not in one word", node)
        return
    if control == "List":
        if address.value is None and (address.kind != "Bit" or address.add_to_code):
            reader.problem("M008", "this choice writes or adds a number and needs a Value", node)
    elif address.kind == "Bit":
        reader.problem("M008", f"a {control} takes a number, a Bit has none: use a List, or another Type", node, "Type")
    elif address.minimum is None or address.maximum is None:
        reader.problem("M008", f"a {control} needs Min and Max", node)
    elif address.minimum > address.maximum:
        reader.problem("M007", f"Min {address.minimum} is greater than Max {address.maximum}", node, "Min")
    elif address.default is not None and not address.minimum <= address.default <= address.maximum:
        message = f"Default {address.default} is not in {address.minimum} to {address.maximum}"
        reader.problem("M007", message, node, "Default")
    if address.kind in ("Bit", "BitArray"):
        return  # the number says which bit, or only adds to the code
    largest = (10 ** (address.width // 4) if address.kind == "BCD" else 1 << address.width) - 1
    for attribute, number in (("Value", address.value), ("Max", address.maximum)):
        if number is not None and number > largest:
            message = f"{attribute} {number} does not fit into {address.width} bits as {address.kind}"
            reader.problem("M007", message, node, attribute)


def _check_place(reader: Reader, node: etree._Element, address: ErrorAddress) -> None:
    if address.location is None:
        if not address.text and not address.add_to_code:
            reader.problem("M008", "an ErrorAddress needs an Address, or adds to the error code", node)
        return
    number = address.maximum if address.value is None else address.value
    words = (number or 0) // 16 + 1 if address.kind == "BitArray" else 1
    reader.engine_writes(node, "Address", address.location, words)
