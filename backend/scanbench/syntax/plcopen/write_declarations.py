"""Declarations -> types and variables of a PLCopen file."""

from collections.abc import Iterable

from scanbench.syntax import tree
from scanbench.syntax.plcopen.write_objects import CannotWrite, add, text
from scanbench.syntax.xml_tree import Element

SECTIONS = {
    "VAR_INPUT": "inputVars", "VAR_OUTPUT": "outputVars", "VAR_IN_OUT": "inOutVars", "VAR": "localVars",
    "VAR_TEMP": "tempVars", "VAR_EXTERNAL": "externalVars", "VAR_GLOBAL": "globalVars",
}  # fmt: skip
ELEMENTARY = frozenset(
    "BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL TIME DATE DT TOD STRING WSTRING".split()
)
SHORT = {"TIME_OF_DAY": "TOD", "DATE_AND_TIME": "DT"}


def write_type(parent: Element, spec: tree.TypeSpec) -> None:
    """The type as the content of an element."""
    match spec:
        case tree.NamedType(name):
            known = SHORT.get(name.upper(), name.upper())
            if known in ("STRING", "WSTRING"):
                add(parent, known.lower())
            elif known in ELEMENTARY:
                add(parent, known)
            else:
                add(parent, "derived", name=name)
        case tree.StringSpec(length, wide=wide):
            kind = "wstring" if wide else "string"
            add(parent, kind, **({"length": text(length)} if length is not None else {}))
        case tree.ArraySpec(ranges, element):
            made = add(parent, "array")
            for low, high in ranges:
                add(made, "dimension", lower=text(low), upper=text(high))
            write_type(add(made, "baseType"), element)
        case tree.StructSpec(members, union=False, extends=None):
            made = add(parent, "struct")
            for member in members:
                write_variable(made, member)
        case tree.EnumSpec(values, base):
            made = add(parent, "enum")
            listed = add(made, "values")
            for name, value, _ in values:
                add(listed, "value", name=name, **({"value": text(value)} if value is not None else {}))
            if base is not None:
                write_type(add(made, "baseType"), base)
        case tree.SubrangeSpec(base, low, high):
            signed = "subrangeUnsigned" if base.name.upper().startswith("U") else "subrangeSigned"
            made = add(parent, signed)
            add(made, "range", lower=text(low), upper=text(high))
            write_type(add(made, "baseType"), base)
        case tree.ReferenceSpec(target, pointer=True):
            write_type(add(add(parent, "pointer"), "baseType"), target)
        case _:
            raise CannotWrite(f"the type {text(spec)}")


def write_initial(parent: Element, initial: tree.Initial) -> None:
    """A start value as the content of an element."""
    match initial:
        case tree.ArrayInit(items):
            made = add(parent, "arrayValue")
            for times, item in items:
                write_initial(
                    add(made, "value", **({"repetitionValue": text(times)} if times is not None else {})), item
                )
        case tree.StructInit(parts=parts) if parts:
            raise CannotWrite("the start values of a data block")
        case tree.StructInit(members):
            made = add(parent, "structValue")
            for name, item, _ in members:
                write_initial(add(made, "value", member=name), item)
        case _:
            add(parent, "simpleValue", value=text(initial))


def write_variable(parent: Element, variable: tree.Variable) -> None:
    if variable.arguments or variable.elements or variable.edge:
        raise CannotWrite(f"the declaration of {variable.name}")
    address = {"address": variable.address} if variable.address else {}
    made = add(parent, "variable", name=variable.name, **address)
    write_type(add(made, "type"), variable.type)
    if variable.initial is not None:
        write_initial(add(made, "initialValue"), variable.initial)


def write_sections(parent: Element, sections: Iterable[tree.VariableSection]) -> None:
    """What a person declared; what the parser added for edges and steps is made again when the file is read."""
    for section in sections:
        own = [each for each in section.variables if each.name[0] not in "$#" and not _is_step(each)]
        if section.keyword not in SECTIONS or section.kept:
            raise CannotWrite(section.kept or section.keyword)
        if not own:
            continue
        marks = {word.lower(): "true" for word in section.qualifiers if word in ("CONSTANT", "RETAIN", "PERSISTENT")}
        if "NON_RETAIN" in section.qualifiers:
            marks["nonretain"] = "true"
        made = add(parent, SECTIONS[section.keyword], **marks)
        for each in own:
            write_variable(made, each)


def _is_step(variable: tree.Variable) -> bool:
    return isinstance(variable.type, tree.NamedType) and variable.type.name == "SFC_STEP"
