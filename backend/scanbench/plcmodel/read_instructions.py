"""The instructions of a model file: those that raise errors, those that clear them, those that tell of them, and messages."""

from collections.abc import Sequence
from dataclasses import replace

from lxml import etree

from scanbench.plcmodel.areas import Location
from scanbench.plcmodel.catalogue import ErrorEntry
from scanbench.plcmodel.model import Instruction, MessageInstruction, QueryInstruction, ResetInstruction, TextPlace
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
            found += [instruction, *_ranges(reader, node, instruction, errors)]
    return tuple(found)


def _ranges(
    reader: Reader, node: etree._Element, first: Instruction, errors: dict[str, ErrorEntry]
) -> list[Instruction]:
    """The further ranges of an instruction, each with its own error."""
    found: list[Instruction] = []
    for part, child in enumerate(node.iterchildren("Range"), 1):
        limits = _limits(reader, child, errors)
        if limits is None:
            continue
        error, low, high = limits
        if any(low <= other.maximum and other.minimum <= high for other in (first, *found)):
            reader.problem("M004", f"{low} to {high} meets numbers of {first.name} that have an error already", child)
        found.append(
            replace(first, error=error, minimum=low, maximum=high, part=part, clears=None, texts=None, text="")
        )
    return found


def _nodes(layers: Sequence[Reader], tag: str) -> list[Element]:
    return [each for each in merged(layers, "Instructions/*", "Name", "Instructions").values() if each[1].tag == tag]


def _instruction(reader: Reader, node: etree._Element, errors: dict[str, ErrorEntry]) -> Instruction | None:
    limits = _limits(reader, node, errors)
    if limits is None:
        return None
    id, low, high = limits
    clears = None if (text := node.get("Clears")) is None else number_of(text)
    if clears is not None and low <= clears <= high:
        reader.problem("M007", f"{clears} cannot both raise the error and clear it", node, "Clears")
    return Instruction(
        name=node.get("Name", ""),
        error=id,
        parameter=node.get("Parameter", ""),
        detail=node.get("Detail", ""),
        minimum=low,
        maximum=high,
        clears=clears,
        description=text_of(node, "Description"),
        source=node.get("Source", ""),
        verified=node.get("Verified") == "yes",
        selector=node.get("Selector", ""),
        information=node.get("Information", ""),
        system_errors=_system_errors(reader, node),
        text=node.get("Text", ""),
        texts=_texts(reader, node, high),
    )


def _limits(reader: Reader, node: etree._Element, errors: dict[str, ErrorEntry]) -> tuple[str, int, int] | None:
    """The error of an instruction or of a range of it, and its numbers."""
    parent = node.getparent()
    names = node if node.get("Detail") is not None or parent is None else parent
    id, detail = node.get("Error", ""), names.get("Detail", "")
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
    if low > high:
        reader.problem("M007", f"Min {low} is greater than Max {high}", node, "Min")
    lowest, highest = known.addresses[0].minimum, known.addresses[0].maximum
    # Limits of the detail that make no sense have been told.
    if lowest is not None and highest is not None and lowest <= highest and not lowest <= low <= high <= highest:
        message = f"{low} to {high} is more than detail {detail} takes: {lowest} to {highest}"
        reader.problem("M007", message, node, "Min" if low < lowest else "Max")
    return id, low, high


def _texts(reader: Reader, node: etree._Element, highest: int) -> TextPlace | None:
    """Where texts are kept, one for each number up to the highest."""
    given = [name for name in ("Text", "Texts", "TextWords") if node.get(name) is not None]
    if 0 < len(given) < 3:
        reader.problem(
            "M010", "a text needs Text (the parameter), Texts (its first word) and TextWords", node, given[0]
        )
        return None
    first = reader.place(node, "Texts", bits=16)
    words = int(node.get("TextWords", "0"))
    if first is None or not reader.engine_writes(node, "Texts", first, words * (highest + 1)):
        return None
    return TextPlace(first, words)


def _system_errors(reader: Reader, node: etree._Element) -> Location | None:
    given = [name for name in ("Selector", "Information", "SystemErrors") if node.get(name) is not None]
    if "SystemErrors" in given and len(given) < 3:
        message = "SystemErrors needs the parameters Selector (the code) and Information (its detail word)"
        reader.problem("M010", message, node, "SystemErrors")
    names = [node.get(name, "").upper() for name in ("Parameter", "Selector", "Information", "Text") if node.get(name)]
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
            code = node.get("Code", "")
            found.append(ResetInstruction(node.get("Name", ""), flags, description, source, verified, code))
    return tuple(found)


def queries(layers: Sequence[Reader]) -> tuple[QueryInstruction, ...]:
    """Every instruction that tells of errors."""
    found: list[QueryInstruction] = []
    for reader, node in _nodes(layers, "Query"):
        flags, code = reader.place(node, "Flags", bits=16), reader.place(node, "Code", bits=16)
        bits, levels = (tuple(map(int, node.get(name, "").split())) for name in ("Bits", "Levels"))
        if len(bits) != len(levels):
            reader.problem("M010", f"{len(bits)} Bits need as many Levels, there are {len(levels)}", node, "Levels")
        if flags is None or code is None or not reader.engine_writes(node, "Code", code, 2):
            continue
        made = QueryInstruction(
            node.get("Name", ""), flags, bits, levels, code._replace(bits=32), node.get("LevelType", "UINT"),
            node.get("CodeType", "DWORD"), text_of(node, "Description"), node.get("Source", ""),
            node.get("Verified") == "yes",
        )  # fmt: skip
        found.append(made)
    return tuple(found)


def message_instructions(layers: Sequence[Reader]) -> tuple[MessageInstruction, ...]:
    """Every instruction that shows a text."""
    found: list[MessageInstruction] = []
    for reader, node in _nodes(layers, "Message"):
        low, high = number_of(node.get("Min", "0")), number_of(node.get("Max", "0"))
        texts = _texts(reader, node, high)
        if low > high:
            reader.problem("M007", f"Min {low} is greater than Max {high}", node, "Min")
        elif texts is not None:
            made = MessageInstruction(
                node.get("Name", ""), node.get("Parameter", ""), node.get("Text", ""), low, high, texts,
                text_of(node, "Description"), node.get("Source", ""), node.get("Verified") == "yes",
            )  # fmt: skip
            found.append(made)
    return tuple(found)
