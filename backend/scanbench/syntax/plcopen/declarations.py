"""Types and variables of a PLCopen file -> declarations."""

import re
from collections.abc import Iterator

from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, text_of

SECTIONS = {
    "inputVars": "VAR_INPUT", "outputVars": "VAR_OUTPUT", "inOutVars": "VAR_IN_OUT", "localVars": "VAR",
    "tempVars": "VAR_TEMP", "externalVars": "VAR_EXTERNAL", "globalVars": "VAR_GLOBAL",
}  # fmt: skip
INDENT = "    "
_ISO = re.compile(r"P(?:(\d+)D)?T?(?:(\d+)H)?(?:(\d+)M)?(?:(\d+(?:\.\d+)?)S)?$")


def type_text(node: Element | None) -> str:
    """A type as it is written in ST, of the element around it (`type`, `baseType`, `returnType`)."""
    for each in children(node):
        match kind(each):
            case "derived":
                return attribute(each, "name")
            case "string" | "wstring" as name:
                length = attribute(each, "length")
                return f"{name.upper()}[{length}]" if length else name.upper()
            case "array":
                ranges = ", ".join(
                    f"{attribute(one, 'lower')}..{attribute(one, 'upper')}" for one in children(each, "dimension")
                )
                return f"ARRAY[{ranges}] OF {type_text(child(each, 'baseType'))}"
            case "subrangeSigned" | "subrangeUnsigned":
                limits = child(each, "range")
                return (
                    f"{type_text(child(each, 'baseType'))}({attribute(limits, 'lower')}..{attribute(limits, 'upper')})"
                )
            case "pointer":
                return f"POINTER TO {type_text(child(each, 'baseType'))}"
            case "enum":
                base = child(each, "baseType")
                return f"{f'{type_text(base)} ' if base is not None else ''}({', '.join(_enumerated(each))})"
            case "struct":
                members = "".join(f"{INDENT}{line}\n" for line in variable_lines(each))
                return f"STRUCT\n{members}END_STRUCT"
            case "addData" | "documentation":
                continue
            case name:
                return name.upper()
    return "BOOL"


def _enumerated(node: Element) -> Iterator[str]:
    for each in children(child(node, "values"), "value"):
        value = attribute(each, "value")
        yield attribute(each, "name") + (f" := {value}" if value else "")


def initial_text(node: Element | None) -> str:
    """A start value; empty without one."""
    for each in children(node):
        match kind(each):
            case "simpleValue":
                return attribute(each, "value")
            case "arrayValue":
                return f"[{', '.join(_repeated(one) for one in children(each, 'value'))}]"
            case "structValue":
                members = (f"{attribute(one, 'member')} := {initial_text(one)}" for one in children(each, "value"))
                return f"({', '.join(members)})"
    return ""


def _repeated(node: Element) -> str:
    times = attribute(node, "repetitionValue", "1")
    return initial_text(node) if times == "1" else f"{times}({initial_text(node)})"


def variable_lines(section: Element) -> Iterator[str]:
    for each in children(section, "variable"):
        address, initial = attribute(each, "address"), initial_text(child(each, "initialValue"))
        comment = " ".join(text_of(child(each, "documentation")).split())
        yield (
            f"{attribute(each, 'name')}{f' AT {address}' if address else ''} : {type_text(child(each, 'type'))}"
            f"{f' := {initial}' if initial else ''};{f' // {comment}' if comment else ''}"
        )


def sections_text(interface: Element | None) -> str:
    """The variables of a POU, or global ones."""
    return "".join(section_text(each) for each in children(interface, *SECTIONS))


def section_text(section: Element) -> str:
    """One section; empty without a variable."""
    lines = "".join(f"{INDENT}{line}\n" for line in variable_lines(section))
    words = [word.upper() for word in ("constant", "retain", "persistent") if attribute(section, word) == "true"]
    if attribute(section, "nonretain") == "true":
        words.append("NON_RETAIN")
    return f"{' '.join((SECTIONS[kind(section)], *words))}\n{lines}END_VAR\n" if lines else ""


def type_declaration(node: Element) -> str:
    """A `dataType`."""
    initial = initial_text(child(node, "initialValue"))
    return f"{attribute(node, 'name')} : {type_text(child(node, 'baseType'))}{f' := {initial}' if initial else ''};\n"


def duration_text(written: str) -> str:
    """An interval of a task: as in ST, or as XML writes it, `PT0.02S`."""
    found = _ISO.match(written)
    if written.startswith("P") and found is not None:
        days, hours, minutes, seconds = (float(each or 0) for each in found.groups())
        ms = round(1000 * (seconds + 60 * (minutes + 60 * (hours + 24 * days))))
        return f"T#{ms}ms"
    return written if "#" in written else f"T#{written}"
