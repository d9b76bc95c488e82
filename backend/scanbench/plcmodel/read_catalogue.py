"""The catalogue part of a model file: groups, errors, details. Checks what the schema cannot say."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, cast, get_args

from lxml import etree

from scanbench.plcmodel.catalogue import (
    CODE_LIMITS,
    Control,
    ErrorAddress,
    ErrorDetail,
    ErrorEntry,
    ErrorGroup,
    Hardware,
    Identifies,
    Kind,
    Severity,
    show_code,
)
from scanbench.plcmodel.document import line_of
from scanbench.plcmodel.overlaps import overlaps
from scanbench.plcmodel.reading import Element, Reader, nearest, number_of, removals, text_of, wordings_of

TEXT_LIMIT = 64
FIELD_WIDTH: dict[Kind, int] = {"Bit": 1, "Nibble": 4, "Byte": 8, "BCD": 16, "Word": 16, "BitArray": 1}


@dataclass(slots=True)
class _Branch:
    """A group while the files that make it are looked through."""

    node: etree._Element | None
    errors: dict[str, Element] = field(default_factory=dict)
    groups: dict[str, "_Branch"] = field(default_factory=dict)

    def walk(self) -> Iterator["_Branch"]:
        """This branch and all below."""
        yield self
        for branch in self.groups.values():
            yield from branch.walk()


def read_catalogue(layers: Sequence[Reader]) -> tuple[tuple[ErrorGroup, ...], dict[str, Element]]:
    """The tree that the layers make together, the base first, and where each error was read.

    An error with an id of the base's takes its place; groups of the same name become one.
    """
    root = _Branch(None)
    for reader in layers:
        inherited = {id: branch for branch in root.walk() for id in branch.errors}
        left = dict(inherited)
        removals(reader, "Errors", left)
        for id in inherited.keys() - left.keys():
            del inherited[id].errors[id]
        own: dict[str, int] = {}
        for node in reader.root.iterchildren("ErrorGroup"):
            _add(reader, node, root, left, own)
    made = _made(root)
    elements = {id: element for branch in root.walk() for id, element in branch.errors.items()}
    _unique(made, elements)
    return made.groups, elements


def _add(
    reader: Reader, node: etree._Element, parent: _Branch, inherited: dict[str, _Branch], own: dict[str, int]
) -> None:
    branch = parent.groups.setdefault(text_of(node, "Name"), _Branch(node))
    for child in node.iterchildren("Error"):
        id = child.get("Id", "")
        if id in own:
            reader.problem("M004", f"Id {id!r} is used in line {own[id]} already", child, "Id")
            continue
        own[id] = line_of(child)
        inherited.get(id, branch).errors[id] = reader, child
    for child in node.iterchildren("ErrorSubGroup"):
        _add(reader, child, branch, inherited, own)


def _made(branch: _Branch) -> ErrorGroup:
    """The group as data, without groups that have nothing left in them."""
    errors = [_error(*element) for element in branch.errors.values()]
    groups = [_made(each) for each in branch.groups.values()]
    return ErrorGroup(
        name="" if branch.node is None else text_of(branch.node, "Name"),
        groups=tuple(group for group in groups if group.groups or group.errors),
        errors=tuple(error for error in errors if error is not None),
        wordings=() if branch.node is None else wordings_of(branch.node),
    )


def _unique(tree: ErrorGroup, elements: dict[str, Element]) -> None:
    """A pair of code and flag belongs to one error."""
    pairs: dict[tuple[str, str, int, int | None], str] = {}
    for error in tree.walk():
        pair = (error.code_text, error.flag.area.name, error.flag.byte, error.flag.bit)
        if pair in pairs:
            message = f"code {error.code_text} with flag {error.flag_text} belongs to {pairs[pair]!r} already"
            if not error.coded:
                message = f"flag {error.flag_text} without a code belongs to {pairs[pair]!r} already"
            reader, node = elements[error.id]
            reader.problem("M005", message, node, "ErrorCode" if error.coded else "ErrorFlag")
        pairs.setdefault(pair, error.id)


def _error(reader: Reader, node: etree._Element) -> ErrorEntry | None:
    flag = reader.place(node, "ErrorFlag", bits=1)
    inherited = node.get("AddToErrorCode") in ("true", "1")
    details = tuple(_detail(reader, control, inherited) for control in node.iter("ErrorControl"))
    names = [detail.name for detail in details]
    for name in {name for name in names if names.count(name) > 1}:
        reader.problem("M004", f"two details are named {name!r}", node)
    added = sum(_largest_addition(detail) for detail in details)
    coded = node.get("ErrorCode") is not None
    if added and not coded:
        reader.problem("M008", "an error without an ErrorCode has nothing that a detail could add to", node)
    code = _code(reader, node, added) if coded else 0
    also = tuple(_also(reader, child, details) for child in node.iterchildren("Also"))
    for message in overlaps(flag, node.get("ErrorFlag", ""), details, also):
        reader.problem("M007", message, node)
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
        also=also,
        form=reader.code_form,
        wordings=wordings_of(node),
        lasting=node.get("Cause") == "lasting",
        hardware=cast(Hardware, node.get("Hardware", "")),
        hardware_number=None if (number := node.get("HardwareNumber")) is None else int(number),
        coded=coded,
    )


def _code(reader: Reader, node: etree._Element, added: int) -> int:
    text, form = node.get("ErrorCode", ""), reader.code_form
    if form == "decimal" and not text.isdigit():
        reader.problem("M007", f"{text!r} is not decimal, as the codes of this model are", node, "ErrorCode")
        return 0
    if form != "decimal" and len(text) != int(form[3:]):
        message = f"{text!r} has {len(text)} digits, the codes of this model have {form[3:]}"
        reader.problem("M007", message, node, "ErrorCode")
        return 0
    code = int(text, 10 if form == "decimal" else 16)
    if code + added > CODE_LIMITS[form]:
        largest, limit = show_code(code + added, form), show_code(CODE_LIMITS[form], form)
        message = f"with its details added the error code can grow to {largest}, beyond {limit}"
        reader.problem("M007", message, node, "ErrorCode")
    return code


def _also(reader: Reader, node: etree._Element, details: Sequence[ErrorDetail]) -> ErrorAddress:
    """A bit, a fixed value, or the number of a detail."""
    address = _read_address(reader, node, inherited=False)
    address = replace(address, id=node.get("Detail", ""))
    numbers = {detail.name: detail.addresses[0] for detail in details if detail.control != "List"}
    if address.id and address.id not in numbers:
        message = f"there is no detail {address.id!r} that is a number{nearest(address.id, numbers)}"
        reader.problem("M010", message, node, "Detail")
        return address
    if (address.kind == "Bit") == bool(address.id or address.value is not None) or (address.id and address.value):
        reader.problem(
            "M008", "an Also is a Bit without more, or has a Value, or the Detail whose number it takes", node
        )
        return address
    if address.id:
        address = replace(address, minimum=numbers[address.id].minimum, maximum=numbers[address.id].maximum)
    _check_width(reader, node, address)
    _check_place(reader, node, address)
    return address


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
    return ErrorDetail(
        node.get("Name", ""), control, description, addresses, default, wordings_of(node),
        cast(Identifies, node.get("Identifies", "")), cast(Hardware, node.get("Hardware", "")),
        node.get("Absent") in ("true", "1"),
    )  # fmt: skip


def _address(reader: Reader, node: etree._Element, control: Control, inherited: bool) -> ErrorAddress:
    address = _read_address(reader, node, inherited)
    _check_control(reader, node, control, address)
    _check_width(reader, node, address)
    _check_place(reader, node, address)
    return address


def _read_address(reader: Reader, node: etree._Element, inherited: bool) -> ErrorAddress:
    kind = cast(Kind, node.get("Type"))
    assert kind in get_args(Kind)
    optional = {key: None if (text := node.get(key)) is None else number_of(text) for key in _NUMBERS}
    width = optional["Width"] if optional["Width"] is not None else FIELD_WIDTH[kind]
    return ErrorAddress(
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
        base=_BASES[node.get("Base", "10")],
        default=optional["Default"],
        add_to_code=inherited if (own := node.get("AddToErrorCode")) is None else own in ("true", "1"),
        wordings=wordings_of(node),
        lasting=node.get("Cause") == "lasting",
    )


_BASES: dict[str, Literal[0, 10, 16]] = {"text": 0, "10": 10, "16": 16}
_NUMBERS = ("Shift", "Width", "Value", "Min", "Max", "Default")


def _check_control(reader: Reader, node: etree._Element, control: Control, address: ErrorAddress) -> None:
    if address.is_text:
        _check_text(reader, node, control, address)
    elif control == "List":
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
    if control != "List" and address.value is not None:
        reader.problem("M008", f"a {control} writes what is entered: it has no Value", node, "Value")


def _check_text(reader: Reader, node: etree._Element, control: Control, address: ErrorAddress) -> None:
    if control != "Edit" or address.kind != "Word" or address.location is None:
        reader.problem("M008", "a text belongs into an Edit, with an Address and Type Word", node, "Base")
    elif not 1 <= (address.maximum or 0) <= TEXT_LIMIT:
        reader.problem("M008", f"a text needs Max, its most characters: 1 to {TEXT_LIMIT}", node)
    unfit = [name for name in ("Shift", "Width", "Value", "Min", "Default") if node.get(name) is not None]
    for name in unfit:
        reader.problem("M008", f"a text has no {name}", node, name)
    if address.add_to_code:
        reader.problem("M008", "a text cannot be added to the error code", node)


def _check_width(reader: Reader, node: etree._Element, address: ErrorAddress) -> None:
    if address.kind in ("Bit", "BitArray") or address.is_text:
        return  # the number says which bit, or only adds to the code; a text is as wide as it says
    if address.shift + address.width > 16 or address.width < 1:
        last = address.shift + address.width - 1
        reader.problem("M007", f"bits {address.shift} to {last} are not in one word", node)
        return
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
    if address.is_text:
        words = ((number or 0) + 1) // 2
    reader.engine_writes(node, "Address", address.location, words)
