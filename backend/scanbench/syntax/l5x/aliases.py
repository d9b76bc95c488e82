"""Alias tags and alias parameters: what they are written for."""

import re
from collections.abc import Iterable

from scanbench.syntax.imported import Read
from scanbench.syntax.l5x import notes
from scanbench.syntax.l5x.elements import NUMBERS, element
from scanbench.syntax.l5x.known import Known
from scanbench.syntax.l5x.names import name_of
from scanbench.syntax.l5x.statements import statements
from scanbench.syntax.xml_tree import Element, attribute

_BIT = re.compile(r"\.([0-9]+|\[\w+\])\s*$")


def aliases(tags: Iterable[Element]) -> dict[str, str]:
    """What each alias is written for, by its name in upper case."""
    return {attribute(each, "Name").upper(): attribute(each, "AliasFor") for each in tags if is_alias(each)}


def is_alias(tag: Element) -> bool:
    return attribute(tag, "TagType") == "Alias" and bool(attribute(tag, "AliasFor"))


def typed(parameters: list[Element], locals: Iterable[Element], known: Known, told: list[str]) -> list[Element]:
    """The parameters, of which aliases get the type of what they are written for: exports leave it out. One whose type is not found
    is left out, and told."""
    arrays = {attribute(each, "Name").upper(): attribute(each, "Dimensions") for each in locals}
    made = []
    for each in parameters:
        if is_alias(each) and not attribute(each, "DataType"):
            target = attribute(each, "AliasFor")
            type = _type_of(target, known)
            if not type:
                told.append(notes.no_alias_type(attribute(each, "Name"), target))
                continue
            each.set("DataType", type)
            each.set("Dimensions", arrays.get(target.upper(), ""))
        made.append(each)
    return made


def _type_of(target: str, known: Known) -> str:
    """In upper case; empty where the file does not show it."""
    bit = _BIT.search(target)
    found = element(target[: bit.start()] if bit else target, known)
    if found is None:
        return ""
    if bit:
        return "BOOL" if found.type in NUMBERS else ""
    return found.type


def with_aliases(body: str, parameters: Iterable[Element], known: Known, read: Read) -> str:
    """The body with what alias parameters give to their members before it, and get from them after it."""
    found = [each for each in parameters if is_alias(each)]
    if found and re.search(r"(?i)\bRETURN\b", body):
        read.notes += [notes.alias_parameter(attribute(each, "Name")) for each in found]
        return body
    before, after = "", ""
    for each in found:
        name, target = name_of(attribute(each, "Name")), statements(attribute(each, "AliasFor"), known, read.notes)
        if attribute(each, "Usage") == "Input":
            before += f"{target} := {name};\n"
        after += f"{name} := {target};\n"
    return f"{before}{body}{after}"
