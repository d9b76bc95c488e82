"""Tags, parameters and data types of L5X -> declarations."""

from collections.abc import Iterable, Iterator

from scanbench.syntax.l5x import notes
from scanbench.syntax.l5x.elements import OPEN
from scanbench.syntax.l5x.names import name_of, type_name
from scanbench.syntax.l5x.values import members_of, sizes_of, start_value, structure_in
from scanbench.syntax.xml_tree import Element, attribute, child, children, text_of

INDENT = "    "
ENABLED = ("EnableIn", "EnableOut")
"""Parameters of each Add-On Instruction: in Structured Text it is always enabled."""


def dimensions_of(node: Element) -> list[int]:
    """Of a tag (`2 3`, `2,3`) or of a member (`Dimension`); none where it is no array."""
    return sizes_of(attribute(node, "Dimensions") or attribute(node, "Dimension"))


def sizes_here(node: Element) -> list[int]:
    """The dimensions, each `OPEN` of an `InOut` parameter: it takes arrays of any size, and its own is a placeholder."""
    sizes = dimensions_of(node)
    return [OPEN] * len(sizes) if attribute(node, "Usage") == "InOut" else sizes


def spec(type: str, sizes: Iterable[int]) -> str:
    """The type as it is declared here; arrays of Logix begin with 0."""
    ranges = ", ".join("*" if size == OPEN else f"0..{size - 1}" for size in sizes)
    return f"ARRAY[{ranges}] OF {type_name(type)}" if ranges else type_name(type)


def line_of_tag(node: Element, told: list[str]) -> str:
    """One variable, with its start value and its description; a value that is not read is added to `told`."""
    lost: list[str] = []
    initial = start_value(node, lost) or ("TRUE" if attribute(node, "Name") in ENABLED else "")
    comment = " ".join(text_of(child(node, "Description")).split())
    if lost:
        told.append(notes.lost_value(attribute(node, "Name"), lost[0]))
    if attribute(node, "TagType") in ("Produced", "Consumed"):
        comment = " ".join((comment, "(exchanged with another controller, which there is not here)")).strip()
    declared = f"{name_of(attribute(node, 'Name'))} : {spec(attribute(node, 'DataType'), sizes_here(node))}"
    return f"{INDENT}{declared}{f' := {initial}' if initial else ''};{f' // {comment}' if comment else ''}\n"


def section(words: str, tags: Iterable[Element], told: list[str]) -> str:
    """A section of variables; empty without one."""
    lines = "".join(line_of_tag(each, told) for each in tags)
    return f"{words}\n{lines}END_VAR\n" if lines else ""


def sections(words: str, tags: Iterable[Element], told: list[str]) -> str:
    """The same, what never changes apart."""
    own = [each for each in tags if attribute(each, "TagType", "Base") != "Alias"]
    constants = [each for each in own if attribute(each, "Constant") == "true"]
    return section(f"{words} RETAIN", (each for each in own if each not in constants), told) + section(
        f"{words} CONSTANT", constants, told
    )


def data_type(node: Element) -> str:
    """A `DataType`: a structure, of which bits are members of their own, and texts are their length and characters."""
    lines = "".join(
        f"{INDENT}{name_of(attribute(each, 'Name'))} : {spec(attribute(each, 'DataType'), dimensions_of(each))};\n"
        for each in children(child(node, "Members"), "Member")
        if attribute(each, "Hidden") != "true"
    )
    return f"{name_of(attribute(node, 'Name'))} : STRUCT\n{lines}END_STRUCT;\n"


def types_of_data(tags: Iterable[Element], known: set[str]) -> Iterator[str]:
    """The types that are defined nowhere in the file, those of modules for example, as the data of their tags shows them.

    `known`: names in upper case; what is made is added.
    """
    for tag in tags:
        structure = structure_in(tag)
        if structure is not None:
            yield from _type_of(structure, known)


def _type_of(structure: Element, known: set[str]) -> Iterator[str]:
    name = attribute(structure, "DataType")
    if name.upper() in known or "." in type_name(name):
        return
    known.add(name.upper())
    lines = ""
    for member, type, dimensions, element in members_of(structure):
        inner = child(element, "Element", "Structure") if child(element, "Element") is not None else element
        if inner is not None and next(members_of(inner), None) is not None:
            yield from _type_of(inner, known)
        lines += f"{INDENT}{name_of(member)} : {spec(type, sizes_of(dimensions))};\n"
    yield f"{name_of(name)} : STRUCT\n{lines}END_STRUCT;\n"
