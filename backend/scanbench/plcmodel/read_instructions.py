"""The instructions of a model file: those that raise errors, and those that clear them."""

from collections.abc import Sequence

from lxml import etree

from scanbench.plcmodel.areas import Location
from scanbench.plcmodel.catalogue import ErrorEntry
from scanbench.plcmodel.model import Instruction, ResetInstruction
from scanbench.plcmodel.reading import Element, Reader, merged, nearest, number_of, text_of


def instructions(layers: Sequence[Reader], errors: dict[str, ErrorEntry]) -> tuple[Instruction, ...]:
    """Every instruction; one with the name of the base's takes its place. `errors` by id."""
    found: list[Instruction] = []
    for reader, node in _nodes(layers, "Instruction"):
        name = node.get("Name", "")
        if any(other.name.upper() == name.upper() for other in found):
            reader.problem("M004", f"Instruction {name!r} is there twice", node, "Name")
        instruction = _instruction(reader, node, errors)
        if instruction is not None:
            found.append(instruction)
    return tuple(found)


def _nodes(layers: Sequence[Reader], tag: str) -> list[Element]:
    return [each for each in merged(layers, "Instructions/*", "Name", "Instructions").values() if each[1].tag == tag]


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
        selector=node.get("Selector", ""),
        information=node.get("Information", ""),
        system_errors=_system_errors(reader, node),
    )


def _system_errors(reader: Reader, node: etree._Element) -> Location | None:
    given = [name for name in ("Selector", "Information", "SystemErrors") if node.get(name) is not None]
    if "SystemErrors" in given and len(given) < 3:
        message = "SystemErrors needs the parameters Selector (the code) and Information (its detail word)"
        reader.problem("M010", message, node, "SystemErrors")
    names = [node.get(name, "").upper() for name in ("Parameter", "Selector", "Information") if node.get(name)]
    if len(set(names)) < len(names):
        reader.problem("M004", f"two parameters of {node.get('Name')} have one name", node)
    return reader.place(node, "SystemErrors", bits=16)


def resets(layers: Sequence[Reader]) -> tuple[ResetInstruction, ...]:
    """Every instruction that clears errors."""
    found: list[ResetInstruction] = []
    for reader, node in _nodes(layers, "Reset"):
        flags = reader.place(node, "Flags", bits=16)
        if flags is not None:
            description, source = text_of(node, "Description"), node.get("Source", "")
            verified = node.get("Verified") == "yes"
            found.append(ResetInstruction(node.get("Name", ""), flags, description, source, verified))
    return tuple(found)
